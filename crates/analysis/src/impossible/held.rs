//! Whether wheels hold the angular momentum of a slew wherever its base shall rest.

use nalgebra::Vector3;
use righting_multibody::Quaternion;
use righting_scenario::Scenario;
use righting_scenario::wheels::{Wheel, stored_at_start};
use righting_verifier::{ATTITUDE_ERROR, SLEW_AT_REST_DEG_S, at_rest_deg_s};

use super::Impossible;
use crate::detumble::inertia_range_kg_m2;
use crate::zonotope::Zonotope;

/// The first attitude in which the base shall rest, with the joints at rest, and in which the momentum that never changes is
/// more than the wheels can store: failed ones what they have, the others up to their limits.
pub(super) fn unheld(scenario: &Scenario) -> Option<Impossible> {
    let slew = scenario.maneuver().slew()?;
    let changes = scenario.acting_environment().is_some() || scenario.may_drift();
    if scenario.wheels().is_empty() || changes {
        return None;
    }
    let (failed, working): (Vec<Wheel>, Vec<Wheel>) =
        scenario.wheels().iter().partition(|wheel| wheel.failed);
    let (kept, reached) = (stored_at_start(&failed), Zonotope::momenta(&working));
    let initial = scenario.initial();
    let total = initial.angular_momentum_n_m_s
        + initial.attitude.to_inertial(&stored_at_start(scenario.wheels()));
    let left_in = |target: &Quaternion<f64>| {
        let wanted: Vector3<f64> = target.to_body(&total) - kept;
        // An attitude that is off by its tolerance.
        reached.distance_to(&wanted) - 2.0 * ATTITUDE_ERROR * total.norm()
    };
    let stops = scenario.waypoints().iter().enumerate().filter(|(_, stop)| stop.is_at_rest);
    let stops = stops.map(|(index, stop)| (format!("waypoint {}", index + 1), &stop.target));
    let mut rests = stops.chain([("the target".to_owned(), &slew.target)]);
    let longest_s = scenario.horizon().duration_s;
    let shortest_s = scenario.free_duration().map_or(longest_s, |free| free.shortest_s);
    let rest_deg_s = at_rest_deg_s(SLEW_AT_REST_DEG_S, shortest_s);
    let mut largest_kg_m2 = None;
    rests.find_map(|(place, target)| {
        let left_n_m_s = left_in(target);
        if left_n_m_s <= 0.0 {
            return None;
        }
        let largest_kg_m2 = *largest_kg_m2
            .get_or_insert_with(|| inertia_range_kg_m2(scenario.system(), scenario.collision())[1]);
        let least_deg_s = (left_n_m_s / largest_kg_m2).to_degrees();
        (least_deg_s > rest_deg_s).then_some(Impossible::Unheld { place, left_n_m_s, least_deg_s })
    })
}
