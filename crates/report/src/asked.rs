//! What a scenario asks for, in words and as an attitude.

use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};
use righting_results::Solution;
use righting_scenario::file::{Duration, DurationRange, ManeuverType, Scenario};

use crate::number::{drawn, short};

/// The maneuver in one phrase: "slew of 20° about [0.74, 0.02, 0.68] in 30 s".
pub fn phrase(scenario: &Scenario) -> String {
    phrase_with(scenario, None, short)
}

/// [`phrase`] as figures show it.
pub(crate) fn phrase_drawn(scenario: &Scenario) -> String {
    phrase_with(scenario, None, drawn)
}

/// The maneuver of a plan: [`phrase`] with the duration that the plan chose where it was free, "in 12.3 s (of
/// 5 to 60)".
pub fn planned_phrase(solution: &Solution) -> String {
    phrase_with(&solution.scenario, solution.duration_s, short)
}

/// [`planned_phrase`] as figures show it.
pub(crate) fn planned_phrase_drawn(solution: &Solution) -> String {
    phrase_with(&solution.scenario, solution.duration_s, drawn)
}

fn phrase_with(scenario: &Scenario, chosen_s: Option<f64>, number: fn(f64) -> String) -> String {
    let maneuver = &scenario.maneuver;
    let triple = |values: [f64; 3]| format!("[{}]", values.map(number).join(", "));
    let duration = match scenario.horizon.duration_s {
        Duration::Given(duration_s) => format!("{} s", number(duration_s)),
        Duration::Free(DurationRange { min, max }) => {
            let range = format!("{} to {}", number(min), number(max));
            match chosen_s {
                Some(chosen_s) => format!("{} s (of {range})", number(chosen_s)),
                None => format!("{range} s"),
            }
        }
    };
    match maneuver.kind {
        ManeuverType::Slew => {
            let (axis, angle_deg) =
                scenario.slew_axis_and_angle_deg().unwrap_or(([f64::NAN; 3], f64::NAN));
            let (axis, angle) = (triple(axis), number(angle_deg));
            let way = match maneuver.waypoints.len() {
                0 => String::new(),
                1 => " by way of a waypoint".to_owned(),
                waypoints => format!(" by way of {waypoints} waypoints"),
            };
            match angle_deg == 0.0 && !maneuver.waypoints.is_empty() {
                true => format!("slew back to the start{way} in {duration}"),
                false => format!("slew of {angle}° about {axis}{way} in {duration}"),
            }
        }
        ManeuverType::Detumble => {
            let rate = triple(scenario.initial.angular_rate_deg_s.unwrap_or_default());
            format!("detumble from {rate} °/s in {duration}")
        }
    }
}

/// An attitude that a slew is to reach, body → inertial, and the time until which it is the one asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    pub attitude: UnitQuaternion<f64>,
    pub until_s: f64,
}

/// The attitudes that a slew is to reach, the last one at its end; none for a detumble.
pub(crate) fn targets(scenario: &Scenario) -> Vec<Target> {
    let start = unit(scenario.initial.attitude.unwrap_or([1.0, 0.0, 0.0, 0.0]));
    let turned = |axis: [f64; 3], angle_deg: f64| {
        let axis = Unit::try_new(Vector3::from(axis), f64::MIN_POSITIVE)?;
        Some(start * UnitQuaternion::from_axis_angle(&axis, angle_deg.to_radians()))
    };
    let end = scenario.slew_axis_and_angle_deg().and_then(|(axis, angle)| turned(axis, angle));
    let Some(end) = end else { return Vec::new() };
    let mut until_s = 0.0;
    let waypoints = scenario.maneuver.waypoints.iter().filter_map(|waypoint| {
        until_s += waypoint.duration_s.unwrap_or(0.0) + waypoint.dwell_s.unwrap_or(0.0);
        let attitude = match waypoint.target_attitude {
            Some(wxyz) => unit(wxyz),
            None => turned(waypoint.axis?, waypoint.angle_deg?)?,
        };
        Some(Target { attitude, until_s })
    });
    waypoints.chain([Target { attitude: end, until_s: f64::INFINITY }]).collect()
}

/// The one that is asked for at a time.
pub(crate) fn target_at(targets: &[Target], time_s: f64) -> Option<UnitQuaternion<f64>> {
    let rounding_s = 1e-9 * time_s;
    let next = targets.iter().find(|target| time_s <= target.until_s + rounding_s);
    next.map(|target| target.attitude)
}

/// The rotation of a scalar-first quaternion of any length.
pub(crate) fn unit([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}
