//! `power.svg` and its table: what the joints' torques cost, beside reaction wheels.

use std::fmt::Write;

use righting_analysis::motors::{Braking, Losses};
use righting_analysis::power::{Accounting, Instant};
use righting_analysis::{Motors, PowerProfile, WheelMotors};
use righting_results::Solution;
use righting_scenario::WheelArray;

use crate::asked;
use crate::figure::{Figure, heading, verdict_in_short};
use crate::number::{drawn, short};
use crate::panel::{Curve, Panel, Rule, RuleKind};
use crate::style;

const PANEL_SIZE: [f64; 2] = [640.0, 150.0];
/// Below these heights (N m, W) a curve counts as constant.
const LEAST_TORQUE_SPAN_N_M: f64 = 1e-6;
const LEAST_POWER_SPAN_W: f64 = 1e-6;

/// An arm's power over a maneuver and the wheels it is compared with.
#[derive(Clone, Copy, Debug)]
pub struct PowerComparison<'a> {
    /// Torques and mechanical power of the joints.
    pub profile: &'a PowerProfile,
    /// What the motors draw, where all are known.
    pub motors: Option<&'a Motors<'a>>,
    /// Overall efficiency of the joints' actuators, in (0, 1].
    pub efficiency: f64,
    /// Wheels that would do the same.
    pub wheels: &'a WheelArray,
    /// What the motors of the plan's own wheels do, where their inertias are known.
    pub wheel_motors: Option<&'a WheelMotors<'a>>,
}

/// What a reader calls a variant.
fn accounting_phrase(accounting: Accounting) -> &'static str {
    match accounting {
        Accounting::Signed => "signed sum",
        Accounting::Absolute => "absolute per joint",
        Accounting::WithoutRegeneration => "no regeneration",
        Accounting::WithRegeneration => "with regeneration",
    }
}

/// The figure of joint torques, mechanical power and power drawn over the maneuver, as an SVG
/// document; the power drawn in every [`Accounting`], and by the motors where they are known, beside the
/// steady power of one wheel.
pub fn power_svg(solution: &Solution, comparison: PowerComparison<'_>) -> String {
    let mut panels = vec![
        torque_panel(comparison.profile.instants()),
        mechanical_panel(comparison.profile.instants()),
        drawn_panel(comparison),
    ];
    panels.extend(comparison.motors.map(|motors| motor_panel(motors, comparison.wheels)));
    panels.extend(comparison.wheel_motors.map(wheel_motor_panel));
    let instants = comparison.profile.instants();
    let (title, subtitle) = heading(solution);
    let figure = Figure {
        title,
        subtitle,
        places: instants.iter().map(|instant| instant.time_s).collect(),
        panel_size: PANEL_SIZE,
        panels,
        ..Figure::default()
    };
    figure.render()
}

fn torque_panel(instants: &[Instant]) -> Panel {
    Panel {
        heading: "Joint torques".to_owned(),
        axis_label: "Torque [N m]",
        note: String::new(),
        curves: joint_curves(instants, |instant| &instant.joint_torques_n_m),
        rules: Vec::new(),
        least_span: LEAST_TORQUE_SPAN_N_M,
        ..Panel::default()
    }
}

fn mechanical_panel(instants: &[Instant]) -> Panel {
    let mut curves = joint_curves(instants, |instant| &instant.joint_powers_w);
    let sum = instants.iter().map(|instant| instant.joint_powers_w.iter().sum()).collect();
    let dash = style::LIMIT_DASH;
    curves.push(Curve { name: "sum".to_owned(), dash, ..Curve::plain(style::MAGNITUDE, sum) });
    Panel {
        heading: "Mechanical power of the joints".to_owned(),
        axis_label: "Power [W]",
        note: String::new(),
        curves,
        rules: Vec::new(),
        least_span: LEAST_POWER_SPAN_W,
        ..Panel::default()
    }
}

fn drawn_panel(comparison: PowerComparison<'_>) -> Panel {
    let PowerComparison { profile, efficiency, wheels, .. } = comparison;
    // The later is drawn over the earlier where they agree, the paper's over all.
    let curves = Accounting::ALL.into_iter().rev();
    let curve = |accounting| accounting_curve(accounting, profile.drawn_w(accounting, efficiency));
    let one_wheel = one_wheel_w(wheels);
    Panel {
        heading: format!("Power drawn, \u{3b7} = {}", drawn(efficiency)),
        axis_label: "Power [W]",
        note: format!("dashed: one wheel, {} W", drawn(one_wheel)),
        curves: curves.map(curve).collect(),
        rules: vec![Rule { kind: RuleKind::Reference, value: one_wheel }],
        least_span: LEAST_POWER_SPAN_W,
        ..Panel::default()
    }
}

fn motor_panel(motors: &Motors<'_>, wheels: &WheelArray) -> Panel {
    let one_wheel = one_wheel_w(wheels);
    let curve = |name: &str, color, braking| {
        let drawn_w = motors.drawn_w(braking);
        Curve { name: name.to_owned(), ..Curve::plain(color, drawn_w) }
    };
    Panel {
        heading: "Power drawn by the motors and their drives".to_owned(),
        axis_label: "Power [W]",
        note: format!("dashed: one wheel, {} W", drawn(one_wheel)),
        curves: vec![
            curve("regen.", style::SERIES[3], Braking::FedBack),
            curve("no regen.", style::SERIES[2], Braking::Burnt),
        ],
        rules: vec![Rule { kind: RuleKind::Reference, value: one_wheel }],
        least_span: LEAST_POWER_SPAN_W,
        ..Panel::default()
    }
}

