//! Every field that the schema of scenarios has, in two scenarios that use them all: text in place of a number, one entry
//! too few or too many, and what is below the least that the schema allows are refused by the name of the field.

use std::collections::BTreeSet;
use std::path::Path;

use righting_scenario::Scenario;
use righting_scenario::schema::scenario_schema;
use righting_test_support::path_of;
use serde_json::{Map, Value, json};

/// Fields that go with a URDF file, and that stand in no file with the others.
const OF_URDF: &str = "SystemOptions";

/// An arm by its table, with limits and shapes of all kinds, wheels, a stop on the way and an orbit by its elements.
fn arm() -> Value {
    let drive = json!({
        "viscous_friction_n_m_s": 0.1, "rotor_inertia_kg_m2": 1e-6, "gear_ratio": 10, "gear_efficiency": 0.9,
        "torque_constant_n_m_a": 0.05, "resistance_ohm": 1.0, "idle_power_w": 1.0, "holding_power_w": 0.5
    });
    let link = |name: &str, d_m: f64, a_m: f64| {
        json!({
            "name": name, "mass_kg": 5.0, "a_m": a_m, "alpha_deg": 90.0, "d_m": d_m, "theta_deg": 0.0,
            "angle_min_deg": -90.0, "angle_max_deg": 90.0, "rate_max_deg_s": 17.2,
            "acceleration_max_deg_s2": 11.5, "jerk_max_deg_s3": 20.0, "torque_max_n_m": 100.0, "drive": drive,
            "body_exempt": false, "inertial_frame": "own", "center_of_mass_m": [0, 0, 0],
            "inertia_kg_m2": [[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]]
        })
    };
    let mut links = [link("shoulder", 0.5, 0.0), link("elbow", 0.0, 0.5)];
    let shapes = json!([
        { "sphere": { "center_m": [0, 0, 0], "radius_m": 0.02 } },
        { "capsule": { "from_m": [0, 0, 0], "to_m": [-0.1, 0, 0], "radius_m": 0.02 } }
    ]);
    links[0]["radius_m"] = json!(0.01);
    links[1]["shapes"] = shapes.clone();
    json!({
        "name": "arm", "description": "all fields of a table",
        "system": {
            "name": "arm", "description": "two links",
            "base": {
                "name": "bus", "mass_kg": 300.0, "cube_side_m": 0.5,
                "keep_out_radius_m": 0.1, "angular_rate_max_deg_s": 5.0,
                "keep_out": [
                    { "sphere": { "center_m": [0, 0, 0], "radius_m": 0.1 } },
                    { "capsule": { "from_m": [0, 0, 0], "to_m": [0, 0, 0.1], "radius_m": 0.1 } },
                    { "box": { "center_m": [0, 0, 0], "size_m": [0.2, 0.2, 0.2] } }
                ]
            },
            "mount": {
                "position_m": [0, 0, 0.25], "rotation": [1, 0, 0, 0], "force_max_n": 50.0, "moment_max_n_m": 50.0
            },
            "dh_convention": "standard", "links": links, "project_inertias": true,
            "payload": {
                "mass_kg": 2.0, "inertia_kg_m2": [[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]], "shapes": shapes
            },
            "ignored_pairs": [["links[0]", "payload"]]
        },
        "initial": {
            "joint_angles_deg": [0, 10], "joint_rates_deg_s": [0, 0], "angular_rate_deg_s": [0, 0, 0],
            "attitude": [1, 0, 0, 0]
        },
        "maneuver": {
            "type": "slew", "axis": [0, 0.6, 0.8], "angle_deg": 10.0,
            "waypoints": [
                { "axis": [0, 0, 1], "angle_deg": 5.0, "dwell_s": 2.0, "rest": true, "duration_s": 15.0 },
                { "target_attitude": [1, 0, 0, 0] }
            ]
        },
        "horizon": { "duration_s": 40.0, "steps": 80 },
        "weights": {
            "control": 0.01, "position": 1, "attitude": 1000, "velocity": 1, "angular_rate": 100,
            "joint_angle": 1, "joint_rate": 100, "wheel_torque": 0.01, "wheel_momentum": 1
        },
        "final": { "hard": false, "joint_angles_deg": [0, null], "wheel_momenta_n_m_s": [0.1, null] },
        "wheels": [
            {
                "axis": [0, 0, 1], "momentum_max_n_m_s": 1.0, "torque_max_n_m": 0.1, "steady_power_w": 5.0,
                "initial_momentum_n_m_s": 0.1, "inertia_kg_m2": 0.01, "viscous_friction_n_m_s": 1e-5,
                "failed": false
            },
            { "axis": [1, 0, 0], "momentum_max_n_m_s": 1.0, "torque_max_n_m": 0.1 }
        ],
        "robustness": { "mass_percent": 10, "weight": 2 },
        "environment": {
            "gravity_gradient": {
                "altitude_km": 400.0,
                "elements": {
                    "inclination_deg": 51.6, "right_ascension_deg": 10.0, "argument_of_latitude_deg": 20.0
                }
            },
            "torque_body_n_m": [1e-5, 0, 0], "torque_inertial_n_m": [0, 1e-5, 0]
        },
        "pointing": [
            {
                "name": "Sun", "boresight_body": [1, 0, 0], "direction_inertial": [0, 0, 1], "keep_out_deg": 10.0
            },
            {
                "name": "Earth", "boresight_body": [0, 0, 1],
                "direction_table": { "t_s": [0, 40], "vectors": [[0, 0, 1], [0, 0.1, 1]] }, "keep_in_deg": 60.0
            }
        ],
        "collision": { "clearance_m": 0.01 },
        "solver": {
            "formulation": "reduced", "guess": { "starts": 4, "seed": 1 }, "optimizer": "ipopt",
            "linear_solver": "auto", "max_iterations": 100, "time_limit_s": 10.0, "tolerance": 1e-8
        }
    })
}

