//! The shortest duration of a slew by one plan that chooses it.

use righting_ocp::Control;
use righting_results::IterationRecord;
use righting_scenario::{Maneuver, Scenario, file};

use super::{LONGEST_SHARE, ReachError, Reached, SHORTEST};
use crate::planner::Planner;

/// The weights of effort beside that of time, which is one a second: so small that effort decides between ways that take
/// as long, and not on the time.
const EFFORT: f64 = 1e-4;

/// Whether a slew can be planned so: success must not be a trade between effort and the target, and the times of
/// waypoints are given.
fn is_open(scenario: &Scenario) -> bool {
    matches!(scenario.maneuver(), Maneuver::Slew(_))
        && scenario.is_end_hard()
        && !scenario.solver().is_paper()
        && scenario.waypoints().is_empty()
}

/// The verified plan of the shortest duration that the optimizer finds; none where there is no such plan, or it is as long
/// as the scenario allows.
pub(super) fn fastest(
    scenario: &Scenario,
    watch: &mut dyn FnMut(&IterationRecord) -> Control,
) -> Result<Option<Reached>, ReachError> {
    if !is_open(scenario) {
        return Ok(None);
    }
    let longest_s = scenario.horizon().duration_s;
    let free = scenario.varied(|file| {
        let min = SHORTEST * longest_s;
        file.horizon.duration_s = file::Duration::Free(file::DurationRange { min, max: longest_s });
        file.weights.time = Some(1.0);
        file.weights.control = Some(EFFORT);
        if !file.wheels.is_empty() {
            file.weights.wheel_torque = Some(EFFORT);
        }
    })?;
    let planned = Planner::new().without_remedies().plan(&free, watch)?;
    let duration_s = planned.solution.duration_s;
    let is_found = planned.solution.verification.passed
        && duration_s.is_some_and(|found_s| found_s < LONGEST_SHARE * longest_s);
    Ok(is_found.then_some(Reached { scenario: free, planned }))
}
