//! What the independent check of a trajectory found.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::finite_or_null::FiniteOrNull;

/// Outcome of the independent check: by another model of the system and another integrator than the
/// planner's.
///
/// The mismatches compare the trajectory with what that model and integrator make of its first node
/// and its controls alone.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Verification {
    /// Whether every check passed.
    pub passed: bool,
    /// Largest change of the angular momentum along the trajectory's nodes, relative to the largest
    /// momentum of the arm or of the system along it.
    #[serde(with = "FiniteOrNull")]
    pub momentum_drift: f64,
    /// Largest angle between the trajectory's attitude and the second integration's, rad.
    #[serde(with = "FiniteOrNull")]
    pub attitude_mismatch: f64,
    /// Largest difference in a joint angle, rad.
    #[serde(with = "FiniteOrNull")]
    pub joint_mismatch: f64,
    /// Largest difference in the base's position, m.
    #[serde(with = "FiniteOrNull")]
    pub position_mismatch: f64,
    /// Every check, the worst place of each.
    pub checks: Vec<Check>,
}

/// One check at the place where it is closest to failing or fails most.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Check {
    /// What was checked.
    pub name: String,
    /// The joint, link, pair of links or instrument, where the check has one: "joint 2", "link 3 and body".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// The value at the worst place.
    #[serde(with = "FiniteOrNull")]
    pub value: f64,
    /// What the value must not exceed, or must not fall below.
    pub limit: f64,
    /// Which of the two.
    pub sense: Sense,
    /// How far past the limit still passes.
    pub tolerance: f64,
    /// Unit of value, limit and tolerance; empty for a pure number.
    pub unit: String,
    /// Time of the worst place, s, where the check has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Whether it is about a limit that holds along the way.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_limit: bool,
    /// Whether it passed.
    pub passed: bool,
}

/// How near a plan comes to a limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LimitRecord {
    /// What is limited, and whether at the nodes or between them.
    pub name: String,
    /// The joint, link or pair of links, or instrument, where the limit has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// The value at the worst place.
    #[serde(with = "FiniteOrNull")]
    pub value: f64,
    /// What the value must not exceed, or must not fall below.
    pub bound: f64,
    /// Which of the two.
    pub sense: Sense,
    /// Unit of value and bound; empty for a pure number.
    pub unit: String,
    /// Time of the worst place, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
}

impl LimitRecord {
    /// How far the value is on the right side of its bound, in their unit; negative beyond it.
    pub fn margin(&self) -> f64 {
        match self.sense {
            Sense::AtMost => self.bound - self.value,
            Sense::AtLeast => self.value - self.bound,
        }
    }

    /// What is limited, whether at the nodes or between them.
    pub fn quantity(&self) -> &str {
        let name = self.name.strip_suffix(" between nodes");
        name.or(self.name.strip_suffix(" at nodes")).unwrap_or(&self.name)
    }
}

/// Which side of its limit a value must be on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sense {
    /// The value must not exceed the limit.
    AtMost,
    /// The value must not fall below the limit.
    AtLeast,
}

impl Verification {
    /// Every limit that holds along the way, at its worst place.
    pub fn limits(&self) -> Vec<LimitRecord> {
        let limits = self.checks.iter().filter(|check| check.is_limit);
        limits
            .map(|check| LimitRecord {
                name: check.name.clone(),
                subject: check.subject.clone(),
                value: check.value,
                bound: check.limit,
                sense: check.sense,
                unit: check.unit.clone(),
                time_s: check.time_s,
            })
            .collect()
    }

    /// The checks that failed.
    pub fn failures(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| !check.passed)
    }

    /// The check called `name`, if it was made.
    pub fn check(&self, name: &str) -> Option<&Check> {
        self.checks.iter().find(|check| check.name == name)
    }
}

impl fmt::Display for Check {
    /// One line, such as `joint angle between nodes: joint 2: 1.5712 rad at 12.35 s, at most 1.5708
    /// ± 0.001 rad`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name)?;
        if let Some(subject) = &self.subject {
            write!(f, "{subject}: ")?;
        }
        let [value, limit] = told_apart(self.value, self.limit);
        write!(f, "{value}")?;
        if let Some(time_s) = self.time_s {
            write!(f, " at {time_s:.3} s")?;
        }
        let sense = match self.sense {
            Sense::AtMost => "at most",
            Sense::AtLeast => "at least",
        };
        write!(f, ", {sense} {limit}")?;
        if self.tolerance > 0.0 {
            write!(f, " ± {:.1e}", self.tolerance)?;
        }
        if !self.unit.is_empty() {
            write!(f, " {}", self.unit)?;
        }
        Ok(())
    }
}

/// Two numbers with seven significant digits, or as many more as it takes to see that they differ.
fn told_apart(a: f64, b: f64) -> [String; 2] {
    let shown = |digits: usize| [a, b].map(|number| format!("{number:.digits$e}"));
    let differ = |[a, b]: &[String; 2]| a != b;
    (6..17).map(shown).find(differ).unwrap_or_else(|| shown(6))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_margin_is_negative_beyond_the_bound_whichever_side_that_is() {
        let margin = |sense, value| {
            let name = "joint angle between nodes".to_owned();
            let (subject, unit, time_s) = (None, "rad".to_owned(), None);
            let limit = LimitRecord { name, subject, value, bound: -1.5, sense, unit, time_s };
            assert_eq!(limit.quantity(), "joint angle");
            limit.margin()
        };
        assert_eq!(margin(Sense::AtLeast, -1.0), 0.5);
        assert_eq!(margin(Sense::AtLeast, -2.0), -0.5);
        assert_eq!(margin(Sense::AtMost, -1.0), -0.5);
    }

    #[test]
    fn a_value_just_beyond_its_limit_is_not_printed_as_the_limit() {
        let check = |value| Check {
            name: "angular rate at the end".to_owned(),
            subject: None,
            value,
            limit: 1.0,
            sense: Sense::AtMost,
            tolerance: 0.0,
            unit: "deg/s".to_owned(),
            time_s: Some(60.0),
            is_limit: false,
            passed: false,
        };
        let said = |value| check(value).to_string();
        let name = "angular rate at the end";
        assert_eq!(
            said(1.000_000_02),
            format!("{name}: 1.00000002e0 at 60.000 s, at most 1.00000000e0 deg/s")
        );
        assert_eq!(said(1.5), format!("{name}: 1.500000e0 at 60.000 s, at most 1.000000e0 deg/s"));
        assert_eq!(said(1.0), format!("{name}: 1.000000e0 at 60.000 s, at most 1.000000e0 deg/s"));
        let least_above_one = 1.0 + f64::EPSILON;
        assert!(
            said(least_above_one).contains("1.0000000000000002e0"),
            "{}",
            said(least_above_one)
        );
    }
}