/// A tree of joints that turn and slide, a duration that the plan chooses, an orbit by the attitude of its frame.
fn bodies() -> Value {
    let mut scenario = arm();
    let inertia = json!([[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]]);
    let sphere = json!([{ "sphere": { "center_m": [0, 0, 0.5], "radius_m": 0.02 } }]);
    scenario["system"] = json!({
        "name": "bodies",
        "base": { "mass_kg": 300.0, "inertia_kg_m2": [[12, 0, 0], [0, 12, 0], [0, 0, 12]],
            "center_of_mass_m": [0, 0, 0.01], "keep_out_radius_m": 0.1 },
        "bodies": [
            {
                "name": "turning", "parent": "base", "mass_kg": 5.0, "center_of_mass_m": [0, 0, 0.2],
                "inertia_kg_m2": inertia, "shapes": sphere, "body_exempt": false,
                "joint": {
                    "name": "hinge", "type": "revolute", "position_m": [0, 0, 0.25], "rpy_deg": [0, 90, 0],
                    "axis": [0, 0, 1], "angle_min_deg": -90.0, "angle_max_deg": 90.0, "rate_max_deg_s": 20.0,
                    "acceleration_max_deg_s2": 10.0, "jerk_max_deg_s3": 20.0, "torque_max_n_m": 100.0,
                    "drive": { "viscous_friction_n_m_s": 0.1 }
                }
            },
            {
                "name": "sliding", "parent": "turning", "mass_kg": 5.0, "inertia_kg_m2": inertia,
                "joint": {
                    "type": "prismatic", "rotation": [1, 0, 0, 0], "travel_min_m": 0.1, "travel_max_m": 1.0,
                    "speed_max_m_s": 0.2, "acceleration_max_m_s2": 0.1, "jerk_max_m_s3": 0.2, "force_max_n": 100.0
                }
            }
        ],
        "payload": { "mass_kg": 2.0, "radius_m": 0.01 }
    });
    scenario["system"].as_object_mut().unwrap().remove("payload");
    scenario["initial"] = json!({
        "joint_angles_deg": [10], "joint_travels_m": [0.5], "joint_rates_deg_s": [0], "joint_speeds_m_s": [0]
    });
    scenario["final"] = json!({ "joint_angles_deg": [null], "joint_travels_m": [0.5] });
    scenario["maneuver"] = json!({ "type": "slew", "target_attitude": [1, 0, 0, 0] });
    scenario["horizon"] = json!({ "duration_s": { "min": 5.0, "max": 40.0 }, "steps": 80 });
    scenario["weights"] = json!({ "control": 1e-3, "time": 1.0 });
    scenario["environment"] =
        json!({ "gravity_gradient": { "altitude_km": 400.0, "orbit_attitude": [1, 0, 0, 0] } });
    scenario.as_object_mut().unwrap().remove("wheels");
    scenario
}

