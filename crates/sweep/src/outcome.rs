//! What a case came to.

use std::fmt;

use righting_results::Status;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What a case came to, the same whenever and wherever it is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outcome {
    /// How it ended.
    pub status: CaseStatus,
    /// Whether the independent check passed: of the plan, or of the end that a plan flown open loop
    /// reached.
    pub verified: bool,
    /// Norm of the vector part of the attitude error quaternion at the end; 0 for a detumble.
    #[serde(with = "number_or_null")]
    pub attitude_error: f64,
    /// Norm of the base's angular rate at the end, deg/s.
    #[serde(with = "number_or_null")]
    pub final_rate_deg_s: f64,
    /// Norm of the joint rates at the end, deg/s.
    #[serde(with = "number_or_null")]
    pub joint_rate_deg_s: f64,
    /// Value of the objective.
    #[serde(with = "number_or_null")]
    pub objective: f64,
    /// Iterations of the last solve.
    pub iterations: usize,
    /// Why it failed, if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum CaseStatus {
    /// The optimizer ended so.
    Optimizer(Status),
    /// Flown open loop to the end.
    Flown(Flown),
    /// There was nothing to optimize, or it did not end.
    Trouble(Trouble),
}

/// Flown open loop to the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Flown {
    /// The one way to have been.
    Flown,
}

/// Why a case has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Trouble {
    /// What it sets makes no allowed scenario.
    Refused,
    /// There is no plan to fly or nothing to optimize.
    NotPlanned,
    /// No motion of the arm makes the maneuver.
    Impossible,
    /// Its worker died, twice.
    Crashed,
    /// Its worker did not answer long after the time limit, twice.
    Hung,
}

impl Outcome {
    /// A case that has no result.
    pub fn of_trouble(trouble: Trouble, reason: impl Into<String>) -> Self {
        Self::without_result(CaseStatus::Trouble(trouble), reason.into())
    }

    /// A case stopped at its time limit. How far it had come depends on the machine, and is not kept.
    pub(crate) fn out_of_time(limit_s: f64) -> Self {
        let reason = format!("not done after {limit_s} s");
        Self::without_result(CaseStatus::Optimizer(Status::TimeLimit), reason)
    }

    fn without_result(status: CaseStatus, reason: String) -> Self {
        Self {
            status,
            verified: false,
            attitude_error: f64::NAN,
            final_rate_deg_s: f64::NAN,
            joint_rate_deg_s: f64::NAN,
            objective: f64::NAN,
            iterations: 0,
            reason: Some(reason),
        }
    }

    /// Whether the case does what was asked: it converged, and the independent check agrees.
    pub fn succeeded(&self) -> bool {
        let ended_well = match self.status {
            CaseStatus::Optimizer(status) => status.is_acceptable(),
            CaseStatus::Flown(_) => true,
            CaseStatus::Trouble(_) => false,
        };
        ended_well && self.verified
    }
}

impl fmt::Display for CaseStatus {
    /// As it stands in records and tables, such as `iteration_limit`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// Numbers that are not finite as `null`, which JSON has no other word for.
mod number_or_null {
    use super::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        if value.is_finite() {
            serializer.serialize_f64(*value)
        } else {
            serializer.serialize_none()
        }
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_status_is_one_word_that_can_be_read_back() {
        for (status, word) in [
            (CaseStatus::Optimizer(Status::IterationLimit), "iteration_limit"),
            (CaseStatus::Flown(Flown::Flown), "flown"),
            (CaseStatus::Trouble(Trouble::NotPlanned), "not_planned"),
            (CaseStatus::Trouble(Trouble::Impossible), "impossible"),
        ] {
            assert_eq!(status.to_string(), word);
            let text = serde_json::to_string(&status).unwrap();
            assert_eq!(text, format!("\"{word}\""));
            assert_eq!(serde_json::from_str::<CaseStatus>(&text).unwrap(), status);
        }
    }

    #[test]
    fn an_outcome_without_numbers_can_be_read_back() {
        let outcome = Outcome::of_trouble(Trouble::Crashed, "signal 9");
        let text = serde_json::to_string(&outcome).unwrap();
        assert!(text.contains("\"objective\":null"), "{text}");
        let read: Outcome = serde_json::from_str(&text).unwrap();
        assert!(read.objective.is_nan() && !read.succeeded());
        assert_eq!(serde_json::to_string(&read).unwrap(), text);
    }
}
