//! A base that spins by itself, beside the time that its arm takes to move.

use std::f64::consts::{PI, TAU};

use righting_scenario::scenario::Scenario;

/// A base that turns farther than this by itself during its maneuver spins for long, rad.
const LONG_SPIN_RAD: f64 = 84.0;
/// The beginning that decides such a maneuver, in times that the slowest joint takes for half a turn.
const HALF_TURNS: f64 = 2.5;
/// A base that turns more often than this while the slowest joint makes half a turn spins fast.
const FAST_TURNS: f64 = 10.0;

/// How much of a horizon decides the maneuver: all of it, but of a long detumble of a fast spin only as long
/// as the slowest joint takes a few times for half a turn. Nothing is lost when the arm holds still in the
/// rest, which no coarse grid could follow.
pub(crate) fn beginning_s(scenario: &Scenario) -> f64 {
    let duration_s = scenario.horizon().duration_s;
    let spin_rad = duration_s * scenario.initial().angular_rate_rad_s.norm();
    // A duration that is free is a matter of the whole maneuver.
    match spin_rad > LONG_SPIN_RAD && scenario.free_duration().is_none() {
        true => duration_s.min(HALF_TURNS * half_turn_s(scenario)),
        false => duration_s,
    }
}

/// How long the slowest joint takes for half a turn, or for its range if that is less, from rest to rest.
fn half_turn_s(scenario: &Scenario) -> f64 {
    let limits = scenario.system().joint_limits.iter();
    let times = limits.map(|limits| {
        let (low, high) = limits.angle_range_rad();
        let (rate, acceleration) = (limits.rate_max_rad_s, limits.acceleration_max_rad_s2);
        (high - low).min(PI) / rate + rate / acceleration
    });
    times.fold(0.0, f64::max)
}

/// That the base spins too fast for the arm to follow, if it does.
pub(crate) fn fast_spin(scenario: &Scenario) -> Option<String> {
    let spin_rad_s = scenario.initial().angular_rate_rad_s.norm();
    let turns = spin_rad_s * half_turn_s(scenario) / TAU;
    (turns > FAST_TURNS).then(|| {
        format!(
            "the base turns {turns:.0} times while the slowest joint makes half a turn: no start that was \
             tried slows it"
        )
    })
}
