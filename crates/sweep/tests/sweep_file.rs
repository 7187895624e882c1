//! What a sweep file expands to, and what is said about a wrong one.

use std::collections::HashSet;
use std::path::Path;

use righting_scenario::Scenario;
use righting_sweep::{CaseId, Kind, Sweep, sweep_schema};
use serde_json::{Value, json};

/// As if the file stood among the scenarios.
const FILE: &str = "../../scenarios/sweep.json";

fn sweep_of(vary: Value) -> Value {
    json!({ "name": "test", "scenario": "slew_2dof.json", "vary": vary })
}

fn parse(sweep: &Value) -> Sweep {
    Sweep::parse(&sweep.to_string(), Path::new(FILE)).unwrap_or_else(|error| panic!("{error}"))
}

fn complaint(sweep: &Value) -> String {
    let error = Sweep::parse(&sweep.to_string(), Path::new(FILE)).expect_err("a complaint");
    let text = error.to_string();
    assert!(!text.contains('\n'), "{text}");
    text.strip_prefix(&format!("{FILE}: ")).unwrap_or(&text).to_owned()
}

fn ids(sweep: &Sweep) -> Vec<CaseId> {
    (0..sweep.len()).map(|index| sweep.case(index).id).collect()
}

fn angles(values: Value) -> Value {
    json!({ "field": "maneuver.angle_deg", "values": values })
}

#[test]
fn dimensions_are_crossed_and_the_last_is_fastest() {
    let sweep = parse(&sweep_of(json!([
        { "field": "horizon.duration_s", "name": "t_f", "grid": { "from": 60, "to": 120, "count": 3 } },
        angles(json!([5, 10])),
    ])));
    let values: Vec<Vec<Value>> = (0..sweep.len()).map(|index| sweep.case(index).values).collect();
    let expected =
        [[60.0, 5.0], [60.0, 10.0], [90.0, 5.0], [90.0, 10.0], [120.0, 5.0], [120.0, 10.0]];
    let found: Vec<[f64; 2]> =
        values.iter().map(|row| [0, 1].map(|i| row[i].as_f64().unwrap())).collect();
    assert_eq!(found, expected);
    assert_eq!(sweep.columns()[0].name, "t_f");
    let scenario = sweep.scenario(&sweep.case(3));
    assert_eq!(scenario["horizon"]["duration_s"], 90.0);
    assert_eq!(scenario["maneuver"]["angle_deg"], 10);
    assert_eq!(scenario["maneuver"]["axis"], json!([0.74, 0.02, 0.68]));
}

#[test]
fn zipped_fields_change_together_and_factors_change_what_the_base_has() {
    let sweep = parse(&sweep_of(json!([{ "zip": [
        angles(json!([5, 10, 15])),
        { "field": "system.links[*].mass_kg", "name": "factor", "relative": true, "values": [1, 2, 3] },
    ] }])));
    assert_eq!(sweep.len(), 3);
    let scenario = sweep.scenario(&sweep.case(2));
    assert_eq!(scenario["maneuver"]["angle_deg"], 15);
    assert_eq!(scenario["system"]["links"][0]["mass_kg"], 0.0);
    assert_eq!(scenario["system"]["links"][1]["mass_kg"], 75.0);
}