/// The table again with a payload that is a ball.
fn ball() -> Value {
    let mut scenario = arm();
    scenario["system"]["payload"] = json!({ "mass_kg": 2.0, "radius_m": 0.01 });
    scenario
}

/// A place in a scenario, and what the schema says of it.
struct Place {
    pointer: String,
    schema: Map<String, Value>,
    value: Value,
}

/// Walks a value along its schema.
struct Walk<'a> {
    root: &'a Value,
    places: Vec<Place>,
    /// The fields that were met, each by the name of its type and its own.
    fields: BTreeSet<(String, String)>,
}

impl Walk<'_> {
    /// The part of a schema that is for such a value, with the name of its type.
    fn resolved(&self, schema: &Value, value: &Value, name: &str) -> Option<(Value, String)> {
        if let Some(reference) = schema.get("$ref").and_then(Value::as_str) {
            let name = reference.trim_start_matches("#/$defs/");
            return self.resolved(&self.root["$defs"][name], value, name);
        }
        let alternatives = ["anyOf", "oneOf"].iter().filter_map(|key| schema.get(key)?.as_array());
        let is_object = schema.get("properties").is_some();
        if let Some(all) = alternatives.into_iter().next().filter(|_| !is_object) {
            let mut all = all.iter().filter_map(|one| self.resolved(one, value, name));
            return all.next();
        }
        let kind = match value {
            Value::Null => "null",
            Value::Bool(_) => "boolean",
            Value::Number(_) => "number",
            Value::String(_) => "string",
            Value::Array(_) => "array",
            Value::Object(_) => "object",
        };
        let fits = |listed: &str| listed == kind || (listed, kind) == ("integer", "number");
        let is_of_kind = match schema.get("type") {
            Some(Value::String(listed)) => fits(listed),
            Some(Value::Array(listed)) => listed.iter().filter_map(Value::as_str).any(fits),
            _ => true,
        };
        is_of_kind.then(|| (schema.clone(), name.to_owned()))
    }

    fn visit(&mut self, schema: &Value, value: &Value, pointer: &str, name: &str) {
        let found = self.resolved(schema, value, name);
        let (schema, name) = found.unwrap_or_else(|| panic!("{pointer}: no schema for {value}"));
        match value {
            Value::Object(object) => {
                for (key, value) in object {
                    self.fields.insert((name.clone(), key.clone()));
                    let schema = &schema["properties"][key];
                    self.visit(schema, value, &format!("{pointer}/{key}"), &name);
                }
            }
            Value::Array(array) => {
                for (index, value) in array.iter().enumerate() {
                    self.visit(&schema["items"], value, &format!("{pointer}/{index}"), &name);
                }
            }
            _ => {}
        }
        let schema = schema.as_object().cloned().unwrap_or_default();
        let pointer = pointer.to_owned();
        self.places.push(Place { pointer, schema, value: value.clone() });
    }
}

/// Refused by the name of the field that stands at a place.
#[track_caller]
fn assert_refused(scenario: &Value, pointer: &str, value: &Value) {
    let mut changed = scenario.clone();
    *changed.pointer_mut(pointer).unwrap() = value.clone();
    let refused = Scenario::parse(&changed.to_string(), Path::new("plan.json"));
    let message = match refused {
        Ok(_) => panic!("{pointer}: {value} is accepted"),
        Err(error) => error.to_string(),
    };
    let path = path_of(pointer);
    assert!(message.starts_with(&format!("plan.json: {path}")), "{pointer} = {value}: {message}");
    assert!(!message.contains('\n'), "{message}");
}

