//! JSON values made after a JSON Schema: what a format's own description allows, and now and then what it does not.

use arbitrary::{Result, Unstructured};
use serde_json::{Map, Value, json};

use crate::hostile;

/// Nested values end here.
const DEEPEST: usize = 8;
/// The most elements of an array.
const MOST_ELEMENTS: usize = 4;

/// A value with fewer places is varied no more often in each.
const FEWEST_PLACES: u32 = 40;

/// A schema with the definitions that it refers to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Schema<'s> {
    root: &'s Value,
    here: &'s Value,
}

impl<'s> Schema<'s> {
    pub(crate) fn new(root: &'s Value) -> Self {
        Self { root, here: root }
    }

    fn at(self, here: &'s Value) -> Self {
        Self { here, ..self }
    }

    /// The schema that a reference leads to.
    fn followed(self) -> Self {
        let pointer = self.here.get("$ref").and_then(Value::as_str);
        match pointer.and_then(|pointer| self.root.pointer(pointer.trim_start_matches('#'))) {
            Some(there) => self.at(there).followed(),
            None => self,
        }
    }

    /// The schema of a field.
    fn field(self, name: &str) -> Option<Self> {
        self.fields()?.get(name).map(|field| self.at(field))
    }

    fn fields(self) -> Option<&'s Map<String, Value>> {
        self.followed().here.get("properties").and_then(Value::as_object)
    }

    /// One of several that may hold.
    fn alternative(self, u: &mut Unstructured<'_>) -> Result<Self> {
        let this = self.followed();
        let of = |key: &str| this.here.get(key).and_then(Value::as_array);
        match of("anyOf").or_else(|| of("oneOf")) {
            Some(alternatives) if !alternatives.is_empty() => {
                this.at(u.choose(alternatives)?).alternative(u)
            }
            _ => Ok(this),
        }
    }

    /// A value that fits, or nearly.
    pub(crate) fn value(self, u: &mut Unstructured<'_>, depth: usize) -> Result<Value> {
        if depth > DEEPEST || u.ratio(1, 30)? {
            return hostile::value(u);
        }
        let this = self.alternative(u)?;
        let here = this.here;
        if let Some(constant) = here.get("const") {
            return Ok(constant.clone());
        }
        if let Some(words) = here.get("enum").and_then(Value::as_array) {
            return Ok(u.choose(words)?.clone());
        }
        let kind = match here.get("type") {
            Some(Value::Array(kinds)) if !kinds.is_empty() => u.choose(kinds)?.as_str(),
            Some(kind) => kind.as_str(),
            None => None,
        };
        match kind {
            Some("object") => this.object(u, depth),
            Some("array") => this.array(u, depth),
            Some("number" | "integer") => this.number(u),
            Some("boolean") => Ok(json!(u.arbitrary::<bool>()?)),
            Some("string") => Ok(json!(hostile::text(u)?)),
            Some("null") => Ok(Value::Null),
            _ => hostile::value(u),
        }
    }

    fn object(self, u: &mut Unstructured<'_>, depth: usize) -> Result<Value> {
        let mut object = Map::new();
        let required = self.here.get("required").and_then(Value::as_array);
        for (name, field) in self.fields().into_iter().flatten() {
            let is_required = required.is_some_and(|names| names.iter().any(|n| n == name));
            let chances = if is_required { (29, 30) } else { (1, 4) };
            if u.ratio(chances.0, chances.1)? {
                object.insert(name.clone(), self.at(field).value(u, depth + 1)?);
            }
        }
        if let Some(values) = self.here.get("additionalProperties").filter(|v| v.is_object()) {
            object.insert(hostile::text(u)?, self.at(values).value(u, depth + 1)?);
        }
        Ok(Value::Object(object))
    }

    fn array(self, u: &mut Unstructured<'_>, depth: usize) -> Result<Value> {
        let limit = |key: &str| self.here.get(key).and_then(Value::as_u64).map(|n| n as usize);
        let least = limit("minItems").unwrap_or(0);
        let most = limit("maxItems").unwrap_or(least + MOST_ELEMENTS).min(least + MOST_ELEMENTS);
        let mut count = u.int_in_range(least..=most.max(least))?;
        if u.ratio(1, 30)? {
            count += 1;
        }
        let items = self.here.get("items").unwrap_or(&Value::Null);
        let elements = (0..count).map(|_| self.at(items).value(u, depth + 1));
        Ok(Value::Array(elements.collect::<Result<_>>()?))
    }

    fn number(self, u: &mut Unstructured<'_>) -> Result<Value> {
        let limit = |key: &str| self.here.get(key).and_then(Value::as_f64);
        let least = limit("minimum").or(limit("exclusiveMinimum"));
        let most = limit("maximum").or(limit("exclusiveMaximum"));
        let within = f64::from(u.arbitrary::<u16>()?) / f64::from(u16::MAX);
        let number = match (least, most, u.int_in_range(0..=5)?) {
            (_, _, 0) => hostile::number(u)?,
            (Some(least), _, 1) => least,
            (_, Some(most), 1) => most,
            (Some(least), Some(most), _) => least + within * (most - least),
            (Some(least), None, _) => least + 10.0 * within,
            (None, Some(most), _) => most - 10.0 * within,
            (None, None, _) => 10.0 * (2.0 * within - 1.0),
        };
        let is_whole = self.here.get("type").is_some_and(|kind| kind == "integer");
        Ok(if is_whole { json!(number as i64) } else { json!(number) })
    }

    /// Changes a value that fits here and there, in a few places of all: fields come, go and change.
    pub(crate) fn vary(self, u: &mut Unstructured<'_>, value: &mut Value) -> Result<()> {
        let places = u32::try_from(places(value)).unwrap_or(u32::MAX).max(FEWEST_PLACES);
        self.vary_one_in(places, u, value, 0)
    }

    fn vary_one_in(
        self,
        places: u32,
        u: &mut Unstructured<'_>,
        value: &mut Value,
        depth: usize,
    ) -> Result<()> {
        if u.ratio(1, places)? {
            *value = self.value(u, depth)?;
            return Ok(());
        }
        match value {
            Value::Object(object) => {
                let this = self.with_fields_of(object);
                let names: Vec<String> = object.keys().cloned().collect();
                for name in names {
                    if u.ratio(1, 2 * places)? {
                        object.remove(&name);
                    } else if let (Some(field), Some(inner)) =
                        (this.field(&name), object.get_mut(&name))
                    {
                        field.vary_one_in(places, u, inner, depth + 1)?;
                    }
                }
                for (name, field) in this.fields().into_iter().flatten() {
                    if !object.contains_key(name) && u.ratio(1, places)? {
                        object.insert(name.clone(), this.at(field).value(u, depth + 1)?);
                    }
                }
                if u.ratio(1, 4 * places)? {
                    object.insert(hostile::text(u)?, hostile::value(u)?);
                }
            }
            Value::Array(elements) => {
                let this = self.followed();
                let items = this.at(this.here.get("items").unwrap_or(&Value::Null));
                for element in &mut *elements {
                    items.vary_one_in(places, u, element, depth + 1)?;
                }
                if u.ratio(1, places)? {
                    match u.int_in_range(0..=2)? {
                        0 => drop(elements.pop()),
                        1 => elements.extend(elements.last().cloned()),
                        _ => elements.push(items.value(u, depth + 1)?),
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The alternative with the most fields of an object.
    fn with_fields_of(self, object: &Map<String, Value>) -> Self {
        let this = self.followed();
        let of = |key: &str| this.here.get(key).and_then(Value::as_array);
        let Some(alternatives) = of("anyOf").or_else(|| of("oneOf")) else { return this };
        let shared =
            |schema: &Self| object.keys().filter(|name| schema.field(name).is_some()).count();
        let alternatives = alternatives.iter().map(|schema| this.at(schema).with_fields_of(object));
        alternatives.max_by_key(shared).unwrap_or(this)
    }
}

/// How many values there are in one.
fn places(value: &Value) -> usize {
    1 + match value {
        Value::Object(object) => object.values().map(places).sum(),
        Value::Array(elements) => elements.iter().map(places).sum(),
        _ => 0,
    }
}
