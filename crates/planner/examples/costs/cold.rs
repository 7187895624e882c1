use std::time::{Duration, Instant};

use righting_ocp::{
    Control, Grid, InitialGuess, Iteration, LinearSolverChoice, MultipleShooting, OcpSolution,
    OcpStart, Optimizer, Options, Settings, StageFunctions,
};
use righting_planner::FormulatedManeuver;
use righting_scenario::Scenario;
use serde_json::{Value, json};

use crate::chain::from_constant_guess;
use crate::ipopt_timing::IpoptTiming;
use crate::{Outcome, peak_mib};

/// One solve on the asked grid from the paper's guess: enough iterations for the cost of each.
pub fn by_iteration(scenario: &Scenario) -> Outcome<Value> {
    let mut first = None;
    let mut last = Instant::now();
    let solution = solved(scenario, &Settings::default(), |_| {
        last = Instant::now();
        first.get_or_insert(last);
    })?;
    // What is done once, before the first iteration, is no part of its cost.
    let iterations = last - first.ok_or("no iteration")?;
    let timing = &solution.timing;
    let linear_solver = timing.linear_solver.ok_or("solved with MUMPS")?;
    let linear_algebra = linear_solver.factor.time + linear_solver.solve.time;
    let evaluation = timing.evaluation.total();
    let each = |time: Duration| 1e3 * time.as_secs_f64() / solution.iterations() as f64;
    Ok(json!({
        "status": solution.status.to_string(),
        "objective": solution.objective,
        "iterations": solution.iterations(),
        "optimizer": format!("{:?}", solution.optimizer),
        "solve_s": timing.total.as_secs_f64(),
        "analyse_s": linear_solver.analyse.time.as_secs_f64(),
        "factorizations": linear_solver.factor.calls,
        "iteration_ms": {
            "evaluate": each(evaluation),
            "linear_algebra": each(linear_algebra),
            "optimizer": each(iterations.saturating_sub(evaluation).saturating_sub(linear_algebra)),
            "total": each(iterations),
        },
        "peak_mib": peak_mib(),
    }))
}

/// The same in Ipopt, on whose clocks linear solvers can be compared.
pub fn in_ipopt(scenario: &Scenario, linear_solver: LinearSolverChoice) -> Outcome<Value> {
    let folder = tempfile::tempdir()?;
    let report = folder.path().join("ipopt.txt");
    let ipopt = Options { extra: IpoptTiming::options(&report), ..Options::default() };
    let settings =
        Settings { ipopt, optimizer: Optimizer::Ipopt, linear_solver, ..Settings::default() };
    let solution = solved(scenario, &settings, |_| {})?;
    let cpu = IpoptTiming::read(&report)?;
    Ok(json!({
        "status": solution.status.to_string(),
        "objective": solution.objective,
        "iterations": solution.iterations(),
        "linear_solver": format!("{:?}", solution.linear_solver),
        "solve_s": solution.timing.total.as_secs_f64(),
        "augmented_system_cpu_s": cpu.augmented_system_s,
        "factor_and_solve_cpu_s": cpu.factor_and_solve_s,
        "evaluate_cpu_s": cpu.evaluation_s,
        "total_cpu_s": cpu.total_s,
        "peak_mib": peak_mib(),
    }))
}

fn solved(
    scenario: &Scenario,
    settings: &Settings,
    mut on_iteration: impl FnMut(&Iteration),
) -> Outcome<OcpSolution> {
    let scenario = from_constant_guess(scenario)?;
    let horizon = scenario.horizon();
    let maneuver = FormulatedManeuver::new(&scenario);
    let functions = StageFunctions::compile(&maneuver.problem)?;
    let grid = Grid::new(horizon.duration_s, horizon.steps)?;
    let mut program = MultipleShooting::new(&functions, grid, &maneuver.initial)?;
    let controls = scenario.system().joint_limits.len();
    let guess = InitialGuess::constant(&maneuver.initial, controls, horizon.steps);
    let solution = program.solve(&OcpStart::Guess(guess), settings, |iteration| {
        on_iteration(iteration);
        Control::Continue
    })?;
    Ok(solution)
}
