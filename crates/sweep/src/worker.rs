//! A worker process: cases in, outcomes out, one JSON object a line.
//!
//! ```text
//! parent → worker   {"time_limit_s":600.0,"planned":null}        once: a Setup
//! worker → parent   {"ready":true}                               once
//! parent → worker   {"case_id":"…","scenario":{…}}               a Task, any number of times
//! worker → parent   {"case_id":"…","outcome":{…},"solve_s":0.04} its Answer, before the next Task
//! ```
//!
//! The end of its input ends the worker at once, wherever it is: a parent that was killed leaves none
//! behind.

use std::io::{self, BufRead, Write};
use std::path::PathBuf;
use std::process;
use std::sync::mpsc;
use std::thread;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::case::CaseId;
use crate::evaluation::Evaluator;
use crate::file::Evaluation;
use crate::outcome::Outcome;
use crate::sweep::Sweep;

/// What a worker must know before its first case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setup {
    /// How long a case may take, s.
    pub time_limit_s: f64,
    /// The scenario to plan once and fly in every case; none if every case is planned.
    pub planned: Option<Value>,
    /// The folder that takes the plans of the cases, each in a folder that its case names; none if they are not
    /// kept.
    #[serde(default)]
    pub plans: Option<PathBuf>,
}

/// A case to evaluate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// Which case.
    pub case_id: CaseId,
    /// Its scenario.
    pub scenario: Value,
}

/// A worker is up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ready {
    /// True.
    pub ready: bool,
}

/// What a case came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// Which case.
    pub case_id: CaseId,
    /// What it came to.
    pub outcome: Outcome,
    /// How long it took, s.
    pub solve_s: f64,
}

impl Setup {
    /// What the workers of a sweep must know.
    pub fn of(sweep: &Sweep) -> Self {
        let planned = match sweep.evaluation() {
            Evaluation::Plan => None,
            Evaluation::OpenLoop => Some(sweep.base().clone()),
        };
        Self { time_limit_s: sweep.case_time_limit_s(), planned, plans: None }
    }
}

/// Works until the input ends.
///
/// # Errors
/// Those of reading and writing, also of a plan that is to be kept; what is read must be what a [`Pool`](crate::Pool) writes.
pub fn serve() -> io::Result<()> {
    let (sender, lines) = mpsc::channel::<String>();
    thread::spawn(move || {
        for line in io::stdin().lock().lines() {
            let Ok(line) = line else { break };
            if sender.send(line).is_err() {
                break;
            }
        }
        // Nobody waits for what is being solved.
        process::exit(0);
    });
    let Ok(first) = lines.recv() else { return Ok(()) };
    let mut evaluator = Evaluator::new(serde_json::from_str(&first)?);
    send(&Ready { ready: true })?;
    for line in lines {
        let Task { case_id, scenario } = serde_json::from_str(&line)?;
        let (outcome, took) = evaluator.evaluate(case_id, &scenario)?;
        send(&Answer { case_id, outcome, solve_s: took.as_secs_f64() })?;
    }
    Ok(())
}

fn send(message: &impl Serialize) -> io::Result<()> {
    let mut line = serde_json::to_vec(message)?;
    line.push(b'\n');
    let mut stdout = io::stdout().lock();
    stdout.write_all(&line)?;
    stdout.flush()
}
