//! The paper's tables, and its printed numbers beside ours.

use std::fmt::Write;

use righting_analysis::power::{Accounting, PAPER_EFFICIENCY};
use righting_analysis::{Envelopes, PowerProfile};
use righting_report::PowerTrade;
use righting_scenario::file::{System, SystemReference};

use super::paper::{Planned, SYSTEMS};

/// Everything that is compared.
pub struct Comparison<'a> {
    /// The slews, a system each.
    pub slews: &'a [Planned],
    /// The detumbles, a system each.
    pub detumbles: &'a [Planned],
    /// The slew of 75°.
    pub large: &'a Planned,
    /// Of the 4-DOF arm.
    pub envelopes: &'a Envelopes,
    /// Means over ten seeds of the largest sampled H and T.
    pub sampled: [f64; 2],
    /// Of the 4-DOF slew.
    pub power: &'a PowerProfile,
    /// The 4-DOF slew in other durations.
    pub trades: &'a [PowerTrade],
}

/// Table I as the scenarios have it.
pub fn systems(slews: &[Planned]) -> String {
    let mut text = "\
| system | m₀ [kg] | s [m] | DH | i | mᵢ [kg] | aᵢ [m] | αᵢ [deg] | dᵢ [m] | θ₀ᵢ [deg] | qᵢ [deg] | q̇ᵢ [deg/s] | uᵢ [deg/s²] |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
"
    .to_owned();
    for (named, planned) in SYSTEMS.iter().zip(slews) {
        if let SystemReference::Inline(system) = &planned.scenario.resolved().system {
            write_rows(&mut text, named.name, system);
        }
    }
    text
}

fn write_rows(text: &mut String, name: &str, system: &System) {
    let side = system.base.cube_side_m.map_or("–".to_owned(), |side| side.to_string());
    let bound = |angle: Option<f64>, none: &str| angle.map_or(none.to_owned(), |a| a.to_string());
    for (i, link) in system.links.iter().enumerate() {
        let first = |value: String| if i == 0 { value } else { String::new() };
        let cells = [
            first(name.to_owned()),
            first(system.base.mass_kg.to_string()),
            first(side.clone()),
            first(format!("{:?}", system.dh_convention.unwrap_or_default()).to_lowercase()),
            (i + 1).to_string(),
            link.mass_kg.to_string(),
            link.a_m.to_string(),
            link.alpha_deg.to_string(),
            link.d_m.to_string(),
            link.theta_deg.to_string(),
            format!("{} … {}", bound(link.angle_min_deg, "-∞"), bound(link.angle_max_deg, "+∞")),
            link.rate_max_deg_s.to_string(),
            link.acceleration_max_deg_s2.to_string(),
        ];
        line(text, &format!("| {} |", cells.join(" | ")));
    }
}

/// The paper's numbers beside ours.
pub fn comparison(found: &Comparison<'_>) -> String {
    let mut text = "| | the paper | ours |\n| --- | --- | --- |\n".to_owned();
    let mut row = |what: &str, paper: &str, ours: String| {
        line(&mut text, &format!("| {what} | {paper} | {ours} |"));
    };
    let error = |planned: &Planned| {
        let terminal = &planned.solution.terminal;
        format!("‖e_v‖ = {:.1e}, {}", terminal.attitude_error, verdict(planned))
    };
    row("Fig. 1, slew of 75°", "reached", error(found.large));
    let seconds = |planned: &Planned| {
        let timing = &planned.solution.timing_s;
        format!("{:.2} s, {}", timing.trace + timing.guess + timing.solve, verdict(planned))
    };
    for (i, system) in SYSTEMS.iter().enumerate() {
        let what = format!("Table II, slew, {}", system.name);
        row(&what, &format!("{} s", system.slew_s), seconds(&found.slews[i]));
    }
    for (i, system) in SYSTEMS.iter().enumerate() {
        let what = format!("Table II, detumble, {}", system.name);
        row(&what, &format!("{} s", system.detumble_s), seconds(&found.detumbles[i]));
    }
    for (i, system) in SYSTEMS.iter().enumerate() {
        row(
            &format!("Fig. 4, slew of 20°, {}", system.name),
            "‖e_v‖ ≤ 1e-3",
            error(&found.slews[i]),
        );
    }
    for (i, system) in SYSTEMS.iter().enumerate() {
        let solution = &found.detumbles[i].solution;
        let ours = format!(
            "{:.0} % (20 → {:.1} deg/s, bound {:.1})",
            solution.reduction_percent.unwrap_or(f64::NAN),
            solution.terminal.angular_rate_deg_s,
            solution.bound_deg_s.unwrap_or(f64::NAN),
        );
        row(&format!("Fig. 5, rate taken out, {}", system.name), "up to 40 %", ours);
    }
    let (h, t) = (&found.envelopes.momentum, &found.envelopes.torque);
    let [sampled_h, sampled_t] = found.sampled;
    row("Fig. 7, max ‖H_arm‖, sampled", "≈ 2.7 N m s", format!("{sampled_h:.2} N m s"));
    row("Fig. 7, max ‖H_arm‖, true", "–", format!("{:.2} N m s", h.true_max));
    row("Fig. 7, max ‖T_arm‖, sampled", "≈ 2.2 N m", format!("{sampled_t:.2} N m"));
    row("Fig. 7, max ‖T_arm‖, true", "–", format!("{:.2} N m", t.true_max));
    let [x, y, z] = h.per_axis_max;
    row("Fig. 7, H_arm along x, y, z", "flatter along z", format!("{x:.2}, {y:.2}, {z:.2} N m s"));
    let [x, y, z] = t.per_axis_max;
    row("Fig. 7, T_arm along x, y, z", "flatter along z", format!("{x:.2}, {y:.2}, {z:.2} N m"));
    let peaks = Accounting::ALL.map(|a| found.power.consumption(a, PAPER_EFFICIENCY).peak_w);
    let [signed, absolute, ..] = peaks;
    row("Fig. 8, peak of Σ τ q̇ / η", "≈ 1.2 W", format!("{signed:.3} W"));
    row("Fig. 8, peak of Σ abs(τ q̇) / η", "–", format!("{absolute:.3} W"));
    for trade in found.trades {
        let [signed, absolute] = [0, 1].map(|i| trade.consumptions[i].peak_w);
        let reached = if trade.reached { "" } else { ", misses its target" };
        let ours = format!("{signed:.3} W signed, {absolute:.3} W absolute{reached}");
        row(&format!("Fig. 8, the same slew in {} s", trade.duration_s), "–", ours);
    }
    text
}

fn verdict(planned: &Planned) -> &'static str {
    if planned.solution.verification.passed { "verified" } else { "NOT VERIFIED" }
}

fn line(text: &mut String, line: &str) {
    writeln!(text, "{line}").expect("a string takes all that is written to it");
}
