//! The same iterates as Ipopt on random programs with every kind of bound.

mod common;

use common::support::assert_close;
use common::{fast, ipopt, own};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_interior::{FailureReason, InteriorError};
use righting_ipopt::*;

const VARIABLES: usize = 7;
const CONSTRAINTS: usize = 5;
const PROGRAMS: u64 = 300;

/// Numbers from −1 to 1.
struct Random(ChaCha8Rng);

impl Random {
    fn next(&mut self) -> f64 {
        self.0.random_range(-1.0..1.0)
    }

    fn vector<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.next())
    }
}

/// ```text
/// min ½ Σ h_i x_i² + (p·x)² + q·x + Σ cos(3 x_i) / 4
/// s.t.  a_j·x + b_j x_j² within bounds, x within bounds
/// ```
/// with h positive, and some of the bounds missing or equal.
#[derive(Clone)]
struct Program {
    h: [f64; VARIABLES],
    p: [f64; VARIABLES],
    q: [f64; VARIABLES],
    a: [[f64; VARIABLES]; CONSTRAINTS],
    b: [f64; CONSTRAINTS],
    x: [(f64, f64); VARIABLES],
    g: [(f64, f64); CONSTRAINTS],
    start: [f64; VARIABLES],
}

impl Program {
    fn random(seed: u64) -> Self {
        let mut random = Random(ChaCha8Rng::seed_from_u64(seed));
        let size = [1.0, 10.0, 1e3][(seed % 3) as usize];
        let mut program = Self {
            h: random.vector().map(|h| size * (1.1 + h)),
            p: random.vector().map(|p| 2.0 * p),
            q: random.vector().map(|q| 5.0 * size * q),
            a: std::array::from_fn(|_| random.vector()),
            b: random.vector(),
            x: [(f64::NEG_INFINITY, f64::INFINITY); VARIABLES],
            g: [(f64::NEG_INFINITY, f64::INFINITY); CONSTRAINTS],
            start: random.vector(),
        };
        // There is a point within all bounds.
        let inside: [f64; VARIABLES] = random.vector();
        for (bounds, x) in program.x.iter_mut().zip(inside) {
            *bounds = around(&mut random, x, false);
        }
        for (row, value) in program.values(&inside).into_iter().enumerate() {
            program.g[row] = around(&mut random, value, row < 2);
        }
        program
    }

    fn values(&self, x: &[f64]) -> [f64; CONSTRAINTS] {
        std::array::from_fn(|row| {
            let linear: f64 = self.a[row].iter().zip(x).map(|(a, x)| a * x).sum();
            linear + self.b[row] * x[row] * x[row]
        })
    }
}

