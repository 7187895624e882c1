//! Maneuvers that no motion of the arm makes.

mod held;

use std::error::Error;
use std::fmt;

use nalgebra::Vector3;
use righting_scenario::scenario::Slew;
use righting_scenario::wheels::{any_works, stored_at_start};
use righting_scenario::{Leg, Maneuver, Scenario};
use righting_verifier::ATTITUDE_ERROR;

use crate::detumble::{largest_inertia_kg_m2, some_posture_is_slower};
use crate::holonomy::{SingleJoint, TurnableAxes, off_axis_rad};

/// A bound that rests on sampled postures is taken times this: nothing possible shall be called impossible.
const SAMPLING_MARGIN: f64 = 2.0;
/// An arm that turns its base so much slower about all other axes turns it about one.
const ONE_AXIS: f64 = 0.01;
/// A detumble that gains less than this share of the rate gains nothing.
const NO_GAIN: f64 = 1e-6;

/// Why no motion of the arm makes a maneuver. Displayed as one sentence, with what is possible instead; up
/// to its semicolon it holds no number of the maneuver's own.
///
/// It follows from the arm's mechanics, its limits and the duration. That none of these reasons applies does
/// not say that there is a plan.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Impossible {
    /// No joint turns the base.
    NothingTurns,
    /// The base turns about one axis only.
    OneAxis {
        /// That axis, a unit vector in body axes.
        axis: Vector3<f64>,
        /// Angle between it, whichever way it points, and the axis asked, deg.
        off_deg: f64,
        /// No motion turns the base by as much about other axes, deg: 0, or so little that the duration
        /// does not suffice.
        others_deg: f64,
        /// Whether the cause is that the joints are parallel.
        are_joints_parallel: bool,
    },
    /// Only one joint turns the base, and it does not pass the target.
    OneJoint {
        /// What the joint is called.
        name: String,
        /// The smallest angle between what it reaches and the target, deg.
        nearest_deg: f64,
        /// The angle asked, deg.
        angle_deg: f64,
        /// The axes about which it turns the base by that angle, unit vectors in body axes at the start.
        axes: Vec<Vector3<f64>>,
        /// The largest angle by which it turns the base, deg.
        largest_deg: f64,
    },
    /// No joint turns the base, and the only wheel that works turns it about one axis.
    OneWheel {
        /// That axis, a unit vector in body axes.
        axis: Vector3<f64>,
        /// Angle between it, whichever way it points, and the axis asked, deg.
        off_deg: f64,
    },
    /// Wheels cannot hold the momentum in an attitude in which the base shall rest.
    Unheld {
        /// The attitude: `the target`, or `waypoint` with its number.
        place: String,
        /// What is left of the momentum at the least, N m s.
        left_n_m_s: f64,
        /// And turns the base at this rate at the least, deg/s.
        least_deg_s: f64,
    },
    /// The joints are too slow for the duration.
    TooShort {
        /// No motion of the joints turns the base by as much, deg.
        most_deg: f64,
        /// The angle asked, deg.
        angle_deg: f64,
        /// In this time, s.
        duration_s: f64,
    },
    /// No joint changes the rate that a detumble shall reduce.
    NothingSlows,
    /// In the posture in which the arm shall end the base turns no slower than with the arm stopped at the start.
    EndPosture {
        /// The least rate in that posture, deg/s.
        least_deg_s: f64,
        /// The rate left by stopping the arm where it starts, deg/s.
        stopped_deg_s: f64,
    },
    /// The posture at the start has the largest inertia of all: no other leaves less rate.
    LargestInertia {
        /// The largest principal inertia within the joints' limits and clearances, kg m².
        inertia_kg_m2: f64,
        /// The rate left by stopping the arm where it starts, deg/s.
        stopped_deg_s: f64,
    },
}

impl Impossible {
    /// What makes the maneuver of a scenario impossible, if that is known without planning it. A slew that
    /// is within its tolerance of doing nothing is always possible.
    pub fn of(scenario: &Scenario) -> Option<Self> {
        if let Some(unheld) = held::unheld(scenario) {
            return Some(unheld);
        }
        if any_works(scenario.wheels()) {
            return of_wheels(scenario);
        }
        // What failed wheels keep turns the base, whatever the arm does.
        if stored_at_start(scenario.wheels()) != Vector3::zeros() {
            return None;
        }
        if scenario.acting_environment().is_some() {
            return None;
        }
        match scenario.maneuver() {
            Maneuver::Slew(slew) if scenario.waypoints().is_empty() => of_slew(scenario, slew),
            // Every target is reached from the start, in all the time until then.
            Maneuver::Slew(_) => scenario.legs().into_iter().find_map(|leg| {
                let from = scenario.initial().attitude;
                let whole = scenario.clone().with_leg(&Leg { start: 0.0, from, ..leg });
                of_slew(&whole, whole.maneuver().slew()?)
            }),
            Maneuver::Detumble => of_detumble(scenario),
        }
    }

