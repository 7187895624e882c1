//! Wheels and surroundings of a scenario: what is refused, and by what name.

use righting_scenario::Scenario;
use righting_test_support::scenarios;
use serde_json::{Value, json};

fn refusal(change: impl FnOnce(&mut Value)) -> String {
    let path = scenarios().join("slew_4dof.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut scenario: Value = serde_json::from_str(&text).unwrap();
    change(&mut scenario);
    Scenario::parse(&scenario.to_string(), &path).unwrap_err().to_string()
}

fn wheel(changes: Value) -> Value {
    let mut wheel = json!({
        "axis": [0, 0, 1], "momentum_max_n_m_s": 1.0, "torque_max_n_m": 0.1
    });
    for (name, value) in changes.as_object().unwrap() {
        wheel[name] = value.clone();
    }
    wheel
}

#[test]
fn wheels_are_refused_by_name() {
    let cases = [
        (json!({ "axis": [0, 0, 0] }), "wheels[0].axis", "a vector that is not zero"),
        (json!({ "momentum_max_n_m_s": 0 }), "wheels[0].momentum_max_n_m_s", "found 0"),
        (json!({ "torque_max_n_m": -1 }), "wheels[0].torque_max_n_m", "found -1"),
        (json!({ "initial_momentum_n_m_s": 1.5 }), "wheels[0].initial_momentum_n_m_s", "-1 to 1"),
        (json!({ "torque_n_m": 1 }), "wheels[0]", "torque_n_m"),
        (json!({ "failed": 1 }), "wheels[0].failed", "1"),
    ];
    for (changes, field, expected) in cases {
        let message = refusal(|scenario| scenario["wheels"] = json!([wheel(changes.clone())]));
        assert!(message.contains(field) && message.contains(expected), "{changes}: {message}");
    }
    let many = vec![wheel(json!({})); 17];
    let message = refusal(|scenario| scenario["wheels"] = json!(many));
    assert!(message.contains("wheels: found 17 wheels"), "{message}");
}

#[test]
fn ends_of_wheels_are_refused_by_name() {
    let failed = json!({ "failed": true, "initial_momentum_n_m_s": 0.5 });
    let wheels = json!([wheel(json!({})), wheel(failed)]);
    let cases = [
        (json!([0.0]), "final.wheel_momenta_n_m_s", "one a wheel"),
        (json!([2.0, null]), "final.wheel_momenta_n_m_s[0]", "-1 to 1"),
        (json!([null, 0.0]), "final.wheel_momenta_n_m_s[1]", "keeps its momentum"),
    ];
    for (momenta, field, expected) in cases {
        let message = refusal(|scenario| {
            scenario["wheels"] = wheels.clone();
            scenario["final"] = json!({ "wheel_momenta_n_m_s": momenta.clone() });
        });
        assert!(message.contains(field) && message.contains(expected), "{momenta}: {message}");
    }
    let message = refusal(|scenario| scenario["weights"]["wheel_torque"] = json!(0.1));
    assert!(message.contains("weights.wheel_torque: found 0.1, expected none"), "{message}");
}

#[test]
fn surroundings_are_refused_by_name() {
    let cases = [
        (json!({ "gravity_gradient": {} }), "altitude_km", "missing"),
        (json!({ "gravity_gradient": { "altitude_km": -1 } }), "altitude_km", "found -1"),
        (
            json!({ "gravity_gradient": { "altitude_km": 400, "orbit_attitude": [1, 1, 0, 0] } }),
            "environment.gravity_gradient.orbit_attitude",
            "a unit quaternion",
        ),
        (
            json!({ "gravity_gradient": {
                "altitude_km": 400, "orbit_attitude": [1, 0, 0, 0],
                "elements": {
                    "inclination_deg": 0, "right_ascension_deg": 0, "argument_of_latitude_deg": 0
                }
            } }),
            "environment.gravity_gradient.elements",
            "one of them",
        ),
        (json!({ "torque_body_n_m": [0, 1e9, 0] }), "environment.torque_body_n_m", "found 1e9"),
        (json!({ "drag": 1 }), "environment", "drag"),
    ];
    for (environment, field, expected) in cases {
        let message = refusal(|scenario| scenario["environment"] = environment.clone());
        assert!(message.contains(field) && message.contains(expected), "{environment}: {message}");
    }
}

/// A resolved file with all of it means the same again.
#[test]
fn a_resolved_file_means_the_same() {
    let path = scenarios().join("slew_4dof.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut file: Value = serde_json::from_str(&text).unwrap();
    file["wheels"] = json!([wheel(json!({ "axis": [1, 2, 2], "initial_momentum_n_m_s": 0.25 }))]);
    file["environment"] = json!({ "gravity_gradient": { "altitude_km": 500 } });
    file["final"] = json!({ "wheel_momenta_n_m_s": [0.5] });
    let scenario = Scenario::parse(&file.to_string(), &path).unwrap();
    let resolved = serde_json::to_string(scenario.resolved()).unwrap();
    let again = Scenario::parse(&resolved, &path).unwrap();
    assert_eq!(again.resolved(), scenario.resolved());
    assert_eq!(again.wheels(), scenario.wheels());
    assert_eq!(again.environment(), scenario.environment());
}
