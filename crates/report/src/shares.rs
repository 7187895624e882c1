//! How many of some values are no larger than each of them.

/// More steps than these are finer than a figure.
const MOST_STEPS: usize = 2000;

/// The values that are numbers, the smallest first.
pub(crate) fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The share of sorted values (percent) that are no larger than each of them, as a curve of stairs.
pub(crate) fn stairs(values: &[f64]) -> Vec<[f64; 2]> {
    let count = values.len();
    let steps = count.min(MOST_STEPS);
    let rank = |step: usize| step * count / steps;
    let share = |step: usize| 100.0 * rank(step) as f64 / count as f64;
    let mut stairs = vec![[0.0, 0.0]];
    for step in 1..=steps {
        let value = values[rank(step) - 1];
        stairs.extend([[value, share(step - 1)], [value, share(step)]]);
    }
    stairs
}
