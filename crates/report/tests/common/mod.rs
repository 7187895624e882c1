//! A made-up result, smooth and within its limits but for what a test changes.

use righting_results::{ControlInterval, Node, Solution, Trajectory};

/// A result of a slew or a detumble with `joints` joints on `steps` intervals of 50 ms.
pub fn result(kind: &str, joints: usize, steps: usize) -> (Solution, Trajectory) {
    (solution(kind, joints, steps), trajectory(joints, steps))
}

fn solution(kind: &str, joints: usize, steps: usize) -> Solution {
    let link = serde_json::json!({
        "mass_kg": 7.0, "a_m": 0.25, "alpha_deg": 90.0, "d_m": 0.0, "theta_deg": 0.0,
        "angle_min_deg": -50.0, "angle_max_deg": 50.0,
        "rate_max_deg_s": 17.2, "acceleration_max_deg_s2": 11.5
    });
    let maneuver = match kind {
        "slew" => serde_json::json!({"type": "slew", "axis": [0.0, 0.0, 2.0], "angle_deg": 20.0}),
        _ => serde_json::json!({"type": "detumble"}),
    };
    let check = |name: &str, passed: bool| {
        serde_json::json!({
            "name": name, "subject": "joint 2", "value": 0.8, "limit": 0.872, "sense": "at_most",
            "tolerance": 1e-6, "unit": "rad", "time_s": 12.35, "passed": passed
        })
    };
    let value = serde_json::json!({
        "schema": "righting.solution/1",
        "scenario": {
            "name": "made_up", "system": {
                "name": "some_arm", "base": {"mass_kg": 300.0, "cube_side_m": 0.5},
                "mount": {"position_m": [0.0, 0.0, 0.25]}, "links": vec![link; joints]
            },
            "initial": {
                "joint_angles_deg": vec![0.0; joints], "angular_rate_deg_s": [0.0, 0.0, -20.0]
            },
            "maneuver": maneuver,
            "horizon": {"duration_s": 0.05 * steps as f64, "steps": steps}
        },
        "scenario_sha256": "0",
        "versions": {"righting": "0.1.0", "ipopt": "3.11.9", "linear_solver": "mumps 5.5.1"},
        "status": "solved", "objective": 9.0685e-4, "iterations": 19,
        "constraint_violation": 1e-12,
        "terminal": {
            "attitude_error": 2e-5, "attitude_error_deg": 0.0023, "angular_rate_deg_s": 12.14,
            "joint_rate_deg_s": 1e-4
        },
        "timing_s": {
            "load": 0.0, "trace": 0.1, "guess": 0.0, "evaluate": 0.1, "linear_algebra": 0.1,
            "solve": 0.3, "verify": 0.01, "total": 0.45
        },
        "verification": {
            "passed": true, "momentum_drift": 1e-12, "attitude_mismatch": 1e-9,
            "joint_mismatch": 1e-9, "position_mismatch": 1e-9,
            "checks": [check("joint angle", true), check("joint rate", true)]
        },
        "bound_deg_s": 9.22, "reduction_percent": 39.3
    });
    serde_json::from_value(value).expect("the made-up result has the shape of a result")
}

fn trajectory(joints: usize, steps: usize) -> Trajectory {
    let end = 0.05 * steps as f64;
    let nodes = (0..=steps).map(|k| {
        let time_s = 0.05 * k as f64;
        let phase = time_s / end;
        let half = 10f64.to_radians() * (0.5 - 0.5 * (std::f64::consts::PI * phase).cos());
        Node {
            time_s,
            position_m: [0.0; 3],
            attitude: [half.cos(), 0.0, 0.01 * (9.0 * phase).sin(), half.sin()],
            velocity_m_s: [0.0; 3],
            angular_rate_rad_s: [0.01 * phase.sin(), -0.02, -0.3 + 0.1 * phase],
            joint_angles_rad: (0..joints).map(|i| (6.0 * phase + i as f64).sin()).collect(),
            joint_rates_rad_s: (0..joints).map(|i| 0.2 * (6.0 * phase + i as f64).cos()).collect(),
            power_w: 1.0,
            wheel_momenta_n_m_s: Vec::new(),
        }
    });
    let intervals = (0..steps).map(|k| ControlInterval {
        joint_accelerations_rad_s2: (0..joints)
            .map(|i| -0.01 * (6.0 * k as f64 / steps as f64 + i as f64).sin())
            .collect(),
        joint_jerks_rad_s3: Vec::new(),
        joint_torques_n_m: vec![0.0; joints],
        wheel_torques_n_m: Vec::new(),
    });
    Trajectory::new(nodes.collect(), intervals.collect()).expect("the parts fit")
}
