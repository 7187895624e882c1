//! A file of one kind where another is expected is recognised, and the hint works.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::program::{Run, folder_with, righting, small_slew};

/// `arm.json`, `scenario.json`, `sweep.json` and `wheels.json`, each a good file.
fn folder() -> tempfile::TempDir {
    let folder = folder_with(&small_slew());
    let at = folder.path();
    write(at, "arm.json", &small_slew()["system"]);
    let vary = json!([{ "field": "maneuver.angle_deg", "values": [1, 2] }]);
    write(at, "sweep.json", &json!({ "name": "two", "scenario": "scenario.json", "vary": vary }));
    let wheel = json!({ "axis": [0, 0, 1], "momentum_max_n_m_s": 1, "torque_max_n_m": 0.1 });
    write(at, "wheels.json", &json!({ "wheels": [wheel] }));
    folder
}

fn write(folder: &Path, name: &str, value: &Value) {
    fs::write(folder.join(name), value.to_string()).expect("writable");
}

fn run(folder: &Path, line: &str) -> Run {
    righting(folder, &line.split(' ').collect::<Vec<_>>())
}

fn assert_said(run: &Run, message: &str, hint: Option<&str>) {
    let hint = hint.map(|hint| format!("  hint: {hint}\n")).unwrap_or_default();
    assert_eq!((run.code, run.stderr.as_str()), (2, &*format!("error: {message}\n{hint}")));
    assert_eq!(run.stdout, "");
}

#[test]
fn a_file_of_another_kind_is_recognised() {
    let folder = folder();
    let at = folder.path();
    let name_it = Some("name it in the field `system` of a scenario");
    let sweep_it = Some("`righting sweep` runs it");
    let give_it = Some("`righting envelope` and `righting power` take it with --wheels");
    let solve_it = Some("`righting solve` plans it; a sweep names it in its field `scenario`");
    for (line, message, hint) in [
        (
            "solve arm.json --out o",
            "arm.json: found a system file, expected a scenario file",
            name_it,
        ),
        ("reach arm.json", "arm.json: found a system file, expected a scenario file", name_it),
        (
            "solve sweep.json --out o",
            "sweep.json: found a sweep file, expected a scenario file",
            sweep_it,
        ),
        (
            "solve wheels.json --out o",
            "wheels.json: found a file of wheels, expected a scenario file",
            give_it,
        ),
        (
            "sweep scenario.json --out o",
            "scenario.json: found a scenario file, expected a sweep file",
            solve_it,
        ),
        (
            "sweep plan arm.json --out o",
            "arm.json: found a system file, expected a sweep file",
            None,
        ),
        (
            "envelope sweep.json --out o",
            "sweep.json: found a sweep file, expected a system or scenario file",
            sweep_it,
        ),
        (
            "envelope arm.json --out o --wheels scenario.json",
            "scenario.json: found a scenario file, expected a file of wheels",
            None,
        ),
    ] {
        assert_said(&run(at, line), message, hint);
        assert!(!at.join("o").exists(), "{line}");
    }
}

#[test]
fn a_scenario_that_names_another_kind_as_its_system_is_told_which() {
    let folder = folder();
    let mut scenario = small_slew();
    scenario["system"] = json!("sweep.json");
    write(folder.path(), "scenario.json", &scenario);
    let message = "sweep.json: found a sweep file, expected a system file";
    assert_said(
        &run(folder.path(), "solve scenario.json --out o"),
        message,
        Some("`righting sweep` runs it"),
    );
    scenario["system"] = json!("other.json");
    write(folder.path(), "scenario.json", &scenario);
    write(folder.path(), "other.json", &small_slew());
    let message = "other.json: found a scenario file, expected a system file";
    let hint = "the `system` of a scenario is a system file, or the system itself";
    assert_said(&run(folder.path(), "solve scenario.json --out o"), message, Some(hint));
}

/// What the hints say, done.
#[test]
fn the_hints_lead_on() {
    let folder = folder();
    let at = folder.path();
    let mut scenario = small_slew();
    scenario["system"] = json!("arm.json");
    write(at, "by_name.json", &scenario);
    for line in [
        "solve by_name.json --out plan",
        "sweep sweep.json --out swept",
        "envelope arm.json --out envelope --samples 10 --wheels wheels.json",
        "power plan --wheels wheels.json",
    ] {
        let run = run(at, line);
        assert_eq!(run.code, 0, "{line}: {}", run.stderr);
    }

    let message = "plan/solution.json: found a solution file, expected a scenario file";
    let hint = "its field `scenario` is the scenario that was solved";
    assert_said(&run(at, "solve plan/solution.json --out again"), message, Some(hint));
    let solution = fs::read_to_string(at.join("plan/solution.json")).expect("readable");
    let solution: Value = serde_json::from_str(&solution).expect("JSON");
    write(at, "again.json", &solution["scenario"]);
    assert_eq!(run(at, "solve again.json --out again").code, 0);

    let message = "swept/sweep.json: found a planned sweep, expected a sweep file";
    let hint = "`righting sweep run` works on the folder it is in";
    assert_said(&run(at, "sweep swept/sweep.json --out again"), message, Some(hint));
    assert_eq!(run(at, "sweep run swept").code, 0);
}

#[test]
fn a_file_where_a_folder_is_expected_is_said_to_be_one() {
    let folder = folder();
    let at = folder.path();
    for command in ["verify", "report", "power", "figures"] {
        let message = "scenario.json: found a file, expected the folder of a plan";
        assert_said(&run(at, &format!("{command} scenario.json")), message, None);
    }
    for line in
        ["compare arm.json", "export --format npz", "solve scenario.json --out o --warm-start"]
    {
        let message = "arm.json: found a file, expected the folder of a plan";
        assert_said(&run(at, &format!("{line} arm.json")), message, None);
    }
    for command in ["run", "merge", "show", "slurm --shards 2"] {
        let message = "sweep.json: found a file, expected the folder of a sweep";
        assert_said(&run(at, &format!("sweep {command} sweep.json")), message, None);
    }
    let message = "arm.json: found a file, expected the folder of a library";
    assert_said(&run(at, "solve scenario.json --out o --library arm.json"), message, None);
}

/// Each kind of file has its own format to look at.
#[test]
fn the_hint_about_a_field_names_the_format_of_its_file() {
    let folder = folder();
    let at = folder.path();
    assert_eq!(run(at, "solve scenario.json --out plan").code, 0);
    let damage = |name: &str, pointer: &str| {
        let text = fs::read_to_string(at.join(name)).expect("readable");
        let mut value: Value = serde_json::from_str(&text).expect("JSON");
        *value.pointer_mut(pointer).expect("a field") = json!("x");
        write(at, name, &value);
    };
    damage("scenario.json", "/horizon/steps");
    damage("arm.json", "/links/0/a_m");
    damage("wheels.json", "/wheels/0/axis");
    damage("plan/solution.json", "/status");
    damage("sweep.json", "/vary");
    for (line, schema) in [
        ("solve scenario.json --out o", "schema"),
        ("envelope arm.json --out o", "schema system"),
        ("power plan --wheels wheels.json", "schema wheels"),
        ("verify plan", "schema solution"),
        ("sweep sweep.json --out o", "schema sweep"),
    ] {
        let refused = run(at, line);
        let hint = format!("\n  hint: `righting {schema}` prints the format with every field\n");
        assert!(refused.code == 2 && refused.stderr.ends_with(&hint), "{}", refused.stderr);
        assert_eq!(run(at, schema).code, 0);
    }
}
