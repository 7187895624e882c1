//! `loads.svg`: what the joints' drives and the mount bear, where that is limited.

use righting_analysis::limited_loads::{LimitedLoad, LoadHistory};
use righting_analysis::{PowerProfile, limited_loads};
use righting_results::Solution;
use righting_scenario::SystemDescription;

use crate::figure::{Figure, heading};
use crate::panel::Panel;

const PANEL_SIZE: [f64; 2] = [620.0, 110.0];

/// The figure of every load that has a limit, as an SVG document: torques of the drives, force and moment at
/// the mount, and the base's angular rate; none where nothing is limited.
pub fn loads_svg(
    solution: &Solution,
    system: &SystemDescription,
    profile: &PowerProfile,
) -> Option<String> {
    let histories = limited_loads(system, profile);
    if histories.is_empty() {
        return None;
    }
    let (title, subtitle) = heading(solution);
    let figure = Figure {
        title,
        subtitle,
        places: profile.instants().iter().map(|instant| instant.time_s).collect(),
        panel_size: PANEL_SIZE,
        panels: histories.into_iter().map(|history| panel(history, system)).collect(),
        ..Figure::default()
    };
    Some(figure.render())
}

fn panel(history: LoadHistory, system: &SystemDescription) -> Panel {
    let LoadHistory { load, most, values } = history;
    let (name, axis_label, scale) = match load {
        LimitedLoad::JointTorque(joint) => {
            (format!("Torque of {}", system.names.joint(joint)), "Torque [N m]", 1.0)
        }
        LimitedLoad::MountForce => ("Force at the mount".to_owned(), "Force [N]", 1.0),
        LimitedLoad::MountMoment => ("Moment at the mount".to_owned(), "Moment [N m]", 1.0),
        LimitedLoad::BaseRate => {
            ("Angular rate of the base".to_owned(), "Rate [deg/s]", 1_f64.to_degrees())
        }
    };
    let is_signed = matches!(load, LimitedLoad::JointTorque(_));
    let values = values.into_iter().map(|value| scale * value).collect();
    Panel::limited(name, axis_label, values, scale * most, is_signed)
}
