//! Checks a value against a JSON Schema, for the keywords that ours use. A keyword that is not known
//! here is a failure, so no part of a schema goes unchecked.

use serde_json::{Map, Value};

/// What is wrong with `value`, if anything.
pub fn violation(root: &Value, value: &Value) -> Option<String> {
    Schema { root }.violation(root, value)
}

struct Schema<'a> {
    root: &'a Value,
}

impl Schema<'_> {
    fn violation(&self, schema: &Value, value: &Value) -> Option<String> {
        match schema {
            Value::Bool(true) => None,
            Value::Bool(false) => Some(format!("{value} must not be there")),
            Value::Object(schema) => {
                schema.iter().find_map(|(keyword, rule)| self.broken(schema, keyword, rule, value))
            }
            _ => panic!("not a schema: {schema}"),
        }
    }

    fn is_valid(&self, schema: &Value, value: &Value) -> bool {
        self.violation(schema, value).is_none()
    }

    fn broken(
        &self,
        schema: &Map<String, Value>,
        keyword: &str,
        rule: &Value,
        value: &Value,
    ) -> Option<String> {
        let holds = match keyword {
            "$schema" | "$defs" | "title" | "description" | "default" | "format" => true,
            "$ref" => {
                let pointer = rule.as_str().unwrap().strip_prefix('#').unwrap();
                return self.violation(self.root.pointer(pointer).unwrap(), value);
            }
            "type" => match rule {
                Value::Array(names) => names.iter().any(|name| is_of_type(name, value)),
                name => is_of_type(name, value),
            },
            "const" => rule == value,
            "oneOf" => alternatives(rule).filter(|rule| self.is_valid(rule, value)).count() == 1,
            "anyOf" => alternatives(rule).any(|rule| self.is_valid(rule, value)),
            "required" => value.as_object().is_none_or(|object| {
                alternatives(rule).all(|key| object.contains_key(key.as_str().unwrap()))
            }),
            "properties" => {
                let object = value.as_object()?;
                let rules = rule.as_object().unwrap().iter();
                return rules
                    .filter_map(|(key, rule)| Some((key, rule, object.get(key)?)))
                    .find_map(|(key, rule, value)| {
                        Some(format!("{key}: {}", self.violation(rule, value)?))
                    });
            }
            "additionalProperties" => {
                assert_eq!(rule, false);
                let known = schema["properties"].as_object().unwrap();
                let object = value.as_object()?;
                object.keys().all(|key| known.contains_key(key))
            }
            "items" => {
                return value.as_array()?.iter().find_map(|item| self.violation(rule, item));
            }
            "minItems" => value.as_array()?.len() as u64 >= rule.as_u64().unwrap(),
            "maxItems" => value.as_array()?.len() as u64 <= rule.as_u64().unwrap(),
            "minLength" => value.as_str()?.chars().count() as u64 >= rule.as_u64().unwrap(),
            "minimum" => value.as_f64()? >= rule.as_f64().unwrap(),
            "maximum" => value.as_f64()? <= rule.as_f64().unwrap(),
            "exclusiveMinimum" => value.as_f64()? > rule.as_f64().unwrap(),
            _ => panic!("an unknown keyword: {keyword}"),
        };
        (!holds).then(|| format!("{value} breaks {keyword} {rule}"))
    }
}

fn alternatives(rule: &Value) -> impl Iterator<Item = &Value> {
    rule.as_array().unwrap().iter()
}

fn is_of_type(name: &Value, value: &Value) -> bool {
    match name.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("an unknown type: {other}"),
    }
}
