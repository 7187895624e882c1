//! Which initial guesses are ranked.

use righting_ocp::{InitialGuess, OcpSolution};
use righting_scenario::file::{self, LowDiscrepancyStarts, NamedGuess};
use righting_scenario::scenario::{MAX_STARTS, Maneuver, Scenario};

use crate::initial_guess::InitialGuesses;

/// Low-discrepancy guesses that the automatic guess of a detumble ranks beside the constant one, those after
/// which the base turns slowest: so many …
const DETUMBLE_GUESSES: usize = 4;
/// … of so many.
const SCREENED_GUESSES: usize = 48;
/// Low-discrepancy guesses that the automatic guess of a slew with waypoints ranks beside the constant one and
/// the motion that its legs make one after the other.
const SEQUENCE_GUESSES: usize = 2;
/// A batch of a slew: numbers of low-discrepancy guesses, with the attitude turning evenly to the target and
/// simulated, and closed loops of the joints as `(turns − 1) · 4 + phase`.
struct SlewBatch {
    turning: &'static [usize],
    simulated: &'static [usize],
    loops: &'static [usize],
}
/// What the automatic guess of a slew ranks beside the constant one. Chosen greedily on 65 slews of the
/// shipped arms and seven public ones; docs/decisions.md has what each is worth.
const SLEW_BATCHES: [SlewBatch; 2] = [
    SlewBatch { turning: &[0], simulated: &[], loops: &[4, 6] },
    SlewBatch { turning: &[1, 4, 7], simulated: &[1], loops: &[0, 2, 7, 8] },
];
/// No batch follows where so many starts of the first end in the best optimum found.
const AGREEING: usize = 5;
/// Two optima are the same when their objectives differ by no more than this share.
const SAME_OPTIMUM: f64 = 5e-3;

/// Whether guesses are ranked at all.
pub(super) fn is_ranked(scenario: &Scenario) -> bool {
    !scenario.solver().is_paper()
}

/// The guesses of a batch to rank; none when there are no more batches, or nothing is ranked.
pub(super) fn ranked_guesses(
    scenario: &Scenario,
    guesses: &InitialGuesses<'_>,
    batch: usize,
) -> Vec<InitialGuess> {
    let is_first = batch == 0;
    let constant = || is_first.then(|| guesses.to_end_posture(guesses.constant()));
    match (scenario.solver().guess, scenario.maneuver()) {
        (file::Guess::Named(NamedGuess::Constant), _) => Vec::new(),
        (file::Guess::Starts(LowDiscrepancyStarts { starts, .. }), _) => {
            let count = if is_first { starts as usize } else { 0 };
            let spread = guesses.low_discrepancy(first(scenario)).take(count);
            constant().into_iter().chain(spread).collect()
        }
        (file::Guess::Named(NamedGuess::Auto), Maneuver::Detumble) => {
            let slowest =
                is_first.then(|| guesses.least_final_rate(SCREENED_GUESSES, DETUMBLE_GUESSES));
            let by_wheels = constant().and_then(|held| guesses.driven_by_wheels(held));
            constant().into_iter().chain(by_wheels).chain(slowest.into_iter().flatten()).collect()
        }
        (file::Guess::Named(NamedGuess::Auto), Maneuver::Slew(_))
            if !scenario.waypoints().is_empty() =>
        {
            let spread =
                guesses.low_discrepancy(0).take(if is_first { SEQUENCE_GUESSES } else { 0 });
            let along = constant().into_iter().chain(spread);
            along.map(|guess| guesses.turning_along_legs(guess)).collect()
        }
        (file::Guess::Named(NamedGuess::Auto), Maneuver::Slew(slew)) => {
            let Some(SlewBatch { turning, simulated, loops }) = SLEW_BATCHES.get(batch) else {
                return Vec::new();
            };
            let target = &slew.target;
            let spread = |number: usize| guesses.low_discrepancy(number as u64).take(1);
            let held = constant().map(|constant| guesses.turning_to(constant, target));
            let turning = turning
                .iter()
                .flat_map(|&number| spread(number))
                .map(|guess| guesses.turning_to(guess, target));
            let simulated = simulated
                .iter()
                .flat_map(|&number| spread(number))
                .map(|guess| guesses.simulated(guess));
            let by_wheels = constant()
                .map(|constant| guesses.turning_to(constant, target))
                .and_then(|turning| guesses.driven_by_wheels(turning));
            let loops = guesses.joint_loops(target, loops).into_iter();
            let loops = loops.map(|guess| guesses.to_end_posture(guess));
            constant()
                .into_iter()
                .chain(held)
                .chain(turning)
                .chain(simulated)
                .chain(loops)
                .chain(by_wheels)
                .collect()
        }
    }
}

/// Whether so many solutions of the first batch are the best one that no more starts are needed.
pub(super) fn agree(solutions: &[OcpSolution]) -> bool {
    let objectives = solutions.iter().map(|solution| solution.objective);
    let least = objectives.clone().fold(f64::INFINITY, f64::min);
    objectives.filter(|&found| found <= least * (1.0 + SAME_OPTIMUM)).count() >= AGREEING
}

/// How many rounds of hops from the best optimum may bring nothing before the search ends; none are made with
/// zero.
pub(super) fn patience(scenario: &Scenario, agreed: bool) -> usize {
    let is_auto = scenario.solver().guess == file::Guess::Named(NamedGuess::Auto);
    match (is_auto, scenario.maneuver(), agreed) {
        (false, ..) | (true, Maneuver::Detumble, true) => 0,
        _ => 1,
    }
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

/// Each seed has its own stretch of the sequence.
fn first(scenario: &Scenario) -> u64 {
    match scenario.solver().guess {
        file::Guess::Starts(LowDiscrepancyStarts { seed, .. }) => {
            seed.wrapping_mul(MAX_STARTS) % (1 << 40)
        }
        file::Guess::Named(_) => 0,
    }
}
