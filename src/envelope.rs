//! `righting envelope`: what an arm can give, beside reaction wheels.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use righting_analysis::envelope::Sizing;
use righting_analysis::zonotope::{Radii, Zonotope};
use righting_analysis::{Envelope, Envelopes, envelopes};
use righting_report::{EnvelopeOutlines, envelope_svg};
use righting_scenario::json::FileKind;
use righting_scenario::wheels::Wheel;
use righting_scenario::{SystemOrScenario, WheelArray};
use serde::Serialize;

use crate::failure::Failure;
use crate::figures::Formats;
use crate::output;
use crate::output_folder::OutputFolder;
use crate::wheels::Wheels;

/// Compare an arm's momentum and torque envelopes with those of reaction wheels.
#[derive(Args)]
pub struct Arguments {
    /// A system file, or a scenario file for its system.
    #[arg(value_name = "SYSTEM_OR_SCENARIO")]
    file: PathBuf,
    /// Number of uniform samples.
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    samples: u32,
    /// Seed of the samples.
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    wheels: Wheels,
    /// The folder for envelope.json, envelope.svg and the meshes.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    formats: Formats,
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// What envelope.json holds and `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    schema: &'static str,
    system: &'a str,
    samples: u32,
    seed: u64,
    momentum_n_m_s: &'a Envelope,
    torque_n_m: &'a Envelope,
    wheels: PrintedWheels<'a>,
}

#[derive(Serialize)]
struct PrintedWheels<'a> {
    array: &'a [Wheel],
    momentum_max_n_m_s: f64,
    momentum_min_n_m_s: f64,
    momentum_rms_n_m_s: f64,
    momentum_volume: f64,
    torque_max_n_m: f64,
    torque_min_n_m: f64,
    torque_rms_n_m: f64,
    torque_volume: f64,
}

/// Reads, searches, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let writer = arguments.formats.writer()?;
    let file = SystemOrScenario::read(&arguments.file)
        .map_err(|error| Failure::InputOf { kind: FileKind::SystemOrScenario, error })?;
    let of_scenario = match &file {
        SystemOrScenario::Scenario(scenario) => WheelArray::of(scenario.wheels()),
        SystemOrScenario::System(_) => None,
    };
    let wheels = arguments.wheels.read()?.or(of_scenario).unwrap_or_else(WheelArray::pyramid);
    let system = file.system();
    let folder = OutputFolder::open(&arguments.out)?;
    let found = envelopes(system, arguments.samples as usize, arguments.seed, &wheels);
    let zonotopes = [Zonotope::momenta(wheels.wheels()), Zonotope::torques(wheels.wheels())];
    let [momentum, torque] = [zonotopes[0].radii(), zonotopes[1].radii()];
    let printed = Printed {
        schema: "righting.envelope/1",
        system: &system.name,
        samples: arguments.samples,
        seed: arguments.seed,
        momentum_n_m_s: &found.momentum,
        torque_n_m: &found.torque,
        wheels: PrintedWheels {
            array: wheels.wheels(),
            momentum_max_n_m_s: momentum.max,
            momentum_min_n_m_s: momentum.min,
            momentum_rms_n_m_s: momentum.rms,
            momentum_volume: zonotopes[0].volume(),
            torque_max_n_m: torque.max,
            torque_min_n_m: torque.min,
            torque_rms_n_m: torque.rms,
            torque_volume: zonotopes[1].volume(),
        },
    };
    let json = output::to_json(&printed)?;
    folder.write("envelope.json", json.as_bytes())?;
    let [momentum_mesh, torque_mesh] = [zonotopes[0].mesh(), zonotopes[1].mesh()];
    let meshes = [
        ("momentum_arm.obj", &found.momentum.hull),
        ("momentum_sampled.obj", &found.momentum.sampled_hull),
        ("momentum_wheels.obj", &momentum_mesh),
        ("torque_arm.obj", &found.torque.hull),
        ("torque_sampled.obj", &found.torque.sampled_hull),
        ("torque_wheels.obj", &torque_mesh),
    ];
    for (name, mesh) in meshes {
        folder.write(name, mesh.to_obj().as_bytes())?;
    }
    let figure = figure(&system.name, &found, &wheels);
    writer.write(folder.path(), "envelope.svg", &figure)?;
    if arguments.json {
        output::print(&json)
    } else {
        output::print(&describe(&printed, [momentum, torque]))
    }
}

/// The figure of both envelopes.
pub fn figure(name: &str, found: &Envelopes, wheels: &WheelArray) -> String {
    let outlines = |envelope: &Envelope, wheels: &Zonotope| EnvelopeOutlines {
        arm: envelope.extreme_points.clone(),
        sampled: envelope.sampled_hull.vertices.clone(),
        wheels: wheels.vertices(),
    };
    let momentum = outlines(&found.momentum, &Zonotope::momenta(wheels.wheels()));
    envelope_svg(name, &momentum, &outlines(&found.torque, &Zonotope::torques(wheels.wheels())))
}

fn describe(printed: &Printed<'_>, wheels: [Radii; 2]) -> String {
    let mut text = format!("{:<34}{:>14}{:>14}\n", printed.system, "H [N m s]", "T [N m]");
    let [h, t] = [printed.momentum_n_m_s, printed.torque_n_m];
    let mut row = |name: &str, h: f64, t: f64| {
        let shown = |x: f64| if x < 1e6 { format!("{x:.4}") } else { format!("{x:.4e}") };
        writeln!(text, "{name:<34}{:>14}{:>14}", shown(h), shown(t))
            .expect("a string takes all that is written");
    };
    row(&format!("arm, {} samples, max", printed.samples), h.sampled_max, t.sampled_max);
    row("arm, true max", h.true_max, t.true_max);
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        row(&format!("arm, along {axis}"), h.per_axis_max[i], t.per_axis_max[i]);
    }
    row("arm, least of all directions", h.true_min, t.true_min);
    let working = printed.wheels.array.iter().filter(|wheel| !wheel.failed).count();
    row(&format!("{working} wheels, max"), wheels[0].max, wheels[1].max);
    row("wheels, min", wheels[0].min, wheels[1].min);
    row("wheels, root mean square", wheels[0].rms, wheels[1].rms);
    let [both_h, both_t] = [h.with_wheels, t.with_wheels];
    row("arm and wheels, max", both_h.max, both_t.max);
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let name = format!("arm and wheels, along {axis}");
        row(&name, both_h.per_axis_max[i], both_t.per_axis_max[i]);
    }
    row("arm and wheels, least of all", both_h.min, both_t.min);
    row("volume, sampled hull", h.hull_volume, t.hull_volume);
    row("volume, true, at least", h.true_volume, t.true_volume);
    row("volume, wheels", printed.wheels.momentum_volume, printed.wheels.torque_volume);
    text.push_str("To match in every direction, times\n");
    let factor = |value: Option<f64>| match value {
        None => "none".to_owned(),
        Some(value) if value > 0.0 && value < 0.01 => format!("{value:.2e}"),
        Some(value) => format!("{value:.3}"),
    };
    let mut sizes = |name: &str, h: Option<f64>, t: Option<f64>| {
        writeln!(text, "{name:<34}{:>14}{:>14}", factor(h), factor(t))
            .expect("a string takes all that is written");
    };
    let [h, t]: [&Sizing; 2] = [&h.sizing, &t.sizing];
    sizes("  the arm's link lengths", h.arm_length_factor, t.arm_length_factor);
    sizes("  or the arm's link masses", h.arm_mass_factor, t.arm_mass_factor);
    sizes("  or the wheels' limits", h.wheel_limit_factor, t.wheel_limit_factor);
    text
}