fn walked<'a>(root: &'a Value, scenario: &Value) -> Walk<'a> {
    let mut walk = Walk { root, places: Vec::new(), fields: BTreeSet::new() };
    walk.visit(root, scenario, "", "Scenario");
    walk
}

#[test]
fn the_scenarios_are_good_and_have_every_field() {
    let root = scenario_schema();
    let mut met = BTreeSet::new();
    for scenario in [arm(), bodies(), ball()] {
        Scenario::parse(&scenario.to_string(), Path::new("plan.json")).unwrap();
        met.extend(walked(&root, &scenario).fields);
    }
    let of = |name: &str, schema: &Value| -> Vec<(String, String)> {
        let properties = schema.get("properties").and_then(Value::as_object);
        let keys = properties.into_iter().flat_map(|properties| properties.keys());
        keys.map(|key| (name.to_owned(), key.clone())).collect()
    };
    let types = root["$defs"].as_object().unwrap().iter();
    let mut all = of("Scenario", &root);
    all.extend(
        types.filter(|(name, _)| *name != OF_URDF).flat_map(|(name, schema)| of(name, schema)),
    );
    let missing: Vec<_> = all.into_iter().filter(|field| !met.contains(field)).collect();
    assert_eq!(missing, [("Scenario".to_owned(), "system_options".to_owned())]);
}

#[test]
fn text_is_no_number() {
    let root = scenario_schema();
    for scenario in [arm(), bodies()] {
        for place in walked(&root, &scenario).places {
            if place.value.is_number() {
                for text in ["NaN", "1"] {
                    assert_refused(&scenario, &place.pointer, &json!(text));
                }
            }
        }
    }
}

/// Lists that have as many entries as there are: all others have as many as vectors, quaternions and joints ask for.
fn is_of_any_length(pointer: &str) -> bool {
    let last = pointer.rsplit('/').next().unwrap_or_default();
    ["links", "bodies", "keep_out", "shapes", "pointing", "waypoints", "wheels", "ignored_pairs"]
        .contains(&last)
}

#[test]
fn one_entry_too_few_or_too_many_is_refused() {
    let root = scenario_schema();
    let mut refused = 0;
    for scenario in [arm(), bodies()] {
        for place in walked(&root, &scenario).places {
            let Value::Array(entries) = &place.value else { continue };
            if is_of_any_length(&place.pointer) {
                continue;
            }
            let fewer = entries[1..].to_vec();
            let more = [&entries[..], &entries[..1]].concat();
            for wrong in [fewer, more] {
                // Where a table's two lists differ, the second is named.
                let pointer = place.pointer.replace("direction_table/t_s", "direction_table");
                let wrong = match pointer == place.pointer {
                    true => json!(wrong),
                    false => {
                        json!({ "t_s": wrong, "vectors": scenario.pointer(&pointer).unwrap()["vectors"] })
                    }
                };
                assert_refused(&scenario, &pointer, &wrong);
                refused += 1;
            }
        }
    }
    assert!(refused > 60, "{refused}");
}

#[test]
fn less_than_the_least_is_refused() {
    let root = scenario_schema();
    let mut refused = 0;
    for scenario in [arm(), bodies(), ball()] {
        for place in walked(&root, &scenario).places {
            if !place.value.is_number() {
                continue;
            }
            let bound = |key: &str| place.schema.get(key).and_then(Value::as_f64);
            let wrong = [
                bound("exclusiveMinimum"),
                bound("exclusiveMinimum").map(|least| least - 1.0),
                bound("minimum").map(|least| least - 1.0),
                bound("maximum").map(|most| 2.0 * most + 1.0),
                // Beyond all measure.
                Some(1e300),
                Some(-1e300),
            ];
            for wrong in wrong.into_iter().flatten() {
                assert_refused(&scenario, &place.pointer, &json!(wrong));
                refused += 1;
            }
        }
    }
    assert!(refused > 500, "{refused}");
}