/// Bounds on both sides, one or none, or an equality where allowed.
fn around(random: &mut Random, value: f64, may_be_equal: bool) -> (f64, f64) {
    let (below, above) = (value - random.next().abs() - 0.01, value + random.next().abs() + 0.01);
    match (2.5 * (random.next() + 1.0)) as usize {
        0 => (below, f64::INFINITY),
        1 => (f64::NEG_INFINITY, above),
        2 => (below, above),
        3 if may_be_equal => (value, value),
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

fn lower_triangle() -> impl Iterator<Item = (usize, usize)> {
    (0..VARIABLES).flat_map(|i| (0..=i).map(move |j| (i, j)))
}

impl Problem for Program {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: VARIABLES, constraints: CONSTRAINTS }
    }
    fn bounds(&self, bounds: &mut Bounds) {
        for (i, (lower, upper)) in self.x.iter().enumerate() {
            (bounds.x_lower[i], bounds.x_upper[i]) = (*lower, *upper);
        }
        for (i, (lower, upper)) in self.g.iter().enumerate() {
            (bounds.g_lower[i], bounds.g_upper[i]) = (*lower, *upper);
        }
    }
    fn jacobian_structure(&self) -> TripletStructure {
        let entries =
            (0..CONSTRAINTS).flat_map(|i| (0..VARIABLES).map(move |j| (i as i32, j as i32)));
        let (rows, columns) = entries.unzip();
        TripletStructure { rows, columns }
    }
    fn hessian_structure(&self) -> TripletStructure {
        let (rows, columns) = lower_triangle().map(|(i, j)| (i as i32, j as i32)).unzip();
        TripletStructure { rows, columns }
    }
    fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
        let along: f64 = self.p.iter().zip(x).map(|(p, x)| p * x).sum();
        let of_each =
            |i: usize| 0.5 * self.h[i] * x[i] * x[i] + self.q[i] * x[i] + (3.0 * x[i]).cos() / 4.0;
        Ok(along * along + (0..VARIABLES).map(of_each).sum::<f64>())
    }
    fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        let along: f64 = self.p.iter().zip(x).map(|(p, x)| p * x).sum();
        for (i, out) in out.iter_mut().enumerate() {
            *out =
                self.h[i] * x[i] + self.q[i] - 0.75 * (3.0 * x[i]).sin() + 2.0 * along * self.p[i];
        }
        Ok(())
    }
    fn constraints(&mut self, x: &[f64], _: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
        g.copy_from_slice(&self.values(x));
        Ok(())
    }
    fn jacobian(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        for (row, out) in out.chunks_exact_mut(VARIABLES).enumerate() {
            out.copy_from_slice(&self.a[row]);
            out[row] += 2.0 * self.b[row] * x[row];
        }
        Ok(())
    }
    fn hessian(
        &mut self,
        x: &[f64],
        _: bool,
        factor: f64,
        multipliers: &[f64],
        _: bool,
        out: &mut [f64],
    ) -> Result<(), EvaluationError> {
        for ((i, j), out) in lower_triangle().zip(out) {
            *out = factor * 2.0 * self.p[i] * self.p[j];
            if i == j {
                *out += factor * (self.h[i] - 2.25 * (3.0 * x[i]).cos());
                *out += multipliers.get(i).map_or(0.0, |y| 2.0 * self.b[i] * y);
            }
        }
        Ok(())
    }
}

#[test]
fn random_programs_are_solved_in_the_same_iterations() {
    let (mut given_up, mut scaled, mut regularized) = (0, 0, 0);
    let taken = |iterations: &[Iteration]| -> Vec<(usize, f64)> {
        iterations.iter().map(|it| (it.line_search_trials, it.mu)).collect()
    };
    for seed in 0..PROGRAMS {
        let program = Program::random(seed);
        let start = Start::at(program.start.to_vec());
        let (ours, own) = own(program.clone(), &fast(), &start);
        let (theirs, ipopt) = ipopt(program.clone(), &fast(), &start);
        let ipopt = ipopt.unwrap();
        regularized += ours.iter().filter(|iteration| iteration.regularization > 0.0).count();
        let own = match own {
            Ok(solution) => solution,
            Err(InteriorError {
                reason: FailureReason::RestorationNeeded | FailureReason::StepComputation,
                ..
            }) => {
                given_up += 1;
                continue;
            }
            Err(why) => panic!("{seed}: {why}"),
        };
        assert_eq!(own.status, ipopt.status, "{seed}");
        assert_eq!(taken(&ours), taken(&theirs), "{seed}");
        assert_close(&own.x, &ipopt.x, 1e-6);
        assert_close(&own.multipliers.constraints, &ipopt.multipliers.constraints, 1e-5);
        assert_close(&own.multipliers.lower, &ipopt.multipliers.lower, 1e-5);
        assert_close(&own.multipliers.upper, &ipopt.multipliers.upper, 1e-5);
        scaled += usize::from(program.q.iter().any(|q| q.abs() > 200.0));
    }
    assert!(given_up < PROGRAMS / 20, "{given_up} of {PROGRAMS} given up");
    assert!(scaled > 50 && regularized > 50, "{scaled} scaled, {regularized} regularised");
}
