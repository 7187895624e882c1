//! The pool with workers that crash, hang and babble: shell scripts that speak its protocol.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use righting_sweep::worker::{Setup, Task};
use righting_sweep::{CaseId, CaseStatus, Pool, Record, SweepError, Trouble};
use serde_json::json;

/// Answers every case as flown, unless the scenario says otherwise.
const WORKER: &str = r#"
read -r setup
echo '{"ready":true}'
while read -r task; do
  id=${task#*'"case_id":"'}; id=${id%%'"'*}
  case $task in
    *crash_once*) if mkdir "$MARK" 2>/dev/null; then echo 'note: n' >&2; echo 'out of luck' >&2; exit 7; fi;;
    *crash*) kill -9 $$;;
    *hang*) exec sleep 1000;;
    *lie*) id=00000000000000ff;;
    *endless*) exec tr '\0' x </dev/zero;;
    *babble*) echo 'a library says hello';;
  esac
  echo '{"case_id":"'$id'","outcome":{"status":"flown","verified":true,"attitude_error":0.5,"final_rate_deg_s":0.0,"joint_rate_deg_s":0.0,"objective":null,"iterations":0},"solve_s":0.0}'
done
"#;

const SETUP: Setup = Setup { time_limit_s: 1.0, planned: None, plans: None };

struct Ran {
    records: BTreeMap<u64, Record>,
    result: Result<(), SweepError>,
}

fn run(
    script: &str,
    jobs: usize,
    tasks: &[&str],
    patience: Duration,
    halted: &(dyn Fn() -> bool + Sync),
) -> Ran {
    let folder = tempfile::tempdir().unwrap();
    let mark = folder.path().join("mark");
    let command = || {
        let mut command = Command::new("sh");
        command.args(["-c", script]).env("MARK", &mark);
        command
    };
    let pool = Pool { command: &command, jobs, setup: &SETUP, patience, halted };
    let tasks = tasks
        .iter()
        .enumerate()
        .map(|(i, what)| Task { case_id: CaseId(i as u64), scenario: json!({ "do": what }) });
    let mut records = BTreeMap::new();
    let result = pool.run(tasks, |record| {
        assert!(records.insert(record.case_id.0, record).is_none(), "each case once");
        Ok(())
    });
    Ran { records, result }
}

/// Longer than any machine takes to answer.
const PATIENCE: Duration = Duration::from_secs(600);

fn never() -> bool {
    false
}

#[test]
fn a_worker_that_crashes_costs_its_case_only() {
    let tasks = ["", "crash", "babble", "crash_once", "", ""];
    for jobs in [1, 3] {
        let Ran { records, result } = run(WORKER, jobs, &tasks, PATIENCE, &never);
        result.unwrap();
        assert_eq!(records.len(), tasks.len());
        for (i, what) in tasks.iter().enumerate() {
            let Record { outcome, run, .. } = &records[&(i as u64)];
            let reason = outcome.reason.clone().unwrap_or_default();
            let attempts = if what.is_empty() || *what == "babble" { 1 } else { 2 };
            assert_eq!(run.attempts, attempts, "{what}: {reason}");
            match *what {
                "crash" => {
                    assert_eq!(outcome.status, CaseStatus::Trouble(Trouble::Crashed));
                    assert!(reason.contains("SIGKILL"), "{reason}");
                }
                _ => assert!(outcome.succeeded(), "{what}: {reason}"),
            }
        }
    }
}

#[test]
fn a_worker_that_hangs_is_replaced_and_its_case_tried_once_more() {
    let Ran { records, result } =
        run(WORKER, 1, &["hang", "hang"], Duration::from_millis(100), &never);
    result.unwrap();
    assert_eq!(records.len(), 2);
    for Record { outcome, run, .. } in records.values() {
        assert_eq!(outcome.status, CaseStatus::Trouble(Trouble::Hung));
        assert_eq!(outcome.reason.as_deref(), Some("no answer after 0.1 s"));
        assert_eq!(run.attempts, 2);
    }
}

#[test]
fn an_answer_to_another_case_is_none() {
    let Ran { records, result } = run(WORKER, 2, &["fly", "lie", "fly"], PATIENCE, &never);
    result.unwrap();
    assert_eq!(records.len(), 3);
    let outcome = &records[&1].outcome;
    assert_eq!(outcome.status, CaseStatus::Trouble(Trouble::Crashed));
    assert_eq!(outcome.reason.as_deref(), Some("the worker answered another case"));
    assert!(records[&0].outcome.succeeded() && records[&2].outcome.succeeded());
}

#[test]
fn a_line_without_an_end_is_no_answer_and_fills_no_memory() {
    let patience = Duration::from_millis(300);
    let Ran { records, result } = run(WORKER, 1, &["endless"], patience, &never);
    result.unwrap();
    assert_eq!(records[&0].outcome.status, CaseStatus::Trouble(Trouble::Hung));
    #[cfg(target_os = "linux")]
    {
        let status = std::fs::read_to_string("/proc/self/status").unwrap();
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
        let kib: u64 = peak.trim().trim_end_matches(" kB").parse().unwrap();
        assert!(kib < 200 << 10, "{kib} KiB");
    }
}

#[test]
fn last_words_are_kept() {
    let script = WORKER.replace("if mkdir \"$MARK\" 2>/dev/null; then", "if true; then");
    let Ran { records, result } = run(&script, 1, &["crash_once"], PATIENCE, &never);
    result.unwrap();
    let reason = records[&0].outcome.reason.clone().unwrap();
    assert_eq!(reason, "exit status: 7: out of luck");
}

#[test]
fn workers_that_never_come_up_stop_the_sweep() {
    let script = "echo 'error while loading shared libraries' >&2; exit 127";
    let Ran { records, result } = run(script, 2, &["", "", ""], PATIENCE, &never);
    assert!(records.is_empty());
    let error = result.unwrap_err().to_string();
    assert!(error.contains("does not start") && error.contains("shared libraries"), "{error}");
}

#[test]
fn a_halt_ends_even_a_hung_worker_and_records_nothing_for_it() {
    // Asked many times: the answer turns while the worker hangs.
    let asked = AtomicUsize::new(0);
    let halted = || asked.fetch_add(1, Ordering::Relaxed) > 4;
    let Ran { records, result } = run(WORKER, 1, &["hang", ""], PATIENCE, &halted);
    result.unwrap();
    assert!(records.is_empty());
}

#[test]
fn what_cannot_be_recorded_stops_the_sweep() {
    let command = || {
        let mut command = Command::new("sh");
        command.args(["-c", WORKER]);
        command
    };
    let pool =
        Pool { command: &command, jobs: 2, setup: &SETUP, patience: PATIENCE, halted: &never };
    let tasks = (0..).map(|i| Task { case_id: CaseId(i), scenario: json!({}) });
    let mut recorded = 0;
    let result = pool.run(tasks, |_| {
        recorded += 1;
        match recorded {
            3 => Err(SweepError::Worker { reason: "full".to_owned() }),
            _ => Ok(()),
        }
    });
    assert_eq!(recorded, 3);
    assert!(result.unwrap_err().to_string().contains("full"));
}
