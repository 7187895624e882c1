//! Targets on the way of a slew, and when each is reached.

use righting_multibody::Quaternion;

use crate::error::Error;
use crate::file;
use crate::horizon::Horizon;
use crate::initial::Initial;
use crate::json::{Bounds, Location, Number};
use crate::maneuver::{Maneuver, Slew, slew_to};
use crate::rounding::COMPUTED;
use crate::scenario::{Scenario, SolverSettings};

const MOST_WAYPOINTS: usize = 100;
const TIME_S: Bounds = Bounds::Between(0.0, crate::horizon::LONGEST_S);
/// A way on which the base turns by no more than this is none, rad.
const NO_TURN_RAD: f64 = 1e-9;

/// An attitude to reach on the way, at a node of the scenario's grid, and to hold until another.
#[derive(Clone, Debug, PartialEq)]
pub struct Waypoint {
    /// Attitude to reach, body → inertial.
    pub target: Quaternion<f64>,
    /// Whether base and joints are at rest from arrival to departure.
    pub is_at_rest: bool,
    /// When it is reached, as a share of the duration.
    pub arrival: f64,
    /// When it is left, as a share of the duration.
    pub departure: f64,
}

/// A way from one target to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// When it begins, as a share of the duration.
    pub start: f64,
    /// When it ends, as a share of the duration.
    pub end: f64,
    /// The attitude where it begins, body → inertial.
    pub from: Quaternion<f64>,
    /// The attitude to reach, body → inertial.
    pub target: Quaternion<f64>,
    /// The angle of the shortest turn there, rad.
    pub angle_rad: f64,
}

impl Waypoint {
    /// The nodes of arrival and departure on a grid of so many steps.
    pub fn nodes(&self, steps: usize) -> [usize; 2] {
        [self.arrival, self.departure].map(|share| (share * steps as f64).round() as usize)
    }
}

impl Scenario {
    /// The ways of a slew from one target to the next, the last one to where it ends; none for a detumble.
    pub fn legs(&self) -> Vec<Leg> {
        let Some(slew) = self.maneuver().slew() else { return Vec::new() };
        let mut left = (self.initial().attitude, 0.0);
        let mut leg = |target: Quaternion<f64>, end: f64, departure: f64| {
            let (from, start) = std::mem::replace(&mut left, (target, departure));
            Leg { start, end, from, target, angle_rad: from.angle_to(&target) }
        };
        let waypoints = self.waypoints().iter();
        let mut legs: Vec<Leg> = waypoints
            .map(|waypoint| leg(waypoint.target, waypoint.arrival, waypoint.departure))
            .collect();
        legs.push(leg(slew.target, 1.0, 1.0));
        legs
    }

    /// One of its legs as a slew of its own, from the posture at the start; [`resolved`](Self::resolved) stays as
    /// it was.
    pub fn with_leg(mut self, leg: &Leg) -> Self {
        let (axis, angle_rad) = leg.from.conjugate().product(&leg.target).to_axis_angle();
        self.initial.attitude = leg.from;
        self.maneuver = Maneuver::Slew(Slew { axis, angle_rad, target: leg.target });
        self.waypoints.clear();
        self.horizon.duration_s *= leg.end - leg.start;
        self
    }
}

impl file::Scenario {
    /// Changes the duration, or the longest of a free one, and the times of all waypoints in proportion.
    pub fn stretch_to_s(&mut self, longest_s: f64) {
        let factor = longest_s / self.horizon.duration_s.longest_s();
        self.horizon.duration_s.set_longest_s(longest_s);
        for waypoint in &mut self.maneuver.waypoints {
            let times = waypoint.duration_s.iter_mut().chain(&mut waypoint.dwell_s);
            times.for_each(|time_s| *time_s *= factor);
        }
    }
}

/// Lets a slew without a target of its own end in its last waypoint.
pub(crate) fn end_in_last(maneuver: &mut file::Maneuver) {
    let file::Maneuver { kind, axis, angle_deg, target_attitude, .. } = maneuver;
    let has_target = axis.is_some() || angle_deg.is_some() || target_attitude.is_some();
    let lacks_target = *kind == file::ManeuverType::Slew && !has_target;
    if let (true, Some(last)) = (lacks_target, maneuver.waypoints.last()) {
        maneuver.axis = last.axis;
        maneuver.angle_deg = last.angle_deg;
        maneuver.target_attitude = last.target_attitude;
    }
}

