//! How much of a difference between two numbers of a file is rounding.
//!
//! Programs print six significant digits by default. A number printed so is off by at most 5e-6 of
//! itself, and two that should be equal differ by at most twice that. What a file says that is off by
//! no more is accepted, and noted.

/// The most that two numbers printed to six digits differ by, of their size.
pub(crate) const PRINTED: f64 = 1e-5;

/// What the last digits of double precision leave after some arithmetic, of the size of the operands:
/// not worth a note.
pub(crate) const COMPUTED: f64 = 1e-9;
