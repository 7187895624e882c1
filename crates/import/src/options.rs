//! What is taken from a robot.

use std::collections::BTreeMap;

use righting_multibody::Placement;

/// What is taken from a robot, and how. SI units and radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What floats.
    pub base: BaseOption,
    /// The link at the end of the only branch that moves; every joint off the way from the base to it is
    /// held. By default all branches move.
    pub tip: Option<String>,
    /// Coordinates in which joints are held, rad or m, by joint.
    pub locked: BTreeMap<String, f64>,
    /// Links that are left out, with all that hangs on them.
    pub dropped: Vec<String>,
}

/// What floats.
#[derive(Clone, Debug, PartialEq)]
pub enum BaseOption {
    /// This link of the robot; its frame is the base's.
    Link(String),
    /// A body that is not in the file, which the robot's root link is fixed to.
    Mounted(
        /// The root link's frame in that body's.
        Placement,
    ),
}

impl Options {
    /// The whole robot floats by this link.
    pub fn floating(link: impl Into<String>) -> Self {
        Self::of(BaseOption::Link(link.into()))
    }

    /// The robot's root link is fixed to another body, at this place of it.
    pub fn mounted(placement: Placement) -> Self {
        Self::of(BaseOption::Mounted(placement))
    }

    fn of(base: BaseOption) -> Self {
        Self { base, tip: None, locked: BTreeMap::new(), dropped: Vec::new() }
    }
}
