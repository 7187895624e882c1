//! What a maneuver's duration does to its power.

use righting_analysis::power::{Accounting, Consumption};

use crate::figure::Figure;
use crate::panel::{Curve, Panel, Rule, RuleKind, Scale};
use crate::power::accounting_curve;

const PANEL_SIZE: [f64; 2] = [620.0, 220.0];
/// The paper's figure of its 4-DOF slew in 30 s.
const PAPER_PEAK_W: f64 = 1.2;

/// A maneuver in one duration.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerTrade {
    /// How long it takes, s.
    pub duration_s: f64,
    /// Whether it does what was asked.
    pub reached: bool,
    /// What the joints draw, in the order of [`Accounting::ALL`].
    pub consumptions: Vec<Consumption>,
}

/// The figure of peak power and energy over duration, both axes of values logarithmic, as an SVG
/// document. Durations in which the maneuver falls short are left out.
pub fn power_trade_svg(trades: &[PowerTrade]) -> String {
    let curves = |of: fn(&Consumption) -> f64| -> Vec<Curve> {
        let curve = |(i, accounting): (usize, Accounting)| {
            let value = |trade: &PowerTrade| match trade.consumptions.get(i) {
                Some(used) if trade.reached => of(used),
                _ => f64::NAN,
            };
            accounting_curve(accounting, trades.iter().map(value).collect())
        };
        Accounting::ALL.into_iter().enumerate().map(curve).collect()
    };
    let panels = vec![
        Panel {
            heading: "Peak power drawn".to_owned(),
            axis_label: "Power [W]",
            note: "grey: the paper's, 1.2 W".to_owned(),
            curves: curves(|used| used.peak_w),
            rules: vec![Rule { kind: RuleKind::Reference, value: PAPER_PEAK_W }],
            scale: Scale::Logarithmic,
            ..Panel::default()
        },
        Panel {
            heading: "Energy drawn".to_owned(),
            axis_label: "Energy [J]",
            // Signed, a slew from rest to rest draws nothing.
            curves: curves(|used| used.energy_j).split_off(1),
            scale: Scale::Logarithmic,
            ..Panel::default()
        },
    ];
    let figure = Figure {
        title: "Power of the 4-DOF slew of 20° against its duration".to_owned(),
        subtitle: "Least effort in each duration, efficiency 0.1".to_owned(),
        across: "Duration [s]",
        places: trades.iter().map(|trade| trade.duration_s).collect(),
        panel_size: PANEL_SIZE,
        panels,
        ..Figure::default()
    };
    figure.render()
}
