use righting_ocp::Control;
use righting_planner::plan;
use righting_scenario::Scenario;
use serde_json::{Value, json};

use crate::{Outcome, peak_mib};

/// One plan, as the program makes it.
pub fn measured(scenario: &Scenario) -> Outcome<Value> {
    let plan = plan(scenario, &mut |_| Control::Continue)?;
    let timing = plan.timing;
    let [trace, guess, solve] =
        [timing.trace, timing.guess, timing.solve].map(|time| time.as_secs_f64());
    Ok(json!({
        "status": plan.status,
        "objective": plan.objective,
        "iterations": plan.iterations,
        "linear_solver": format!("{:?}", plan.linear_solver),
        "plan_s": trace + guess + solve,
        "trace_s": trace,
        "guess_s": guess,
        "solve_s": solve,
        "peak_mib": peak_mib(),
    }))
}
