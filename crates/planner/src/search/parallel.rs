use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use righting_ocp::{Control, Grid, Guess, OcpError, Settings, Solution};

use super::model::Model;
use righting_results::solution::IterationRecord;

/// How often a solve shows where it is.
const SHOW_EVERY: Duration = Duration::from_millis(20);

enum Event {
    Iteration(IterationRecord),
    Solved(usize, Box<Result<Solution, OcpError>>),
}

/// Solves of one problem from several starts.
pub(super) struct Batch<'a> {
    pub(super) model: &'a Model,
    pub(super) grid: Grid,
    pub(super) starts: &'a [(Guess, Settings)],
}

impl Batch<'_> {
    /// Solves from every start, on so many threads at most, and returns the solutions in the order
    /// of the starts. `stop` ends all of them; `on_iteration` is only called from this thread.
    ///
    /// The solves share nothing that changes: which thread takes which start does not show.
    pub(super) fn solve(
        &self,
        threads: NonZeroUsize,
        on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
        stop: &AtomicBool,
    ) -> Result<Vec<Solution>, OcpError> {
        let Batch { model, grid, starts } = *self;
        let next = AtomicUsize::new(0);
        let mut solved: Vec<Option<Result<Solution, OcpError>>> =
            starts.iter().map(|_| None).collect();
        thread::scope(|scope| {
            let (sender, events) = mpsc::channel();
            for _ in 0..threads.get().min(starts.len()) {
                let (sender, next) = (sender.clone(), &next);
                scope.spawn(move || {
                    loop {
                        let index = next.fetch_add(1, Ordering::Relaxed);
                        let Some((guess, settings)) = starts.get(index) else { break };
                        let mut shown = Instant::now();
                        let outcome = model.solve(grid, guess.clone(), settings, |record| {
                            // An iteration takes less time than waking the other thread for it.
                            if shown.elapsed() > SHOW_EVERY {
                                shown = Instant::now();
                                // The receiver outlives the scope.
                                let _ = sender.send(Event::Iteration(record));
                            }
                            match stop.load(Ordering::Relaxed) {
                                true => Control::Stop,
                                false => Control::Continue,
                            }
                        });
                        let _ = sender.send(Event::Solved(index, Box::new(outcome)));
                    }
                });
            }
            drop(sender);
            for event in events {
                match event {
                    Event::Iteration(record) => {
                        if on_iteration(&record) == Control::Stop {
                            stop.store(true, Ordering::Relaxed);
                        }
                    }
                    Event::Solved(index, outcome) => solved[index] = Some(*outcome),
                }
            }
        });
        solved.into_iter().flatten().collect()
    }
}
