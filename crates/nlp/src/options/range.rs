use std::fmt;

use crate::NlpError;

/// What an option may be: an interval, open or closed at either end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OptionRange {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
    /// Whether the lower end belongs to it.
    pub lower_belongs: bool,
    /// Whether the upper end belongs to it.
    pub upper_belongs: bool,
}

impl OptionRange {
    pub(super) const fn any() -> Self {
        Self {
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
            lower_belongs: false,
            upper_belongs: false,
        }
    }

    pub(super) const fn above(lower: f64) -> Self {
        Self { lower, ..Self::any() }
    }

    pub(super) const fn at_least(lower: f64) -> Self {
        Self { lower, lower_belongs: true, ..Self::any() }
    }

    pub(super) const fn between(lower: f64, upper: f64) -> Self {
        Self::at_least(lower).up_to(upper)
    }

    /// An integer of 32 bits, as Ipopt has it.
    pub(super) const fn count(lower: f64) -> Self {
        Self::between(lower, i32::MAX as f64)
    }

    pub(super) const fn below(self, upper: f64) -> Self {
        Self { upper, upper_belongs: false, ..self }
    }

    pub(super) const fn up_to(self, upper: f64) -> Self {
        Self { upper, upper_belongs: true, ..self }
    }

    pub(super) fn check(self, field: &'static str, value: f64) -> Result<(), NlpError> {
        let above = value > self.lower || (self.lower_belongs && value == self.lower);
        let below = value < self.upper || (self.upper_belongs && value == self.upper);
        if above && below {
            Ok(())
        } else {
            Err(NlpError::OptionOutOfRange { field, value, expected: self.to_string() })
        }
    }
}

impl fmt::Display for OptionRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (lower, upper) = (self.lower, self.upper);
        match (lower.is_finite(), self.lower_belongs) {
            (false, _) => f.write_str("any number")?,
            (true, true) => write!(f, "at least {lower:?}")?,
            (true, false) => write!(f, "more than {lower:?}")?,
        }
        match (upper.is_finite(), self.upper_belongs) {
            (false, _) => Ok(()),
            (true, true) => write!(f, ", at most {upper:?}"),
            (true, false) => write!(f, ", less than {upper:?}"),
        }
    }
}
