//! Every shipped maneuver through the program, against an independent solution of the same problem.

use std::path::PathBuf;

use serde_json::Value;

use crate::program::{righting, root};

/// How much worse than the reference an objective may be, relative.
const OBJECTIVE_TOLERANCE: f64 = 1e-3;

/// Objectives of CasADi 3.8.2 with Ipopt from the constant guess, N = 600; in the full form, but for
/// the last one, which is the reduced form's.
const REFERENCES: [(&str, f64); 8] = [
    ("slew_2dof", 7.9374e-4),
    ("slew_4dof", 9.0685e-4),
    ("slew_canadarm2_table", 1.5277e-3),
    ("slew_canadarm2", 5.8941e-3),
    ("detumble_2dof", 3.6791),
    ("detumble_4dof", 4.7111),
    ("detumble_canadarm2_table", 5.8799),
    ("detumble_canadarm2", 10.6183),
];

/// Solves a shipped scenario; what it printed.
fn solve(name: &str) -> Value {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenario: PathBuf = root().join("scenarios").join(name).with_extension("json");
    let arguments = [
        "solve".as_ref(),
        scenario.as_os_str(),
        "--out".as_ref(),
        "out".as_ref(),
        "--json".as_ref(),
    ];
    let run = righting(folder.path(), &arguments);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{name}");
    let solution = run.json();
    assert_eq!(solution["status"], "solved", "{name}");
    assert_eq!(solution["verification"]["passed"], true, "{name}");
    assert_eq!(solution["scenario"]["name"], scenario.file_stem().unwrap().to_str().unwrap());
    solution
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// Both forms of a maneuver reach what is asked, at an objective no worse than the reference's.
fn check(name: &str) {
    let (_, reference) = REFERENCES.iter().find(|(known, _)| *known == name).expect("a reference");
    for form in [name.to_owned(), format!("{name}_full")] {
        let solution = solve(&form);
        let objective = number(&solution["objective"]);
        assert!(objective <= reference * (1.0 + OBJECTIVE_TOLERANCE), "{form}: {objective}");
        let terminal = &solution["terminal"];
        assert!(number(&terminal["joint_rate_deg_s"]) < 1.0, "{form}: {terminal}");
        if name.starts_with("slew") {
            assert!(number(&terminal["attitude_error"]) <= 1e-3, "{form}: {terminal}");
            assert!(number(&terminal["angular_rate_deg_s"]) < 0.1, "{form}: {terminal}");
        } else {
            assert!(number(&solution["reduction_percent"]) > 7.0, "{form}: {terminal}");
            assert!(number(&solution["bound_deg_s"]) > 0.0, "{form}");
        }
    }
}

/// Plans every scenario of a folder.
fn plan_all_of(name: &str) {
    let folder = root().join("scenarios").join(name);
    let mut planned = 0;
    for entry in folder.read_dir().unwrap() {
        let file = entry.unwrap().path();
        solve(&format!("{name}/{}", file.file_stem().unwrap().to_str().unwrap()));
        planned += 1;
    }
    assert!(planned >= 2, "{planned}");
}

/// Maneuvers with the limits that real arms and missions have.
#[test]
fn every_real_maneuver_is_planned_and_verified() {
    plan_all_of("real");
}

/// Maneuvers of arm and wheels together.
#[test]
fn every_maneuver_with_wheels_is_planned_and_verified() {
    plan_all_of("wheels");
}

#[test]
fn every_limit_along_the_way_is_listed_with_its_worst_place() {
    let solution = solve("real/slew_canadarm2_limits");
    let limits = solution["limits"].as_array().unwrap();
    let of = |name: &str, subject: &str| {
        let found = limits.iter().find(|l| l["name"] == name && l["subject"] == subject);
        found.unwrap_or_else(|| panic!("no {name} of {subject}"))
    };
    let torque = of("joint torque", "joint 1");
    assert_eq!((number(&torque["bound"]), &torque["unit"]), (2332.0, &Value::from("N m")));
    assert!(number(&torque["value"]) > 0.0 && number(&torque["value"]) < 2332.0);
    let angle = of("joint angle between nodes", "joint 3");
    assert!((number(&angle["value"]) - number(&angle["bound"])).abs() < 1e-3);
    assert!((0.0..=60.0).contains(&number(&angle["time_s"])));
    // Checks of the model and of the end are no limits.
    assert!(limits.len() < solution["verification"]["checks"].as_array().unwrap().len());
    assert!(limits.iter().all(|limit| limit["name"] != "attitude error at the end"));
}

#[test]
fn slew_2dof() {
    check("slew_2dof");
}

#[test]
fn slew_4dof() {
    check("slew_4dof");
}

#[test]
fn slew_canadarm2_table() {
    check("slew_canadarm2_table");
}

#[test]
fn slew_canadarm2() {
    check("slew_canadarm2");
}

#[test]
fn detumble_2dof() {
    check("detumble_2dof");
}

#[test]
fn detumble_4dof() {
    check("detumble_4dof");
}

#[test]
fn detumble_canadarm2_table() {
    check("detumble_canadarm2_table");
}

#[test]
fn detumble_canadarm2() {
    check("detumble_canadarm2");
}

#[test]
fn the_slew_of_the_paper_s_title_figure() {
    let solution = solve("slew75_4dof");
    assert!(number(&solution["terminal"]["attitude_error"]) <= 1e-3);
    assert_eq!(number(&solution["scenario"]["maneuver"]["angle_deg"]), 75.0);
}
