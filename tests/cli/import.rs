//! `righting import`, and scenarios whose system is a URDF file.

use std::fs;

use serde_json::{Value, json};

use crate::program::{righting, root};

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let urdf = root().join("crates/import/tests/data/gripper.urdf");
    fs::copy(urdf, folder.path().join("gripper.urdf")).unwrap();
    folder
}

const LOCKED: [&str; 10] = [
    "import",
    "gripper.urdf",
    "--base",
    "bus",
    "--lock",
    "left=0.02",
    "--acceleration-max-deg-s2",
    "20",
    "--out",
    "system.json",
];

#[test]
fn a_robot_becomes_a_system() {
    let folder = folder();
    let run = righting(folder.path(), &LOCKED);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(run.stdout, "system.json\n");
    for said in [
        "joint \"left\": held at 0.02 m, as asked; 0.2 kg beyond it move with \"arm\"",
        "joint \"right\": held at 0.02 m, since it mimics another joint",
        "gripper.urdf: without <inertial>, taken without mass: \"sensor\"",
    ] {
        assert!(run.stderr.contains(said), "{}", run.stderr);
    }
    let text = fs::read_to_string(folder.path().join("system.json")).unwrap();
    let system: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(system["bodies"][0]["mass_kg"], json!(6.4));
    // Matrices stand in one line each.
    assert!(text.lines().count() < 50, "{text}");

    let mut scenario = json!({
        "name": "slew", "system": "system.json",
        "initial": { "joint_angles_deg": [0.0] },
        "maneuver": { "type": "slew", "axis": [0.0, 0.0, 1.0], "angle_deg": 5.0 },
        "horizon": { "duration_s": 30.0, "steps": 30 },
    });
    fs::write(folder.path().join("by_file.json"), scenario.to_string()).unwrap();
    scenario["system"] = json!("gripper.urdf");
    scenario["system_options"] =
        json!({ "base": "bus", "locked": { "left": 0.02 }, "acceleration_max_deg_s2": 20 });
    fs::write(folder.path().join("direct.json"), scenario.to_string()).unwrap();
    let explained = ["by_file.json", "direct.json"].map(|file| {
        let run = righting(folder.path(), &["explain", file, "--json"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        run.json()
    });
    let inertia = &explained[0]["inertia"];
    assert!(inertia["largest_kg_m2"].as_f64().unwrap() > 13.0, "{inertia}");
    assert_eq!(inertia, &explained[1]["inertia"]);
}

#[test]
fn wrong_robots_and_options_are_bad_input() {
    let folder = folder();
    let bad = |arguments: &[&str], part: &str| {
        let run = righting(folder.path(), arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
        assert!(!folder.path().join("system.json").exists());
    };
    let without = |name: &str| -> Vec<&str> {
        let at = LOCKED.iter().position(|argument| *argument == name).unwrap();
        LOCKED
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != at && *k != at + 1)
            .map(|(_, a)| *a)
            .collect()
    };
    bad(&without("--base"), "<--base <LINK>|--on <FILE>>");
    bad(&without("--acceleration-max-deg-s2"), "acceleration_max_deg_s2: missing");
    bad(&without("--lock"), "acceleration_max_m_s2: missing");
    bad(&[&LOCKED[..], &["--tip", "hand"]].concat(), "tip: found \"hand\"");
    bad(&[&LOCKED[..], &["--lock", "shoulder"]].concat(), "expected JOINT=VALUE");
    bad(&[&LOCKED[..], &["--mount-xyz", "0", "0", "1"]].concat(), "found a mount without `on`");
    fs::write(folder.path().join("base.json"), "{\"links\": []}").unwrap();
    let mut mounted = without("--base");
    mounted.extend(["--on", "base.json"]);
    bad(&mounted, "base.json: found a system file, expected a file with a base");
    fs::write(folder.path().join("gripper.urdf"), "<robot><link></robot>").unwrap();
    bad(&LOCKED, "gripper.urdf: line 1, column");
}

#[test]
fn a_robot_is_mounted_on_a_base() {
    let folder = folder();
    let base = json!({ "name": "servicer", "mass_kg": 150.0, "cube_side_m": 0.9 });
    fs::write(folder.path().join("base.json"), base.to_string()).unwrap();
    let run = righting(
        folder.path(),
        &[
            "import",
            "gripper.urdf",
            "--on",
            "base.json",
            "--mount-xyz",
            "0",
            "0",
            "-0.75",
            "--mount-rpy",
            "180",
            "0",
            "0",
            "--tip",
            "sensor",
            "--acceleration-max-deg-s2",
            "20",
            "--out",
            "system.json",
        ],
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    let text = fs::read_to_string(folder.path().join("system.json")).unwrap();
    let system: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(system["base"]["mass_kg"], json!(250.0));
    assert_eq!(system["bodies"][0]["parent"], json!("servicer"));
    // The shoulder stands 0.3 m out of the robot's bus, which hangs upside down.
    assert_eq!(system["bodies"][0]["joint"]["position_m"], json!([0.0, 0.0, -1.05]));
}
