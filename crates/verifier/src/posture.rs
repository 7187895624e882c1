//! The posture at the end, where the scenario gives it.

use righting_scenario::file::{self, JointKind};

use crate::ledger::{Ledger, Worst};
use crate::model::State;
use crate::worst_of_joints::WorstOfJoints;

/// How far a joint may end from the angle asked, rad: as far as an attitude may be off its second
/// integration. Of a joint that slides in sizes of the system.
pub(super) const END_ANGLE_RAD: f64 = 1e-4;

/// The coordinates in which joints shall end, rad or m; none where the joint is free, and nothing where no angle is
/// asked.
#[derive(Clone, Debug, Default)]
pub(super) struct EndPosture {
    coordinates: Vec<Option<f64>>,
}

impl EndPosture {
    /// Of a resolved scenario.
    pub fn new(end: Option<&file::End>, kinds: &[JointKind]) -> Self {
        Self { coordinates: end.map_or_else(Vec::new, |end| end.joint_coordinates(kinds)) }
    }

    /// Every joint that the scenario asks a coordinate of ends there.
    pub fn check(
        &self,
        end: &State<'_>,
        (slides, size_m): (&[bool], f64),
        time_s: f64,
        ledger: &mut Ledger,
    ) {
        let turning = Worst::new("joint angle at the end", "rad", 0.0);
        let sliding = Worst::new("joint travel at the end", "m", 0.0);
        let mut worst = WorstOfJoints::new(slides, turning, sliding);
        let allowed = [END_ANGLE_RAD, END_ANGLE_RAD * size_m];
        for (joint, (asked, found)) in self.coordinates.iter().zip(end.joint_angles).enumerate() {
            if let Some(asked) = asked {
                worst.within(joint, (found - asked).abs(), allowed, time_s);
            }
        }
        worst.enter(ledger);
    }
}
