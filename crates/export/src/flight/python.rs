//! The head of a Python script: the plan as constants.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use righting_multibody::JointKind;
use righting_results::{Solution, Trajectory};

use super::{COEFFICIENTS, Flight};
use crate::xml::number;

/// Characters a line of encoded numbers.
const WIDTH: usize = 96;

/// Constants of a script.
pub(super) struct Constants {
    text: String,
}

impl Constants {
    /// The plan, without the model of its system.
    pub fn new(
        flight: &Flight,
        solution: &Solution,
        trajectory: &Trajectory,
        maneuver: &str,
    ) -> Self {
        let mut constants = Self { text: String::new() };
        let (nodes, intervals) = (trajectory.nodes(), trajectory.intervals());
        let (steps, joints) = (intervals.len(), flight.joints.len());
        constants.text("NAME", &solution.scenario.name);
        constants.text("MANEUVER", maneuver);
        constants.text("SCENARIO_SHA256", &solution.scenario_sha256);
        let names = flight.names().map(quoted);
        constants.value("JOINTS", &format!("[{}]", names.collect::<Vec<_>>().join(", ")));
        let kinds = flight.joints.iter().map(|joint| flight.arm.hinges[joint.hinge].kind);
        let unit = match kinds.into_iter().any(|kind| kind == JointKind::Prismatic) {
            true => "rad or m",
            false => "rad",
        };
        constants.text("JOINT_UNIT", unit);
        constants.value("END_ATTITUDE", &row(trajectory.end().attitude));
        constants.array("TIMES", &[steps + 1], nodes.iter().map(|node| node.time_s));
        let angles = flight.angles(nodes.iter().map(|node| &node.joint_angles_rad));
        constants.array("ANGLES", &[steps + 1, joints], angles);
        let rates = flight.motions(nodes.iter().map(|node| &node.joint_rates_rad_s));
        constants.array("RATES", &[steps + 1, joints], rates);
        let accelerations = intervals.iter().map(|interval| &interval.joint_accelerations_rad_s2);
        constants.array("ACCELERATIONS", &[steps, joints], flight.motions(accelerations));
        let still = vec![0.0; trajectory.joints()];
        let jerks = intervals.iter().map(|interval| match trajectory.has_jerks() {
            true => &interval.joint_jerks_rad_s3,
            false => &still,
        });
        constants.array("JERKS", &[steps, joints], flight.motions(jerks));
        let torques = flight.torques(intervals.iter().map(|interval| &interval.joint_torques_n_m));
        constants.array("TORQUES", &[steps, joints], torques);
        let coefficients = flight.torque_coefficients.iter().copied();
        constants.array("TORQUE_COEFFICIENTS", &[steps, COEFFICIENTS, joints], coefficients);
        constants
    }

    /// A text.
    pub fn text(&mut self, name: &str, text: &str) {
        self.value(name, &quoted(text));
    }

    /// A value in Python's words.
    pub fn value(&mut self, name: &str, value: &str) {
        writeln!(self.text, "{name} = {value}").expect("a string takes all that is written to it");
    }

    /// A text of several lines that no quotation marks or backslashes are in.
    pub fn lines(&mut self, name: &str, lines: &str) {
        self.value(name, &format!("r\"\"\"{lines}\"\"\""));
    }

    /// An array of doubles, in C order.
    pub fn array(&mut self, name: &str, shape: &[usize], values: impl IntoIterator<Item = f64>) {
        let bytes: Vec<u8> = values.into_iter().flat_map(f64::to_le_bytes).collect();
        let encoded = STANDARD.encode(bytes);
        let lines = (0..encoded.len()).step_by(WIDTH);
        let lines = lines.map(|start| &encoded[start..encoded.len().min(start + WIDTH)]);
        let lines: Vec<&str> = lines.collect();
        let shape: String = shape.iter().map(|length| format!("{length}, ")).collect();
        let value = format!("decoded(\"\"\"\n{}\n\"\"\", ({shape}))", lines.join("\n"));
        self.value(name, &value);
    }

    /// The script: `template`, which flies the plan, with these constants where it says `# CONSTANTS`, and
    /// what every script has in common.
    pub fn into_script(self, template: &str) -> Vec<u8> {
        let flight = template.replacen("# CONSTANTS\n", &self.text, 1);
        [&flight, "\n\n", include_str!("common.py")].concat().into_bytes()
    }
}

/// Numbers as a Python list.
pub(super) fn row(values: impl IntoIterator<Item = f64>) -> String {
    format!("[{}]", values.into_iter().map(number).collect::<Vec<_>>().join(", "))
}

/// A text as JSON has it, and Python too.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
