//! The second-order conditions at the end of a solve.

use righting_ipopt::SolveError;
use righting_nlp::{AugmentedSystem, Declarations, Factorization, LinearSolver, NlpError, Problem};

use crate::error::OcpError;
use crate::kkt::StageKkt;
use crate::nlp::MultipleShooting;
use crate::point::Point;
use crate::samples::Samples;

/// By how much Ipopt relaxes bounds, relative to their size (`bound_relax_factor`).
const RELAXED: f64 = 1e-8;
/// What is first added to the diagonal to find a way down.
const FIRST_SHIFT: f64 = 1e-6;
/// How much more each time that it is not enough.
const SHIFT_GROWTH: f64 = 2.0;
/// Shifts tried: up to 1e12.
const SHIFTS: usize = 60;
/// Inverse iterations; the shift is less than twice the curvature sought.
const INVERSE_ITERATIONS: usize = 20;

/// How the Lagrangian curves along the constraints, those in force held.
///
/// With Σ the barrier terms of bounds and inequalities, the matrix
///
/// ```text
/// ⎡ W + Σ_x          J_cᵀ   J_dᵀ ⎤
/// ⎢          Σ_s            −I   ⎥
/// ⎢ J_c                          ⎥
/// ⎣ J_d     −I                   ⎦
/// ```
///
/// has one negative eigenvalue a constraint, and none that is zero, exactly where the reduced
/// Hessian of the barrier problem is positive definite (Gould, *Mathematical Programming* 32, 1985).
/// Ipopt looks at the matrix of every step it takes, but not at that of the point it returns.
#[derive(Debug, Clone, PartialEq)]
pub enum Curvature {
    /// Upwards in every direction: a first-order point is a strict local minimum.
    Upward,
    /// Downwards in some direction: a first-order point is a saddle or a maximum.
    Downward {
        /// The steepest such direction to first order, as changes of the controls, one row a step.
        /// Its sign means nothing, its largest entry is one.
        controls: Samples,
    },
    /// Not at all in some direction, as far as the numbers tell.
    Flat,
}

impl MultipleShooting<'_> {
    /// How the Lagrangian curves at `point`: one evaluation of the second derivatives and one
    /// factorisation by stages, and a few more where it does not curve upwards.
    ///
    /// # Errors
    /// [`OcpError::Dimension`] when the point belongs to another problem or grid,
    /// [`OcpError::Solve`] when the stage solver refuses the system.
    pub fn curvature(&mut self, point: &Point) -> Result<Curvature, OcpError> {
        if point.layout != self.layout() {
            return Err(OcpError::Dimension {
                what: "point",
                expected: self.layout().variables(),
                found: point.z.len(),
            });
        }
        let mut system = BarrierSystem::at(self, point).map_err(SolveError::Invalid)?;
        let constraints = self.layout().constraints();
        let upward = Factorization::Regular { negative_eigenvalues: constraints };
        let mut stages = StageKkt::new(&self.stage_dims()).stop_at_excess();
        stages
            .analyse(system.matrix.order(), system.matrix.rows(), system.matrix.columns())
            .map_err(SolveError::LinearSolver)?;
        if stages.factor(system.matrix.values()) == upward {
            return Ok(Curvature::Upward);
        }
        let mut shift = FIRST_SHIFT;
        for _ in 0..SHIFTS {
            if stages.factor(system.shifted(shift)) == upward {
                system.shifted(0.0);
                return Ok(self.way_down(&system.matrix, &mut stages));
            }
            shift *= SHIFT_GROWTH;
        }
        Ok(Curvature::Flat)
    }

    /// Inverse iteration on the reduced Hessian: with Z a basis of the constraints' null space and
    /// δ the shift, solutions with a right-hand side b of the variables alone are
    /// Z (Zᵀ(W + Σ + δ)Z)⁻¹ Zᵀ b, and turn towards the most negative curvature.
    fn way_down(&self, system: &AugmentedSystem, stages: &mut StageKkt) -> Curvature {
        let layout = self.layout();
        let mut direction = vec![0.0; system.order()];
        // No symmetry of a maneuver leaves this direction alone.
        for (i, value) in direction[..system.variables()].iter_mut().enumerate() {
            *value = (1.0 + i as f64).sin();
        }
        for _ in 0..INVERSE_ITERATIONS {
            direction[system.variables()..].fill(0.0);
            stages.solve(&mut direction);
            let moved = &direction[..system.variables()];
            let largest = moved.iter().fold(0.0_f64, |largest, d| largest.max(d.abs()));
            if !(largest.is_finite() && largest > 0.0) {
                return Curvature::Flat;
            }
            direction.iter_mut().for_each(|d| *d /= largest);
        }
        if system.primal_curvature(&direction) >= 0.0 {
            return Curvature::Flat;
        }
        let of_step = |step| &direction[layout.control(step)];
        let steps = layout.dimensions().steps;
        let largest = (0..steps).flat_map(of_step).fold(0.0_f64, |a, d| a.max(d.abs()));
        let mut controls = Samples::new(layout.dimensions().controls);
        for step in 0..steps {
            let row: Vec<f64> = of_step(step).iter().map(|d| d / largest).collect();
            controls.push(&row);
        }
        Curvature::Downward { controls }
    }
}

