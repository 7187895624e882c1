//! The declarations against the headers they restate: the C compiler compares the types, this test
//! compares the values.

use righting_ipopt_sys::{
    AlgorithmMode, ApplicationReturnStatus as Status, Bool, FALSE, HAS_HSL_LOADER, Index, Int,
    Number, TRUE,
};
use std::path::Path;
use std::process::Command;

#[test]
fn declarations_match_the_installed_headers() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/abi_probe.c");
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("abi_probe");
    let mut compile = Command::new(std::env::var_os("CC").unwrap_or_else(|| "cc".into()));
    compile.arg(&source).arg("-o").arg(&program);
    if !HAS_HSL_LOADER {
        compile.arg("-DIPOPT_3_14");
    }
    for directory in std::env::split_paths(env!("IPOPT_INCLUDE_PATH")) {
        compile.arg("-I").arg(directory);
    }
    let output = compile.output().expect("a C compiler (cc) is needed to check the bindings");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));

    let output = Command::new(&program).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let printed: Vec<(&str, i32)> = printed
        .lines()
        .map(|line| line.rsplit_once(' ').unwrap())
        .map(|(name, value)| (name, value.parse().unwrap()))
        .collect();
    assert_eq!(printed, expected());
}

// `Bool` is an integer or a `bool`, by version.
#[allow(clippy::useless_conversion)]
fn expected() -> Vec<(&'static str, i32)> {
    let size = |bytes: usize| i32::try_from(bytes).unwrap();
    vec![
        ("sizeof(Number)", size(size_of::<Number>())),
        ("sizeof(Index)", size(size_of::<Index>())),
        ("sizeof(Int)", size(size_of::<Int>())),
        ("sizeof(Bool)", size(size_of::<Bool>())),
        ("TRUE", i32::from(TRUE)),
        ("FALSE", i32::from(FALSE)),
        ("Solve_Succeeded", Status::SOLVE_SUCCEEDED.0),
        ("Solved_To_Acceptable_Level", Status::SOLVED_TO_ACCEPTABLE_LEVEL.0),
        ("Infeasible_Problem_Detected", Status::INFEASIBLE_PROBLEM_DETECTED.0),
        ("Search_Direction_Becomes_Too_Small", Status::SEARCH_DIRECTION_BECOMES_TOO_SMALL.0),
        ("Diverging_Iterates", Status::DIVERGING_ITERATES.0),
        ("User_Requested_Stop", Status::USER_REQUESTED_STOP.0),
        ("Feasible_Point_Found", Status::FEASIBLE_POINT_FOUND.0),
        ("Maximum_Iterations_Exceeded", Status::MAXIMUM_ITERATIONS_EXCEEDED.0),
        ("Restoration_Failed", Status::RESTORATION_FAILED.0),
        ("Error_In_Step_Computation", Status::ERROR_IN_STEP_COMPUTATION.0),
        ("Maximum_CpuTime_Exceeded", Status::MAXIMUM_CPUTIME_EXCEEDED.0),
        ("Not_Enough_Degrees_Of_Freedom", Status::NOT_ENOUGH_DEGREES_OF_FREEDOM.0),
        ("Invalid_Problem_Definition", Status::INVALID_PROBLEM_DEFINITION.0),
        ("Invalid_Option", Status::INVALID_OPTION.0),
        ("Invalid_Number_Detected", Status::INVALID_NUMBER_DETECTED.0),
        ("Unrecoverable_Exception", Status::UNRECOVERABLE_EXCEPTION.0),
        ("NonIpopt_Exception_Thrown", Status::NON_IPOPT_EXCEPTION_THROWN.0),
        ("Insufficient_Memory", Status::INSUFFICIENT_MEMORY.0),
        ("Internal_Error", Status::INTERNAL_ERROR.0),
        ("RegularMode", AlgorithmMode::REGULAR.0),
        ("RestorationPhaseMode", AlgorithmMode::RESTORATION_PHASE.0),
    ]
}
