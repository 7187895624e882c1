//! The joints' motion as ROS 2 has it: `trajectory_msgs/msg/JointTrajectory`, as YAML and as JSON.

use std::fmt::Write;

use righting_results::{Node, Trajectory};
use righting_scenario::Scenario;
use serde::Serialize;

use crate::ExportError;
use crate::arm::joint_name;

const NANOSECONDS: f64 = 1e9;

/// `trajectory_msgs/msg/JointTrajectory`: coordinates, rates, accelerations and torques of the joints that
/// move, one point a node; SI units and radians, of joints that slide m and N. Locked joints are not among them.
///
/// Accelerations and torques are those with which the step begins that begins at the point, and at the last
/// point those with which the step ends that ends there: the same where accelerations are continuous.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointTrajectory {
    header: Header,
    joint_names: Vec<String>,
    points: Vec<Point>,
}

/// `std_msgs/msg/Header`: a stamp of zero starts the motion when the message is taken.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Header {
    stamp: Duration,
    frame_id: String,
}

/// `trajectory_msgs/msg/JointTrajectoryPoint`.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Point {
    positions: Vec<f64>,
    velocities: Vec<f64>,
    accelerations: Vec<f64>,
    effort: Vec<f64>,
    time_from_start: Duration,
}

/// `builtin_interfaces/msg/Duration`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
struct Duration {
    sec: i32,
    nanosec: u32,
}

impl JointTrajectory {
    /// The motion of a plan's joints.
    ///
    /// # Errors
    /// [`ExportError::Steps`] where nodes are less than a nanosecond apart.
    pub fn new(scenario: &Scenario, trajectory: &Trajectory) -> Result<Self, ExportError> {
        let system = scenario.system();
        let limits = &system.joint_limits;
        let turning: Vec<usize> =
            (0..limits.len()).filter(|&joint| !limits[joint].is_locked()).collect();
        let pick = |values: &[f64]| turning.iter().map(|index| values[*index]).collect();
        let point = |(k, node): (usize, &Node)| {
            let accelerations = trajectory.joint_accelerations_at(k);
            let torques = match trajectory.intervals().get(k) {
                Some(interval) => interval.joint_torques_n_m.clone(),
                None => {
                    let external = trajectory.external(scenario, (k, 0.0), &node.state().to_vec());
                    system.model.joint_torques(
                        &node.angular_rate_rad_s.into(),
                        &node.joint_angles_rad,
                        &node.joint_rates_rad_s,
                        &accelerations,
                        external.as_ref(),
                    )
                }
            };
            Point {
                positions: pick(&node.joint_angles_rad),
                velocities: pick(&node.joint_rates_rad_s),
                accelerations: pick(&accelerations),
                effort: pick(&torques),
                time_from_start: Duration::of(node.time_s - trajectory.start().time_s),
            }
        };
        let points: Vec<Point> = trajectory.nodes().iter().enumerate().map(point).collect();
        if points.windows(2).any(|pair| pair[1].time_from_start <= pair[0].time_from_start) {
            let times = trajectory.nodes().windows(2);
            let steps_s = times.map(|pair| pair[1].time_s - pair[0].time_s);
            return Err(ExportError::Steps { step_s: steps_s.fold(f64::INFINITY, f64::min) });
        }
        let joint_names = turning.iter().map(|&joint| joint_name(system, joint)).collect();
        Ok(Self { header: Header::default(), joint_names, points })
    }

    /// The message as YAML, as `ros2 topic pub` takes it and YAML 1.1 reads it.
    pub fn to_yaml(&self) -> String {
        let mut text = String::new();
        let mut line = |arguments: std::fmt::Arguments<'_>| {
            text.write_fmt(arguments).expect("a string takes all that is written to it");
            text.push('\n');
        };
        line(format_args!("header:"));
        line(format_args!("  stamp: {}", self.header.stamp.to_yaml()));
        line(format_args!("  frame_id: \"{}\"", self.header.frame_id));
        line(format_args!("joint_names: [{}]", self.joint_names.join(", ")));
        line(format_args!("points:"));
        for point in &self.points {
            line(format_args!("  - positions: {}", sequence(&point.positions)));
            line(format_args!("    velocities: {}", sequence(&point.velocities)));
            line(format_args!("    accelerations: {}", sequence(&point.accelerations)));
            line(format_args!("    effort: {}", sequence(&point.effort)));
            line(format_args!("    time_from_start: {}", point.time_from_start.to_yaml()));
        }
        text
    }

    /// The message as JSON.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("names and finite numbers");
        text.push('\n');
        text
    }
}

impl Duration {
    /// To the nearest nanosecond.
    fn of(time_s: f64) -> Self {
        let nanoseconds = (time_s * NANOSECONDS).round();
        let sec = (nanoseconds / NANOSECONDS).floor();
        Self { sec: sec as i32, nanosec: (nanoseconds - sec * NANOSECONDS) as u32 }
    }

    fn to_yaml(self) -> String {
        format!("{{sec: {}, nanosec: {}}}", self.sec, self.nanosec)
    }
}

fn sequence(values: &[f64]) -> String {
    let cells: Vec<String> = values.iter().copied().map(float).collect();
    format!("[{}]", cells.join(", "))
}

/// A number with 17 digits. YAML 1.1 takes it for one only with a point and a sign of the exponent.
fn float(value: f64) -> String {
    let text = format!("{value:.16e}");
    match text.contains("e-") {
        true => text,
        false => text.replace('e', "e+"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_floats_of_yaml_1_1() {
        assert_eq!(float(0.0), "0.0000000000000000e+0");
        assert_eq!(float(-1.0 / 64.0), "-1.5625000000000000e-2");
        assert_eq!(float(31.25), "3.1250000000000000e+1");
    }

    #[test]
    fn times_are_whole_nanoseconds() {
        assert_eq!(Duration::of(0.05), Duration { sec: 0, nanosec: 50_000_000 });
        assert_eq!(Duration::of(29.999_999_999_9), Duration { sec: 30, nanosec: 0 });
        assert_eq!(Duration::of(1.0 / 3.0), Duration { sec: 0, nanosec: 333_333_333 });
    }
}