/// Checks the waypoints of a slew that were read from `place`, and fills in their times.
pub(crate) fn waypoints(
    given: &mut [file::Waypoint],
    (initial, slew): (&Initial, &Slew),
    horizon: Horizon,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<Vec<Waypoint>, Error> {
    if given.len() > MOST_WAYPOINTS {
        let found = format!("{} waypoints", given.len());
        return Err(place.refuse(found, format_args!("at most {MOST_WAYPOINTS}")));
    }
    let mut targets = Vec::with_capacity(given.len());
    for (index, waypoint) in given.iter().enumerate() {
        let place = place.index(index);
        let file::Waypoint { axis, angle_deg, target_attitude, dwell_s, duration_s, .. } = waypoint;
        targets.push(slew_to((axis, angle_deg, target_attitude), initial, &place, notes)?.target);
        for (name, time_s) in [("dwell_s", dwell_s), ("duration_s", duration_s)] {
            time_s.map(|time_s| place.key(name).within(time_s, TIME_S)).transpose()?;
        }
    }
    let nodes = schedule(given, &angles(initial, &targets, slew), horizon, place)?;
    let mut left = 0;
    for (index, (waypoint, &[arrival, departure])) in given.iter_mut().zip(&nodes).enumerate() {
        let place = place.index(index);
        let mut fill = |name: &str, time_s: &mut Option<f64>, steps: usize| {
            let taken_s = horizon.time_s(steps);
            let off_s = time_s.map_or(0.0, |given_s| (given_s - taken_s).abs());
            if off_s > COMPUTED * horizon.duration_s {
                notes.push(place.key(name).note(format_args!(
                    "taken as {} s, a whole number of steps",
                    Number::rounded(taken_s, 9)
                )));
            }
            *time_s = Some(taken_s);
        };
        fill("duration_s", &mut waypoint.duration_s, arrival - left);
        fill("dwell_s", &mut waypoint.dwell_s, departure - arrival);
        waypoint.rest = Some(waypoint.rest.unwrap_or(true));
        left = departure;
    }
    let share = |node: usize| node as f64 / horizon.steps as f64;
    let checked = targets.into_iter().zip(given).zip(nodes);
    Ok(checked
        .map(|((target, waypoint), [arrival, departure])| Waypoint {
            target,
            is_at_rest: waypoint.rest.unwrap_or(true),
            arrival: share(arrival),
            departure: share(departure),
        })
        .collect())
}

/// The angles of the ways from the start over the targets to the end, rad.
fn angles(initial: &Initial, targets: &[Quaternion<f64>], slew: &Slew) -> Vec<f64> {
    let mut before = initial.attitude;
    let ways = targets.iter().chain([&slew.target]);
    ways.map(|target| std::mem::replace(&mut before, *target).angle_to(target)).collect()
}

/// The nodes at which waypoints are reached and left. What the given times leave is shared by the ways without
/// one in proportion to their angles; where the base turns on none of those, the last way takes it.
fn schedule(
    given: &[file::Waypoint],
    angles_rad: &[f64],
    horizon: Horizon,
    place: &Location,
) -> Result<Vec<[usize; 2]>, Error> {
    let step_s = horizon.step_s();
    let given_s: f64 = given
        .iter()
        .map(|waypoint| waypoint.dwell_s.unwrap_or(0.0) + waypoint.duration_s.unwrap_or(0.0))
        .sum();
    let left_s = horizon.duration_s - given_s;
    if left_s < -0.5 * step_s {
        return Err(place.refuse(
            format_args!("waypoints that take {} s", Number::rounded(given_s, 6)),
            format_args!("at most horizon.duration_s, {}", Number(horizon.duration_s)),
        ));
    }
    let open = |index: usize| given.get(index).is_none_or(|waypoint| waypoint.duration_s.is_none());
    let turn = |index: usize| if angles_rad[index] > NO_TURN_RAD { angles_rad[index] } else { 0.0 };
    let all_rad: f64 = (0..angles_rad.len()).filter(|&index| open(index)).map(turn).sum();
    let node = |time_s: f64| ((time_s / step_s).round() as usize).min(horizon.steps);
    let (mut time_s, mut left) = (0.0, 0);
    let mut nodes = Vec::with_capacity(given.len());
    let too_short = |index: usize| {
        format!(
            "a step of the horizon, {} s, at the least: the base turns by {}\u{b0}",
            Number::rounded(step_s, 6),
            Number::rounded(angles_rad[index].to_degrees(), 4)
        )
    };
    for (index, waypoint) in given.iter().enumerate() {
        let share = if all_rad > 0.0 { turn(index) / all_rad } else { 0.0 };
        let way_s = waypoint.duration_s.unwrap_or(share * left_s.max(0.0));
        time_s += way_s;
        let arrival = node(time_s);
        if turn(index) > 0.0 && arrival == left {
            let place = place.index(index).key("duration_s");
            return Err(place.refuse(Number::rounded(way_s, 6), too_short(index)));
        }
        time_s += waypoint.dwell_s.unwrap_or(0.0);
        left = node(time_s);
        nodes.push([arrival, left]);
    }
    if turn(given.len()) > 0.0 && left == horizon.steps {
        let left_s = horizon.duration_s - time_s;
        return Err(place.refuse(
            format_args!("{} s left for the way to the end", Number::rounded(left_s.max(0.0), 6)),
            too_short(given.len()),
        ));
    }
    Ok(nodes)
}

/// Refuses what waypoints do not go with: a duration that is free, since a dwell takes its time, and the paper's
/// solve, whose guess holds the start.
pub(crate) fn check_company(
    is_duration_free: bool,
    solver: SolverSettings,
    place: &Location,
) -> Result<(), Error> {
    if is_duration_free {
        let expected = "a number: maneuver.waypoints do not go with a free duration";
        return Err(place.key("horizon").key("duration_s").refuse("a free duration", expected));
    }
    if solver.is_paper() {
        let expected = "another guess: maneuver.waypoints do not go with the constant one";
        return Err(place.key("solver").key("guess").refuse("\"constant\"", expected));
    }
    Ok(())
}
