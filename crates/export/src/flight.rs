//! What it takes to fly a plan by its torques alone.
//!
//! Scripts build the system in a simulator and apply the plan's torques, which are given as a polynomial
//! of every step.

mod basilisk;
mod mujoco;
mod python;
mod step_torques;

pub use basilisk::basilisk;
pub use mujoco::mujoco;

use righting_results::Trajectory;
use righting_scenario::Scenario;

use crate::ExportError;
use crate::arm::Arm;
use step_torques::{COEFFICIENTS, StepTorques};

/// A plan as simulators fly it.
///
/// Torques do not tell the angle of a joint that turns no inertia, and of two joints on one axis with
/// no inertia between them they tell the sum only. The former, and the first of the latter, hold their
/// angle at the start; the second of two makes the motion of both. All that has mass moves as planned.
struct Flight {
    arm: Arm,
    joints: Vec<FlownJoint>,
    /// Of every step, a row of each power of the place in the step, which goes from −1 to 1, N m or N.
    torque_coefficients: Vec<f64>,
}

/// A joint that moves in a flight.
struct FlownJoint {
    /// Its hinge, by its place.
    hinge: usize,
    /// Its place among the joint coordinates.
    index: usize,
    /// The joints before it whose motion it makes too, and the sense of each.
    others: Vec<(usize, f64)>,
}

impl Flight {
    fn new(scenario: &Scenario, trajectory: &Trajectory) -> Result<Self, ExportError> {
        let mut arm = Arm::new(scenario.system());
        let start_rad = &trajectory.start().joint_angles_rad;
        let mut joints = Vec::new();
        let mut others: Vec<(usize, f64)> = Vec::new();
        for index in 0..arm.hinges.len() {
            let next = arm.only_next(index);
            let sense = next.and_then(|next| arm.hinges[index].shares_axis_with(next));
            let hinge = &mut arm.hinges[index];
            let start_rad = start_rad[hinge.coordinate];
            if hinge.is_idle {
                hinge.held_at.get_or_insert(start_rad);
            }
            if hinge.held_at.is_some() {
                others.clear();
                continue;
            }
            match sense {
                Some(sense) => {
                    hinge.held_at = Some(start_rad);
                    others.push((hinge.coordinate, 1.0));
                    others.iter_mut().for_each(|(_, of_other)| *of_other *= sense);
                }
                None => {
                    let others = std::mem::take(&mut others);
                    joints.push(FlownJoint { hinge: index, index: hinge.coordinate, others });
                }
            }
        }
        let torques = StepTorques::new(scenario, trajectory)?;
        let mut torque_coefficients = Vec::new();
        for of_joints in &torques.coefficients {
            let rows = (0..COEFFICIENTS)
                .flat_map(|power| joints.iter().map(move |joint| of_joints[joint.index][power]));
            torque_coefficients.extend(rows);
        }
        Ok(Self { arm, joints, torque_coefficients })
    }

    /// Names of the joints that turn.
    fn names(&self) -> impl Iterator<Item = &str> {
        self.joints.iter().map(|joint| self.arm.hinges[joint.hinge].joint.as_str())
    }

    /// Torques of the joints that turn, of rows of all joints.
    fn torques<'a>(&self, rows: impl Iterator<Item = &'a Vec<f64>>) -> Vec<f64> {
        rows.flat_map(|row| self.joints.iter().map(|joint| row[joint.index])).collect()
    }

    /// Rates or accelerations of the joints that turn, of rows of all joints.
    fn motions<'a>(&self, rows: impl Iterator<Item = &'a Vec<f64>>) -> Vec<f64> {
        rows.flat_map(|row| self.joints.iter().map(|joint| joint.motion(row))).collect()
    }

    /// Angles of the joints that turn, of rows of all joints.
    fn angles<'a>(&self, rows: impl Iterator<Item = &'a Vec<f64>>) -> Vec<f64> {
        let held = |joint: &FlownJoint| -> f64 {
            let angle = |index: usize| {
                let hinge = self.arm.hinges.iter().find(|hinge| hinge.coordinate == index);
                hinge.and_then(|hinge| hinge.held_at).unwrap_or_default()
            };
            joint.others.iter().map(|(other, sense)| sense * angle(*other)).sum()
        };
        let angle = |joint: &FlownJoint, row: &[f64]| joint.motion(row) - held(joint);
        rows.flat_map(|row| self.joints.iter().map(|joint| angle(joint, row))).collect()
    }
}

impl FlownJoint {
    fn motion(&self, row: &[f64]) -> f64 {
        row[self.index] + self.others.iter().map(|(other, sense)| sense * row[*other]).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use righting_scenario::file::Duration;
    use righting_test_support::{motion, shipped, swing, varied};

    /// The tabulated arm's joints 1 and 2 turn about one axis with nothing between them, and its last link
    /// is a point on its joint's axis.
    #[test]
    fn joints_that_torques_do_not_tell_are_held() {
        let scenario = varied(&shipped("slew_canadarm2_table"), |file| {
            file.horizon.duration_s = Duration::Given(3.0);
            file.horizon.steps = 6.0;
        });
        let model = &scenario.system().model;
        let trajectory = motion(&scenario, &swing(&scenario));
        let flight = Flight::new(&scenario, &trajectory).unwrap();
        let held: Vec<&str> = flight
            .arm
            .hinges
            .iter()
            .filter(|hinge| hinge.held_at.is_some())
            .map(|hinge| hinge.joint.as_str())
            .collect();
        assert_eq!(held.first(), Some(&"joint_1"));
        assert_eq!(held.last(), Some(&"joint_7"));

        // Held so, the arm has its center of mass where the plan has it.
        let planned = &trajectory.nodes()[3].joint_angles_rad;
        let flown = flight.angles(std::iter::once(planned));
        let mut angles: Vec<f64> =
            flight.arm.hinges.iter().map(|hinge| hinge.held_at.unwrap_or_default()).collect();
        flight.joints.iter().zip(flown).for_each(|(joint, angle)| angles[joint.index] = angle);
        let moved = (angles[0] - planned[0]).abs();
        assert!(moved > 0.01, "{moved} rad shows nothing");
        let [found, expected] = [&angles, planned].map(|angles| model.center_of_mass(angles));
        assert!((found - expected).norm() < 1e-12, "{found} {expected}");
    }
}
