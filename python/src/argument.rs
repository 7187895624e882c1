//! Arguments that are numbers of a range.

use std::num::NonZeroUsize;
use std::time::Duration;

use crate::failure::{Failure, Outcome};

/// A time.
pub fn seconds(name: &'static str, seconds: f64) -> Outcome<Duration> {
    let duration = Some(seconds).filter(|seconds| *seconds > 0.0);
    let duration = duration.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| refused(name, seconds, "a time above 0"))
}

/// How many of something.
pub fn count(name: &'static str, count: usize) -> Outcome<NonZeroUsize> {
    NonZeroUsize::new(count).ok_or_else(|| refused(name, count, "at least 1"))
}

/// A number above zero.
pub fn above_zero(name: &'static str, value: f64) -> Outcome<f64> {
    within(name, value, value > 0.0, "a number above 0")
}

/// A number that is not below zero.
pub fn not_negative(name: &'static str, value: f64) -> Outcome<f64> {
    within(name, value, value >= 0.0, "a number from 0")
}

/// A percentage below 100, as a share.
pub fn share(name: &'static str, percent: f64) -> Outcome<f64> {
    let is_allowed = (0.0..100.0).contains(&percent);
    within(name, percent, is_allowed, "a number from 0, below 100").map(|percent| percent / 100.0)
}

fn within(
    name: &'static str,
    value: f64,
    is_allowed: bool,
    expected: &'static str,
) -> Outcome<f64> {
    match is_allowed && value.is_finite() {
        true => Ok(value),
        false => Err(refused(name, value, expected)),
    }
}

fn refused(name: &'static str, found: impl ToString, expected: &'static str) -> Failure {
    Failure::Argument { name, found: found.to_string(), expected }
}
