//! `righting explain`: what an arm can do at all.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use righting_analysis::detumble::rate_bound_rad_s;
use righting_analysis::{Abilities, Impossible};
use righting_report::{short, turn_rates_svg};
use righting_results::{SOLUTION_FILE, Solution};
use righting_scenario::json::FileKind;
use righting_scenario::scenario::DEFAULT_CLEARANCE_M;
use righting_scenario::{
    CollisionModel, Maneuver, Scenario, Slew, SystemDescription, SystemOrScenario,
};
use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde_json::Value;

use crate::failure::Failure;
use crate::figures::Formats;
use crate::output;
use crate::output_folder::OutputFolder;

const JSON_FILE: &str = "explain.json";
const FIGURE_FILE: &str = "explain.svg";
/// An arm hardly turns its base about an axis that its loops turn it this much less about.
const HARDLY: f64 = 0.1;

/// Say what an arm can do: about which axes it turns the base, how fast, and whether a maneuver is
/// possible.
///
/// Nothing is planned. Turn rates and durations are first estimates from some motions of the joints, timed at
/// their limits, clearances left out: of eight slews tried, the estimate was between 0.6 and 4.2 times the
/// shortest duration that `righting reach` found. What is called impossible is.
#[derive(Args)]
#[command(mut_arg("png", |png| png.requires("out")))]
pub struct Arguments {
    /// A system file, a scenario file, or the folder of a plan for its scenario.
    #[arg(value_name = "SYSTEM_OR_SCENARIO_OR_DIR")]
    path: PathBuf,
    /// The folder for explain.json and explain.svg.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    formats: Formats,
    /// Print the contents of explain.json.
    #[arg(long)]
    pub json: bool,
}

/// What explain.json holds and `--json` prints. Joints are counted from one, vectors are in body axes.
#[derive(Serialize, JsonSchema)]
#[schemars(title = "Righting explain")]
struct Printed<'a> {
    /// "righting.explain/1".
    schema: &'static str,
    /// Name of the system.
    system: &'a str,
    /// Name of the scenario, if one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario: Option<&'a str>,
    /// Number of joints.
    joints: usize,
    /// Joints whose limits leave them no motion.
    locked_joints: Vec<usize>,
    /// Joints that move, but neither turn the base nor change how the others do.
    idle_joints: Vec<usize>,
    /// Dimensions of the group that the base's attitudes stay in: 0 (it does not turn), 1 (about one axis)
    /// or 3 (about every axis, unless only one joint counts).
    rank: usize,
    /// The only axis about which the base turns; absent if the rank is not 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    only_axis: Option<[f64; 3]>,
    /// How far the base turns a radian of a joint, root mean square over the joints' ranges, about the three
    /// axes for which that is most and least, rad/rad.
    singular_values: [f64; 3],
    /// No motion of the joints turns the base faster, as far as postures were looked at, deg/s.
    fastest_deg_s: f64,
    /// Loops of the joints through the posture at the start, or the middle one of a system.
    loops: Loops,
    /// Inertia of the whole system with its joints held, over the postures within limits and clearances.
    inertia: Inertia,
    /// Present for a scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    maneuver: Option<Asked>,
}

#[derive(Serialize, JsonSchema)]
struct Loops {
    /// How many were looked at.
    count: usize,
    /// The axes about which they turn the base most, less and least.
    principal_axes: [[f64; 3]; 3],
    /// How far a loop turns it about each, root mean square, deg.
    turns_deg: [f64; 3],
    /// How fast the best mixture of them turns it about each, deg/s.
    rates_deg_s: [f64; 3],
}

#[derive(Serialize, JsonSchema)]
struct Inertia {
    /// Smallest principal inertia, kg m².
    smallest_kg_m2: f64,
    /// Largest principal inertia, kg m².
    largest_kg_m2: f64,
    /// Their ratio: no detumble divides a rate by more.
    best_detumble_factor: f64,
}

