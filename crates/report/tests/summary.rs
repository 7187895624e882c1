//! The text a person reads after a solve.

mod common;

use std::path::PathBuf;

use righting_report::{status_phrase, summary, verification_summary};
use righting_results::Status;

#[test]
fn a_verified_slew_says_asked_reached_proven_and_where() {
    let (solution, _) = common::result("slew", 4, 600);
    let text = summary(&solution, &[PathBuf::from("out/demo/trajectory.csv")]);
    for part in [
        "made_up: slew of 20° about [0, 0, 2] in 30 s, 600 steps",
        "some_arm, 4 joints, reduced form",
        "solved after 19 iterations and 0.45 s in all: objective 9.068500e-4",
        "attitude error 2.0e-5 (0.0023°)",
        "Verified: an independent integration agrees and every limit holds",
        "ok  joint angle   45.8  ≤ 50 deg    4.13  joint 2 at 12.3 s",
        "out/demo/trajectory.csv",
    ] {
        assert!(text.contains(part), "no \"{part}\" in:\n{text}");
    }
}

#[test]
fn a_detumble_says_how_close_to_the_bound_it_came() {
    let (solution, _) = common::result("detumble", 4, 600);
    let text = summary(&solution, &[]);
    assert!(text.contains("detumble from [0, 0, -20] °/s"), "{text}");
    assert!(
        text.contains("12.1 °/s, 39.3 % less (at least 9.22 °/s with the arm at rest)"),
        "{text}"
    );
    assert!(!text.contains("Files"), "{text}");

    // Of joints that move at the start, it says what the share is of.
    let (mut moving, _) = common::result("detumble", 4, 600);
    moving.stopped_deg_s = Some(19.9);
    moving.scenario.initial.joint_rates_deg_s = Some(vec![1.0, 0.0, 0.0, 0.0]);
    let text = summary(&moving, &[]);
    let part = "39.3 % less than the 19.9 °/s that stopping the arm leaves (at least 9.22";
    assert!(text.contains(part), "{text}");
}

#[test]
fn a_failed_check_stands_out() {
    let (mut solution, _) = common::result("slew", 4, 600);
    solution.verification.passed = false;
    solution.verification.checks[1].passed = false;
    for text in [summary(&solution, &[]), verification_summary(&solution)] {
        assert!(text.contains("NOT VERIFIED: 1 of 2 checks failed"), "{text}");
        assert!(text.contains("FAILED  joint rate"), "{text}");
    }
}

#[test]
fn no_two_statuses_read_alike() {
    use Status::*;
    let all = [
        Solved,
        Acceptable,
        Infeasible,
        IterationLimit,
        TimeLimit,
        Stalled,
        Interrupted,
        SearchDirectionTooSmall,
        Diverging,
        RestorationFailed,
        EvaluationError,
        InternalError,
    ];
    let mut phrases: Vec<_> = all.map(status_phrase).to_vec();
    phrases.sort_unstable();
    phrases.dedup();
    assert_eq!(phrases.len(), all.len());
}

#[test]
fn a_limit_exceeded_within_its_tolerance_says_so() {
    let (mut solution, _) = common::result("slew", 4, 600);
    let check = &mut solution.verification.checks[0];
    check.value = check.limit + 1e-4;
    check.tolerance = 1e-3;
    let text = verification_summary(&solution);
    assert!(text.contains("joint 2 at 12.3 s (± 0.0573 is tolerated)"), "{text}");
    assert!(text.contains("\n  in tolerance  "), "{text}");
}
