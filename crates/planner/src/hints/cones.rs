//! Cones that stand in the way of a slew.

use righting_multibody::Quaternion;
use righting_results::Trajectory;
use righting_scenario::{ConeSide, Pointing, Scenario};

/// Places that are looked at on a shortest turn.
const PLACES: usize = 200;
/// So near to its cone's edge, rad, a boresight is at it.
const AT_EDGE_RAD: f64 = 2e-3;
/// Being there in so much of the time is worth naming.
const OFTEN: f64 = 0.05;

/// The cones that a shortest turn from target to target passes through, or leaves, and those at whose edge the motion often
/// is.
pub(super) fn in_the_way(scenario: &Scenario, trajectory: &Trajectory) -> Vec<String> {
    let of_cone = |cone: &Pointing| {
        let crossed = is_crossed(scenario, cone).then(|| {
            let how = match cone.side {
                ConeSide::Outside => "goes through",
                ConeSide::Inside => "leaves",
            };
            format!("the shortest turn {how} the cone of \"{}\"", cone.name)
        });
        let nodes = trajectory.nodes().iter();
        let at_edge = nodes.filter(|node| {
            let attitude = Quaternion::from_array(node.attitude);
            excess_rad(cone, &attitude, node.time_s) > -AT_EDGE_RAD
        });
        let share = at_edge.count() as f64 / trajectory.nodes().len() as f64;
        let often = (share >= OFTEN).then(|| {
            let percent = (100.0 * share).round();
            format!("\"{}\" is at the edge of its cone {percent} % of the time", cone.name)
        });
        crossed.into_iter().chain(often)
    };
    scenario.pointing().iter().flat_map(of_cone).collect()
}

fn is_crossed(scenario: &Scenario, cone: &Pointing) -> bool {
    let duration_s = scenario.horizon().duration_s;
    scenario.legs().iter().any(|leg| {
        let (axis, angle_rad) = leg.from.conjugate().product(&leg.target).to_axis_angle();
        (0..=PLACES).any(|place| {
            let share = place as f64 / PLACES as f64;
            let turned = Quaternion::from_axis_angle(&axis, share * angle_rad);
            let time_s = duration_s * (leg.start + share * (leg.end - leg.start));
            excess_rad(cone, &leg.from.product(&turned), time_s) > 0.0
        })
    })
}

/// How far a boresight is on the wrong side of its cone, rad.
fn excess_rad(cone: &Pointing, attitude: &Quaternion<f64>, time_s: f64) -> f64 {
    cone.excess_rad(cone.angle_rad(attitude, time_s))
}
