//! The iterate of a solve that is under way, from within its callback.

mod support;

use righting_ipopt::*;
use righting_ipopt_sys::HAS_HSL_LOADER;
use support::assert_close;
use support::hock_schittkowski::*;
use support::quadratic::Projection;

/// Ipopt 3.14 has what its predecessors with the HSL loader have not.
const HAS_ITERATES: bool = !HAS_HSL_LOADER;

/// The iterate and its violations at the `at`-th iteration, where the solve is stopped.
fn stopped_at(
    at: usize,
    problem: &mut impl Problem,
    options: &Options,
    start: &[f64],
) -> (NlpSolution, Option<Iterate>, Option<Violations>) {
    let (mut iterate, mut violations) = (None, None);
    let start = Start::at(start.to_vec());
    let solution = solve_with(problem, options, &start, &mut BunchKaufman::default(), |now| {
        if now.iteration < at {
            return Control::Continue;
        }
        (iterate, violations) = (current_iterate(), current_violations());
        Control::Stop
    });
    (solution.unwrap(), iterate, violations)
}

#[test]
fn an_interrupted_solve_can_go_on_from_its_last_iterate() {
    let options = Options::default();
    let (stopped, iterate, violations) = stopped_at(3, &mut Dense(Hs071), &options, Hs071::START);
    assert_eq!((stopped.status, stopped.iterations), (Status::UserStop, 3));
    assert_eq!(iterate.is_some(), HAS_ITERATES);
    assert_eq!(violations.is_some(), HAS_ITERATES);
    let (Some(iterate), Some(violations)) = (iterate, violations) else { return };

    assert_close(&iterate.x, &stopped.x, 1e-12);
    assert_close(&iterate.g, &Hs071::constraints(&iterate.x), 1e-12);
    assert_close(&iterate.multipliers.constraints, &stopped.multipliers.constraints, 1e-12);
    assert!(iterate.multipliers.lower.iter().all(|z| *z > 0.0));
    let largest = violations.constraints.iter().copied().fold(0.0, f64::max);
    let product: f64 = iterate.x.iter().product();
    let norm: f64 = iterate.x.iter().map(|x| x * x).sum();
    assert_close(&[largest], &[(25.0 - product).max((norm - 40.0).abs())], 1e-9);
    assert_eq!(violations.lower, [0.0; 4]);
    assert_eq!(violations.lagrangian_gradient.map(|gradient| gradient.len()), Some(4));

    let go_on = |_: &Iteration| Control::Continue;
    let rest = solve(&mut Dense(Hs071), &options, &iterate.to_start(), go_on).unwrap();
    assert_eq!(rest.status, Status::Solved);
    assert_close(&rest.x, Hs071::SOLUTION, 1e-6);
}

#[test]
fn multipliers_of_fixed_variables_are_evaluated_meanwhile() {
    // min (x₀ − 3)² + (x₁ − 5)² + (x₂ − 1)²  s.t.  x₀ + x₁ + x₂ = 0, x₁ fixed at 2: Ipopt asks for
    // the gradient and the Jacobian of x₁.
    let mut problem = Projection::of(&[3.0, 5.0, 1.0])
        .within(&[(-9.0, 9.0), (2.0, 2.0), (-9.0, 9.0)])
        .subject_to(&[(0, 1.0), (1, 1.0), (2, 1.0)], (0.0, 0.0));
    let (stopped, iterate, _) = stopped_at(1, &mut problem, &Options::default(), &[0.0; 3]);
    assert_eq!(stopped.status, Status::UserStop);
    assert_eq!(iterate.is_some(), HAS_ITERATES);
    let Some(iterate) = iterate else { return };
    assert_eq!(iterate.x[1], 2.0);
    let multiplier = 2.0 * (2.0 - 5.0) + iterate.multipliers.constraints[0];
    let found = iterate.multipliers.lower[1] - iterate.multipliers.upper[1];
    assert_close(&[found], &[multiplier], 1e-9);
}

#[test]
fn the_restoration_phase_has_iterates_too() {
    let options = Options { start_with_resto: true, ..Options::default() };
    let mut seen = 0;
    let start = Start::at(Hs071::START.to_vec());
    let solution = solve(&mut Dense(Hs071), &options, &start, |iteration| {
        if let (true, Some(iterate), Some(violations)) =
            (iteration.restoration, current_iterate(), current_violations())
        {
            assert_eq!(iterate.x.len(), 4);
            assert_eq!(violations.constraints.len(), 2);
            assert_eq!(violations.lagrangian_gradient, None);
            seen += 1;
        }
        Control::Continue
    });
    assert_eq!(solution.unwrap().status, Status::Solved);
    assert_eq!(seen > 0, HAS_ITERATES);
}

#[test]
fn outside_of_a_solve_there_is_none() {
    assert_eq!(current_iterate(), None);
    let go_on = |_: &Iteration| Control::Continue;
    let start = Start::at(Hs071::START.to_vec());
    solve(&mut Dense(Hs071), &Options::default(), &start, go_on).unwrap();
    assert_eq!(current_iterate(), None);
    assert_eq!(current_violations(), None);
}
