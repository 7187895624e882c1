//! Duration and grid, as they stand in a scenario file.

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::whole_number::whole_number;

/// Duration and grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `duration_s` and `steps`")]
pub struct Horizon {
    /// Duration, s: a number, or the shortest and the longest of a duration that is free.
    pub duration_s: Duration,
    /// Number of equal intervals N.
    #[schemars(with = "u64", range(min = 1, max = 100_000))]
    #[serde(serialize_with = "whole_number")]
    pub steps: f64,
}

/// How long a maneuver takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Duration {
    /// So long, s.
    Given(#[schemars(extend("exclusiveMinimum" = 0))] f64),
    /// As long as is best.
    Free(DurationRange),
}

/// Between what a free duration may be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `min` and `max`")]
pub struct DurationRange {
    /// The shortest, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub min: f64,
    /// The longest, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub max: f64,
}

impl From<f64> for Duration {
    fn from(duration_s: f64) -> Self {
        Self::Given(duration_s)
    }
}

impl Duration {
    /// The duration, or the longest of a free one, s.
    pub fn longest_s(self) -> f64 {
        match self {
            Self::Given(duration_s) => duration_s,
            Self::Free(DurationRange { max, .. }) => max,
        }
    }

    /// Changes the duration, or the longest of a free one.
    pub fn set_longest_s(&mut self, longest_s: f64) {
        match self {
            Self::Given(duration_s) => *duration_s = longest_s,
            Self::Free(DurationRange { max, .. }) => *max = longest_s,
        }
    }

    /// So many times as long.
    pub fn times(self, factor: f64) -> Self {
        match self {
            Self::Given(duration_s) => Self::Given(factor * duration_s),
            Self::Free(DurationRange { min, max }) => {
                Self::Free(DurationRange { min: factor * min, max: factor * max })
            }
        }
    }
}

impl<'de> Deserialize<'de> for Duration {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct GivenOrFree;
        impl<'de> Visitor<'de> for GivenOrFree {
            type Value = Duration;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a number, or an object with `min` and `max`")
            }

            fn visit_f64<E: serde::de::Error>(self, duration_s: f64) -> Result<Self::Value, E> {
                Ok(Duration::Given(duration_s))
            }

            fn visit_u64<E: serde::de::Error>(self, duration_s: u64) -> Result<Self::Value, E> {
                Ok(Duration::Given(duration_s as f64))
            }

            fn visit_i64<E: serde::de::Error>(self, duration_s: i64) -> Result<Self::Value, E> {
                Ok(Duration::Given(duration_s as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                DurationRange::deserialize(MapAccessDeserializer::new(map)).map(Duration::Free)
            }
        }
        deserializer.deserialize_any(GivenOrFree)
    }
}
