use std::time::Instant;

use righting_nlp::{
    Control, Hessian, Iteration, LinearSolver, MuStrategy, NlpSolution, Options, Problem, Start,
    Status, Timing,
};

use crate::barrier::{keep_near_path, slope};
use crate::filter::Filter;
use crate::line_search::{Taken, Watchdog};
use crate::point::{Point, Step};
use crate::program::{Program, Row};
use crate::start::{Iterate, first};
use crate::system::System;
use crate::{GivesUp, largest};

/// The least fraction to the boundary.
pub(crate) const TAU_MIN: f64 = 0.99;

/// A solution, and what Ipopt does not tell.
#[derive(Debug)]
pub struct Solved {
    /// As Ipopt would return it.
    pub solution: NlpSolution,
    /// Where it converged: whether the augmented system at the solution, not regularised, has one
    /// negative eigenvalue a constraint and none that is zero. Then the Lagrangian curves upwards
    /// along the constraints, those in force held, and the solution is a strict local minimum
    /// (Gould, *Mathematical Programming* 32, 1985).
    pub curves_upwards: bool,
}

/// Solves `problem` from `start` as Ipopt would with these options, `fast_step_computation` among
/// them. `on_iteration` sees every iterate, the start included, and may end the solve.
///
/// # Errors
/// [`GivesUp`] wherever Ipopt has to take over, from the start.
pub fn solve<P, L>(
    problem: &mut P,
    options: &Options,
    start: &Start,
    linear_solver: &mut L,
    on_iteration: impl FnMut(&Iteration) -> Control,
) -> Result<Solved, GivesUp>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    let clock = Instant::now();
    check(problem, options)?;
    let mut program = Program::new(problem, options, start)?;
    let iterate = first(&mut program, options, start)?;
    let system = System::new(linear_solver, &program, options)?;
    let is_cold = start.multipliers.is_none();
    let mut method = Method::new(program, system, options, iterate)?;
    if is_cold {
        method.estimate_multipliers()?;
    }
    let (status, last_iteration) = method.run(on_iteration)?;
    let curves_upwards = status.is_success() && method.curves_upwards()?;
    Ok(Solved { solution: method.into_solution(status, last_iteration, clock), curves_upwards })
}

/// Options that are none, or that ask for what the method does not have.
fn check<P: Problem + ?Sized>(problem: &P, options: &Options) -> Result<(), GivesUp> {
    options.validate()?;
    let default = Options::default();
    let unsupported = [
        (options.mu_strategy != MuStrategy::Monotone, "an adaptive barrier parameter"),
        (options.hessian != Hessian::Exact, "an approximate Hessian"),
        (options.mu_target != 0.0, "a barrier parameter to converge to"),
        (options.obj_scaling_factor != 1.0, "a factor of the objective"),
        (problem.scaling().is_some(), "scaling by the problem"),
        (options.expect_infeasible, "expecting infeasibility"),
        (options.start_with_resto, "a restoration phase"),
        (!options.fast_step_computation, "iterative refinement"),
        (options.max_cpu_time < default.max_cpu_time, "a time limit"),
        (options.print_level > 0, "printing"),
        (!options.honor_original_bounds, "a solution within relaxed bounds"),
        (
            options.acceptable_obj_change_tol != default.acceptable_obj_change_tol,
            "a tolerance of the objective's change",
        ),
        (!options.extra.is_empty(), "an option that has no field"),
    ];
    if let Some((_, what)) = unsupported.iter().find(|(is_asked, _)| *is_asked) {
        return Err(GivesUp::Unsupported(what));
    }
    Ok(())
}

/// A solve on its way.
pub(crate) struct Method<'a, P: ?Sized, L: ?Sized> {
    pub(crate) program: Program<'a, P>,
    pub(crate) system: System<'a, L>,
    pub(crate) options: &'a Options,
    pub(crate) point: Point,
    pub(crate) trial: Point,
    pub(crate) y: Vec<f64>,
    pub(crate) z: Vec<f64>,
    pub(crate) step: Step,
    /// ∇f, zero for the slacks.
    gradient: Vec<f64>,
    /// ∇f + Jᵀ y − z of the bounds.
    pub(crate) lagrangian: Vec<f64>,
    /// Right-hand sides of the step in w.
    pub(crate) dual_residuals: Vec<f64>,
    sigma: Vec<f64>,
    pub(crate) mu: f64,
    pub(crate) tau: f64,
    pub(crate) filter: Filter,
    pub(crate) watchdog: Watchdog,
    /// Whether the last step was as small as rounding errors.
    pub(crate) was_tiny: bool,
    pub(crate) acceptable: u32,
}

