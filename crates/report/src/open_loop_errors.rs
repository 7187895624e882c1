//! `errors.svg`: how far off plans flown open loop end.

use crate::axis::Range;
use crate::chart::{Chart, Labels};
use crate::number::drawn;
use crate::shares::{sorted, stairs};
use crate::style;
use crate::svg::Stroke;

/// The figure of the attitude errors at the end of plans flown open loop, as an SVG document: the share
/// of flights (percent) that end within an angle. `errors_deg` in any order. None if there are none.
pub fn open_loop_errors_svg(name: &str, errors_deg: &[f64]) -> Option<String> {
    let errors = sorted(errors_deg.iter().copied());
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
    let curve = Stroke { color: style::Z, width: style::CURVE_WIDTH, dash: "" };
    chart.curve(&stairs(&errors), curve);
    Some(chart.svg.finish())
}
