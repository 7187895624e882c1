//! Motions of the joints that are looked at, the same every time.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use righting_multibody::JointKind;
use righting_scenario::halton::Halton;
use righting_scenario::{JointLimits, SystemDescription};

use super::transport::{self, JointPath};

/// Steps along a loop, and along a straight line.
const STEPS: usize = 16;
const STEPS_STRAIGHT: usize = 4;
/// Where the part of Halton's sequence begins that phases are drawn from.
const PHASES: u64 = 1 << 20;

/// A motion of the joints: what it turns the base by, and how long it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    /// Rotation vector, body axes at the start, rad.
    pub turn_rad: Vector3<f64>,
    /// How long the joints take at their limits, one of them being at its own, s.
    pub time_s: f64,
}

impl Turn {
    /// The base's mean rate, rad/s.
    pub fn rate_rad_s(&self) -> Vector3<f64> {
        self.turn_rad / self.time_s
    }
}

/// q = m + c cos 2πs + d sin 2πs.
struct Ellipse {
    middle: Vec<f64>,
    cosine: Vec<f64>,
    sine: Vec<f64>,
}

/// A joint without limits goes once around.
struct WholeTurn<'a> {
    posture: &'a [f64],
    joint: usize,
}

/// Straight from one posture to another.
struct Line<'a> {
    from: &'a [f64],
    to: &'a [f64],
}

impl JointPath for Ellipse {
    fn at(&self, s: f64) -> (Vec<f64>, Vec<f64>) {
        let (sin, cos) = (TAU * s).sin_cos();
        let joints = 0..self.middle.len();
        joints
            .map(|i| {
                let (c, d) = (self.cosine[i], self.sine[i]);
                (self.middle[i] + c * cos + d * sin, TAU * (d * cos - c * sin))
            })
            .unzip()
    }
}

impl JointPath for WholeTurn<'_> {
    fn at(&self, s: f64) -> (Vec<f64>, Vec<f64>) {
        let mut angles = self.posture.to_vec();
        let mut rates = vec![0.0; angles.len()];
        angles[self.joint] += TAU * s;
        rates[self.joint] = TAU;
        (angles, rates)
    }
}

impl JointPath for Line<'_> {
    fn at(&self, s: f64) -> (Vec<f64>, Vec<f64>) {
        let ends = self.from.iter().zip(self.to);
        ends.map(|(from, to)| (from + s * (to - from), to - from)).unzip()
    }
}

/// The motions of some joints of a system.
pub(super) struct Motions<'a> {
    pub system: &'a SystemDescription,
    /// Where they begin: one angle a joint, rad.
    pub start: &'a [f64],
    /// The joints that move, counted from zero.
    pub joints: &'a [usize],
}

