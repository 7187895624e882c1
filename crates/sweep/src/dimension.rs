//! One dimension of a sweep, checked: fields that change together.

use std::collections::HashMap;

use righting_scenario::Error;
use righting_scenario::json::{Location, shown};
use serde_json::{Value, json};

use crate::field_path::FieldPath;
use crate::file;
use crate::setting::{Kind, Settings};

/// A column of the results that says what was set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its head.
    pub name: String,
    /// JSON path of the field.
    pub field: String,
    /// Whether the settings are factors on what the base scenario has there.
    pub relative: bool,
    /// What every setting is.
    pub kind: Kind,
}

/// Fields that change together, each with the same number of settings.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dimension {
    variations: Vec<Variation>,
}

/// One field and its settings.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variation {
    pub name: String,
    pub path: FieldPath,
    pub relative: bool,
    settings: Settings,
}

impl Dimension {
    pub fn from_file(dimension: &file::Dimension, place: &Location) -> Result<Self, Error> {
        let Some(zipped) = &dimension.zip else {
            let alone = Self { variations: vec![Variation::from_file(dimension, place)?] };
            return match alone.first_repeated() {
                Some((index, _)) => {
                    let again = format!("{} again", shown(&alone.variations[0].get(index)));
                    Err(place.key("values").index(index).refuse(again, "each value once"))
                }
                None => Ok(alone),
            };
        };
        let alone = file::Dimension { zip: Some(zipped.clone()), ..Default::default() };
        if *dimension != alone {
            return Err(place.refuse("`zip` with other fields", "`zip` alone"));
        }
        let place = place.key("zip");
        if zipped.is_empty() {
            return Err(place.refuse("[]", "at least one field"));
        }
        let mut variations: Vec<Variation> = Vec::new();
        for (index, dimension) in zipped.iter().enumerate() {
            let place = place.index(index);
            if dimension.zip.is_some() {
                return Err(place.key("zip").refuse("a `zip` in a `zip`", "a field"));
            }
            let variation = Variation::from_file(dimension, &place)?;
            if let Some(first) = variations.first()
                && first.len() != variation.len()
            {
                let expected = format!("{} settings, as the first has", first.len());
                return Err(place.refuse(variation.len(), expected));
            }
            variations.push(variation);
        }
        let zipped = Self { variations };
        match zipped.first_repeated() {
            Some((index, earlier)) => {
                let found = format!("settings {} the same as settings {}", index + 1, earlier + 1);
                Err(place.refuse(found, "each combination once"))
            }
            None => Ok(zipped),
        }
    }

    /// The first setting that an earlier one is the same as, and that one; none where settings are drawn.
    fn first_repeated(&self) -> Option<(usize, usize)> {
        if !self.variations.iter().all(|variation| variation.settings.are_listed()) {
            return None;
        }
        let mut seen: HashMap<String, usize> = HashMap::new();
        (0..self.len()).find_map(|index| {
            let settings = self.variations.iter().map(|variation| variation.get(index));
            let earlier = seen.insert(Value::from_iter(settings).to_string(), index)?;
            Some((index, earlier))
        })
    }

    /// Number of settings.
    pub fn len(&self) -> usize {
        self.variations[0].len()
    }

    pub fn variations(&self) -> &[Variation] {
        &self.variations
    }
}

impl Variation {
    fn from_file(dimension: &file::Dimension, place: &Location) -> Result<Self, Error> {
        let field_place = place.key("field");
        let field = dimension.field.as_deref();
        let field =
            field.ok_or_else(|| field_place.missing("the path of a field of the scenario"))?;
        let path = FieldPath::parse(field)
            .map_err(|allowed| field_place.refuse(shown(&json!(field)), allowed))?;
        let name = dimension.name.as_deref().unwrap_or(field);
        if name.trim().is_empty() {
            return Err(place.key("name").refuse(shown(&json!(name)), "a name"));
        }
        Ok(Self {
            name: name.to_owned(),
            relative: dimension.relative,
            settings: Settings::from_file(dimension, field, place)?,
            path,
        })
    }

    pub fn len(&self) -> usize {
        self.settings.len()
    }

    pub fn get(&self, index: usize) -> Value {
        self.settings.get(index)
    }

    /// Its column in the results.
    pub fn column(&self) -> Column {
        Column {
            name: self.name.clone(),
            field: self.path.as_str().to_owned(),
            relative: self.relative,
            kind: self.settings.kind(),
        }
    }

    /// Sets the field in a scenario; the error says why that is not possible.
    pub fn apply(&self, scenario: &mut Value, setting: &Value) -> Result<(), String> {
        self.path.change(scenario, &mut |value| {
            if self.relative {
                let factor = setting.as_f64().ok_or("a factor must be a number")?;
                scale(value, factor)
            } else {
                *value = setting.clone();
                Ok(())
            }
        })
    }
}

/// Multiplies a number, or every number of an array.
fn scale(value: &mut Value, factor: f64) -> Result<(), String> {
    match value {
        Value::Number(number) => {
            *value = json!(number.as_f64().unwrap_or(f64::NAN) * factor);
            Ok(())
        }
        Value::Array(elements) => {
            elements.iter_mut().try_for_each(|element| scale(element, factor))
        }
        _ => Err(format!("the base scenario has {value} there, which no factor can change")),
    }
}
