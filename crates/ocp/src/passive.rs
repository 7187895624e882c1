use righting_symbolic::{Expr, jacobian};

use crate::control_problem::ControlProblem;

/// The states that the optimum depends on: those that `seen` (costs and constraints) or a finite
/// bound reads, and those whose rates such states need.
pub(crate) fn active_states(
    problem: &ControlProblem,
    states: &[Expr],
    rates: &[Expr],
    seen: &[Expr],
) -> Vec<usize> {
    let mut active: Vec<bool> =
        (0..states.len()).map(|i| problem.state_bounds.bounds_component(i)).collect();
    for (_, state) in jacobian(seen, states).sparsity().iter() {
        active[state] = true;
    }
    let dependencies = jacobian(rates, states);
    loop {
        let before = active.iter().filter(|&&a| a).count();
        for (rate, state) in dependencies.sparsity().iter() {
            active[state] |= active[rate];
        }
        if active.iter().filter(|&&a| a).count() == before {
            break;
        }
    }
    (0..states.len()).filter(|&i| active[i]).collect()
}