impl<'a, P, L> Method<'a, P, L>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    fn new(
        mut program: Program<'a, P>,
        system: System<'a, L>,
        options: &'a Options,
        Iterate { w, y, z }: Iterate,
    ) -> Result<Self, GivesUp> {
        let (primals, constraints, bounds) = (w.len(), y.len(), z.len());
        let mu = options.mu_init;
        let mut point = Point::at(w, constraints, bounds);
        point.evaluate(&mut program, &z, mu)?;
        let mut method = Self {
            program,
            system,
            options,
            trial: point.clone(),
            point,
            y,
            z,
            step: Step { w: vec![0.0; primals], y: vec![0.0; constraints], z: vec![0.0; bounds] },
            gradient: vec![0.0; primals],
            lagrangian: vec![0.0; primals],
            dual_residuals: vec![0.0; primals],
            sigma: vec![0.0; primals],
            mu,
            tau: TAU_MIN.max(1.0 - mu),
            filter: Filter::default(),
            watchdog: Watchdog::default(),
            was_tiny: false,
            acceptable: 0,
        };
        method.differentiate()?;
        Ok(method)
    }

    /// The multipliers that leave the least gradient of the Lagrangian.
    fn estimate_multipliers(&mut self) -> Result<(), GivesUp> {
        let most = self.options.constr_mult_init_max;
        if most <= 0.0 || self.y.is_empty() {
            return Ok(());
        }
        // With y = 0 this is the gradient that y has to cancel.
        let rhs: Vec<f64> = self.lagrangian.iter().map(|gradient| -gradient).collect();
        let mut y = vec![0.0; self.y.len()];
        if self.system.least_squares(&rhs, &mut y) && largest(&y) <= most {
            self.y = y;
            self.differentiate_lagrangian();
        }
        Ok(())
    }

    fn run(
        &mut self,
        mut on_iteration: impl FnMut(&Iteration) -> Control,
    ) -> Result<(Status, Iteration), GivesUp> {
        let mut step_norm = 0.0;
        let mut regularization = 0.0;
        let mut taken = Taken { primal: 0.0, dual: 0.0, trials: 0 };
        let mut count = 0;
        loop {
            let errors = self.errors();
            let iteration = Iteration {
                iteration: count,
                restoration: false,
                objective: self.point.objective / self.program.objective_scale,
                primal_infeasibility: errors.primal,
                dual_infeasibility: errors.dual,
                mu: self.mu,
                step_norm,
                regularization,
                alpha_primal: taken.primal,
                alpha_dual: taken.dual,
                line_search_trials: taken.trials,
            };
            if on_iteration(&iteration) == Control::Stop {
                return Ok((Status::UserStop, iteration));
            }
            if let Some(status) = self.ends(&errors, count) {
                return Ok((status, iteration));
            }
            let x = &self.point.w[..self.program.variables()];
            self.program.hessian(x, &self.y, self.system.hessian_mut())?;
            self.lower_barrier(&errors);
            regularization = self.find_step()?;
            step_norm = largest(&self.step.w);
            taken = self.line_search()?;
            self.accept()?;
            count += 1;
        }
    }

    fn curves_upwards(&mut self) -> Result<bool, GivesUp> {
        let x = &self.point.w[..self.program.variables()];
        self.program.hessian(x, &self.y, self.system.hessian_mut())?;
        self.weigh_bounds();
        Ok(self.system.has_right_inertia(&self.sigma))
    }

    /// Σ of w: how much the bounds' barriers curve.
    fn weigh_bounds(&mut self) {
        self.sigma.fill(0.0);
        let bounds = self.program.bounds.iter().zip(&self.point.distances);
        for ((bound, distance), z) in bounds.zip(&self.z) {
            self.sigma[bound.index()] += z / distance;
        }
    }

    /// The Newton step of the barrier problem; returns the regularisation of the Hessian.
    fn find_step(&mut self) -> Result<f64, GivesUp> {
        self.weigh_bounds();
        self.dual_residuals.copy_from_slice(&self.lagrangian);
        let bounds = self.program.bounds.iter().zip(&self.point.distances);
        for ((bound, distance), z) in bounds.zip(&self.z) {
            self.dual_residuals[bound.index()] +=
                bound.sign() * z + slope(bound, *distance, self.mu);
        }
        let regularization = self.system.factorise(&self.sigma, self.mu)?;
        let residuals = std::mem::take(&mut self.point.residuals);
        self.solve_for_step(&residuals);
        self.point.residuals = residuals;
        if self.step.is_finite() { Ok(regularization) } else { Err(GivesUp::NoStep) }
    }

    /// The step with these residuals of the constraints.
    pub(crate) fn solve_for_step(&mut self, residuals: &[f64]) {
        let Step { w, y, z } = &mut self.step;
        self.system.solve(&self.dual_residuals, residuals, w, y);
        w.iter_mut().chain(y).for_each(|step| *step = -*step);
        let bounds = self.program.bounds.iter().zip(&self.point.distances);
        for ((dz, z), (bound, distance)) in z.iter_mut().zip(&self.z).zip(bounds) {
            *dz = (self.mu - z * bound.sign() * w[bound.index()]) / distance - z;
        }
    }

    /// ∇φ along the step.
    pub(crate) fn slope(&self) -> f64 {
        let bounds = self.program.bounds.iter().zip(&self.point.distances);
        let of_bounds: f64 = bounds
            .map(|(bound, distance)| slope(bound, *distance, self.mu) * self.step.w[bound.index()])
            .sum();
        of_bounds + self.gradient.iter().zip(&self.step.w).map(|(g, dw)| g * dw).sum::<f64>()
    }

    /// Makes the trial point, whose multipliers are already in place, the current one.
    fn accept(&mut self) -> Result<(), GivesUp> {
        std::mem::swap(&mut self.point, &mut self.trial);
        if self.point.moves_bounds {
            let bounds = self.program.bounds.iter_mut().zip(&self.point.distances);
            for (bound, distance) in bounds {
                let value = self.point.w[bound.index()] - bound.sign() * distance;
                bound.value = if bound.sign() > 0.0 {
                    bound.value.min(value)
                } else {
                    bound.value.max(value)
                };
            }
        }
        keep_near_path(&mut self.z, &self.point.distances, self.mu);
        self.differentiate()
    }

    fn differentiate(&mut self) -> Result<(), GivesUp> {
        let x = &self.point.w[..self.program.variables()];
        self.program.gradient(x, &mut self.gradient[..self.program.variables()])?;
        self.program.jacobian(x, self.system.jacobian_mut())?;
        self.differentiate_lagrangian();
        Ok(())
    }

    fn differentiate_lagrangian(&mut self) {
        let Self { program, lagrangian, y, .. } = self;
        lagrangian.copy_from_slice(&self.gradient);
        let jacobian = &program.declared.jacobian;
        let entries = jacobian.rows.iter().zip(&jacobian.columns);
        for ((&row, &column), value) in entries.zip(self.system.jacobian()) {
            lagrangian[column as usize] += value * y[row as usize];
        }
        for (row, y) in program.rows.iter().zip(&*y) {
            if let Row::Slack(index) = *row {
                lagrangian[index] -= y;
            }
        }
        for (bound, z) in program.bounds.iter().zip(&self.z) {
            lagrangian[bound.index()] -= bound.sign() * z;
        }
    }

    fn into_solution(mut self, status: Status, last: Iteration, clock: Instant) -> NlpSolution {
        let mut x = self.point.w;
        x.truncate(self.program.variables());
        self.program.put_within_bounds(&mut x);
        let g = self.program.unscaled_constraints(&x);
        let constraint_violation = self.program.declared.violation(&x, &g);
        NlpSolution {
            status,
            x,
            objective: last.objective,
            g,
            multipliers: self.program.unscaled_multipliers(&self.y, &self.z),
            iterations: last.iteration,
            constraint_violation,
            last_iteration: Some(last),
            timing: Timing {
                total: clock.elapsed(),
                evaluation: self.program.timing,
                linear_solver: Some(self.system.timing),
            },
        }
    }
}