impl Motions<'_> {
    /// `count` closed loops in postures spread over the joints' ranges: by turns of all joints, of two of
    /// them, and, of a joint without limits, once around. The arm goes to a loop and back on a straight line
    /// from the start, which is done once however often it goes round, and takes no time here.
    pub fn loops(&self, count: usize) -> Vec<Turn> {
        let limits = &self.system.joint_limits;
        let is_free = |joint: usize| {
            limits[joint].angle_min_rad.is_infinite() && limits[joint].angle_max_rad.is_infinite()
        };
        let pairs = self.joints.iter().enumerate().flat_map(|(k, &i)| {
            self.joints[k..].iter().map(move |&j| [i, j]).filter(|&[i, j]| i != j || is_free(i))
        });
        let pairs: Vec<[usize; 2]> = pairs.collect();
        if pairs.is_empty() {
            return Vec::new();
        }
        let sizes = Halton::starting_after(self.start.len(), PHASES);
        let drawn = self.postures().zip(sizes).take(count).enumerate();
        drawn
            .map(|(k, (middle, sizes))| match (k % 2, pairs[k / 2 % pairs.len()]) {
                (0, _) => self.around(&self.ellipse(middle, self.joints, &sizes)),
                (_, [i, j]) if i == j => self.once_around(&middle, i),
                (_, pair) => self.around(&self.ellipse(middle, &pair, &sizes)),
            })
            .filter(|found| found.time_s > 0.0)
            .collect()
    }

    /// `count` straight motions from the start to postures spread over the joints' ranges.
    pub fn swings(&self, count: usize) -> Vec<Turn> {
        let swings = self.postures().take(count).map(|to| {
            let times = self.joints.iter().map(|&joint| {
                let limits = &self.system.joint_limits[joint];
                (to[joint] - self.start[joint]).abs() / limits.rate_max_rad_s
            });
            Turn {
                time_s: times.fold(0.0, f64::max),
                turn_rad: transport::rotation_vector(&self.straight_to(&to)),
            }
        });
        swings.filter(|found| found.time_s > 0.0).collect()
    }

    fn postures(&self) -> impl Iterator<Item = Vec<f64>> {
        Halton::new(self.start.len()).map(|unit| {
            let mut posture = self.start.to_vec();
            for &joint in self.joints {
                let [low, high] = range(&self.system.joint_limits[joint], self.start[joint]);
                posture[joint] = low + (high - low) * unit[joint];
            }
            posture
        })
    }

    /// Of `joints` as far as their limits let them sway, in phases drawn for each; of two joints a quarter
    /// of a turn apart and drawn sizes.
    fn ellipse(&self, middle: Vec<f64>, joints: &[usize], sizes: &[f64]) -> Ellipse {
        let still = vec![0.0; middle.len()];
        let mut ellipse = Ellipse { middle, cosine: still.clone(), sine: still };
        for (k, &joint) in joints.iter().enumerate() {
            let room = room(&self.system.joint_limits[joint], ellipse.middle[joint]);
            let (radius, phase) = match joints.len() {
                2 => (room * sizes[joint], 0.25 * k as f64),
                _ => (room, sizes[joint]),
            };
            let (sin, cos) = (TAU * phase).sin_cos();
            (ellipse.cosine[joint], ellipse.sine[joint]) = (radius * cos, radius * sin);
        }
        ellipse
    }

    fn around(&self, ellipse: &Ellipse) -> Turn {
        let radii = ellipse.cosine.iter().zip(&ellipse.sine).map(|(c, d)| c.hypot(*d));
        let times = radii.zip(&self.system.joint_limits).map(|(radius, limits)| {
            let by_rate = radius / limits.rate_max_rad_s;
            let by_acceleration = (radius / limits.acceleration_max_rad_s2).sqrt();
            TAU * by_rate.max(by_acceleration)
        });
        let time_s = times.fold(0.0, f64::max);
        self.conjugated(&ellipse.at(0.0).0, ellipse, time_s)
    }

    fn once_around(&self, posture: &[f64], joint: usize) -> Turn {
        let time_s = TAU / self.system.joint_limits[joint].rate_max_rad_s;
        self.conjugated(posture, &WholeTurn { posture, joint }, time_s)
    }

    /// A loop that begins in another posture than the start, as it is seen from there.
    fn conjugated(&self, from: &[f64], path: &impl JointPath, time_s: f64) -> Turn {
        let turned = transport::along(&self.system.model, path, STEPS);
        let turn_rad = self.straight_to(from).to_inertial(&transport::rotation_vector(&turned));
        Turn { turn_rad, time_s }
    }

    fn straight_to(&self, to: &[f64]) -> righting_multibody::Quaternion<f64> {
        let line = Line { from: self.start, to };
        transport::along(&self.system.model, &line, STEPS_STRAIGHT)
    }
}

/// The range of a joint's angle; half a turn either way of `start` where there is no limit.
fn range(limits: &JointLimits, start: f64) -> [f64; 2] {
    let or = |limit: f64, other: f64| if limit.is_finite() { limit } else { other };
    [or(limits.angle_min_rad, start - PI), or(limits.angle_max_rad, start + PI)]
}

/// How far a joint can sway to both sides, at most half a turn, rad; a joint that slides as far as it goes, m.
fn room(limits: &JointLimits, middle: f64) -> f64 {
    let room = (limits.angle_max_rad - middle).min(middle - limits.angle_min_rad).max(0.0);
    match limits.kind {
        JointKind::Revolute => room.min(PI),
        JointKind::Prismatic => room,
    }
}