#[derive(Serialize, JsonSchema)]
struct Asked {
    /// "slew" or "detumble".
    #[serde(rename = "type")]
    kind: &'static str,
    /// Duration asked, s.
    duration_s: f64,
    /// Whether nothing is known that makes it impossible. That is no promise of a plan.
    possible: bool,
    /// Why it is impossible.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Where the axis is what makes it impossible: those about which the base can turn by the angle asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    possible_axes: Option<Vec<[f64; 3]>>,
    /// Slew: the axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    axis: Option<[f64; 3]>,
    /// Slew: the angle, deg.
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<f64>,
    /// Slew by an arm that turns the base about one axis only: the angle between that axis and the one asked,
    /// deg.
    #[serde(skip_serializing_if = "Option::is_none")]
    off_axis_deg: Option<f64>,
    /// Slew: how fast loops turn the base about the axis, deg/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    rate_deg_s: Option<f64>,
    /// Slew: a first estimate of the time needed, s; absent where no motion looked at turns the base about
    /// the axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    estimated_s: Option<f64>,
    /// Slew: the joints' rates do not allow less, as far as postures were looked at, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    least_s: Option<f64>,
    /// Detumble: the rate left by stopping the arm where it starts, deg/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    stopped_deg_s: Option<f64>,
    /// Detumble: no motion that stops the arm leaves less, deg/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    bound_deg_s: Option<f64>,
}

/// The JSON Schema (draft 2020-12) of explain.json.
pub fn schema() -> Value {
    schema_for!(Printed<'_>).to_value()
}

/// Reads, looks, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let writer = arguments.formats.writer()?;
    let given = read(&arguments.path)?;
    let (system, scenario) = match &given {
        SystemOrScenario::System(system) => (&**system, None),
        SystemOrScenario::Scenario(scenario) => (scenario.system(), Some(&**scenario)),
    };
    let folder = arguments.out.as_ref().map(|out| OutputFolder::open(out)).transpose()?;
    let abilities = match scenario {
        Some(scenario) => {
            let start = &scenario.initial().joint_angles_rad;
            Abilities::of(system, start, scenario.collision())
        }
        None => {
            let middle = system.joint_angles_at(&vec![0.5; system.joint_count()]);
            Abilities::of(system, &middle, &CollisionModel::new(system, DEFAULT_CLEARANCE_M))
        }
    };
    let printed = printed(system, scenario, &abilities);
    let json = output::to_json(&printed)?;
    let mut files = Vec::new();
    if let Some(folder) = &folder {
        files.push(folder.write(JSON_FILE, json.as_bytes())?);
        let asked = scenario.and_then(|scenario| match scenario.maneuver() {
            Maneuver::Slew(slew) => Some(&slew.axis),
            Maneuver::Detumble => None,
        });
        let name = scenario.map_or(&*system.name, Scenario::name);
        let figure = turn_rates_svg(name, &abilities.rates.semi_axes_deg_s(), asked);
        files.extend(writer.write(folder.path(), FIGURE_FILE, &figure)?);
    }
    if arguments.json {
        output::print(&json)
    } else {
        output::print(&describe(&printed, &abilities, &files))
    }
}

/// What a path stands for: of a plan's folder, the scenario that was solved.
fn read(path: &Path) -> Result<SystemOrScenario, Failure> {
    if !path.is_dir() {
        return SystemOrScenario::read(path)
            .map_err(|error| Failure::InputOf { kind: FileKind::SystemOrScenario, error });
    }
    let file = path.join(SOLUTION_FILE);
    let scenario = Solution::read_json(&file)
        .and_then(|solution| Scenario::from_file(solution.scenario, &file))
        .map_err(|error| Failure::InputOf { kind: FileKind::Solution, error })?;
    Ok(SystemOrScenario::Scenario(Box::new(scenario)))
}

fn printed<'a>(
    system: &'a SystemDescription,
    scenario: Option<&'a Scenario>,
    abilities: &Abilities,
) -> Printed<'a> {
    let Abilities { axes, rates, inertia_range_kg_m2 } = abilities;
    let counted = |joints: &[usize]| joints.iter().map(|joint| joint + 1).collect();
    let [smallest_kg_m2, largest_kg_m2] = *inertia_range_kg_m2;
    Printed {
        schema: "righting.explain/1",
        system: &system.name,
        scenario: scenario.map(Scenario::name),
        joints: system.joint_count(),
        locked_joints: counted(&axes.locked_joints),
        idle_joints: counted(&axes.idle_joints),
        rank: axes.rank(),
        only_axis: axes.only_axis().map(Into::into),
        singular_values: axes.singular_values,
        fastest_deg_s: axes.fastest_rad_s.to_degrees(),
        loops: Loops {
            count: rates.loops,
            principal_axes: rates.principal_axes.map(Into::into),
            turns_deg: rates.turns_rad.map(f64::to_degrees),
            rates_deg_s: rates.rates_rad_s.map(f64::to_degrees),
        },
        inertia: Inertia {
            smallest_kg_m2,
            largest_kg_m2,
            best_detumble_factor: abilities.best_detumble_factor(),
        },
        maneuver: scenario.map(|scenario| asked(scenario, abilities)),
    }
}

