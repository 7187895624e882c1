//! The posture at the end, where the scenario gives it.

use righting_scenario::file;

use crate::ledger::{Ledger, Subject, Worst};
use crate::model::State;

/// How far a joint may end from the angle asked, rad: as far as an attitude may be off its second
/// integration.
pub(super) const END_ANGLE_RAD: f64 = 1e-4;

/// The angles in which joints shall end, rad; none where the joint is free, and nothing where no angle is
/// asked.
#[derive(Clone, Debug, Default)]
pub(super) struct EndPosture {
    angles_rad: Vec<Option<f64>>,
}

impl EndPosture {
    /// Of a resolved scenario.
    pub fn new(end: Option<&file::End>) -> Self {
        let angles_deg = end.and_then(|end| end.joint_angles_deg.as_ref()).into_iter().flatten();
        Self { angles_rad: angles_deg.map(|angle| angle.map(f64::to_radians)).collect() }
    }

    /// Every joint that the scenario asks an angle of ends there.
    pub fn check(&self, end: &State<'_>, time_s: f64, ledger: &mut Ledger) {
        let mut worst = Worst::new("joint angle at the end", "rad", 0.0);
        for (joint, (asked, found)) in self.angles_rad.iter().zip(end.joint_angles).enumerate() {
            if let Some(asked) = asked {
                let subject = Some(Subject::Joint(joint));
                worst.at_most((found - asked).abs(), END_ANGLE_RAD, subject, Some(time_s));
            }
        }
        ledger.add(worst);
    }
}
