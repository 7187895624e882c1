use righting_ocp::Control;
use righting_planner::Planner;
use righting_results::Timing;
use righting_scenario::Scenario;
use serde_json::{Value, json};

use crate::{Outcome, peak_mib};

/// One plan, as the program makes it.
pub fn measured(scenario: &Scenario) -> Outcome<Value> {
    let plan = Planner::new().plan(scenario, &mut |_| Control::Continue)?;
    let Timing { trace, guess, solve, .. } = plan.solution.timing_s;
    Ok(json!({
        "status": plan.solution.status,
        "objective": plan.solution.objective,
        "iterations": plan.solution.iterations,
        "linear_solver": plan.solution.versions.linear_solver,
        "plan_s": trace + guess + solve,
        "trace_s": trace,
        "guess_s": guess,
        "solve_s": solve,
        "peak_mib": peak_mib(),
    }))
}
