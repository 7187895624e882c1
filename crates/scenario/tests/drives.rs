//! Joint drives: what they mean, and what is refused.

use std::path::Path;

use righting_scenario::{Drive, Scenario};
use serde_json::{Value, json};

fn with_drive(drive: Value) -> Result<Scenario, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let read = |file: &str| -> Value {
        serde_json::from_str(&std::fs::read_to_string(folder.join(file)).unwrap()).unwrap()
    };
    let mut scenario = read("slew_4dof.json");
    scenario["system"] = read("systems/xlink_4dof.json");
    scenario["system"]["links"][3]["drive"] = drive;
    let read = Scenario::parse(&scenario.to_string(), Path::new("plan.json"));
    read.map_err(|error| error.to_string())
}

#[test]
fn a_joint_without_a_drive_has_one_that_adds_nothing() {
    let scenario = with_drive(json!({ "viscous_friction_n_m_s": 0.5, "gear_ratio": 100,
        "rotor_inertia_kg_m2": 1e-4, "torque_constant_n_m_a": 0.05, "resistance_ohm": 2 }));
    let scenario = scenario.unwrap();
    let drives = &scenario.system().drives;
    assert_eq!(drives[..3], [Drive::default(); 3]);
    assert_eq!(Drive::default().torque(3.0, 1.0, 1.0), 3.0);
    // 3 + 0.5 · 2 + 100² · 1e-4 · 4
    assert!((drives[3].torque(3.0, 2.0, 4.0) - 8.0).abs() < 1e-12);
    assert_eq!(drives[3].motor.unwrap().resistance_ohm, 2.0);
}

#[test]
fn a_wrong_drive_is_refused_with_its_field() {
    for (drive, expected) in [
        (json!(7), ": found 7, expected an object: a drive"),
        (json!({"gear_ratio": 0}), ".gear_ratio: found 0, expected a number above 0"),
        (json!({"gear_efficiency": 1.1}), ".gear_efficiency: found 1.1, expected a number above 0"),
        (json!({"gear_efficiency": 0}), ".gear_efficiency: found 0, expected a number above 0"),
        (json!({"rotor_inertia_kg_m2": -1}), ".rotor_inertia_kg_m2: found -1, expected"),
        (json!({"viscous_friction_n_m_s": -1}), ".viscous_friction_n_m_s: found -1, expected"),
        (json!({"idle_power_w": -3}), ".idle_power_w: found -3, expected"),
        (json!({"holding_power_w": 1e300}), ".holding_power_w: found 1e300, expected"),
        (json!({"torque_constant_n_m_a": 0.05}), ".resistance_ohm: missing, expected"),
        (json!({"resistance_ohm": 1}), ".torque_constant_n_m_a: missing, expected"),
        (
            json!({"torque_constant_n_m_a": 0, "resistance_ohm": 1}),
            ".torque_constant_n_m_a: found 0",
        ),
        (json!({"ratio": 3}), ".ratio"),
    ] {
        let message = with_drive(drive.clone()).unwrap_err();
        let rest = message.strip_prefix("plan.json: system.links[3].drive");
        let rest = rest.unwrap_or_else(|| panic!("{drive}: {message}"));
        assert!(rest.starts_with(expected), "{drive}: {message}");
    }
}
