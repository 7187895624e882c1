//! `errors.svg`: how far off plans flown open loop end.

use crate::axis::Range;
use crate::chart::{Chart, Labels};
use crate::number::drawn;
use crate::style;
use crate::svg::Stroke;

/// More steps than these are finer than the figure.
const MOST_STEPS: usize = 2000;

/// The figure of the attitude errors at the end of plans flown open loop, as an SVG document: the share
/// of flights (percent) that end within an angle. `errors_deg` in any order. None if there are none.
pub fn open_loop_errors_svg(name: &str, errors_deg: &[f64]) -> Option<String> {
    let mut errors: Vec<f64> = errors_deg.iter().copied().filter(|e| e.is_finite()).collect();
    errors.sort_by(f64::total_cmp);
    let last = *errors.last()?;
    let quantile = |share: f64| errors[((share * errors.len() as f64).ceil() as usize).max(1) - 1];
    let (median, most) = (quantile(0.5), quantile(0.95));
    let subtitle = format!(
        "{} plans flown open loop: half end within {}\u{b0}, 95 % within {}\u{b0}, all within {}\u{b0}",
        errors.len(),
        drawn(median),
        drawn(most),
        drawn(last)
    );
    let labels = Labels {
        title: name,
        subtitle: &subtitle,
        x: "Attitude error at the end [deg]",
        y: "Flights within [%]",
    };
    let x = Range { low: 0.0, high: last }.padded(1e-9);
    let mut chart = Chart::new(&labels, Range { low: 0.0, ..x }, Range { low: 0.0, high: 104.0 });
    let rule = Stroke { color: style::LIMIT, width: style::RULE_WIDTH, dash: style::LIMIT_DASH };
    for (angle, percent) in [(median, 50.0), (most, 95.0)] {
        chart.curve(&[[0.0, percent], [angle, percent], [angle, 0.0]], rule);
    }
    let count = errors.len();
    let steps = count.min(MOST_STEPS);
    let rank = |step: usize| step * count / steps;
    let share = |step: usize| 100.0 * rank(step) as f64 / count as f64;
    let mut stairs = vec![[0.0, 0.0]];
    for step in 1..=steps {
        let error = errors[rank(step) - 1];
        stairs.extend([[error, share(step - 1)], [error, share(step)]]);
    }
    let curve = Stroke { color: style::Z, width: style::CURVE_WIDTH, dash: "" };
    chart.curve(&stairs, curve);
    Some(chart.svg.finish())
}
