//! `doctor` and `schema`.

use std::path::Path;

use serde_json::json;

use crate::program::{folder_with, righting, small_slew};

#[test]
fn doctor_says_what_this_machine_solves_with() {
    let run = righting(Path::new("."), &["doctor"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for part in ["Ipopt", "MUMPS", "BLAS", "linear solvers  mumps", "Ready to solve."] {
        assert!(run.stdout.contains(part), "no {part} in {}", run.stdout);
    }
    let found = righting(Path::new("."), &["doctor", "--json"]).json();
    assert_eq!(found["ok"], true);
    assert_eq!(found["problems"], serde_json::json!([]));
    assert!(found["ipopt"].as_str().is_some_and(|version| version.starts_with("3.")));
    assert!(found["linear_solvers"].as_array().is_some_and(|all| all.contains(&"mumps".into())));
    let sets = found["instruction_sets_available"].as_array().expect("a list");
    assert!(sets.contains(&found["instruction_set"]));
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
