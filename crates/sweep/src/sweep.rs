//! A sweep, checked: what a sweep file means.

use std::path::Path;

use righting_scenario::json::{Bounds, Document, FileKind, Location, shown};
use righting_scenario::{Error, Scenario};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::base::Base;
use crate::case::{Case, CaseId};
use crate::dimension::{Column, Dimension, Variation};
use crate::file::{self, Evaluation, ScenarioReference};
use crate::system_values::{SYSTEM, put_systems_inline};
use crate::table::RESULT_COLUMNS;

/// The most cases that a sweep may have.
pub const MOST_CASES: usize = 100_000_000;

const TIME_LIMIT_S: Bounds = Bounds::Above(0.0, 1e6);
const DEFAULT_TIME_LIMIT_S: f64 = 600.0;

/// A checked sweep: a list of cases, none of which is expanded before it is asked for.
#[derive(Clone, Debug)]
pub struct Sweep {
    resolved: file::Sweep,
    dimensions: Vec<Dimension>,
    columns: Vec<Column>,
    len: usize,
    base: Base,
    base_sha256: String,
    case_time_limit_s: f64,
}

/// The JSON Schema (draft 2020-12) of a sweep file.
pub fn sweep_schema() -> Value {
    schemars::schema_for!(file::Sweep).to_value()
}

impl Sweep {
    /// Reads and checks a sweep file and its base scenario.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Field`] for a field that is wrong.
    pub fn read(file: &Path) -> Result<Self, Error> {
        Self::from_document(&Document::read(file, FileKind::Sweep)?, file)
    }

