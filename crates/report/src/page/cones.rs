//! The cones of the instruments as the page draws them.

use righting_results::Node;
use righting_scenario::{ConeSide, Pointing, Scenario};
use serde::Serialize;

use super::columns::{Column, encoded};

/// An instrument and its cone.
#[derive(Debug, Serialize)]
pub(super) struct Cone {
    name: String,
    /// Whether the boresight stays inside, and not outside.
    is_inside: bool,
    half_angle_rad: f64,
    /// Unit vector, body axes.
    boresight_body: [f64; 3],
    /// The cone's axis at every node shown, a unit vector in inertial axes.
    axes: Column,
}

/// Every cone of a scenario at these nodes.
pub(super) fn cones(scenario: &Scenario, nodes: &[&Node]) -> Vec<Cone> {
    let of = |cone: &Pointing| {
        let axes = nodes.iter().map(|node| cone.direction.at(node.time_s));
        Cone {
            name: cone.name.clone(),
            is_inside: cone.side == ConeSide::Inside,
            half_angle_rad: cone.half_angle_rad,
            boresight_body: cone.boresight.into(),
            axes: encoded(axes.flat_map(|axis| [axis.x, axis.y, axis.z])),
        }
    };
    scenario.pointing().iter().map(of).collect()
}