    /// The axes about which the base can turn instead, by the angle asked: unit vectors in body axes, each
    /// standing for both its directions if there is only one; empty where there is none, and where the axis
    /// is not what stands in the way.
    pub fn possible_axes(&self) -> &[Vector3<f64>] {
        match self {
            Self::OneAxis { axis, .. } | Self::OneWheel { axis, .. } => std::slice::from_ref(axis),
            Self::OneJoint { axes, .. } => axes,
            _ => &[],
        }
    }
}

fn of_slew(scenario: &Scenario, slew: &Slew) -> Option<Impossible> {
    let system = scenario.system();
    let initial = scenario.initial();
    let target = initial.attitude.conjugate().product(&slew.target).normalized();
    let missed = target.vector.norm();
    if missed <= ATTITUDE_ERROR {
        return None;
    }
    let duration_s = scenario.horizon().duration_s;
    let tolerance_rad = 2.0 * ATTITUDE_ERROR.asin();
    // Whether a rotation by `angle_rad` is out of reach at a rate that was looked for in samples.
    let is_beyond = |angle_rad: f64, fastest_rad_s: f64| {
        angle_rad - SAMPLING_MARGIN * fastest_rad_s * duration_s > tolerance_rad
    };
    let angle_rad = 2.0 * missed.min(1.0).asin();
    let turnable = TurnableAxes::new(system);
    if turnable.rank() == 0 {
        return Some(Impossible::NothingTurns);
    }
    // A rotation about the only axis a comes this near to the target: in axes that turn along about a, the
    // base turns by no more than what ω has across a.
    let axis = turnable.principal_axes[0];
    let across_rad = 2.0 * (target.vector - axis * axis.dot(&target.vector)).norm().min(1.0).asin();
    let across_rad_s = turnable.fastest_across_rad_s;
    let is_about_one_axis = across_rad_s <= ONE_AXIS * turnable.fastest_rad_s;
    if is_about_one_axis && is_beyond(across_rad, across_rad_s) {
        let others_rad = match turnable.rank() {
            1 => 0.0,
            _ => SAMPLING_MARGIN * across_rad_s * duration_s,
        };
        return Some(Impossible::OneAxis {
            axis,
            off_deg: off_axis_rad(&axis, &slew.axis).to_degrees(),
            others_deg: others_rad.to_degrees(),
            are_joints_parallel: turnable.are_joints_parallel,
        });
    }
    if let &[joint] = turnable.effective_joints.as_slice() {
        let travel_rad = system.joint_limits[joint].rate_max_rad_s * duration_s;
        let curve = SingleJoint::new(system, &initial.joint_angles_rad, joint, travel_rad);
        let nearest_rad = curve.smallest_miss_rad(&target);
        if curve.is_whole && nearest_rad > tolerance_rad {
            return Some(Impossible::OneJoint {
                name: system.names.joint(joint),
                nearest_deg: nearest_rad.to_degrees(),
                angle_deg: angle_rad.to_degrees(),
                axes: curve.axes_at(angle_rad),
                largest_deg: curve.largest_angle_rad().to_degrees(),
            });
        }
    }
    is_beyond(angle_rad, turnable.fastest_rad_s).then(|| Impossible::TooShort {
        most_deg: (SAMPLING_MARGIN * turnable.fastest_rad_s * duration_s).to_degrees(),
        angle_deg: angle_rad.to_degrees(),
        duration_s,
    })
}

/// Of a maneuver with wheels that work. One of them and a base that no joint turns: without momentum the base's rate is
/// along Ĩ⁻¹ a, which never changes.
fn of_wheels(scenario: &Scenario) -> Option<Impossible> {
    let slew = scenario.maneuver().slew()?;
    let wheels = scenario.wheels().iter();
    let stores_nothing = wheels.clone().all(|wheel| wheel.initial_momentum_n_m_s == 0.0);
    let is_at_rest = scenario.initial().angular_momentum_n_m_s == Vector3::zeros();
    let works: Vec<_> = wheels.filter(|wheel| !wheel.failed).collect();
    let [wheel] = works[..] else { return None };
    let is_alone = TurnableAxes::new(scenario.system()).rank() == 0;
    if !is_alone || !stores_nothing || !is_at_rest || scenario.environment().is_some() {
        return None;
    }
    let posture = &scenario.initial().joint_angles_rad;
    let inertia = scenario.system().model.locked_inertia(posture);
    let axis = inertia.cholesky()?.solve(&Vector3::from(wheel.axis)).normalize();
    let target = scenario.initial().attitude.conjugate().product(&slew.target).normalized();
    let across = (target.vector - axis * axis.dot(&target.vector)).norm();
    (across > ATTITUDE_ERROR).then(|| Impossible::OneWheel {
        axis,
        off_deg: off_axis_rad(&axis, &slew.axis).to_degrees(),
    })
}

