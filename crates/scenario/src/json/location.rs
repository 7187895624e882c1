//! A place in a JSON file, for checks that types cannot make.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::error::{Error, FieldError, FieldProblem, Mismatch};

/// A field of a file, to complain about.
#[derive(Clone, Debug)]
pub struct Location {
    file: PathBuf,
    path: String,
}

impl Location {
    /// The whole of a file.
    pub fn root(file: &Path) -> Self {
        Self { file: file.to_owned(), path: String::new() }
    }

    /// The field `key` of the object here.
    pub fn key(&self, key: &str) -> Self {
        let separator = if self.path.is_empty() { "" } else { "." };
        Self { file: self.file.clone(), path: format!("{}{separator}{key}", self.path) }
    }

    /// The element `index` of the array here.
    pub fn index(&self, index: usize) -> Self {
        Self { file: self.file.clone(), path: format!("{}[{index}]", self.path) }
    }

    /// The JSON path of this field, such as `links[3].mass_kg`; empty at the root.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// A remark on what is here and was accepted.
    pub(crate) fn note(&self, remark: impl fmt::Display) -> String {
        format!("{}: {remark}", self.path)
    }

    /// What is here is not what is expected.
    pub fn refuse(&self, found: impl fmt::Display, expected: impl fmt::Display) -> Error {
        self.error(FieldProblem::Mismatch(Mismatch::new(found, expected)))
    }

    /// Nothing is here, but something is expected.
    pub fn missing(&self, expected: impl Into<String>) -> Error {
        self.error(FieldProblem::Missing { expected: expected.into() })
    }

    /// What is here leads to a problem elsewhere: at `field`.
    pub fn because(&self, field: impl fmt::Display, problem: FieldProblem) -> Error {
        Self { path: format!("{}: {field}", self.path), ..self.clone() }.error(problem)
    }

    /// The number, if it is within bounds.
    ///
    /// # Errors
    /// [`Error::Field`] otherwise.
    pub fn within(&self, value: f64, bounds: Bounds) -> Result<f64, Error> {
        if bounds.contain(value) { Ok(value) } else { Err(self.refuse(Number(value), bounds)) }
    }

    /// Every number, if all are within bounds.
    ///
    /// # Errors
    /// [`Error::Field`] otherwise, with the index of the first that is not.
    pub fn all_within<const COUNT: usize>(
        &self,
        values: [f64; COUNT],
        bounds: Bounds,
    ) -> Result<[f64; COUNT], Error> {
        for (index, value) in values.into_iter().enumerate() {
            self.index(index).within(value, bounds)?;
        }
        Ok(values)
    }

    fn error(&self, problem: FieldProblem) -> Error {
        let field = FieldError { path: self.path.clone(), problem };
        Error::Field { file: self.file.clone(), field: Box::new(field) }
    }
}

/// The numbers a field may hold.
#[derive(Clone, Copy, Debug)]
pub enum Bounds {
    /// From the first to the second.
    Between(f64, f64),
    /// More than the first, up to the second.
    Above(f64, f64),
    /// A whole number from the first to the second.
    Whole(f64, f64),
}

impl Bounds {
    fn contain(self, value: f64) -> bool {
        match self {
            Self::Between(low, high) => low <= value && value <= high,
            Self::Above(low, high) => low < value && value <= high,
            Self::Whole(low, high) => low <= value && value <= high && value.fract() == 0.0,
        }
    }
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Between(low, high) => {
                write!(f, "a number from {} to {}", Number(low), Number(high))
            }
            Self::Above(low, high) => {
                write!(f, "a number above {} and up to {}", Number(low), Number(high))
            }
            Self::Whole(low, high) => {
                write!(f, "a whole number from {} to {}", Number(low), Number(high))
            }
        }
    }
}

/// A number as a person writes it.
pub struct Number(pub f64);

impl Number {
    /// The number rounded to this many significant digits.
    pub fn rounded(value: f64, digits: usize) -> Self {
        let decimals = digits.saturating_sub(1);
        Self(format!("{value:.decimals$e}").parse().unwrap_or(value))
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let magnitude = self.0.abs();
        if magnitude != 0.0 && !(1e-4..1e7).contains(&magnitude) {
            write!(f, "{:e}", self.0)
        } else {
            write!(f, "{}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_and_bounds_read_well() {
        let root = Location::root(Path::new("arm.json"));
        let place = root.key("links").index(3).key("mass_kg");
        let error = place.within(-1.0, Bounds::Between(0.0, 1e9)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "arm.json: links[3].mass_kg: found -1, expected a number from 0 to 1e9"
        );
        assert!(place.within(f64::NAN, Bounds::Above(0.0, 1.0)).is_err());
        assert!(place.within(0.0, Bounds::Above(0.0, 1.0)).is_err());
        assert!(place.within(1.5, Bounds::Whole(0.0, 2.0)).is_err());
        assert!(place.within(2.0, Bounds::Whole(0.0, 2.0)).is_ok());
        assert_eq!(place.path(), "links[3].mass_kg");
        assert_eq!(place.note("as it is"), "links[3].mass_kg: as it is");
        for (value, shown) in [(0.436_629_4, "0.436629"), (1.0, "1"), (-0.000_012, "-1.2e-5")] {
            assert_eq!(Number::rounded(value, 6).to_string(), shown);
        }
    }
}
