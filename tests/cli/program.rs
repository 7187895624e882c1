//! Running the program and looking at what it did.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};

/// What a run did.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// Runs the program in `folder`.
pub fn righting<A: AsRef<std::ffi::OsStr>>(folder: &Path, arguments: &[A]) -> Run {
    command(folder).args(arguments).output().map(Run::from).expect("the program starts")
}

/// The program, to be run in `folder`.
pub fn command(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_righting"));
    command.current_dir(folder).stdin(Stdio::null());
    command
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code().expect("the program ends by itself"),
            stdout: String::from_utf8(output.stdout).expect("stdout is UTF-8"),
            stderr: String::from_utf8(output.stderr).expect("stderr is UTF-8"),
        }
    }
}

impl Run {
    /// Refused as bad input: exit code 2 and one message, at one glance, that holds `part`.
    pub fn assert_refused(&self, part: &str) {
        assert_eq!(self.code, 2, "{}", self.stderr);
        assert!(self.stderr.contains(part), "no \"{part}\" in: {}", self.stderr);
        assert!(self.stderr.starts_with("error: "), "{}", self.stderr);
        assert!(self.stderr.lines().count() <= 2, "{}", self.stderr);
        assert!(!self.stderr.contains("panicked"), "{}", self.stderr);
    }

    /// The one JSON object on stdout.
    pub fn json(&self) -> Value {
        let value: Value = serde_json::from_str(&self.stdout).expect("stdout is one JSON value");
        assert!(value.is_object(), "{}", self.stdout);
        value
    }
}

/// A scenario of the 2-joint arm that solves in a moment.
pub fn small_slew() -> Value {
    let link = |mass_kg: f64, a_m: f64, alpha_deg: f64, theta_deg: f64, range_deg: Value| {
        json!({
            "mass_kg": mass_kg, "a_m": a_m, "alpha_deg": alpha_deg, "d_m": 0.0,
            "theta_deg": theta_deg, "angle_min_deg": range_deg[0], "angle_max_deg": range_deg[1],
            "rate_max_deg_s": 17.2, "acceleration_max_deg_s2": 11.5, "body_exempt": true
        })
    };
    json!({
        "name": "small",
        "system": {
            "name": "two_joints",
            "base": { "mass_kg": 300.0, "cube_side_m": 0.5 },
            "mount": { "position_m": [0.0, 0.0, 0.25] },
            "links": [
                link(0.0, 0.0, -90.0, 0.0, json!([null, null])),
                link(25.0, 1.0, 0.0, -90.0, json!([-90.0, 90.0]))
            ]
        },
        "initial": { "joint_angles_deg": [0.0, 30.0] },
        "maneuver": { "type": "slew", "axis": [1.0, 0.0, 0.0], "angle_deg": 2.0 },
        "horizon": { "duration_s": 20.0, "steps": 40 }
    })
}

/// The same with a spin to take out.
pub fn small_detumble() -> Value {
    let mut scenario = small_slew();
    scenario["maneuver"] = json!({ "type": "detumble" });
    scenario["initial"]["angular_rate_deg_s"] = json!([0.0, 0.0, -5.0]);
    scenario
}

/// A folder with `scenario.json`.
pub fn folder_with(scenario: &Value) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("scenario.json"), scenario.to_string()).expect("writable");
    folder
}

/// Solves `scenario.json` of a folder into `out` beneath it.
pub fn solve(folder: &Path) -> Run {
    righting(folder, &["solve", "scenario.json", "--out", "out"])
}

/// Names of the files in a folder, sorted.
pub fn files_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// The repository.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}