fn asked(scenario: &Scenario, abilities: &Abilities) -> Asked {
    let reason = Impossible::of(scenario);
    let axes = |reason: &Impossible| {
        let axes = reason.possible_axes();
        (!axes.is_empty()).then(|| axes.iter().map(|axis| (*axis).into()).collect())
    };
    let (slew, is_detumble) = match scenario.maneuver() {
        Maneuver::Slew(slew) => (Some(slew), false),
        Maneuver::Detumble => (None, true),
    };
    let estimated_s = |slew: &Slew| abilities.rates.duration_s(&slew.axis, slew.angle_rad);
    let least_s = |slew: &Slew| match slew.angle_rad.abs() {
        0.0 => Some(0.0),
        angle => Some(angle / abilities.axes.fastest_rad_s).filter(|least| least.is_finite()),
    };
    Asked {
        kind: if is_detumble { "detumble" } else { "slew" },
        duration_s: scenario.horizon().duration_s,
        possible: reason.is_none(),
        possible_axes: reason.as_ref().and_then(axes),
        axis: slew.map(|slew| slew.axis.into()),
        angle_deg: slew.map(|slew| slew.angle_rad.to_degrees()),
        off_axis_deg: slew
            .and_then(|slew| abilities.axes.off_axis_rad(&slew.axis))
            .map(f64::to_degrees),
        rate_deg_s: slew.map(|slew| abilities.rates.about(&slew.axis).to_degrees()),
        estimated_s: slew.filter(|_| reason.is_none()).and_then(estimated_s),
        least_s: slew.and_then(least_s),
        stopped_deg_s: is_detumble.then(|| scenario.stopped_rate_rad_s().to_degrees()),
        bound_deg_s: is_detumble.then(|| rate_bound_rad_s(scenario).to_degrees()),
        reason: reason.map(|reason| reason.to_string()),
    }
}

/// The same in sentences.
fn describe(printed: &Printed<'_>, abilities: &Abilities, files: &[PathBuf]) -> String {
    let joints = if printed.joints == 1 { "joint" } else { "joints" };
    let mut text = format!("{}: {} {joints}\n", printed.system, printed.joints);
    let mut line = |name: &str, sentence: &str| {
        writeln!(text, "  {name:<9}{sentence}").expect("a string takes all that is written");
    };
    if let Some(locked) = listed(&printed.locked_joints) {
        line("locked", &format!("{locked} cannot move."));
    }
    if let Some(idle) = listed(&printed.idle_joints) {
        line("idle", &format!("{idle} can move, but nothing of it reaches the base."));
    }
    line("axes", &about_axes(printed, abilities));
    for (name, sentence) in about_loops(&printed.loops) {
        line(name, &sentence);
    }
    let Inertia { smallest_kg_m2, largest_kg_m2, best_detumble_factor } = printed.inertia;
    line(
        "inertia",
        &format!(
            "With the arm held, principal inertias lie between {} and {} kg m\u{b2}: a detumble divides the \
             rate by {} at most.",
            short(smallest_kg_m2),
            short(largest_kg_m2),
            short(best_detumble_factor),
        ),
    );
    if let (Some(asked), Some(name)) = (&printed.maneuver, printed.scenario) {
        text.push_str(&format!("\n{name}: {}\n  {}\n", phrase(asked), verdict(asked)));
    }
    if !files.is_empty() {
        text.push_str("\nFiles\n");
        for file in files {
            text.push_str(&format!("  {}\n", file.display()));
        }
    }
    text
}

