//! JSON text as a tree in which no object has a key twice.

use std::fmt;

use serde::de::{
    Deserialize, DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor,
};
use serde_json::{Map, Number, Value};

use super::shown_path;

/// What the parser is told when a key appears twice, to know its own complaint again.
const DUPLICATE: &str = "duplicate field";

/// Why a text is not a tree.
pub(super) struct SyntaxError {
    /// JSON path of the place; empty at the root.
    pub path: String,
    pub problem: SyntaxProblem,
}

pub(super) enum SyntaxProblem {
    /// The path's last key appears twice.
    Duplicate,
    /// The text is not JSON.
    NotJson { line: usize, column: usize, reason: String },
}

pub(super) fn parse(text: &str) -> Result<Value, SyntaxError> {
    let mut source = serde_json::Deserializer::from_str(text);
    let tree: Result<Unique, _> = serde_path_to_error::deserialize(&mut source);
    let Unique(root) = tree.map_err(|error| {
        // The last segment is unknown where the parser has left a value but met no next key.
        let path = error.path().to_string();
        let path = path.trim_end_matches('?').trim_end_matches('.');
        syntax_error(if path.is_empty() { String::new() } else { shown_path(path) }, error.inner())
    })?;
    source.end().map_err(|error| syntax_error(String::new(), &error))?;
    Ok(root)
}

fn syntax_error(path: String, error: &serde_json::Error) -> SyntaxError {
    let text = error.to_string();
    let reason = text.split(" at line ").next().unwrap_or(&text).to_owned();
    let problem = if reason == DUPLICATE {
        SyntaxProblem::Duplicate
    } else {
        SyntaxProblem::NotJson { line: error.line(), column: error.column(), reason }
    };
    SyntaxError { path, problem }
}

/// Any JSON value.
struct Unique(Value);

impl<'de> Deserialize<'de> for Unique {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Tree).map(Self)
    }
}

struct Tree;

impl<'de> Visitor<'de> for Tree {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(Value::Number(value.into()))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(Value::Number(value.into()))
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Value, E> {
        Number::from_f64(value).map(Value::Number).ok_or_else(|| E::custom("number out of range"))
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(Value::String(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Value, A::Error> {
        let mut array = Vec::new();
        while let Some(Unique(element)) = elements.next_element()? {
            array.push(element);
        }
        Ok(Value::Array(array))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            if object.contains_key(&key) {
                entries.next_value_seed(Refused)?;
            }
            let Unique(value) = entries.next_value()?;
            object.insert(key, value);
        }
        Ok(Value::Object(object))
    }
}

/// The value of a key that has one already. Refusing it from within gives the complaint its path.
struct Refused;

impl<'de> DeserializeSeed<'de> for Refused {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, _: D) -> Result<(), D::Error> {
        Err(D::Error::custom(DUPLICATE))
    }
}
