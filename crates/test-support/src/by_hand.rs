//! Arms whose truth can be worked out by hand.

use std::path::Path;

use righting_scenario::Scenario;
use serde_json::{Value, json};

/// A link that turns within ± `range_deg`, or freely.
pub fn link(mass_kg: f64, a_m: f64, alpha_deg: f64, range_deg: Option<f64>) -> Value {
    json!({
        "mass_kg": mass_kg, "a_m": a_m, "alpha_deg": alpha_deg, "d_m": 0.0, "theta_deg": 0.0,
        "angle_min_deg": range_deg.map(|range| -range), "angle_max_deg": range_deg,
        "rate_max_deg_s": 20.0, "acceleration_max_deg_s2": 10.0, "body_exempt": false
    })
}

/// A cube of 100 kg and 1 m with an arm whose first joint turns about z through `mount_m`.
pub fn on_a_cube(mount_m: [f64; 3], links: &[Value]) -> Scenario {
    let scenario = json!({
        "name": "by_hand",
        "system": {
            "name": "by_hand",
            "base": { "mass_kg": 100.0, "cube_side_m": 1.0, "keep_out_radius_m": 0.0 },
            "mount": { "position_m": mount_m },
            "links": links
        },
        "initial": { "joint_angles_deg": vec![0.0; links.len()] },
        "maneuver": { "type": "slew", "axis": [0, 0, 1], "angle_deg": 10.0 },
        "horizon": { "duration_s": 30.0, "steps": 60 },
        "collision": { "clearance_m": 0.0 }
    });
    Scenario::parse(&scenario.to_string(), Path::new("by_hand.json")).unwrap()
}
