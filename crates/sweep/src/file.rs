//! The shape of sweep files, before anything in them is believed.

use righting_scenario::file::Scenario;
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

/// Many maneuvers: a base scenario and what varies in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: a sweep")]
#[schemars(title = "Righting sweep")]
pub struct Sweep {
    /// Name of the sweep.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Free text for the reader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Path of a scenario file, relative to this file, or the scenario itself: what every case has
    /// but for the fields that vary.
    pub scenario: ScenarioReference,
    /// What varies. The dimensions are crossed: every setting of each with every setting of the
    /// others, the last one fastest.
    #[schemars(length(min = 1))]
    pub vary: Vec<Dimension>,
    /// What is done with a case; `plan` by default.
    #[serde(default)]
    pub evaluation: Evaluation,
    /// How long a case may take, s; 600 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub case_time_limit_s: Option<f64>,
}

/// A scenario by file name or inline.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ScenarioReference {
    /// Path of a scenario file, relative to the sweep file.
    File(String),
    /// The scenario itself; its system's path is relative to the sweep file.
    Inline(Box<Scenario>),
}

/// What is done with a case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Evaluation {
    /// Plan the case and verify the plan.
    #[default]
    Plan,
    /// Plan the base scenario once and fly that plan's joint motion in the case's system.
    OpenLoop,
}

/// One dimension: a field with its settings, or several that change together.
///
/// Of `values`, `grid`, `fibonacci`, `uniform`, `normal` and `directions` a field has exactly one;
/// `zip` stands alone.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `field` or `zip`")]
pub struct Dimension {
    /// JSON path of the field in the scenario, such as `system.links[1].mass_kg`; `[*]` stands for
    /// every element of an array, all of which are set alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
    /// Head of its column in the results; the field's path by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Whether the settings are factors on the base scenario's number (or numbers) there.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub relative: bool,
    /// A list; of the field `system` systems, or paths of system files relative to this file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub values: Option<Vec<Value>>,
    /// Evenly spaced numbers, both ends included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<Grid>,
    /// So many unit vectors on a spherical Fibonacci lattice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1_000_000))]
    pub fibonacci: Option<u64>,
    /// Random numbers, all of a range alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uniform: Option<Uniform>,
    /// Random numbers, normally distributed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<Normal>,
    /// Random unit vectors, all directions alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub directions: Option<Directions>,
    /// Fields that change together, first setting with first setting: each with as many. Settings may repeat,
    /// but no combination of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub zip: Option<Vec<Dimension>>,
}

/// Evenly spaced numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `from`, `to` and `count`")]
pub struct Grid {
    /// The first.
    pub from: f64,
    /// The last.
    pub to: f64,
    /// How many.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub count: u64,
}

/// Random numbers, all of a range alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `low`, `high` and `count`")]
pub struct Uniform {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// How many.
    #[schemars(range(min = 1, max = 100_000_000))]
    pub count: u64,
    /// Seed; 0 by default. Fields draw their own numbers from the same seed.
    #[serde(default)]
    pub seed: u64,
}

/// Random numbers, normally distributed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `mean`, `deviation` and `count`")]
pub struct Normal {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    #[schemars(range(min = 0))]
    pub deviation: f64,
    /// How many.
    #[schemars(range(min = 1, max = 100_000_000))]
    pub count: u64,
    /// Seed; 0 by default. Fields draw their own numbers from the same seed.
    #[serde(default)]
    pub seed: u64,
}

/// Random unit vectors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `count`")]
pub struct Directions {
    /// How many.
    #[schemars(range(min = 1, max = 100_000_000))]
    pub count: u64,
    /// Seed; 0 by default.
    #[serde(default)]
    pub seed: u64,
}

// Read by hand: serde's derived reader of an untagged type forgets what was wrong in the
// alternative that was meant.
impl<'de> Deserialize<'de> for ScenarioReference {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct FileOrInline;
        impl<'de> Visitor<'de> for FileOrInline {
            type Value = ScenarioReference;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("the path of a scenario file, or an object: a scenario")
            }

            fn visit_str<E: serde::de::Error>(self, path: &str) -> Result<Self::Value, E> {
                Ok(ScenarioReference::File(path.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let scenario = Scenario::deserialize(MapAccessDeserializer::new(map))?;
                Ok(ScenarioReference::Inline(Box::new(scenario)))
            }
        }
        deserializer.deserialize_any(FileOrInline)
    }
}
