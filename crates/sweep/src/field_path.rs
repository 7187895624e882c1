//! A field of a scenario by its JSON path.

use serde_json::{Map, Value};

/// A parsed path such as `system.links[*].mass_kg`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FieldPath {
    text: String,
    steps: Vec<Step>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Step {
    Key(String),
    Index(usize),
    Every,
}

impl FieldPath {
    /// Parses; the error says what is allowed.
    pub fn parse(text: &str) -> Result<Self, &'static str> {
        const ALLOWED: &str = "a JSON path such as maneuver.angle_deg or system.links[1].mass_kg";
        let mut steps = Vec::new();
        for part in text.split('.') {
            let (key, indices) = part.split_at(part.find('[').unwrap_or(part.len()));
            if key.is_empty() {
                return Err(ALLOWED);
            }
            steps.push(Step::Key(key.to_owned()));
            let mut rest = indices;
            while !rest.is_empty() {
                let inside = rest.strip_prefix('[').and_then(|rest| rest.split_once(']'));
                let (index, after) = inside.ok_or(ALLOWED)?;
                steps.push(match index {
                    "*" => Step::Every,
                    _ => Step::Index(index.parse().map_err(|_| ALLOWED)?),
                });
                rest = after;
            }
        }
        Ok(Self { text: text.to_owned(), steps })
    }

    /// The path as it was written.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Whether it goes on from an element of an array, or ends in one.
    pub fn reaches_into_arrays(&self) -> bool {
        self.steps.iter().any(|step| !matches!(step, Step::Key(_)))
    }

    /// Puts into `root` what `resolved` has at the first key of this path that `root` lacks.
    pub fn fill_in(&self, root: &mut Value, resolved: &Value) {
        let (mut here, mut there) = (root, resolved);
        for step in &self.steps {
            let Step::Key(key) = step else { return };
            let (Some(entries), Some(default)) = (here.as_object_mut(), there.get(key)) else {
                return;
            };
            here = entries.entry(key.clone()).or_insert_with(|| default.clone());
            there = default;
        }
    }

    /// Changes the field, or each of them. An object that is not there yet is made; the error says
    /// what stands in the way.
    pub fn change(
        &self,
        root: &mut Value,
        change: &mut dyn FnMut(&mut Value) -> Result<(), String>,
    ) -> Result<(), String> {
        walk(root, &self.steps, change)
    }
}

fn walk(
    here: &mut Value,
    steps: &[Step],
    change: &mut dyn FnMut(&mut Value) -> Result<(), String>,
) -> Result<(), String> {
    let Some((step, rest)) = steps.split_first() else { return change(here) };
    match (step, here) {
        (Step::Key(key), here @ (Value::Object(_) | Value::Null)) => {
            if here.is_null() {
                *here = Value::Object(Map::new());
            }
            let entries = here.as_object_mut().expect("an object by now");
            walk(entries.entry(key.clone()).or_insert(Value::Null), rest, change)
        }
        (Step::Key(key), _) => Err(format!("there is no object that could have `{key}`")),
        (Step::Index(index), Value::Array(elements)) => match elements.get_mut(*index) {
            Some(element) => walk(element, rest, change),
            None => Err(format!("there is no element {index} of {}", elements.len())),
        },
        (Step::Every, Value::Array(elements)) => {
            elements.iter_mut().try_for_each(|element| walk(element, rest, change))
        }
        (Step::Index(_) | Step::Every, _) => Err("there is no array".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_path_reaches_one_field_or_every_element_s() {
        let mut root = json!({ "links": [{ "m": 1 }, { "m": 2 }] });
        let mut set = |path: &str| {
            FieldPath::parse(path)?.change(&mut root, &mut |value| {
                *value = json!(9);
                Ok(())
            })
        };
        set("links[1].m").unwrap();
        set("payload.m").unwrap();
        assert!(set("links[2].m").unwrap_err().contains("element 2 of 2"));
        assert!(set("links.m").is_err() && set("links[0][0]").is_err());
        assert_eq!(root, json!({ "links": [{ "m": 1 }, { "m": 9 }], "payload": { "m": 9 } }));
        FieldPath::parse("links[*].m")
            .unwrap()
            .change(&mut root, &mut |value| {
                *value = json!(value.as_f64().unwrap() * 2.0);
                Ok(())
            })
            .unwrap();
        assert_eq!(root["links"], json!([{ "m": 2.0 }, { "m": 18.0 }]));
    }

    #[test]
    fn what_is_not_written_is_filled_in_from_its_first_key_on() {
        let resolved = json!({ "initial": { "joint_rates_deg_s": [0, 0] }, "weights": { "control": 1, "time": 2 } });
        let filled = |path: &str| {
            let mut root = json!({ "initial": {}, "links": [{}] });
            FieldPath::parse(path).unwrap().fill_in(&mut root, &resolved);
            root
        };
        let rates = json!({ "initial": { "joint_rates_deg_s": [0, 0] }, "links": [{}] });
        assert_eq!(filled("initial.joint_rates_deg_s[1]"), rates);
        assert_eq!(filled("weights.control")["weights"], resolved["weights"]);
        assert_eq!(filled("links[0].mass_kg"), json!({ "initial": {}, "links": [{}] }));
    }

    #[test]
    fn what_is_no_path_is_refused() {
        for text in ["", ".", "a.", "a..b", "a[", "a[x]", "a[1", "[0]", "a[0]b"] {
            assert!(FieldPath::parse(text).is_err(), "{text}");
        }
    }
}
