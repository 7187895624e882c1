//! The attitudes that one joint alone gives the base.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use righting_multibody::Quaternion;
use righting_scenario::SystemDescription;

use super::transport::{self, JointPath};

/// Longest step along the curve, rad of the joint; of one that slides in sizes of the system.
const STEP_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// No joint is followed for more turns than this, either way; none that slides for more sizes than its radians.
const MOST_TURNS: f64 = 20.0;
/// Axes nearer to each other than this count once, rad.
const SAME_AXIS_RAD: f64 = 0.01;

/// The curve of the base's attitudes while one joint moves and the others stay: the exact answer for an arm
/// with a single joint that counts.
#[derive(Clone, Debug, PartialEq)]
pub struct SingleJoint {
    /// The joint, counted from zero.
    pub joint: usize,
    /// Whether the curve goes as far as the joint does: it is followed for 20 turns at most.
    pub is_whole: bool,
    /// Attitudes relative to the start (body → body at the start), in the order of the joint's angle.
    attitudes: Vec<Quaternion<f64>>,
}

/// One joint moves, the others stay: s is its angle.
struct Turned<'a> {
    posture: &'a [f64],
    joint: usize,
}

impl JointPath for Turned<'_> {
    fn at(&self, s: f64) -> (Vec<f64>, Vec<f64>) {
        let mut angles = self.posture.to_vec();
        let mut rates = vec![0.0; angles.len()];
        angles[self.joint] = s;
        rates[self.joint] = 1.0;
        (angles, rates)
    }
}

impl SingleJoint {
    /// From the posture `start_rad` (one angle a joint) as far as `joint`'s limits go, but no further than
    /// `travel_rad` either way (m where it slides).
    ///
    /// # Panics
    /// `start_rad` does not have one angle a joint, or there is no such joint.
    pub fn new(
        system: &SystemDescription,
        start_rad: &[f64],
        joint: usize,
        travel_rad: f64,
    ) -> Self {
        let limits = &system.joint_limits[joint];
        let start = start_rad[joint];
        let unit = 1.0 / system.radians_a_unit()[joint];
        let (most, step) = (MOST_TURNS * TAU * unit, STEP_RAD * unit);
        let [down, up] = [start - limits.angle_min_rad, limits.angle_max_rad - start]
            .map(|room| room.clamp(0.0, travel_rad.max(0.0)));
        let path = Turned { posture: start_rad, joint };
        let side = |room: f64, way: f64| -> Vec<Quaternion<f64>> {
            let room = room.min(most);
            let steps = (room / step).ceil() as usize;
            let at = |k: usize| start + way * room * k as f64 / steps as f64;
            let mut attitude = Quaternion::identity();
            let mut passed = Vec::with_capacity(steps);
            for k in 0..steps {
                let turn = transport::step(&system.model, &path, at(k), at(k + 1));
                attitude = attitude.product(&turn);
                passed.push(attitude);
            }
            passed
        };
        let mut attitudes = side(down, -1.0);
        attitudes.reverse();
        attitudes.push(Quaternion::identity());
        attitudes.extend(side(up, 1.0));
        Self { joint, is_whole: down <= most && up <= most, attitudes }
    }

    /// How near the curve comes to the rotation `target` of the base from its start: the smallest angle
    /// between the two, rad.
    pub fn smallest_miss_rad(&self, target: &Quaternion<f64>) -> f64 {
        let at_start = Quaternion::identity().angle_to(target);
        let segments = self.attitudes.windows(2).map(|ends| nearest(&ends[0], &ends[1], target));
        segments.fold(at_start, f64::min)
    }

    /// The largest angle by which the joint turns the base from its start, rad, at most π.
    pub fn largest_angle_rad(&self) -> f64 {
        self.angles().fold(0.0, f64::max)
    }

    /// The axes (unit vectors, body axes at the start) about which the joint turns the base by `angle_rad`,
    /// positive and at most π.
    pub fn axes_at(&self, angle_rad: f64) -> Vec<Vector3<f64>> {
        let mut axes: Vec<Vector3<f64>> = Vec::new();
        let angles: Vec<f64> = self.angles().collect();
        for (ends, attitudes) in angles.windows(2).zip(self.attitudes.windows(2)) {
            let [before, after] = [ends[0] - angle_rad, ends[1] - angle_rad];
            if before * after > 0.0 || before == after {
                continue;
            }
            let share = before / (before - after);
            let turn = transport::rotation_vector(&attitudes[0].conjugate().product(&attitudes[1]));
            let here = attitudes[0].product(&transport::rotation(&(turn * share)));
            let axis = here.to_axis_angle().0;
            if axes.iter().all(|known| known.angle(&axis) > SAME_AXIS_RAD) {
                axes.push(axis);
            }
        }
        axes
    }

    fn angles(&self) -> impl Iterator<Item = f64> {
        self.attitudes.iter().map(|attitude| attitude.to_axis_angle().1)
    }
}

/// The smallest angle between `target` and the attitudes on the shortest way between two others, rad.
///
/// With (w, v) the target seen from the first of them, the angle to the attitude turned by φ about the unit
/// vector a is least where w cos(φ/2) + a·v sin(φ/2) is most.
fn nearest(from: &Quaternion<f64>, to: &Quaternion<f64>, target: &Quaternion<f64>) -> f64 {
    let (axis, length) = from.conjugate().product(to).to_axis_angle();
    let seen = from.conjugate().product(target);
    let seen = if seen.w < 0.0 { Quaternion { w: -seen.w, vector: -seen.vector } } else { seen };
    let best = (2.0 * axis.dot(&seen.vector).atan2(seen.w)).clamp(0.0, length);
    Quaternion::from_axis_angle(&axis, best).angle_to(&seen)
}