fn about_axes(printed: &Printed<'_>, abilities: &Abilities) -> String {
    let axes = &abilities.axes;
    match (printed.rank, &axes.effective_joints[..]) {
        (0, _) => "Nothing that this arm's joints do turns the base.".to_owned(),
        (_, &[joint]) if printed.only_axis.is_none() => format!(
            "Only joint {} turns the base: its attitudes are a curve, about an axis that moves with it.",
            joint + 1
        ),
        _ => match (axes.only_axis(), axes.are_joints_parallel) {
            (Some(axis), true) if axes.effective_joints.len() > 1 => format!(
                "This arm's joints are parallel: it turns the base about {} only.",
                vector(&axis.into())
            ),
            (Some(axis), _) => {
                format!("This arm turns the base about {} only.", vector(&axis.into()))
            }
            (None, _) => "This arm turns the base about every axis.".to_owned(),
        },
    }
}

/// How far and how fast loops turn the base, about the axes about which they do.
fn about_loops(loops: &Loops) -> Vec<(&'static str, String)> {
    let Loops { count, principal_axes, turns_deg, rates_deg_s } = loops;
    let turning: Vec<usize> = (0..3).filter(|&k| rates_deg_s[k] > 0.0).collect();
    let each = |values: &[f64; 3]| -> Vec<String> {
        let shown = turning.iter().map(|&k| short(values[k]));
        shown.collect()
    };
    let axes: Vec<String> = turning.iter().map(|&k| vector(&principal_axes[k])).collect();
    if turning.is_empty() {
        return vec![("loops", "No loop that ends where it begins turns the base.".to_owned())];
    }
    let mut sentences = vec![
        (
            "loops",
            format!(
                "{count} loops of the joints turn the base by {}\u{b0} (root mean square) about {}.",
                and(&each(turns_deg)),
                and(&axes),
            ),
        ),
        (
            "rates",
            format!(
                "Round after round at the joints' limits, they turn it at {} \u{b0}/s about the same.",
                and(&each(rates_deg_s)),
            ),
        ),
    ];
    let hardly: Vec<String> = turning
        .iter()
        .filter(|&&k| rates_deg_s[k] < HARDLY * rates_deg_s[0])
        .map(|&k| vector(&principal_axes[k]))
        .collect();
    if !hardly.is_empty() {
        sentences.push(("", format!("That is hardly about {}.", and(&hardly))));
    }
    sentences
}

fn phrase(asked: &Asked) -> String {
    let duration = short(asked.duration_s);
    match (asked.axis, asked.angle_deg) {
        (Some(axis), Some(angle_deg)) => {
            format!("slew of {}\u{b0} about {} in {duration} s", short(angle_deg), vector(&axis))
        }
        _ => format!("detumble in {duration} s"),
    }
}

fn verdict(asked: &Asked) -> String {
    if let Some(reason) = &asked.reason {
        return format!("Impossible: {reason}.");
    }
    if let (Some(stopped), Some(bound)) = (asked.stopped_deg_s, asked.bound_deg_s) {
        return format!(
            "Stopping the arm leaves {} \u{b0}/s. No motion that stops it leaves less than {} \u{b0}/s.",
            short(stopped),
            short(bound)
        );
    }
    let needs = match (asked.estimated_s, asked.least_s) {
        (Some(estimated), Some(least)) => format!(
            "It takes about {} s, by a first estimate; the joints' rates do not allow less than {} s.",
            short(estimated),
            short(least)
        ),
        (None, Some(least)) => format!(
            "No motion looked at turns the base about this axis; the joints' rates do not allow less than \
             {} s.",
            short(least)
        ),
        _ => String::new(),
    };
    format!("Nothing is known that makes it impossible. {needs}")
}

/// "Joint 3" or "Joints 1, 2 and 3".
fn listed(joints: &[usize]) -> Option<String> {
    let numbers: Vec<String> = joints.iter().map(usize::to_string).collect();
    match joints.len() {
        0 => None,
        1 => Some(format!("Joint {}", and(&numbers))),
        _ => Some(format!("Joints {}", and(&numbers))),
    }
}

fn and(words: &[String]) -> String {
    match words.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => words.concat(),
    }
}

fn vector(components: &[f64; 3]) -> String {
    let shown = components.map(|x| short(if x.abs() < 5e-4 { 0.0 } else { x }));
    format!("[{}]", shown.join(", "))
}
