//! The value axis of a panel: its range, ticks and their labels.

use crate::number::drawn;

/// A closed, non-empty range of finite values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    pub low: f64,
    pub high: f64,
}

impl Range {
    /// The smallest range that holds all finite `values`; `None` when there are none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        values.into_iter().filter(|v| v.is_finite()).fold(None, |range: Option<Self>, v| {
            Some(range.map_or(Self { low: v, high: v }, |r| r.including(v)))
        })
    }

    pub fn including(self, value: f64) -> Self {
        Self { low: self.low.min(value), high: self.high.max(value) }
    }

    pub fn span(self) -> f64 {
        self.high - self.low
    }

    pub fn contains(self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// Widened by 6 % on either side. A range too narrow to draw (a curve that is constant but for
    /// rounding) opens to `least` or a thousandth of its values, whichever is more.
    pub fn padded(self, least: f64) -> Self {
        let least = least.max(1e-3 * self.low.abs().max(self.high.abs()));
        let half = 0.5 * self.span().max(least);
        let middle = self.low + 0.5 * self.span();
        Self { low: middle - 1.12 * half, high: middle + 1.12 * half }
    }

    /// Ticks where the values are decimal logarithms: powers of ten, and 2 and 5 times those where they are few.
    pub fn decades(self) -> Vec<(f64, String)> {
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        let step = ((last - first) / 8 + 1) as usize;
        let multiples: &[f64] = if self.span() < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        (first..=last)
            .step_by(step)
            .flat_map(|decade| multiples.iter().map(move |multiple| (decade, *multiple)))
            .map(|(decade, multiple)| {
                let value = multiple * 10f64.powi(decade);
                (value.log10(), drawn(value))
            })
            .filter(|(value, _)| self.contains(*value))
            .collect()
    }

    /// About `count` ticks at multiples of 1, 2 or 5 · 10ⁿ, with their labels.
    pub fn ticks(self, count: f64) -> Vec<(f64, String)> {
        let rough = self.span() / count;
        let magnitude = 10f64.powf(rough.log10().floor());
        let step = magnitude
            * [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * magnitude >= rough).unwrap_or(10.0);
        let first = (self.low / step).ceil();
        let last = (self.high / step).floor();
        let drawable = step.is_normal() && first.is_finite() && last - first <= 100.0;
        if !drawable {
            return Vec::new();
        }
        let decimals = (-step.log10().floor()).clamp(0.0, 300.0) as usize;
        let scientific = decimals > 4 || step >= 1e5;
        (0..=(last - first) as usize)
            .map(|i| {
                let value = (first + i as f64) * step;
                // Rounding would otherwise print "-0".
                let value = if value.abs() < 0.5 * step { 0.0 } else { value };
                let label = match (scientific, value == 0.0) {
                    (true, false) => format!("{value:.1e}"),
                    _ => format!("{value:.*}", if scientific { 0 } else { decimals }),
                };
                (value, label.replace('-', "\u{2212}"))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> Vec<String> {
        Range { low, high }.ticks(5.0).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn decades_are_few_and_inside() {
        let labels = |low, high| -> Vec<String> {
            Range { low, high }.decades().into_iter().map(|(_, label)| label).collect()
        };
        assert_eq!(labels(-1.1, 0.4), ["0.1", "0.2", "0.5", "1", "2"]);
        assert_eq!(labels(-5.2, -0.9), ["1.0e\u{2212}5", "1.0e\u{2212}4", "0.001", "0.01", "0.1"]);
        assert!(labels(-300.0, 300.0).len() < 12);
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(labels(0.0, 30.0), ["0", "10", "20", "30"]);
        assert_eq!(labels(-0.11, 0.11), ["−0.10", "−0.05", "0.00", "0.05", "0.10"]);
        assert_eq!(labels(-3e-7, 1e-7), ["−3.0e−7", "−2.0e−7", "−1.0e−7", "0", "1.0e−7"]);
        for range in [Range { low: -1e300, high: 1e300 }, Range { low: 1.0, high: 1.0 + 1e-9 }] {
            let ticks = range.ticks(5.0);
            assert!(ticks.len() < 12 && ticks.iter().all(|(v, _)| range.contains(*v)));
        }
    }

    #[test]
    fn ranges_skip_what_cannot_be_drawn() {
        assert_eq!(
            Range::of([f64::NAN, 2.0, f64::INFINITY, -1.0]),
            Some(Range { low: -1.0, high: 2.0 })
        );
        assert_eq!(Range::of([f64::NAN]), None);
        let flat = Range { low: 5.0, high: 5.0 }.padded(1e-3);
        assert!(flat.span() > 0.0 && flat.contains(5.0));
    }
}
