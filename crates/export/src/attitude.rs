//! What attitude files have in common: how a node and a text are written.

use std::fmt::Write;

use nalgebra::{Quaternion, UnitQuaternion};
use righting_results::Node;
use righting_scenario::error::Mismatch;

use crate::ExportError;

/// The longest value that keeps a line within 254 characters.
const LONGEST_VALUE: usize = 200;

/// Q1 Q2 Q3 QC and the angular rate in deg/s, 16 digits each, as many as an Attitude Ephemeris Message
/// takes.
pub(crate) fn numbers(node: &Node) -> String {
    let unit = unit(node);
    let rates = node.angular_rate_rad_s.map(f64::to_degrees);
    let mut text = String::new();
    for number in [unit.i, unit.j, unit.k, unit.w].into_iter().chain(rates) {
        // An Attitude Ephemeris Message has no negative zero.
        let number = if number == 0.0 { 0.0 } else { number };
        write!(text, " {number:.15e}").expect("a string takes all that is written to it");
    }
    text
}

/// The attitude, body → inertial.
pub(crate) fn unit(node: &Node) -> UnitQuaternion<f64> {
    let [w, x, y, z] = node.attitude;
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

/// A text value: printable ASCII on one line, upper case as Attitude Ephemeris Messages ask for.
pub(crate) fn value(keyword: &'static str, value: &str) -> Result<String, ExportError> {
    let trimmed = value.trim();
    let is_plain = trimmed.chars().all(|c| c == ' ' || c.is_ascii_graphic());
    if trimmed.is_empty() || trimmed.len() > LONGEST_VALUE || !is_plain {
        let expected = "1 to 200 printable ASCII characters";
        let mismatch = Mismatch::new(format_args!("{value:?}"), expected);
        return Err(ExportError::Value { keyword, mismatch });
    }
    Ok(trimmed.to_ascii_uppercase())
}

/// A comment of any text in printable ASCII.
pub(crate) fn plain(comment: &str) -> String {
    let spelt = comment.replace("°/s", "deg/s").replace('°', " deg");
    let is_plain = |&c: &char| c == ' ' || c.is_ascii_graphic();
    spelt.chars().filter(is_plain).take(LONGEST_VALUE).collect()
}
