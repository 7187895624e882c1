//! Worker processes, each up for many cases.

use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Sender};
use std::thread;
use std::time::Duration;

use crate::error::SweepError;
use crate::outcome::{Outcome, Trouble};
use crate::process::{Process, Silence};
use crate::record::{Record, RunFacts};
use crate::worker::{Answer, Ready, Setup, Task};

/// How often in a row a worker may die before it is up.
const STARTS: usize = 3;
/// How long a worker may take to come up.
const START_PATIENCE: Duration = Duration::from_secs(60);
/// How often a case is tried.
const ATTEMPTS: u32 = 2;

/// Worker processes, each up for many cases.
///
/// Processes, not threads: MUMPS is not thread-safe, and a case that brings its process down takes
/// nothing else with it.
pub struct Pool<'a> {
    /// Makes the command of a worker: a program that does as [`worker`](crate::worker) says.
    pub command: &'a (dyn Fn() -> Command + Sync),
    /// How many workers.
    pub jobs: usize,
    /// What each is told first.
    pub setup: &'a Setup,
    /// How long a worker may think about a case before it counts as hung. Longer than the time limit
    /// of a case, which a worker keeps by itself.
    pub patience: Duration,
    /// Whether to stop now, asked many times a second.
    pub halted: &'a (dyn Fn() -> bool + Sync),
}

impl Pool<'_> {
    /// Has every task done, and hands over records as they come, in any order.
    ///
    /// A worker that dies or hangs is replaced and its task tried once more; if that fails too, the
    /// record says why. Returns early, the workers killed, when it is halted.
    ///
    /// # Errors
    /// The first error of `on_record`, and [`SweepError::Worker`] when no worker comes up.
    pub fn run(
        &self,
        tasks: impl Iterator<Item = Task> + Send,
        mut on_record: impl FnMut(Record) -> Result<(), SweepError>,
    ) -> Result<(), SweepError> {
        let tasks = Mutex::new(tasks);
        let next = || match tasks.lock() {
            Ok(mut tasks) => tasks.next(),
            Err(_) => None,
        };
        let failed = AtomicBool::new(false);
        let halted = || failed.load(Ordering::Relaxed) || (self.halted)();
        let (sender, events) = mpsc::channel();
        thread::scope(|scope| {
            for _ in 0..self.jobs.max(1) {
                let sender = sender.clone();
                let (next, halted) = (&next, &halted);
                scope.spawn(move || {
                    if let Err(error) = self.work(next, halted, &sender) {
                        // The receiver lives until every sender is gone.
                        let _ = sender.send(Err(error));
                    }
                });
            }
            drop(sender);
            let mut result = Ok(());
            for event in events {
                if result.is_ok() {
                    result = event.and_then(&mut on_record);
                    failed.store(result.is_err(), Ordering::Relaxed);
                }
            }
            result
        })
    }

    /// What one worker and those that replace it do.
    fn work(
        &self,
        next: &dyn Fn() -> Option<Task>,
        halted: &dyn Fn() -> bool,
        records: &Sender<Result<Record, SweepError>>,
    ) -> Result<(), SweepError> {
        let mut worker = None;
        while !halted()
            && let Some(task) = next()
        {
            let Some(record) = self.attempt(&task, &mut worker, halted)? else { break };
            if records.send(Ok(record)).is_err() {
                break;
            }
        }
        Ok(())
    }

    /// The record of a task; none if there is no time left for one.
    fn attempt(
        &self,
        task: &Task,
        worker: &mut Option<Process>,
        halted: &dyn Fn() -> bool,
    ) -> Result<Option<Record>, SweepError> {
        let mut trouble = None;
        for attempts in 1..=ATTEMPTS {
            let mut process = match worker.take() {
                Some(process) => process,
                None => match self.start(halted)? {
                    Some(process) => process,
                    None => return Ok(None),
                },
            };
            if halted() {
                return Ok(None);
            }
            let answer =
                process.send(task).and_then(|()| process.receive::<Answer>(self.patience, halted));
            trouble = match answer {
                Ok(Answer { case_id, outcome, solve_s }) if case_id == task.case_id => {
                    *worker = Some(process);
                    let run = RunFacts { solve_s, attempts };
                    return Ok(Some(Record { case_id, outcome, run }));
                }
                Ok(_) => Some((Trouble::Crashed, "the worker answered another case".to_owned())),
                Err(Silence::Halted) => return Ok(None),
                Err(Silence::Died(how)) => Some((Trouble::Crashed, how)),
                Err(Silence::Hung) => {
                    let reason = format!("no answer after {} s", self.patience.as_secs_f64());
                    Some((Trouble::Hung, reason))
                }
            };
        }
        Ok(trouble.map(|(trouble, reason)| Record {
            case_id: task.case_id,
            outcome: Outcome::of_trouble(trouble, reason),
            run: RunFacts { solve_s: 0.0, attempts: ATTEMPTS },
        }))
    }

    /// A worker that is up; none if there is no time left for one.
    fn start(&self, halted: &dyn Fn() -> bool) -> Result<Option<Process>, SweepError> {
        let mut reason = String::new();
        for _ in 0..STARTS {
            let mut process = Process::start((self.command)())
                .map_err(|error| SweepError::Worker { reason: error.to_string() })?;
            let ready = process
                .send(self.setup)
                .and_then(|()| process.receive::<Ready>(START_PATIENCE, halted));
            reason = match ready {
                Ok(_) => return Ok(Some(process)),
                Err(Silence::Halted) => return Ok(None),
                Err(Silence::Died(how)) => how,
                Err(Silence::Hung) => format!("no word in {} s", START_PATIENCE.as_secs()),
            };
        }
        Err(SweepError::Worker { reason })
    }
}