/// The augmented system at a point, without regularisation.
struct BarrierSystem {
    matrix: AugmentedSystem,
    /// The barrier terms Σ of variables and slacks.
    sigma: Vec<f64>,
}

impl BarrierSystem {
    fn at(program: &mut MultipleShooting<'_>, point: &Point) -> Result<Self, NlpError> {
        let declared = Declarations::of(program)?;
        let mut matrix = AugmentedSystem::new(&declared);
        // The shooting problem can be evaluated anywhere: its functions have no domain to leave.
        let mut constraint_values = vec![0.0; matrix.constraints()];
        let z = &point.z;
        let _ = program.constraints(z, true, &mut constraint_values);
        let _ = program.jacobian(z, false, matrix.jacobian_mut());
        let _ = program.hessian(z, false, 1.0, &point.constraints, true, matrix.hessian_mut());

        let Declarations { x_lower, x_upper, g_lower, g_upper, .. } = &declared;
        let of_variables = (0..matrix.variables()).map(|i| {
            curvature_of_barrier(point.lower[i], z[i] - x_lower[i], x_lower[i])
                + curvature_of_barrier(point.upper[i], x_upper[i] - z[i], x_upper[i])
        });
        let of_slacks = declared.inequalities().map(|row| {
            let (force, value) = (point.constraints[row], constraint_values[row]);
            curvature_of_barrier(-force, value - g_lower[row], g_lower[row])
                + curvature_of_barrier(force, g_upper[row] - value, g_upper[row])
        });
        let sigma: Vec<f64> = of_variables.chain(of_slacks).collect();
        matrix.diagonal_mut().copy_from_slice(&sigma);
        Ok(Self { matrix, sigma })
    }

    /// The values with `shift` added to the diagonal of the variables.
    fn shifted(&mut self, shift: f64) -> &[f64] {
        let variables = self.matrix.variables();
        let diagonal = self.matrix.diagonal_mut();
        diagonal.copy_from_slice(&self.sigma);
        diagonal[..variables].iter_mut().for_each(|value| *value += shift);
        self.matrix.values()
    }
}