    /// Reads and checks a sweep from its text; `file` names it in errors, and relative paths start
    /// from its folder.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, Error> {
        Self::from_document(&Document::parse(file, text, FileKind::Sweep)?, file)
    }

    fn from_document(document: &Document, file: &Path) -> Result<Self, Error> {
        Self::from_file_at(document.decode()?, file, &Location::root(file))
    }

    /// Checks a sweep that stands at `place` in `file`.
    pub(crate) fn from_file_at(
        mut sweep: file::Sweep,
        file: &Path,
        place: &Location,
    ) -> Result<Self, Error> {
        if sweep.name.trim().is_empty() {
            return Err(place.key("name").refuse("\"\"", "a name"));
        }
        let mut base = Base::read(&sweep.scenario, file, &place.key("scenario"))?;
        for (index, dimension) in sweep.vary.iter_mut().enumerate() {
            put_systems_inline(dimension, file, &place.key("vary").index(index))?;
        }
        let dimensions = dimensions(&sweep.vary, &place.key("vary"))?;
        let columns = columns(&dimensions, &place.key("vary"))?;
        let len = dimensions
            .iter()
            .try_fold(1usize, |len, dimension| len.checked_mul(dimension.len()))
            .filter(|&len| len <= MOST_CASES)
            .ok_or_else(|| {
                let counts: Vec<String> =
                    dimensions.iter().map(|dimension| dimension.len().to_string()).collect();
                let cases = format!("{} cases", counts.join(" × "));
                place.key("vary").refuse(cases, format!("at most {MOST_CASES}"))
            })?;
        let case_time_limit_s = match sweep.case_time_limit_s {
            Some(limit_s) => place.key("case_time_limit_s").within(limit_s, TIME_LIMIT_S)?,
            None => DEFAULT_TIME_LIMIT_S,
        };
        for variation in dimensions.iter().flat_map(Dimension::variations) {
            if variation.relative || variation.path.reaches_into_arrays() {
                base.fill_in(&variation.path);
            }
        }
        let scenario = base.to_file();
        let base_sha256 = scenario.sha256();
        let resolved = file::Sweep {
            scenario: ScenarioReference::Inline(Box::new(scenario)),
            case_time_limit_s: Some(case_time_limit_s),
            ..sweep
        };
        let sweep =
            Self { dimensions, columns, len, base, base_sha256, case_time_limit_s, resolved };
        for case in sweep.telling_cases() {
            sweep.check(&case, file, place)?;
        }
        Ok(sweep)
    }

    /// The first case, since every field is set there and one that the scenario does not have shows; and that
    /// of each system, since the base scenario may not fit it.
    fn telling_cases(&self) -> Vec<Case> {
        let is_system = |dimension: &&Dimension| {
            dimension.variations().iter().any(|variation| variation.path.as_str() == SYSTEM)
        };
        let Some(systems) = self.dimensions.iter().find(is_system) else {
            return vec![self.case(0)];
        };
        let after = self.dimensions.iter().rev().take_while(|dimension| !is_system(dimension));
        let apart: usize = after.map(Dimension::len).product();
        (0..systems.len()).map(|index| self.case(index * apart)).collect()
    }

    fn check(&self, case: &Case, file: &Path, place: &Location) -> Result<(), Error> {
        let mut scenario = self.base.written().clone();
        for (column, (at, variation)) in self.variations(place).enumerate() {
            let setting = &case.values[column];
            variation.apply(&mut scenario, setting).map_err(|problem| {
                let expected = format!("a field that the settings fit ({problem})");
                at.key("field").refuse(shown(&json!(variation.path.as_str())), expected)
            })?;
        }
        match Scenario::parse(&scenario.to_string(), file) {
            Err(Error::Field { field, .. }) => {
                let about = |at: &str| field.path.starts_with(at) || at.starts_with(&field.path);
                let at_fault = |variation: &Variation| about(variation.path.as_str());
                let is_system = |variation: &Variation| variation.path.as_str() == SYSTEM;
                let find = |is_it: &dyn Fn(&Variation) -> bool| {
                    self.variations(place).find(|(_, variation)| is_it(variation))
                };
                let culprit = find(&at_fault)
                    .or_else(|| find(&is_system))
                    .map_or(place.key("vary"), |(at, _)| at);
                let of_case = match case.index {
                    0 => "the first case".to_owned(),
                    index => format!("case {}", index + 1),
                };
                Err(culprit.because(format_args!("{} of {of_case}", field.path), field.problem))
            }
            Err(error) => Err(error),
            Ok(_) => Ok(()),
        }
    }

    /// Every variation with its place in the file.
    fn variations<'a>(
        &'a self,
        place: &'a Location,
    ) -> impl Iterator<Item = (Location, &'a Variation)> {
        self.dimensions.iter().enumerate().flat_map(move |(i, dimension)| {
            let at = place.key("vary").index(i);
            let zipped = self.resolved.vary[i].zip.is_some();
            dimension.variations().iter().enumerate().map(move |(j, variation)| {
                (if zipped { at.key("zip").index(j) } else { at.clone() }, variation)
            })
        })
    }

    /// Name of the sweep.
    pub fn name(&self) -> &str {
        &self.resolved.name
    }

    /// Number of cases.
    #[allow(clippy::len_without_is_empty)] // There is always at least one.
    pub fn len(&self) -> usize {
        self.len
    }

    /// What the cases set, one entry a value of a [`Case`].
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// What is done with a case.
    pub fn evaluation(&self) -> Evaluation {
        self.resolved.evaluation
    }

    /// How long a case may take, s.
    pub fn case_time_limit_s(&self) -> f64 {
        self.case_time_limit_s
    }

    /// The sweep as a file, its base scenario and all systems inline.
    pub fn resolved(&self) -> &file::Sweep {
        &self.resolved
    }

    /// The base scenario as it is written, its system inline.
    pub fn base(&self) -> &Value {
        self.base.written()
    }

    /// Case `index` of [`len`](Self::len).
    ///
    /// # Panics
    /// If there are fewer.
    pub fn case(&self, index: usize) -> Case {
        assert!(index < self.len, "case {index} of {}", self.len);
        let mut rest = index;
        let mut digits: Vec<usize> = self
            .dimensions
            .iter()
            .rev()
            .map(|dimension| {
                let digit = rest % dimension.len();
                rest /= dimension.len();
                digit
            })
            .collect();
        digits.reverse();
        let settings = self.dimensions.iter().zip(digits);
        let values: Vec<Value> = settings
            .flat_map(|(dimension, digit)| dimension.variations().iter().map(move |v| v.get(digit)))
            .collect();
        Case { index, id: self.id(&values), values }
    }

    /// The scenario of a case: the base scenario with what the case sets.
    pub fn scenario(&self, case: &Case) -> Value {
        let mut scenario = self.base.written().clone();
        let variations = self.dimensions.iter().flat_map(Dimension::variations);
        for (variation, setting) in variations.zip(&case.values) {
            // The first case could be set so; one that cannot is refused when it is planned.
            if variation.apply(&mut scenario, setting).is_err() {
                scenario = Value::Null;
            }
        }
        scenario
    }

    fn id(&self, values: &[Value]) -> CaseId {
        let variations = self.dimensions.iter().flat_map(Dimension::variations);
        let mut set: Vec<String> = variations
            .zip(values)
            .map(|(variation, value)| {
                let sign = if variation.relative { "*=" } else { "=" };
                format!("{}{sign}{value}\n", variation.path.as_str())
            })
            .collect();
        set.sort_unstable();
        let mut hash = Sha256::new();
        hash.update(&self.base_sha256);
        hash.update(match self.evaluation() {
            Evaluation::Plan => "\nplan\n",
            Evaluation::OpenLoop => "\nopen_loop\n",
        });
        set.iter().for_each(|line| hash.update(line));
        let digest = hash.finalize();
        CaseId(u64::from_be_bytes(digest[..8].try_into().expect("eight bytes of 32")))
    }
}

fn dimensions(vary: &[file::Dimension], place: &Location) -> Result<Vec<Dimension>, Error> {
    if vary.is_empty() {
        return Err(place.refuse("[]", "at least one field that varies"));
    }
    let checked = vary.iter().enumerate();
    checked.map(|(i, dimension)| Dimension::from_file(dimension, &place.index(i))).collect()
}

/// The columns; no field is set and no name used twice.
fn columns(dimensions: &[Dimension], place: &Location) -> Result<Vec<Column>, Error> {
    let mut columns: Vec<Column> = Vec::new();
    for (i, dimension) in dimensions.iter().enumerate() {
        for variation in dimension.variations() {
            let name = shown(&json!(variation.name));
            let field = variation.path.as_str();
            if columns.iter().any(|column| column.field == field) {
                let again = format!("{} again", shown(&json!(field)));
                return Err(place.index(i).refuse(again, "each field once"));
            }
            let is_taken = RESULT_COLUMNS.contains(&variation.name.as_str());
            if is_taken || columns.iter().any(|column| column.name == variation.name) {
                return Err(place.index(i).refuse(name, "a name that no other column has"));
            }
            columns.push(variation.column());
        }
    }
    Ok(columns)
}
