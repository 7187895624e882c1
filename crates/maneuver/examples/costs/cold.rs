use std::time::{Duration, Instant};

use righting_maneuver::{FormulatedManeuver, Scenario};
use righting_ocp::{
    Control, Grid, Guess, LinearSolver, MultipleShooting, Options, Settings, Solution,
    StageFunctions, Start,
};
use serde_json::{Value, json};

use crate::chain::from_constant_guess;
use crate::ipopt_timing::IpoptTiming;
use crate::{Outcome, peak_mib};

/// One solve on the asked grid from the paper's guess: enough iterations for the cost of each.
pub fn measured(scenario: &Scenario, linear_solver: LinearSolver) -> Outcome<Value> {
    let scenario = from_constant_guess(scenario)?;
    let horizon = scenario.horizon();
    let (maneuver, formulate) = timed(|| FormulatedManeuver::new(&scenario));
    let (functions, compile) = timed(|| StageFunctions::compile(&maneuver.problem));
    let functions = functions?;
    let grid = Grid::new(horizon.duration_s, horizon.steps)?;
    let (program, transcribe) =
        timed(|| MultipleShooting::new(&functions, grid, &maneuver.initial));
    let controls = scenario.system().joint_limits.len();
    let guess = Guess::constant(&maneuver.initial, controls, horizon.steps);

    let folder = tempfile::tempdir()?;
    let report = folder.path().join("ipopt.txt");
    let ipopt = Options { extra: IpoptTiming::options(&report), ..Options::default() };
    let settings = Settings { ipopt, linear_solver, ..Settings::default() };
    let solution = program?.solve(&Start::Guess(guess), &settings, |_| Control::Continue)?;
    let cpu = IpoptTiming::read(&report)?;
    let seconds = Duration::as_secs_f64;
    let mut record = json!({
        "status": solution.status.to_string(),
        "objective": solution.objective,
        "iterations": solution.iterations(),
        "linear_solver": format!("{:?}", solution.linear_solver),
        "trace_s": seconds(&(formulate + compile)),
        "transcribe_s": seconds(&transcribe),
        "solve_s": seconds(&solution.timing.total),
        "evaluate_s": seconds(&solution.timing.evaluation.total()),
        "jacobians": solution.timing.evaluation.jacobian.calls,
        "hessians": solution.timing.evaluation.hessian.calls,
        "augmented_system_cpu_s": cpu.augmented_system_s,
        "factor_and_solve_cpu_s": cpu.factor_and_solve_s,
        "evaluate_cpu_s": cpu.evaluation_s,
        "total_cpu_s": cpu.total_s,
        "peak_mib": peak_mib(),
    });
    if let Some(stage) = stage_times(&solution)
        && let Some(fields) = record.as_object_mut()
    {
        fields.extend(stage);
    }
    Ok(record)
}

/// What the stage solver counted and timed itself, and what an iteration costs without what is done
/// once.
fn stage_times(solution: &Solution) -> Option<serde_json::Map<String, Value>> {
    let timing = &solution.timing;
    let stage = timing.linear_solver?;
    let each = |time: Duration| 1e3 * time.as_secs_f64() / solution.iterations() as f64;
    let linear_algebra = stage.factor.time + stage.solve.time;
    let fields = json!({
        "factorizations": stage.factor.calls,
        "back_solves": stage.solve.calls,
        "analyse_s": stage.analyse.time.as_secs_f64(),
        "factor_s": stage.factor.time.as_secs_f64(),
        "back_solve_s": stage.solve.time.as_secs_f64(),
        "iteration_ms": {
            "evaluate": each(timing.evaluation.total()),
            "linear_algebra": each(linear_algebra),
            "ipopt": each(timing.inside_ipopt()),
            "total": each(timing.total.saturating_sub(stage.analyse.time)),
        },
    });
    fields.as_object().cloned()
}

fn timed<T>(body: impl FnOnce() -> T) -> (T, Duration) {
    let begun = Instant::now();
    let value = body();
    (value, begun.elapsed())
}
