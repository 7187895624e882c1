//! Which initial guesses are ranked.

use righting_ocp::InitialGuess;
use righting_scenario::file::{self, LowDiscrepancyStarts, NamedGuess};
use righting_scenario::scenario::{MAX_STARTS, Maneuver, Scenario};

use crate::initial_guess::InitialGuesses;

/// Low-discrepancy guesses that the automatic guess ranks beside the constant one.
const AUTO_GUESSES: usize = 4;
/// Of how many of them a detumble's automatic guess takes those after which the base turns slowest.
const SCREENED_GUESSES: usize = 32;
/// From here on a slew has so many optima that more guesses pay: closed loops of the joints.
const LARGE_SLEW_RAD: f64 = 0.5;
/// Where no loop turns the base about the axis, so many more low-discrepancy guesses, simulated.
const LARGE_SLEW_GUESSES: usize = 5;

/// Whether guesses are ranked at all.
pub(super) fn is_ranked(scenario: &Scenario) -> bool {
    count(scenario) > 0
}

/// The guesses to rank; none if nothing is ranked.
pub(super) fn ranked_guesses(
    scenario: &Scenario,
    guesses: &InitialGuesses<'_>,
) -> Vec<InitialGuess> {
    let count = count(scenario);
    if count == 0 {
        return Vec::new();
    }
    let mut ranked = vec![guesses.constant()];
    let is_auto = scenario.solver().guess == file::Guess::Named(NamedGuess::Auto);
    match scenario.maneuver() {
        Maneuver::Detumble if is_auto => {
            ranked.extend(guesses.least_final_rate(SCREENED_GUESSES, count));
        }
        Maneuver::Slew(slew) if is_auto => {
            ranked.extend(guesses.low_discrepancy(0).take(count));
            if slew.target.angle_to(&scenario.initial().attitude) > LARGE_SLEW_RAD {
                let loops = guesses.joint_loops(&slew.target);
                if loops.is_empty() {
                    let more = guesses.low_discrepancy(count as u64).take(LARGE_SLEW_GUESSES);
                    ranked.extend(more.map(|guess| guesses.simulated(guess)));
                }
                ranked.extend(loops);
            }
        }
        _ => ranked.extend(guesses.low_discrepancy(first(scenario)).take(count)),
    }
    ranked
}

/// What leads away from a stationary point, best first: `count` guesses in all.
pub(super) fn guesses_beside_saddle(
    scenario: &Scenario,
    guesses: &InitialGuesses<'_>,
    count: usize,
) -> Vec<InitialGuess> {
    match scenario.maneuver() {
        Maneuver::Detumble => guesses.least_final_rate(SCREENED_GUESSES, count),
        Maneuver::Slew(_) => {
            let all = guesses.low_discrepancy(0).take(count);
            all.map(|guess| guesses.simulated(guess)).collect()
        }
    }
}

/// How many guesses are ranked beside the constant one; zero if nothing is ranked.
fn count(scenario: &Scenario) -> usize {
    match scenario.solver().guess {
        file::Guess::Named(NamedGuess::Constant) => 0,
        file::Guess::Named(NamedGuess::Auto) => AUTO_GUESSES,
        file::Guess::Starts(LowDiscrepancyStarts { starts, .. }) => starts as usize,
    }
}

/// Each seed has its own stretch of the sequence.
fn first(scenario: &Scenario) -> u64 {
    match scenario.solver().guess {
        file::Guess::Starts(LowDiscrepancyStarts { seed, .. }) => {
            seed.wrapping_mul(MAX_STARTS) % (1 << 40)
        }
        file::Guess::Named(_) => 0,
    }
}
