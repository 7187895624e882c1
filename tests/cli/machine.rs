//! `doctor` and `schema`.

use std::path::Path;

use serde_json::json;

use crate::program::{folder_with, righting, small_slew};

#[test]
fn doctor_says_what_this_machine_solves_with() {
    let run = righting(Path::new("."), &["doctor"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for part in [
        "Ipopt",
        "MUMPS",
        "BLAS",
        "MA57 by ",
        ", calls the stage solver",
        "linear solvers  mumps, stage",
        "Ready to solve.",
    ] {
        assert!(run.stdout.contains(part), "no {part} in {}", run.stdout);
    }
    let found = righting(Path::new("."), &["doctor", "--json"]).json();
    assert_eq!(found["ok"], true);
    assert_eq!(found["problems"], serde_json::json!([]));
    assert!(found["ipopt"].as_str().is_some_and(|version| version.starts_with("3.")));
    assert!(found["mumps"].as_str().is_some_and(|version| version.starts_with("5.")));
    let slots = ["MA57 by LSL_setMA57", "MA57 by hsllib (memfd)"];
    assert!(found["slot"].as_str().is_some_and(|slot| slots.contains(&slot)), "{}", found["slot"]);
    assert_eq!(found["stage_solver_called"], true);
    assert_eq!(found["linear_solvers"], json!(["mumps", "stage"]));
    let sets = found["instruction_sets_available"].as_array().expect("a list");
    assert!(sets.contains(&found["instruction_set"]));
}

#[test]
#[cfg(target_os = "linux")]
fn without_ipopt_all_works_that_does_not_solve() {
    let folder = folder_with(&small_slew());
    assert_eq!(crate::program::solve(folder.path()).code, 0);
    // What the system finds first is no library.
    let broken = tempfile::tempdir().expect("a temporary folder");
    for name in ["libipopt.so.1", "libipopt.so.3"] {
        std::fs::write(broken.path().join(name), "").expect("writable");
    }
    let run = |arguments: &[&str]| {
        let mut command = crate::program::command(folder.path());
        command.args(arguments).env("LD_LIBRARY_PATH", broken.path());
        crate::program::Run::from(command.output().expect("the program starts"))
    };
    for arguments in [
        &["--version"][..],
        &["schema"],
        &["verify", "out"],
        &["report", "out"],
        &["figures", "out"],
        &["export", "out", "--format", "npz"],
        &["power", "out"],
    ] {
        let done = run(arguments);
        assert_eq!((done.code, done.stderr.as_str()), (0, ""), "{arguments:?}");
    }
    for arguments in [&["solve", "scenario.json", "--out", "none"][..], &["reach", "scenario.json"]]
    {
        run(arguments).assert_refused("looked for libipopt.so.");
        assert!(run(arguments).stderr.contains("apt-get install coinor-libipopt-dev"));
    }
    assert!(!folder.path().join("none").exists());
    let doctor = run(&["doctor", "--json"]);
    assert_eq!(doctor.code, 2);
    assert_eq!(doctor.json()["ok"], false);
    assert_eq!(doctor.json()["slot"], "none");
    assert_eq!(doctor.json()["linear_solvers"], json!([]));
}

#[test]
fn schemas_describe_the_files_that_the_program_reads() {
    let schema = righting(Path::new("."), &["schema"]).json();
    assert_eq!(schema, righting(Path::new("."), &["schema", "scenario"]).json());
    assert!(schema["$schema"].is_string());
    for field in small_slew().as_object().expect("an object").keys() {
        assert!(schema["properties"][field].is_object(), "{field}");
    }
    let system = righting(Path::new("."), &["schema", "system"]).json();
    assert!(system["properties"]["links"].is_object());
    let wheels = righting(Path::new("."), &["schema", "wheels"]).json();
    assert_eq!(wheels["properties"]["wheels"]["type"], "array");
    let wheel = &wheels["$defs"]["Wheel"];
    assert_eq!(wheel["required"], json!(["axis", "momentum_max_n_m_s", "torque_max_n_m"]));
    assert_eq!(wheel["additionalProperties"], false);
}

#[test]
fn options_of_ipopt_in_the_working_folder_have_no_effect() {
    let folder = folder_with(&small_slew());
    std::fs::write(folder.path().join("ipopt.opt"), "max_iter 1\nprint_level 5\n")
        .expect("writable");
    let run = crate::program::solve(folder.path());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(!run.stdout.contains("Ipopt"), "{}", run.stdout);
}