#[test]
fn axes_are_unit_vectors_and_draws_are_the_same_every_time() {
    let vary = json!([
        { "field": "maneuver.axis", "directions": { "count": 4, "seed": 3 } },
        { "field": "system.base.mass_kg", "relative": true,
          "uniform": { "low": 0.9, "high": 1.1, "count": 5, "seed": 1 } },
    ]);
    let sweep = parse(&sweep_of(vary.clone()));
    for index in 0..sweep.len() {
        let case = sweep.case(index);
        let axis: Vec<f64> =
            case.values[0].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        assert!((axis.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
        let mass = sweep.scenario(&case)["system"]["base"]["mass_kg"].as_f64().unwrap();
        assert!((270.0..=330.0).contains(&mass), "{mass}");
    }
    assert_eq!(ids(&parse(&sweep_of(vary))), ids(&sweep));
}

#[test]
fn a_case_keeps_its_id_when_the_sweep_grows_or_is_written_another_way() {
    let axis = json!({ "field": "maneuver.axis", "values": [[1, 0, 0], [0, 1, 0]] });
    let first = parse(&sweep_of(json!([axis, angles(json!([5, 10]))])));
    let second = parse(&sweep_of(json!([angles(json!([20, 10, 5])), axis])));
    let (first, second): (HashSet<_>, HashSet<_>) =
        (ids(&first).into_iter().collect(), ids(&second).into_iter().collect());
    assert_eq!((first.len(), second.len()), (4, 6));
    assert!(first.is_subset(&second));

    let mut other = sweep_of(json!([axis, angles(json!([5, 10]))]));
    other["scenario"] = json!("slew_2dof_full.json");
    assert!(ids(&parse(&other)).iter().all(|id| !first.contains(id)));
    let mut flown = sweep_of(json!([axis, angles(json!([5, 10]))]));
    flown["evaluation"] = json!("open_loop");
    assert!(ids(&parse(&flown)).iter().all(|id| !first.contains(id)));
}

/// Arms of different numbers of joints, each with its start.
fn three_arms() -> Value {
    json!({ "zip": [
        { "field": "system", "values": ["systems/single_link_2dof.json", "systems/xlink_4dof.json",
                                        "systems/xlink_4dof_solar_arrays.json"] },
        { "field": "initial.joint_angles_deg", "values": [[0, 0], [0, 0, 0, 0], [0, 0, 0, 0]] },
    ] })
}

#[test]
fn arms_of_other_numbers_of_joints_keep_the_defaults_that_fit_them() {
    let sweep = parse(&sweep_of(json!([three_arms(), angles(json!([5, 10]))])));
    assert_eq!(sweep.columns()[0].kind, Kind::Named);
    for (index, joints) in [2, 2, 4, 4, 4, 4].into_iter().enumerate() {
        let scenario = sweep.scenario(&sweep.case(index));
        let checked = Scenario::parse(&scenario.to_string(), Path::new("case")).unwrap();
        assert_eq!(checked.system().joint_count(), joints);
        // No path is left in a case: a shard runs on machines that have no other file.
        assert!(scenario["system"]["base"]["mass_kg"].is_number());
    }
    let planned = sweep_of(json!([three_arms()]));
    let again = json!(parse(&planned).resolved());
    let moved = Sweep::parse(&again.to_string(), Path::new("elsewhere/sweep.json")).unwrap();
    assert_eq!(ids(&moved), ids(&parse(&planned)));
}

#[test]
fn the_id_of_a_case_follows_what_is_in_a_system_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sweep.json");
    let arm = folder.path().join("arm.json");
    let scenario = Scenario::read(Path::new("../../scenarios/slew_2dof.json")).unwrap();
    let sweep = json!({ "name": "test", "scenario": scenario.resolved(),
                        "vary": [{ "field": "system", "values": ["arm.json"] }] });
    let of_mass = |mass_kg: f64| {
        let mut system = scenario.resolved_system().clone();
        system.base.mass_kg = mass_kg;
        std::fs::write(&arm, json!(system).to_string()).unwrap();
        Sweep::parse(&sweep.to_string(), &file).unwrap().case(0).id
    };
    assert_ne!(of_mass(300.0), of_mass(310.0));
    assert_eq!(of_mass(300.0), of_mass(300.0));
}

#[test]
fn a_part_of_what_the_base_leaves_to_its_default_can_vary() {
    let vary = json!([
        { "field": "collision.clearance_m", "relative": true, "values": [1, 2] },
        { "field": "initial.joint_rates_deg_s[1]", "values": [0] },
        { "field": "solver.guess.starts", "values": [4] },
    ]);
    let mut sweep = sweep_of(vary);
    let base = std::fs::read_to_string("../../scenarios/sweeps/reach_2dof.json").unwrap();
    sweep["scenario"] = serde_json::from_str::<Value>(&base).unwrap()["scenario"].clone();
    sweep["scenario"]["system"] = json!("systems/single_link_2dof.json");
    let sweep = parse(&sweep);
    let scenario = sweep.scenario(&sweep.case(1));
    assert_eq!(scenario["collision"]["clearance_m"], 0.02);
    assert_eq!(scenario["initial"]["joint_rates_deg_s"], json!([0.0, 0]));
    assert_eq!(scenario["solver"], json!({ "guess": { "starts": 4 } }));
}

#[test]
fn whatever_is_wrong_the_complaint_names_the_field() {
    let vary = |dimension: Value| sweep_of(json!([dimension]));
    let mut no_scenario = sweep_of(json!([angles(json!([5]))]));
    no_scenario["scenario"] = json!("absent.json");
    let mut unknown = sweep_of(json!([angles(json!([5]))]));
    unknown["jobs"] = json!(3);
    let mut slow = sweep_of(json!([angles(json!([5]))]));
    slow["case_time_limit_s"] = json!(0);
    for (sweep, start, part) in [
        (sweep_of(json!([])), "vary: ", "at least one field"),
        (no_scenario, "scenario: ", "no such file"),
        (unknown, "jobs: ", "unknown field"),
        (slow, "case_time_limit_s: found 0, expected", "above 0"),
        (vary(json!({ "values": [1] })), "vary[0].field: missing", "path"),
        (
            vary(json!({ "field": "maneuver.angle_deg" })),
            "vary[0]: found none, expected",
            "one of `values`",
        ),
        (vary(angles(json!([]))), "vary[0].values: found 0 values, expected", "1 to"),
        (vary(angles(json!([5, 5]))), "vary[0].values[1]: found 5 again, expected", "once"),
        (
            vary(angles(json!(["x"]))),
            "vary[0]: ",
            "maneuver.angle_deg of the first case: found \"x\", expected a number",
        ),
        (vary(angles(json!([500]))), "vary[0]: ", "from -180 to 180"),
        (
            vary(json!({ "field": "maneuver.angel_deg", "values": [1] })),
            "vary[0]: ",
            "did you mean `angle_deg`",
        ),
        (
            vary(json!({ "field": "system.links[7].mass_kg", "values": [1] })),
            "vary[0].field: ",
            "no element 7 of 2",
        ),
        (
            vary(json!({ "field": "a..b", "values": [1] })),
            "vary[0].field: found \"a..b\"",
            "JSON path",
        ),
        (
            vary(json!({ "field": "name", "relative": true, "values": [1] })),
            "vary[0].field: ",
            "no factor",
        ),
        (
            vary(json!({ "field": "maneuver.angle_deg", "values": [1], "fibonacci": 3 })),
            "vary[0]: found `values` and `fibonacci`, expected",
            "one of",
        ),
        (
            vary(
                json!({ "field": "maneuver.angle_deg", "grid": { "from": 1, "to": 1, "count": 2 } }),
            ),
            "vary[0].grid.count: found 2, expected",
            "same",
        ),
        (
            vary(json!({ "field": "maneuver.angle_deg",
                         "uniform": { "low": 2, "high": 1, "count": 2 } })),
            "vary[0].uniform.high: found 1, expected",
            "above 2",
        ),
        (vary(json!({ "zip": [] })), "vary[0].zip: ", "at least one"),
        (
            vary(json!({ "zip": [angles(json!([1, 2])), { "field": "name", "values": ["a"] }] })),
            "vary[0].zip[1]: found 1, expected",
            "2 settings, as the first has",
        ),
        (
            sweep_of(json!([angles(json!([1])), angles(json!([2]))])),
            "vary[1]: found \"maneuver.angle_deg\" again, expected",
            "once",
        ),
        (
            vary(json!({ "zip": [
                angles(json!([5, 10, 5])),
                { "field": "horizon.duration_s", "values": [30, 30, 30] },
            ] })),
            "vary[0].zip: found settings 3 the same as settings 1, expected",
            "each combination once",
        ),
        (
            vary(
                json!({ "field": "system", "values": ["systems/single_link_2dof.json", "systems/xlink_4dof.json"] }),
            ),
            "vary[0]: initial.joint_angles_deg of case 2: found an array of 2, expected",
            "an array of 4, one a joint",
        ),
        (
            vary(json!({ "field": "system", "values": ["absent.json"] })),
            "vary[0].values[0]: found \"absent.json\", expected",
            "no such file",
        ),
        (
            vary(json!({ "field": "system", "values": ["arm.urdf"] })),
            "vary[0].values[0]: found \"arm.urdf\", expected",
            "`righting import`",
        ),
        (
            vary(json!({ "field": "maneuver.angle_deg", "name": "status", "values": [1] })),
            "vary[0]: found \"status\", expected",
            "no other column",
        ),
        (
            sweep_of(json!([
                { "field": "maneuver.angle_deg", "grid": { "from": 0, "to": 1, "count": 100000 } },
                { "field": "horizon.duration_s", "grid": { "from": 1, "to": 2, "count": 100000 } },
            ])),
            "vary: found 100000 × 100000 cases, expected",
            "at most",
        ),
    ] {
        let text = complaint(&sweep);
        assert!(text.starts_with(start) && text.contains(part), "{text}");
    }
}

#[test]
fn the_schema_has_every_field() {
    let schema = sweep_schema();
    for field in ["name", "scenario", "vary", "evaluation", "case_time_limit_s"] {
        assert!(schema["properties"].get(field).is_some(), "{field}");
    }
    assert_eq!(schema["additionalProperties"], false);
}
