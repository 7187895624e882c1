//! Plans flown with spacecraft that are not as planned.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::Stdio;

use nalgebra::{DMatrix, DVector};
use righting_flight::Plant;
use righting_multibody::Quaternion;
use righting_results::Trajectory;
use righting_scenario::file;
use righting_verifier::model::State;
use serde_json::{Value, json};

use crate::program::{
    Run, command, files_in, folder_with, righting, small_detumble, small_slew, solve,
};

fn fly(folder: &Path, arguments: &[&str]) -> Run {
    righting(folder, &[&["fly", "scenario.json", "--out", "flown"], arguments].concat())
}

#[test]
fn flights_are_a_table_a_summary_a_figure_and_a_page() {
    let folder = folder_with(&small_slew());
    let run = fly(folder.path(), &["--flights", "5", "--period", "2", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let found = run.json();
    assert_eq!(found["schema"], "righting.fly/1");
    assert_eq!((&found["flights"], &found["completed"]), (&json!(5), &json!(5)));
    let median = |of: &Value| of["final_error_deg"]["median"].as_f64().expect("a number");
    assert!(median(&found) < 0.5 * median(&found["open_loop"]));
    assert!(found["replan_ms"]["median"].as_f64().expect("a number") > 0.0);
    let flown = folder.path().join("flown");
    let files =
        ["flight.csv", "flight_momentum.svg", "flights.csv", "flights.svg", "fly.html", "fly.json"];
    assert_eq!(files_in(&flown), files);
    let written = std::fs::read_to_string(flown.join("fly.json")).expect("written");
    assert_eq!(written, run.stdout);
    let table = std::fs::read_to_string(flown.join("flights.csv")).expect("written");
    assert_eq!(table.lines().count(), 6);
    assert!(table.lines().skip(1).all(|row| row.split(',').count() == 10 && row.ends_with(",0")));
    // The first flight's motion is that of the table's first row.
    let motion = read(&flown.join("flight.csv"));
    let target = Quaternion::from_axis_angle(&nalgebra::Vector3::x(), 2f64.to_radians());
    let missed = Quaternion::from_array(motion.end().attitude).angle_to(&target).to_degrees();
    let cell = table.lines().nth(1).and_then(|row| row.split(',').nth(1)).expect("a cell");
    assert!((missed - cell.parse::<f64>().expect("a number")).abs() < 1e-9);
    let page = std::fs::read_to_string(flown.join("fly.html")).expect("written");
    for name in ["planned", "open loop", "flown"] {
        assert!(page.contains(&format!("\"{name}\"")), "{name}");
    }
}

fn read(file: &Path) -> Trajectory {
    Trajectory::read_csv(file).expect("a motion")
}

#[test]
fn what_cannot_be_flown_is_named() {
    let folder = folder_with(&small_slew());
    let refused = |arguments: &[&str], part: &str| {
        let run = fly(folder.path(), arguments);
        assert_eq!(run.code, 2, "{}", run.stderr);
        assert!(run.stderr.contains(part), "no \"{part}\" in: {}", run.stderr);
    };
    refused(&["--stick", "3@5"], "--stick: found joint 3, expected one of joints 1 to 2");
    refused(&["--stick", "0@5"], "expected a joint, counted from 1, and a time, such as 2@10");
    refused(&["--period", "0"], "expected a number of seconds above 0");
    refused(&["--lost-percent", "120"], "expected a number from 0, below 100");
    refused(&["--delay-s", "nan"], "expected a number from 0");
    refused(&["--plant", "stdio", "--stick", "1@2"], "leave out --joint-lag-s");
    refused(
        &["--plant", "stdio", "--flights", "3"],
        "--plant stdio is one flight: leave out --flights",
    );
    let detumble = folder_with(&small_detumble());
    fly(detumble.path(), &["--mode", "both"])
        .assert_refused("feedback is for slews, this is a detumble");
}

/// A plan of the small slew, and its folder.
fn planned() -> (tempfile::TempDir, Trajectory) {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let plan = read(&folder.path().join("out/trajectory.csv"));
    (folder, plan)
}

/// A plant whose second link weighs more than `system` says.
fn heavier(mut system: file::System, plan: &Trajectory) -> Plant {
    system.links[1].mass_kg *= 1.1;
    Plant::new(&system, None, &State::of_node(plan.start()))
}

#[test]
fn another_program_can_be_the_spacecraft() {
    let (folder, plan) = planned();
    let mut child = command(folder.path())
        .args(["fly", "out", "--out", "flown", "--plant", "stdio", "--period", "2"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut answers = child.stdin.take().expect("piped");
    let mut lines = BufReader::new(child.stdout.take().expect("piped")).lines();
    let mut heard = || -> Option<Value> {
        let line = lines.next()?.expect("a line");
        Some(serde_json::from_str(&line).expect("JSON"))
    };
    let opening = heard().expect("an opening");
    assert_eq!(opening["start"]["joint_rates_rad_s"], json!([0.0, 0.0]));
    let system = serde_json::from_value(opening["system"].clone()).expect("a system");
    let mut plant = heavier(system, &plan);
    let mut commands = 0;
    while let Some(told) = heard() {
        assert_eq!(told["step"], commands);
        let accelerations: Vec<f64> =
            serde_json::from_value(told["joint_accelerations_rad_s2"].clone()).expect("numbers");
        plant.advance(&accelerations, told["duration_s"].as_f64().expect("a number"));
        let state = plant.state();
        let answer = json!({
            "attitude": state.attitude_wxyz(),
            "joint_angles_rad": state.joint_angles,
            "joint_rates_rad_s": state.joint_rates,
            "angular_rate_rad_s": state.angular_rate.as_slice(),
        });
        writeln!(answers, "{answer}").expect("heard");
        commands += 1;
    }
    let run = Run::from(child.wait_with_output().expect("it ends"));
    assert_eq!((run.code, commands), (0, 40), "{}", run.stderr);
    assert!(run.stderr.contains("1 flights, 1 completed, 0 replans missed"), "{}", run.stderr);
    let written = std::fs::read_to_string(folder.path().join("flown/fly.json")).expect("written");
    let written: Value = serde_json::from_str(&written).expect("JSON");
    let error_deg = written["final_error_deg"]["max"].as_f64().expect("a number");
    let target = Quaternion::from_axis_angle(&nalgebra::Vector3::x(), 2f64.to_radians());
    let reached = Quaternion::from_array(plant.state().attitude_wxyz()).angle_to(&target);
    assert!((error_deg - reached.to_degrees()).abs() < 1e-9);
    assert!(error_deg < 0.01 && written["open_loop"]["final_error_deg"]["max"].is_null());
}

/// A flight computer that knows nothing but the table of gains.
#[test]
fn exported_gains_correct_a_flight() {
    let (folder, plan) = planned();
    for (out, name) in [("gains.csv", "out/gains.csv"), ("gains.npz", "out/gains.npz")] {
        let arguments = ["export", "out", "--format", "gains", "--out", name];
        let run = righting(folder.path(), &arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{out}");
    }
    let table = std::fs::read_to_string(folder.path().join("out/gains.csv")).expect("written");
    let mut lines = table.lines();
    let head = lines.next().expect("a head");
    assert!(head.starts_with(
        "t_s,qw,qx,qy,qz,q1_rad,q2_rad,dq1_rad_s,dq2_rad_s,u1_rad_s2,u2_rad_s2,k1_phi_x"
    ));
    assert!(head.ends_with("k2_q1,k2_q2,k2_dq1,k2_dq2"));
    let rows: Vec<Vec<f64>> = lines
        .map(|row| row.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    assert_eq!(rows.len(), plan.steps());
    let solution =
        std::fs::read_to_string(folder.path().join("out/solution.json")).expect("written");
    let solution: Value = serde_json::from_str(&solution).expect("JSON");
    let system: file::System =
        serde_json::from_value(solution["scenario"]["system"].clone()).expect("a system");
    let missed = |corrects: bool| {
        let mut plant = heavier(system.clone(), &plan);
        for row in &rows {
            let state = plant.state();
            let planned = Quaternion::new(row[1], row[2], row[3], row[4]);
            let [w, x, y, z] = planned
                .conjugate()
                .product(&Quaternion::from_array(state.attitude_wxyz()))
                .to_array();
            let joints = state.joint_angles.iter().chain(state.joint_rates).zip(&row[5..9]);
            let turned = [x, y, z].map(|part| 2.0 * w.signum() * part);
            let off = turned.into_iter().chain(joints.map(|(is, planned)| is - planned));
            let gains = DMatrix::from_row_slice(2, 7, &row[11..25]);
            let correction = gains * DVector::from_iterator(7, off);
            let told: Vec<f64> = match corrects {
                true => row[9..11].iter().zip(&correction).map(|(u, by)| u - by).collect(),
                false => row[9..11].to_vec(),
            };
            plant.advance(&told, 0.5);
        }
        let target = Quaternion::from_axis_angle(&nalgebra::Vector3::x(), 2f64.to_radians());
        Quaternion::from_array(plant.state().attitude_wxyz()).angle_to(&target).to_degrees()
    };
    let (corrected, open_loop) = (missed(true), missed(false));
    assert!(open_loop > 0.05 && corrected < 0.2 * open_loop, "{corrected}° of {open_loop}°");
}
