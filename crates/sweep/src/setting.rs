//! The settings of one field: a list, or a rule that makes one.

use std::collections::HashSet;

use righting_analysis::envelope::fibonacci;
use righting_scenario::Error;
use righting_scenario::json::{Bounds, Location};
use serde_json::{Value, json};

use crate::draw::Draws;
use crate::file;

const FINITE: Bounds = Bounds::Between(-1e300, 1e300);
const DEVIATION: Bounds = Bounds::Between(0.0, 1e300);
/// Longer arrays are text in a table.
const LONGEST_VECTOR: usize = 32;
/// The most settings that are kept in memory.
const MOST_LISTED: f64 = 1e6;
/// The most that are drawn as they are asked for.
const MOST_DRAWN: f64 = 1e8;

/// What all settings of a field are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Numbers.
    Number,
    /// Arrays of so many numbers.
    Vector(usize),
    /// Objects such as systems, each with another `name`, by which a table shows them.
    Named,
    /// Anything else, which a table shows as text.
    Text,
}

/// The settings of one field, in order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Settings {
    Listed(Vec<Value>),
    Uniform { low: f64, high: f64, count: usize, draws: Draws },
    Normal { mean: f64, deviation: f64, count: usize, draws: Draws },
    Directions { count: usize, draws: Draws },
}

impl Settings {
    /// Checks the one rule that a dimension of `field` gives.
    pub fn from_file(
        dimension: &file::Dimension,
        field: &str,
        place: &Location,
    ) -> Result<Self, Error> {
        const RULES: &str = "`values`, `grid`, `fibonacci`, `uniform`, `normal` or `directions`";
        let file::Dimension { values, grid, fibonacci, uniform, normal, directions, .. } =
            dimension;
        let rules = [
            ("`values`", values.is_some()),
            ("`grid`", grid.is_some()),
            ("`fibonacci`", fibonacci.is_some()),
            ("`uniform`", uniform.is_some()),
            ("`normal`", normal.is_some()),
            ("`directions`", directions.is_some()),
        ];
        let given: Vec<&str> =
            rules.into_iter().filter_map(|(rule, is_given)| is_given.then_some(rule)).collect();
        if given.len() != 1 {
            let found = if given.is_empty() { "none".to_owned() } else { given.join(" and ") };
            return Err(place.refuse(found, format_args!("one of {RULES}")));
        }
        let draws = |seed: u64| Draws::new(seed, field);
        if let Some(values) = values {
            listed(values, &place.key("values"))
        } else if let Some(grid) = grid {
            spaced(grid, &place.key("grid"))
        } else if let Some(count) = *fibonacci {
            let count = count_of(count, MOST_LISTED, &place.key("fibonacci"))?;
            Ok(Self::Listed(lattice(count)))
        } else if let Some(uniform) = uniform {
            let place = place.key("uniform");
            let low = place.key("low").within(uniform.low, FINITE)?;
            let high = place.key("high").within(uniform.high, FINITE)?;
            if low >= high {
                return Err(place.key("high").refuse(high, format_args!("a number above {low}")));
            }
            let count = count_of(uniform.count, MOST_DRAWN, &place.key("count"))?;
            Ok(Self::Uniform { low, high, count, draws: draws(uniform.seed) })
        } else if let Some(normal) = normal {
            let place = place.key("normal");
            Ok(Self::Normal {
                mean: place.key("mean").within(normal.mean, FINITE)?,
                deviation: place.key("deviation").within(normal.deviation, DEVIATION)?,
                count: count_of(normal.count, MOST_DRAWN, &place.key("count"))?,
                draws: draws(normal.seed),
            })
        } else if let Some(directions) = directions {
            let place = place.key("directions").key("count");
            let count = count_of(directions.count, MOST_DRAWN, &place)?;
            Ok(Self::Directions { count, draws: draws(directions.seed) })
        } else {
            unreachable!("one of them is given")
        }
    }

    pub fn len(&self) -> usize {
        match self {
            Self::Listed(values) => values.len(),
            Self::Uniform { count, .. }
            | Self::Normal { count, .. }
            | Self::Directions { count, .. } => *count,
        }
    }

    /// What all of them are.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Uniform { .. } | Self::Normal { .. } => Kind::Number,
            Self::Directions { .. } => Kind::Vector(3),
            Self::Listed(values) => {
                let first = kind_of(&values[0]);
                let alike = values.iter().all(|value| kind_of(value) == first);
                match (alike, are_named(values)) {
                    (_, true) => Kind::Named,
                    (true, false) => first,
                    (false, false) => Kind::Text,
                }
            }
        }
    }

    /// Whether they are a list, of which any may be the same as another.
    pub fn are_listed(&self) -> bool {
        matches!(self, Self::Listed(_))
    }

    /// Setting `index` of [`len`](Self::len).
    pub fn get(&self, index: usize) -> Value {
        match self {
            Self::Listed(values) => values[index].clone(),
            Self::Uniform { low, high, draws, .. } => json!(draws.uniform(index, *low, *high)),
            Self::Normal { mean, deviation, draws, .. } => {
                json!(draws.normal(index, *mean, *deviation))
            }
            Self::Directions { draws, .. } => json!(draws.direction(index)),
        }
    }
}

fn kind_of(value: &Value) -> Kind {
    match value {
        Value::Number(_) => Kind::Number,
        Value::Array(elements)
            if (1..=LONGEST_VECTOR).contains(&elements.len())
                && elements.iter().all(Value::is_number) =>
        {
            Kind::Vector(elements.len())
        }
        _ => Kind::Text,
    }
}

/// Whether all are objects with names of which none appears twice.
fn are_named(values: &[Value]) -> bool {
    let mut seen = HashSet::new();
    values.iter().all(|value| value["name"].as_str().is_some_and(|name| seen.insert(name)))
}

fn count_of(count: u64, most: f64, place: &Location) -> Result<usize, Error> {
    Ok(place.within(count as f64, Bounds::Whole(1.0, most))? as usize)
}

fn listed(values: &[Value], place: &Location) -> Result<Settings, Error> {
    if !(1..=MOST_LISTED as usize).contains(&values.len()) {
        let expected = format!("1 to {MOST_LISTED}");
        return Err(place.refuse(format!("{} values", values.len()), expected));
    }
    Ok(Settings::Listed(values.to_vec()))
}

fn spaced(grid: &file::Grid, place: &Location) -> Result<Settings, Error> {
    let from = place.key("from").within(grid.from, FINITE)?;
    let to = place.key("to").within(grid.to, FINITE)?;
    let count = count_of(grid.count, MOST_LISTED, &place.key("count"))?;
    if (from == to) != (count == 1) {
        let allowed = "1 where `from` and `to` are the same, more where they are not";
        return Err(place.key("count").refuse(count, allowed));
    }
    let last = (count - 1).max(1) as f64;
    // In this form round steps give round numbers.
    let number = |i: usize| json!((from * (last - i as f64) + to * i as f64) / last);
    Ok(Settings::Listed((0..count).map(number).collect()))
}

fn lattice(count: usize) -> Vec<Value> {
    fibonacci(count).map(|axis| json!([axis.x, axis.y, axis.z])).collect()
}
