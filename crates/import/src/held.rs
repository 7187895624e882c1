//! Joints that are held, at which coordinate, and why.

use std::fmt;

use crate::error::{ImportError, OptionName, listed, quoted};
use crate::options::Options;
use crate::robot::{Joint, JointKind, Limits, Robot};

/// Why a joint does not move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Held {
    /// The file says that it is fixed.
    Fixed,
    /// It is locked at this coordinate by an option.
    Locked(f64),
    /// Its limits leave this coordinate only.
    Limited(f64),
    /// It mimics another joint, which stands at its coordinate zero, or is held, so that this is its own.
    Mimicking(f64),
    /// It is off the way from base to tip, and held here, at zero or the limit next to it.
    OffTheWay(f64),
}

impl Held {
    /// Where it is held, rad or m.
    pub fn coordinate(&self) -> f64 {
        match *self {
            Self::Fixed => 0.0,
            Self::Locked(at) | Self::Limited(at) | Self::Mimicking(at) | Self::OffTheWay(at) => at,
        }
    }

    /// Why, for a note.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::Fixed => "since it is fixed",
            Self::Locked(_) => "as asked",
            Self::Limited(_) => "since its limits allow nothing else",
            Self::Mimicking(_) => "since it mimics another joint, whose motion it would follow",
            Self::OffTheWay(_) => "since it is not on the way from base to tip",
        }
    }
}

impl Robot {
    /// The coordinates in which options lock joints, one a joint; none of the others.
    pub(crate) fn locked(&self, options: &Options) -> Result<Vec<Option<f64>>, ImportError> {
        let mut locked = vec![None; self.joints.len()];
        for (name, &at) in &options.locked {
            let Some(index) = self.joints.iter().position(|joint| joint.name == *name) else {
                let movable = self.joints.iter().filter(|joint| joint.moves());
                let names = listed(movable.map(|joint| joint.name.as_str()));
                let expected = format!("joints of the robot that move: {names}");
                return Err(OptionName::Locked.refuse(quoted(name), expected));
            };
            let joint = &self.joints[index];
            if !joint.moves() {
                let found = format!("{}, which has no coordinate", quoted(name));
                return Err(OptionName::Locked.refuse(found, "joints that turn or slide"));
            }
            let lower = joint.limits.lower.max(-Limits::FARTHEST);
            let upper = joint.limits.upper.min(Limits::FARTHEST);
            if !(lower <= at && at <= upper) {
                let range = [lower, upper].map(|at| joint.shown(at));
                let found = format!("{} at {}", quoted(name), joint.shown(at));
                let expected = format!("its limits kept: {} to {}", range[0], range[1]);
                return Err(OptionName::Locked.refuse(found, expected));
            }
            locked[index] = Some(at);
        }
        Ok(locked)
    }

    /// Why joint `index` is held; none where it moves.
    pub(crate) fn held(
        &self,
        index: usize,
        locked: &[Option<f64>],
        is_on_the_way: bool,
    ) -> Option<Held> {
        let joint = &self.joints[index];
        if !joint.moves() {
            return Some(Held::Fixed);
        }
        if let Some(at) = locked[index] {
            return Some(Held::Locked(at));
        }
        if joint.mimic.is_some() {
            return Some(Held::Mimicking(self.mimicked(index, locked)));
        }
        if joint.limits.lower == joint.limits.upper {
            return Some(Held::Limited(joint.limits.lower));
        }
        (!is_on_the_way).then(|| Held::OffTheWay(joint.rest()))
    }

    /// The coordinate of a joint that mimics others, which are locked or at rest.
    fn mimicked(&self, index: usize, locked: &[Option<f64>]) -> f64 {
        // coordinate = factor · (that of `joint`) + offset, along a chain that may be a ring.
        let (mut joint, mut factor, mut offset) = (index, 1.0, 0.0);
        for _ in 0..self.joints.len() {
            let Some(mimic) = self.joints[joint].mimic.filter(|_| locked[joint].is_none()) else {
                break;
            };
            offset += factor * mimic.offset;
            factor *= mimic.multiplier;
            joint = mimic.joint;
        }
        let at = factor * locked[joint].unwrap_or(self.joints[joint].rest()) + offset;
        let limits = self.joints[index].limits;
        match at.abs() <= Limits::FARTHEST {
            true => at.max(limits.lower).min(limits.upper),
            // No mechanism: a product of multipliers beyond sense.
            false => self.joints[index].rest(),
        }
    }
}

impl Joint {
    /// Whether it has one coordinate.
    pub(crate) fn moves(&self) -> bool {
        matches!(self.kind, JointKind::Turning | JointKind::Sliding)
    }

    /// Zero, or the limit next to it, rad or m.
    fn rest(&self) -> f64 {
        0.0_f64.max(self.limits.lower).min(self.limits.upper)
    }

    /// A coordinate as messages give it.
    pub(crate) fn shown(&self, coordinate: f64) -> impl fmt::Display + use<> {
        if self.kind == JointKind::Sliding {
            format!("{coordinate} m")
        } else {
            format!("{} deg", (coordinate.to_degrees() * 1e9).round() / 1e9)
        }
    }
}
