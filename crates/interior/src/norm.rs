//! Maximum norms and finiteness, written so that they compile to vector code.

/// Numbers compared at a time: a chain of single comparisons would wait for each.
const LANES: usize = 8;

/// Whether every entry is a number, and finite.
pub(crate) fn are_finite(values: &[f64]) -> bool {
    // Without an early exit, so that it compiles to vector code.
    values.iter().fold(true, |finite, value| finite & value.is_finite())
}

/// ‖·‖∞; not a number if an entry is not.
pub(crate) fn max_norm(values: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = larger(*lane, value.abs());
        }
    }
    rest.iter().map(|value| value.abs()).chain(lanes).fold(0.0, larger)
}

/// ‖·‖₁.
pub(crate) fn sum_norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).sum()
}

/// The larger of two sizes; not a number if one is not.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
