//! How to solve, as it stands in a scenario file.

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::whole_number::optional_whole_number;

/// How to solve.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object of solver settings")]
pub struct Solver {
    /// States of the optimal control problem; `reduced` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub formulation: Option<Formulation>,
    /// Initial guess; `auto` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guess: Option<Guess>,
    /// Who makes the iterations; `ipopt` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub optimizer: Option<Optimizer>,
    /// Linear solver inside the optimizer; `auto` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linear_solver: Option<LinearSolverChoice>,
    /// Largest number of iterations; 3000 by default.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        serialize_with = "optional_whole_number"
    )]
    #[schemars(with = "Option<u64>", range(min = 1, max = 1_000_000))]
    pub max_iterations: Option<f64>,
    /// Wall time after which a plan is stopped, s; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    pub time_limit_s: Option<f64>,
    /// Convergence tolerance of the optimizer; 1e-8 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1e-14, max = 1e-2))]
    pub tolerance: Option<f64>,
}

/// States of the optimal control problem.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// All 13 + 2j states of the free-floating system.
    Full,
    /// Momentum eliminated: attitude, joint angles and joint rates, 4 + 2j states.
    #[default]
    Reduced,
}

/// Initial guess of the optimizer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Guess {
    /// A named way of guessing.
    Named(NamedGuess),
    /// The best of several low-discrepancy starts.
    Starts(LowDiscrepancyStarts),
}

/// The named ways of guessing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NamedGuess {
    /// The start held over the horizon, no control.
    Constant,
    /// Whatever is fastest and finds the best plan.
    Auto,
}

/// The best of several low-discrepancy starts: joint motions whose ends are points of a Halton sequence,
/// the same every time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `starts`")]
pub struct LowDiscrepancyStarts {
    /// Number of starts.
    #[schemars(range(min = 1, max = 1000))]
    pub starts: u64,
    /// Which stretch of the sequence; 0 by default.
    #[serde(default)]
    pub seed: u64,
}

/// Who makes the iterations of the interior-point method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Optimizer {
    /// Ipopt makes every plan. The starts that are compared before it, and the coarser grids, are solved
    /// by Righting's own implementation of Ipopt's method, and by Ipopt where that gives up.
    #[default]
    Ipopt,
    /// Righting's own implementation makes the plan too, and Ipopt where that gives up; with MUMPS Ipopt
    /// alone.
    Interior,
    /// The same as `ipopt`.
    Auto,
}

/// Linear solver inside the optimizer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LinearSolverChoice {
    /// The faster of those that work for the problem.
    #[default]
    Auto,
    /// MUMPS, for any problem.
    Mumps,
    /// The factorisation that knows the stages of an optimal control problem.
    Stage,
}

impl<'de> Deserialize<'de> for Guess {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NamedOrStarts;
        impl<'de> Visitor<'de> for NamedOrStarts {
            type Value = Guess;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("\"constant\", \"auto\" or an object with `starts`")
            }

            fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Self::Value, E> {
                match name {
                    "constant" => Ok(Guess::Named(NamedGuess::Constant)),
                    "auto" => Ok(Guess::Named(NamedGuess::Auto)),
                    _ => Err(E::unknown_variant(name, &["constant", "auto"])),
                }
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let starts = LowDiscrepancyStarts::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Guess::Starts(starts))
            }
        }
        deserializer.deserialize_any(NamedOrStarts)
    }
}
