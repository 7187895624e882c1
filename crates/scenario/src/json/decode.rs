//! A JSON tree as typed values, with an error that is structured instead of a sentence.

use std::fmt::{self, Display};

use serde::de::value::StrDeserializer;
use serde::de::{
    self, Deserialize, DeserializeSeed, Deserializer, Expected, IntoDeserializer, MapAccess,
    SeqAccess, Unexpected, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value};

use super::{nearest, shown, shown_key};
use crate::error::{FieldError, FieldProblem, Mismatch};

/// Reads a tree as a `T`.
pub(super) fn decode<'a, T: Deserialize<'a>>(root: &'a Value) -> Result<T, FieldError> {
    T::deserialize(Node(root)).map_err(DecodeError::into_field_error)
}

/// A step of a JSON path.
#[derive(Debug)]
enum Step {
    Key(String),
    Index(usize),
}

/// A field error whose path is still being found: steps are added on the way out of the tree.
#[derive(Debug)]
struct DecodeError {
    /// Innermost first.
    steps: Vec<Step>,
    problem: FieldProblem,
}

impl DecodeError {
    fn at(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }

    /// Fills in the value if the error was raised about it just now.
    fn about(mut self, node: &Value) -> Self {
        if let FieldProblem::Mismatch(Mismatch { found, .. }) = &mut self.problem
            && found.is_empty()
        {
            *found = shown(node);
        }
        self
    }

    /// What stands there is filled in by [`about`](Self::about).
    fn expected(expected: impl Display) -> Self {
        let problem = FieldProblem::Mismatch(Mismatch::new("", expected));
        Self { steps: Vec::new(), problem }
    }

    fn into_field_error(self) -> FieldError {
        let mut path = String::new();
        for step in self.steps.iter().rev() {
            match step {
                Step::Key(key) if path.is_empty() => path.push_str(&shown_key(key)),
                Step::Key(key) => path.extend([".", &shown_key(key)]),
                Step::Index(index) => path.push_str(&format!("[{index}]")),
            }
        }
        FieldError { path, problem: self.problem }
    }
}

impl Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.problem)
    }
}

impl std::error::Error for DecodeError {}

impl de::Error for DecodeError {
    fn custom<T: Display>(message: T) -> Self {
        Self::expected(message)
    }

    fn invalid_type(_: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::expected(phrase(&expected.to_string()))
    }

    fn invalid_value(_: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::expected(phrase(&expected.to_string()))
    }

    fn invalid_length(_: usize, expected: &dyn Expected) -> Self {
        Self::expected(phrase(&expected.to_string()))
    }

    fn unknown_variant(variant: &str, expected: &'static [&'static str]) -> Self {
        let mut named = alternatives(expected);
        if let Some(nearest) = nearest(variant, expected) {
            named.push_str(&format!("; did you mean \"{nearest}\"?"));
        }
        Self::expected(named)
    }

    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        let problem = FieldProblem::Unknown {
            nearest: nearest(field, expected).map(str::to_owned),
            known: expected.iter().map(|&name| name.to_owned()).collect(),
        };
        Self { steps: vec![Step::Key(field.to_owned())], problem }
    }

    fn missing_field(field: &'static str) -> Self {
        let problem = FieldProblem::Missing { expected: String::new() };
        Self { steps: vec![Step::Key(field.to_owned())], problem }
    }

    fn duplicate_field(field: &'static str) -> Self {
        Self { steps: vec![Step::Key(field.to_owned())], problem: FieldProblem::Duplicate }
    }
}

/// Rust's word for a type in a user's words.
fn phrase(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "u64" | "usize" => "a whole number from 0".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "an array".to_owned(),
        _ if expected.starts_with("struct ") => "an object".to_owned(),
        _ => expected.to_owned(),
    }
}

fn alternatives(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    match quoted.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => quoted.concat(),
    }
}

#[derive(Clone, Copy)]
struct Node<'a>(&'a Value);

impl<'de> Deserializer<'de> for Node<'de> {
    type Error = DecodeError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DecodeError> {
        let result = match self.0 {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Number(number) => match (number.as_u64(), number.as_i64(), number.as_f64()) {
                (Some(value), ..) => visitor.visit_u64(value),
                (None, Some(value), _) => visitor.visit_i64(value),
                (None, None, Some(value)) => visitor.visit_f64(value),
                (None, None, None) => Err(DecodeError::expected("a number")),
            },
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Array(elements) => visitor.visit_seq(Elements { elements, next: 0 }),
            Value::Object(entries) => visitor.visit_map(Entries::new(entries)),
        };
        result.map_err(|error| error.about(self.0))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DecodeError> {
        match self.0 {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        len: usize,
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        match self.0 {
            Value::Array(elements) if elements.len() == len => self.deserialize_any(visitor),
            _ => Err(DecodeError::expected(format_args!("an array of {len}")).about(self.0)),
        }
    }

    // The derived reader of a struct also takes an array of its fields in order; a file may not.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        match self.0 {
            Value::Array(_) => Err(de::Error::invalid_type(Unexpected::Seq, &visitor)),
            _ => self.deserialize_any(visitor),
        }
        .map_err(|error: DecodeError| error.about(self.0))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        let result = match self.0 {
            Value::String(name) => {
                let name: StrDeserializer<'_, DecodeError> = name.as_str().into_deserializer();
                visitor.visit_enum(name)
            }
            _ => Err(DecodeError::expected(alternatives(variants))),
        };
        result.map_err(|error| error.about(self.0))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct newtype_struct seq tuple_struct map identifier ignored_any
    }
}

struct Elements<'a> {
    elements: &'a [Value],
    next: usize,
}

impl<'de> SeqAccess<'de> for Elements<'de> {
    type Error = DecodeError;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, DecodeError> {
        let index = self.next;
        let Some(element) = self.elements.get(index) else { return Ok(None) };
        self.next += 1;
        seed.deserialize(Node(element)).map(Some).map_err(|error| error.at(Step::Index(index)))
    }
}

struct Entries<'a> {
    entries: serde_json::map::Iter<'a>,
    current: Option<(&'a String, &'a Value)>,
}

impl<'a> Entries<'a> {
    fn new(entries: &'a Map<String, Value>) -> Self {
        Self { entries: entries.iter(), current: None }
    }
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = DecodeError;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, DecodeError> {
        self.current = self.entries.next();
        let Some((key, _)) = self.current else { return Ok(None) };
        let key: StrDeserializer<'_, DecodeError> = key.as_str().into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<T::Value, DecodeError> {
        let Some((key, value)) = self.current.take() else {
            return Err(de::Error::custom("a value without a key"));
        };
        seed.deserialize(Node(value)).map_err(|error| error.at(Step::Key(key.clone())))
    }
}