/// Σ = v / d of a bound with multiplier `force` at this distance; zero without a bound.
fn curvature_of_barrier(force: f64, distance: f64, bound: f64) -> f64 {
    if !bound.is_finite() {
        return 0.0;
    }
    let relaxed = RELAXED * bound.abs().max(1.0);
    force.max(0.0) / (distance + relaxed).max(f64::EPSILON)
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;
    use righting_nlp::{Control, Options};

    use super::*;
    use crate::grid::Grid;
    use crate::problem::{ControlProblem, Interval};
    use crate::solve::{Optimizer, Settings};
    use crate::stage::StageFunctions;
    use crate::start::{Guess, Start};

    const STEPS: usize = 10;

    /// x' = u over one second. With all controls equal to u the cost Σ u² − c x(1)² is (N − c) u²,
    /// and along every other direction it curves up more.
    fn pulled_away(pull: f64) -> ControlProblem {
        ControlProblem::new(1, 1, |_, u| vec![u[0]])
            .running_cost(|_, u| u[0].powi(2))
            .terminal_cost(move |x| x[0].powi(2) * -pull)
    }

    /// The curvature where a solve from these controls ends.
    fn curvature_from(problem: &ControlProblem, control: f64) -> (Curvature, f64, usize) {
        let functions = StageFunctions::compile(problem).unwrap();
        let grid = Grid::new(1.0, STEPS).unwrap();
        let mut program = MultipleShooting::new(&functions, grid, &[0.0]).unwrap();
        let mut guess = Guess::constant(&[0.0], 1, STEPS);
        for step in 0..STEPS {
            guess.controls.row_mut(step)[0] = control;
            guess.states.row_mut(step + 1)[0] = control * (step + 1) as f64 / STEPS as f64;
        }
        let settings = Settings {
            ipopt: Options { tolerance: 1e-9, ..Options::default() },
            ..Settings::default()
        };
        let start = Start::Guess(guess);
        let solution = program.solve(&start, &settings, |_| Control::Continue).unwrap();
        assert!(solution.status.is_success(), "{:?}", solution.status);
        let curvature = program.curvature(&solution.point).unwrap();
        assert!(curvature == Curvature::Upward || !solution.curves_upwards);
        let by_interior = Settings { optimizer: Optimizer::Interior, ..settings };
        let solution = program.solve(&start, &by_interior, |_| Control::Continue).unwrap();
        assert_eq!(solution.curves_upwards, curvature == Curvature::Upward);
        (curvature, solution.states.row(STEPS)[0], solution.iterations())
    }

    #[test]
    fn a_minimum_curves_upwards_and_a_saddle_does_not() {
        let least = STEPS as f64;
        let (curvature, _, iterations) = curvature_from(&pulled_away(0.99 * least), 0.0);
        assert_eq!((curvature, iterations), (Curvature::Upward, 0));
        // Ipopt stops at once here too.
        let (curvature, _, iterations) = curvature_from(&pulled_away(1.01 * least), 0.0);
        assert_eq!(iterations, 0);
        let Curvature::Downward { controls } = curvature else { panic!("{curvature:?}") };
        assert_eq!(controls.len(), STEPS);
        let (sum, squares) = controls
            .rows()
            .fold((0.0, 0.0), |(sum, squares), u| (sum + u[0], squares + u[0].powi(2)));
        assert!(squares < 1.01 * least * (sum / least).powi(2), "{controls:?}");
    }

    #[test]
    fn a_minimum_that_only_bounds_hold_is_one() {
        let pulled = || pulled_away(2.0 * STEPS as f64);
        let bounded_control = pulled().control_bounds(Interval::symmetric(&[0.7]));
        let (curvature, end, iterations) = curvature_from(&bounded_control, 0.1);
        assert!((end - 0.7).abs() < 1e-6 && iterations > 0, "{end}");
        assert_eq!(curvature, Curvature::Upward);

        let bounded_state = pulled().state_bounds(Interval::symmetric(&[0.7]));
        let (curvature, end, _) = curvature_from(&bounded_state, 0.1);
        assert!((end - 0.7).abs() < 1e-6, "{end}");
        assert_eq!(curvature, Curvature::Upward);

        let path = pulled().path_constraints(Interval::symmetric(&[0.49]), |x| vec![x[0].powi(3)]);
        let (curvature, end, _) = curvature_from(&path, 0.1);
        assert!((end.powi(3) - 0.49).abs() < 1e-6, "{end}");
        assert_eq!(curvature, Curvature::Upward);
    }

    #[test]
    fn a_saddle_between_bounds_is_none_the_less_one() {
        let pulled = pulled_away(2.0 * STEPS as f64);
        let bounded = pulled.control_bounds(Interval::symmetric(&[0.7]));
        let (curvature, end, _) = curvature_from(&bounded, 0.0);
        assert_eq!(end, 0.0);
        assert!(matches!(curvature, Curvature::Downward { .. }), "{curvature:?}");
    }

    #[test]
    fn a_point_of_another_grid_is_refused() {
        let functions = StageFunctions::compile(&pulled_away(1.0)).unwrap();
        let program = |steps| {
            MultipleShooting::new(&functions, Grid::new(1.0, steps).unwrap(), &[0.0]).unwrap()
        };
        let start = Start::Guess(Guess::constant(&[0.0], 1, 4));
        let solution =
            program(4).solve(&start, &Settings::default(), |_| Control::Continue).unwrap();
        let refused = program(5).curvature(&solution.point);
        assert!(matches!(refused, Err(OcpError::Dimension { what: "point", .. })));
    }
}
