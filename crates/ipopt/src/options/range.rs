use crate::SolveError;
use std::fmt;

/// An interval, open or closed at either end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Range {
    pub(super) lower: f64,
    pub(super) upper: f64,
    pub(super) lower_belongs: bool,
    pub(super) upper_belongs: bool,
}

impl Range {
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

    /// An integer for Ipopt, which has 32 bits.
    pub(super) const fn count(lower: f64) -> Self {
        Self::between(lower, i32::MAX as f64)
    }

    pub(super) const fn below(self, upper: f64) -> Self {
        Self { upper, upper_belongs: false, ..self }
    }

    pub(super) const fn up_to(self, upper: f64) -> Self {
        Self { upper, upper_belongs: true, ..self }
    }

    pub(super) fn check(self, field: &'static str, value: f64) -> Result<(), SolveError> {
        let above = value > self.lower || (self.lower_belongs && value == self.lower);
        let below = value < self.upper || (self.upper_belongs && value == self.upper);
        if above && below {
            Ok(())
        } else {
            Err(SolveError::OptionOutOfRange { field, value, allowed: self.to_string() })
        }
    }
}

impl fmt::Display for Range {
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