fn of_detumble(scenario: &Scenario) -> Option<Impossible> {
    let stopped_rad_s = scenario.stopped_rate_rad_s();
    let enough_rad_s = stopped_rad_s * (1.0 - NO_GAIN);
    if !some_posture_is_slower(scenario, enough_rad_s) {
        let inertia_kg_m2 = largest_inertia_kg_m2(scenario);
        let least_rad_s = scenario.initial().angular_momentum_n_m_s.norm() / inertia_kg_m2;
        if least_rad_s >= enough_rad_s {
            let stopped_deg_s = stopped_rad_s.to_degrees();
            return Some(match scenario.end_angles_rad().iter().any(Option::is_some) {
                true => {
                    let least_deg_s = least_rad_s.to_degrees();
                    Impossible::EndPosture { least_deg_s, stopped_deg_s }
                }
                false => Impossible::LargestInertia { inertia_kg_m2, stopped_deg_s },
            });
        }
    }
    let turnable = TurnableAxes::new(scenario.system());
    turnable.effective_joints.is_empty().then_some(Impossible::NothingSlows)
}

impl fmt::Display for Impossible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingTurns => write!(f, "nothing that this arm's joints do turns the base"),
            Self::OneAxis { axis, off_deg, others_deg, are_joints_parallel } => {
                match are_joints_parallel {
                    true => write!(f, "this arm's joints are parallel: it turns")?,
                    false => write!(f, "this arm turns")?,
                }
                let axis = Shown(axis);
                write!(
                    f,
                    " the base about {axis} only; the axis asked is {off_deg:.1}\u{b0} from it"
                )?;
                match others_deg {
                    0.0 => Ok(()),
                    _ => write!(
                        f,
                        ", and about others it turns it by less than {}\u{b0}",
                        Degrees(*others_deg)
                    ),
                }
            }
            Self::OneJoint { name, nearest_deg, angle_deg, axes, largest_deg } => {
                write!(
                    f,
                    "only {name} of this arm turns the base, and not to the target; it comes no nearer than \
                     {nearest_deg:.1}\u{b0}, and "
                )?;
                if axes.is_empty() {
                    return write!(f, "it turns the base by {largest_deg:.1}\u{b0} at most");
                }
                let axes: Vec<String> = axes.iter().map(|axis| Shown(axis).to_string()).collect();
                write!(
                    f,
                    "by {angle_deg:.1}\u{b0} it turns the base about {} only",
                    axes.join(" or ")
                )
            }
            Self::OneWheel { axis, off_deg } => write!(
                f,
                "no joint turns the base, and the one wheel that works turns it about {} only; the axis asked is \
                 {off_deg:.1}\u{b0} from it",
                Shown(axis)
            ),
            Self::Unheld { place, left_n_m_s, least_deg_s } => write!(
                f,
                "the wheels cannot hold the angular momentum in {place}; {left_n_m_s:.3e} N m s are left, and the base \
                 turns at {least_deg_s:.3} deg/s at the least there"
            ),
            Self::TooShort { most_deg, angle_deg, duration_s } => write!(
                f,
                "the duration is too short for this arm; in {duration_s} s its joints turn the base by less \
                 than {}\u{b0}, and the angle asked is {}\u{b0}",
                Degrees(*most_deg),
                Degrees(*angle_deg)
            ),
            Self::NothingSlows => {
                write!(f, "nothing that this arm's joints do changes the base's rate")
            }
            Self::EndPosture { least_deg_s, stopped_deg_s } => write!(
                f,
                "in the posture in which the arm shall end, final.joint_angles_deg, the base turns no slower than with \
                 the arm stopped where it starts; {least_deg_s:.4} deg/s there at the least, {stopped_deg_s:.4} \
                 deg/s here"
            ),
            Self::LargestInertia { inertia_kg_m2, stopped_deg_s } => write!(
                f,
                "the posture already has the largest inertia within reach; stopping the arm there leaves \
                 {stopped_deg_s:.6} deg/s, and no other posture leaves less ({inertia_kg_m2:.4} kg m\u{b2})"
            ),
        }
    }
}

impl Error for Impossible {}

/// An angle with one decimal, or two digits where that would say nothing.
struct Degrees(f64);

impl fmt::Display for Degrees {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self(degrees) if degrees.abs() >= 0.1 => write!(f, "{degrees:.1}"),
            Self(degrees) => write!(f, "{degrees:.1e}"),
        }
    }
}

/// A unit vector with three decimals.
pub(crate) struct Shown<'a>(pub &'a Vector3<f64>);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value: f64| {
            let text = format!("{value:.3}");
            let text = text.trim_end_matches('0').trim_end_matches('.');
            if text == "-0" { "0".to_owned() } else { text.to_owned() }
        };
        let Self(vector) = self;
        write!(f, "[{}, {}, {}]", number(vector.x), number(vector.y), number(vector.z))
    }
}
