//! What `righting explain` found, in sentences.

use std::fmt::Write;
use std::path::PathBuf;

use righting_analysis::explanation::{Asked, Inertia, Loops};
use righting_analysis::{Abilities, Explanation};
use righting_report::short;
use righting_scenario::Names;

/// An arm hardly turns its base about an axis that its loops turn it this much less about.
const HARDLY: f64 = 0.1;

/// All of it.
pub fn describe(
    explanation: &Explanation<'_>,
    names: &Names,
    abilities: &Abilities,
    files: &[PathBuf],
) -> String {
    let joints = if explanation.joints == 1 { "joint" } else { "joints" };
    let mut text = format!("{}: {} {joints}\n", explanation.system, explanation.joints);
    let mut line = |name: &str, sentence: &str| {
        writeln!(text, "  {name:<9}{sentence}").expect("a string takes all that is written");
    };
    if let Some(locked) = listed(&explanation.locked_joints, names) {
        line("locked", &format!("{locked} cannot move."));
    }
    if let Some(idle) = listed(&explanation.idle_joints, names) {
        line("idle", &format!("{idle} can move, but nothing of it reaches the base."));
    }
    line("axes", &about_axes(explanation, names, abilities));
    for (name, sentence) in about_loops(&explanation.loops) {
        line(name, &sentence);
    }
    let Inertia { smallest_kg_m2, largest_kg_m2, best_detumble_factor } = explanation.inertia;
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
    if let (Some(asked), Some(name)) = (&explanation.maneuver, explanation.scenario) {
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

fn about_axes(explanation: &Explanation<'_>, names: &Names, abilities: &Abilities) -> String {
    let axes = &abilities.axes;
    match (explanation.rank, &axes.effective_joints[..]) {
        (0, _) => "Nothing that this arm's joints do turns the base.".to_owned(),
        (_, &[joint]) if explanation.only_axis.is_none() => format!(
            "Only {} turns the base: its attitudes are a curve, about an axis that moves with it.",
            names.joint(joint)
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
    let way = match asked.waypoints.unwrap_or(0) {
        0 => String::new(),
        1 => " by way of a waypoint".to_owned(),
        waypoints => format!(" by way of {waypoints} waypoints"),
    };
    match (asked.axis, asked.angle_deg) {
        (Some(_), Some(0.0)) if asked.waypoints.is_some() => {
            format!("slew back to the start{way} in {duration} s")
        }
        (Some(axis), Some(angle_deg)) => {
            let (angle, axis) = (short(angle_deg), vector(&axis));
            format!("slew of {angle}\u{b0} about {axis}{way} in {duration} s")
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

/// "Joint 3" or "Joints 1, 2 and 3", or by their names, of joints counted from one.
fn listed(joints: &[usize], names: &Names) -> Option<String> {
    let named: Option<Vec<String>> = joints
        .iter()
        .map(|joint| names.of_joint(joint.checked_sub(1)?).map(str::to_owned))
        .collect();
    if let Some(named) = named.filter(|named| !named.is_empty()) {
        return Some(and(&named));
    }
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
