//! The arm beside reaction wheels.

use serde_json::{Value, json};

use crate::program::{files_in, folder_with, righting, small_slew};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn an_envelope_has_its_numbers_meshes_and_figure() {
    let folder = folder_with(&small_slew());
    let system = small_slew()["system"].to_string();
    std::fs::write(folder.path().join("system.json"), system).expect("writable");
    let arguments = ["envelope", "scenario.json", "--samples", "300", "--out", "out", "--json"];
    let run = righting(folder.path(), &arguments);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let found = run.json();
    for quantity in ["momentum_n_m_s", "torque_n_m"] {
        let envelope = &found[quantity];
        let largest = number(&envelope["true_max"]);
        assert!(0.0 < number(&envelope["sampled_max"]));
        assert!(number(&envelope["sampled_max"]) <= largest);
        let axis: Vec<f64> =
            envelope["true_max_axis"].as_array().expect("a vector").iter().map(number).collect();
        assert!((axis.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-9);
        let per_axis = envelope["per_axis_max"].as_array().expect("a vector");
        assert!(per_axis.len() == 3 && per_axis.iter().all(|x| number(x) <= largest * 1.000_001));
        assert!(number(&envelope["hull_volume"]) >= 0.0);
    }
    let wheels = &found["wheels"];
    let close = |field: &str, expected: f64| {
        assert!((number(&wheels[field]) - expected).abs() < 1e-9, "{field}: {}", wheels[field]);
    };
    close("momentum_max_n_m_s", 4.0 / 3.0_f64.sqrt());
    close("momentum_min_n_m_s", 4.0 / 6.0_f64.sqrt());
    close("torque_max_n_m", 0.4 / 3.0_f64.sqrt());
    close("torque_min_n_m", 0.4 / 6.0_f64.sqrt());
    let out = folder.path().join("out");
    let written = std::fs::read_to_string(out.join("envelope.json")).expect("written");
    assert_eq!(serde_json::from_str::<Value>(&written).expect("JSON"), found);
    let files = files_in(&out);
    assert_eq!(files.len(), 8, "{files:?}");
    let mesh = std::fs::read_to_string(out.join("momentum_wheels.obj")).expect("written");
    assert_eq!(mesh.lines().filter(|line| line.starts_with("v ")).count(), 14);

    let of_system = ["envelope", "system.json", "--samples", "300", "--out", "again"];
    let run = righting(folder.path(), &of_system);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(run.stdout.contains("arm, true max"), "{}", run.stdout);
    let again =
        std::fs::read_to_string(folder.path().join("again/envelope.json")).expect("written");
    assert_eq!(again, written);
}

#[test]
fn wheels_come_from_a_file_that_is_checked() {
    let folder = folder_with(&small_slew());
    let wheel = json!({ "axis": [0, 0, 2], "momentum_max_n_m_s": 3.0, "torque_max_n_m": 0.5 });
    let run = |wheels: Value| {
        std::fs::write(folder.path().join("wheels.json"), wheels.to_string()).expect("writable");
        let arguments =
            ["envelope", "scenario.json", "--wheels", "wheels.json", "--out", "out", "--json"];
        righting(folder.path(), &arguments)
    };
    let found = run(json!({ "wheels": [wheel] })).json();
    assert_eq!(found["wheels"]["momentum_max_n_m_s"], 3.0);
    assert_eq!(found["wheels"]["momentum_min_n_m_s"], 0.0);
    run(json!({ "wheels": [] }))
        .assert_refused("wheels: found 0 wheels, expected an array of 1 to 16 wheels");
    let mut still = wheel.clone();
    still["axis"] = json!([0, 0, 0]);
    run(json!({ "wheels": [still] }))
        .assert_refused("wheels[0].axis: found [0, 0, 0], expected a vector that is not zero\n");
    let mut weak = wheel.clone();
    weak["torque_max_n_m"] = json!(-1);
    run(json!({ "wheels": [wheel, weak] })).assert_refused(
        "wheels[1].torque_max_n_m: found -1, expected a number above 0 and up to 1000000\n",
    );
}

#[test]
fn bad_input_is_refused_before_anything_is_made() {
    let folder = folder_with(&json!({ "name": "no arm" }));
    let run = |file: &str| righting(folder.path(), &["envelope", file, "--out", "out"]);
    run("scenario.json").assert_refused("scenario.json");
    run("absent.json").assert_refused("no such file");
    assert!(!folder.path().join("out").exists());
    let none = ["envelope", "scenario.json", "--out", "out", "--samples", "0"];
    assert_eq!(righting(folder.path(), &none).code, 2);
}
