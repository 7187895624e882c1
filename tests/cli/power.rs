//! What a plan's motion costs.

use serde_json::{Value, json};

use crate::program::{files_in, folder_with, righting, small_detumble, small_slew, solve};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn power_is_drawn_and_written() {
    for scenario in [small_slew(), small_detumble()] {
        let folder = folder_with(&scenario);
        assert_eq!(solve(folder.path()).code, 0);
        let run = righting(folder.path(), &["power", "out", "--json"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        let found = run.json();
        let variants = &found["variants"];
        let energy = |name: &str| number(&variants[name]["energy_j"]);
        for name in ["signed", "absolute", "without_regeneration", "with_regeneration"] {
            let mean = number(&variants[name]["mean_w"]);
            assert!((mean * number(&found["duration_s"]) - energy(name)).abs() < 1e-9);
            assert!(mean <= number(&variants[name]["peak_w"]));
        }
        assert!(energy("with_regeneration") < energy("without_regeneration"));
        assert!(energy("without_regeneration") < energy("absolute"));
        let (work, change) = (&found["work_j"], &found["kinetic_energy_change_j"]);
        // The paper's formula takes the work for a tenth of the energy.
        assert!((energy("signed") / 10.0 - number(work)).abs() < 1e-12 * energy("absolute"));
        assert!((number(work) - number(change)).abs() < 1e-4 * energy("absolute"));
        assert_eq!(found["wheels"]["steady_power_w"], 20.0);
        assert_eq!(found["wheels"]["energy_j"], 400.0);

        let out = folder.path().join("out");
        let written = std::fs::read_to_string(out.join("power.json")).expect("written");
        assert_eq!(serde_json::from_str::<Value>(&written).expect("JSON"), found);
        let figure = std::fs::read_to_string(out.join("power.svg")).expect("written");
        assert!(figure.contains("Torque [N m]") && figure.contains("Power [W]"));
        // The next solve leaves no power of this plan behind.
        assert_eq!(solve(folder.path()).code, 0);
        assert!(!files_in(&out).contains(&"power.json".to_owned()));
    }
}

#[test]
fn efficiency_wheels_and_folder_are_taken() {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let wheel = json!({ "axis": [0, 0, 1], "momentum_max_n_m_s": 1, "torque_max_n_m": 1 });
    let mut thirsty = wheel.clone();
    thirsty["steady_power_w"] = json!(7.5);
    let wheels = json!({ "wheels": [wheel, thirsty] });
    std::fs::write(folder.path().join("wheels.json"), wheels.to_string()).expect("writable");
    let run = |options: &[&str]| {
        righting(folder.path(), &[&["power", "out", "--json", "--out", "costs"], options].concat())
    };
    let tenth = run(&[]).json();
    let whole = run(&["--efficiency", "1", "--wheels", "wheels.json"]).json();
    let energy = |found: &Value| number(&found["variants"]["absolute"]["energy_j"]);
    assert!((energy(&tenth) / energy(&whole) - 10.0).abs() < 1e-9);
    assert_eq!(whole["wheels"]["steady_power_w"], 12.5);
    assert_eq!(files_in(&folder.path().join("costs")), ["power.json", "power.svg"]);
    for efficiency in ["0", "-0.1", "1.5", "nan", "much"] {
        let refused = run(&[&format!("--efficiency={efficiency}")]);
        assert_eq!(refused.code, 2);
        assert!(refused.stderr.contains("more than 0, at most 1"), "{}", refused.stderr);
    }
    thirsty["steady_power_w"] = json!(-1);
    let wheels = json!({ "wheels": [thirsty] });
    std::fs::write(folder.path().join("wheels.json"), wheels.to_string()).expect("writable");
    run(&["--wheels", "wheels.json"]).assert_refused("wheels[0].steady_power_w");
}

#[test]
fn what_is_no_plan_is_refused() {
    let folder = folder_with(&small_slew());
    let power = || righting(folder.path(), &["power", "out"]);
    power().assert_refused("no such file");
    assert_eq!(solve(folder.path()).code, 0);
    let table = folder.path().join("out/trajectory.csv");
    let text = std::fs::read_to_string(&table).expect("readable");
    let fewer: Vec<&str> = text.lines().collect();
    let joined = [&fewer[..20], &fewer[41..]].concat().join("\n");
    std::fs::write(&table, joined).expect("writable");
    power().assert_refused("steps: found 19, expected 40");
    // One that can be drawn but does not hold is drawn, and said not to hold.
    let changed = text.replacen("0.0000000000000000e0,", "1.0000000000000000e-2,", 2);
    std::fs::write(&table, changed).expect("writable");
    let run = power();
    assert_eq!(run.code, 4, "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("NOT VERIFIED"), "{}", run.stdout);
}