fn wheel_motor_panel(motors: &WheelMotors<'_>) -> Panel {
    let curve = |name: &str, color, braking| {
        let drawn_w = motors.drawn_w(braking);
        Curve { name: name.to_owned(), ..Curve::plain(color, drawn_w) }
    };
    Panel {
        heading: "Mechanical power of the wheels' motors".to_owned(),
        axis_label: "Power [W]",
        curves: vec![
            curve("regen.", style::SERIES[3], Braking::FedBack),
            curve("no regen.", style::SERIES[2], Braking::Burnt),
        ],
        least_span: LEAST_POWER_SPAN_W,
        ..Panel::default()
    }
}

/// The steady power of the wheel that takes least, W.
fn one_wheel_w(wheels: &WheelArray) -> f64 {
    wheels.wheels().iter().map(|wheel| wheel.steady_power_w).fold(f64::INFINITY, f64::min)
}

/// The curve of a variant: the same colour and short name in every figure.
pub(crate) fn accounting_curve(accounting: Accounting, values: Vec<f64>) -> Curve {
    let (name, color, dash) = match accounting {
        Accounting::Signed => ("signed", style::SERIES[0], ""),
        Accounting::Absolute => ("absolute", style::SERIES[1], ""),
        Accounting::WithoutRegeneration => ("no regen.", style::SERIES[2], style::SERIES_DASHES[1]),
        Accounting::WithRegeneration => ("regen.", style::SERIES[3], ""),
    };
    Curve { name: name.to_owned(), dash, ..Curve::plain(color, values) }
}

fn joint_curves(instants: &[Instant], of: impl Fn(&Instant) -> &Vec<f64>) -> Vec<Curve> {
    let joints = instants.first().map_or(0, |instant| of(instant).len());
    let values = |joint: usize| instants.iter().map(|instant| of(instant)[joint]).collect();
    (0..joints).map(|joint| Curve::of_joint(joint, values(joint))).collect()
}

/// The comparison as a table for people.
pub fn power_table(solution: &Solution, comparison: PowerComparison<'_>) -> String {
    let PowerComparison { profile, motors, efficiency, wheels, wheel_motors } = comparison;
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments<'_>| {
        text.write_fmt(arguments).expect("a string takes all that is written to it");
        text.push('\n');
    };
    let scenario = &solution.scenario;
    let asked = asked::planned_phrase(solution);
    line(format_args!("{}: {asked}, {}", scenario.name, verdict_in_short(solution)));
    line(format_args!("  {:<34}{:>12}{:>12}{:>12}", "", "peak [W]", "mean [W]", "energy [J]"));
    let mut row = |name: &str, numbers: [f64; 3]| {
        let [peak, mean, energy] = numbers.map(short);
        line(format_args!("  {name:<34}{peak:>12}{mean:>12}{energy:>12}"));
    };
    for accounting in Accounting::ALL {
        let used = profile.consumption(accounting, efficiency);
        let name = format!("arm, {}", accounting_phrase(accounting));
        row(&name, [used.peak_w, used.mean_w, used.energy_j]);
    }
    let of_motors = [
        ("motors, no regeneration", Braking::Burnt),
        ("motors, with regeneration", Braking::FedBack),
    ];
    for (name, braking) in of_motors {
        if let Some(used) = motors.map(|motors| motors.consumption(braking)) {
            row(&format!("arm, {name}"), [used.peak_w, used.mean_w, used.energy_j]);
        }
    }
    let steady_w = wheels.steady_power_w();
    let name = format!("{} wheels, spinning steadily", wheels.wheels().len());
    row(&name, [steady_w, steady_w, steady_w * profile.duration_s()]);
    let of_wheels = [
        ("wheels, motors, no regeneration", Braking::Burnt),
        ("wheels, motors, with regeneration", Braking::FedBack),
    ];
    for (name, braking) in of_wheels {
        if let Some(used) = wheel_motors.map(|motors| motors.consumption(braking)) {
            row(name, [used.peak_w, used.mean_w, used.energy_j]);
        }
    }
    let but_motors = if motors.is_some() { ", motors at their own" } else { "" };
    line(format_args!(
        "  at an efficiency of {} of the arm's actuators{but_motors}",
        short(efficiency)
    ));
    let list = |values: Vec<f64>| values.into_iter().map(short).collect::<Vec<_>>().join(", ");
    line(format_args!("  peak joint torques {} N m", list(profile.peak_torques_n_m())));
    if let Some(motors) = motors {
        let (currents, voltages) = (motors.peak_currents_a(), motors.peak_voltages_v());
        line(format_args!("  peak currents {} A", list(currents)));
        line(format_args!("  peak voltages {} V", list(voltages)));
        let Losses { windings_j, gears_j, friction_j, standing_j } = motors.losses();
        line(format_args!(
            "  heat of windings {} J, gears {} J, friction {} J; electronics and brakes {} J",
            short(windings_j),
            short(gears_j),
            short(friction_j),
            short(standing_j),
        ));
    }
    if let Some(motors) = wheel_motors {
        let rpm = |speed: &f64| speed * 60.0 / std::f64::consts::TAU;
        line(format_args!(
            "  peak speeds of the wheels {} rpm; heat of their friction {} J, change of their kinetic energy {} J",
            list(motors.peak_speeds_rad_s().iter().map(rpm).collect()),
            short(motors.friction_j()),
            short(motors.kinetic_energy_change_j()),
        ));
    }
    line(format_args!(
        "  work of the joints {} J, change of kinetic energy {} J",
        short(profile.work_j()),
        short(profile.kinetic_energy_change_j()),
    ));
    text
}
