//! What would help where a plan misses its target or there is none: tried, not guessed.
//!
//! Each remedy is a change of the scenario that is planned and verified itself; the first that works is named.
//! It takes at most a few more plans, and no longer than the planner gives it; what is not finished by then is
//! not mentioned.

use righting_results::{Solution, Status};
use righting_scenario::{Error, Maneuver, Scenario};

use crate::hints::{estimated_times_longer, two_digits};
use crate::planned::Planned;

/// Durations tried at most, and weights.
const MOST_TRIES: usize = 3;
/// How much longer each duration is than the one before.
const LONGER: f64 = 2.0;
/// What a weight of the control is divided by each time.
const LIGHTER: f64 = 10.0;

/// What was tried and what came of it; `plan` plans a changed scenario, or says nothing when it shall stop.
pub(crate) fn remedies(
    scenario: &Scenario,
    planned: &Planned,
    mut plan: impl FnMut(&Scenario) -> Option<Planned>,
) -> Vec<String> {
    let mut notes = Vec::new();
    if !needs_any(scenario, &planned.solution) {
        return notes;
    }
    let mut works = |changed: Result<Scenario, Error>| -> Option<bool> {
        Some(plan(&changed.ok()?)?.solution.verification.passed)
    };
    if !scenario.is_end_hard() && scenario.weights().attitude > 0.0 {
        let mut control = scenario.weights().control;
        for _ in 0..MOST_TRIES {
            control /= LIGHTER;
            match works(scenario.varied(|file| file.weights.control = Some(control))) {
                Some(true) => {
                    notes.push(format!("weights.control {control:e} was tried and reaches it"));
                    break;
                }
                Some(false) => {}
                None => return notes,
            }
        }
    }
    let first_s = scenario.horizon().duration_s * estimated_times_longer(scenario, planned);
    let mut duration_s = first_s;
    for _ in 0..MOST_TRIES {
        let rounded_s = two_digits(duration_s);
        match works(scenario.varied(|file| file.stretch_to_s(rounded_s))) {
            Some(true) => {
                notes.push(format!("horizon.duration_s {rounded_s} was tried and works"));
                return notes;
            }
            Some(false) => duration_s *= LONGER,
            None => return notes,
        }
    }
    notes.push(format!(
        "no duration that was tried works either, from {} to {} s",
        two_digits(first_s),
        two_digits(duration_s / LONGER)
    ));
    notes
}

/// Whether the target of a slew was missed, or nothing was found at all. A detumble has no target that a longer
/// duration would bring nearer.
fn needs_any(scenario: &Scenario, solution: &Solution) -> bool {
    let asks_for_target = scenario.weights().attitude > 0.0;
    match (solution.status, scenario.maneuver()) {
        (Status::Interrupted | Status::TimeLimit, _) => false,
        (status, Maneuver::Slew(_)) if status.is_acceptable() => {
            asks_for_target && solution.largest_miss().0 > righting_verifier::ATTITUDE_ERROR
        }
        (_, Maneuver::Slew(_)) => !solution.has_plan(),
        (_, Maneuver::Detumble) => false,
    }
}
