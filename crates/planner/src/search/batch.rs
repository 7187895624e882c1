use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};

use rayon::ThreadPool;
use righting_ocp::{
    Control, Grid, InitialGuess, MultipleShooting, OcpError, OcpSolution, Settings,
};
use righting_results::IterationRecord;

use super::model::{Model, solve_from};

/// How often a solve shows where it is: an iteration takes less time than waking the thread that shows
/// it.
const SHOW_EVERY: Duration = Duration::from_millis(20);

enum Event {
    Iteration(IterationRecord),
    Solved(usize, Box<Result<OcpSolution, OcpError>>),
}

/// Solves of one problem from several starts.
pub(super) struct Batch<'a> {
    model: &'a Model,
    grid: Grid,
    starts: &'a [(InitialGuess, Settings)],
    /// Programs that no thread is at work on. The next solve is spared their set-up.
    idle: Mutex<Vec<MultipleShooting<'a>>>,
}

impl<'a> Batch<'a> {
    pub(super) fn new(
        model: &'a Model,
        grid: Grid,
        starts: &'a [(InitialGuess, Settings)],
    ) -> Self {
        Self { model, grid, starts, idle: Mutex::default() }
    }

    /// Solves from every start, on the threads of the pool, and returns the solutions in the order
    /// of the starts. `stop` ends all of them; `on_iteration` is only called from this thread.
    ///
    /// The solves share nothing that changes them: which thread takes which start does not show.
    pub(super) fn solve(
        &self,
        pool: Option<&ThreadPool>,
        on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
        stop: &AtomicBool,
    ) -> Result<Vec<OcpSolution>, OcpError> {
        // A machine that gives no threads still has this one.
        let Some(pool) = pool else { return self.solve_here(on_iteration, stop) };
        let mut solved: Vec<Option<Result<OcpSolution, OcpError>>> =
            self.starts.iter().map(|_| None).collect();
        pool.in_place_scope_fifo(|scope| {
            let (sender, events) = mpsc::channel();
            for (index, start) in self.starts.iter().enumerate() {
                let sender = sender.clone();
                scope.spawn_fifo(move |_| {
                    let mut shown = Instant::now();
                    let outcome = self.solve_one(start, |record| {
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

    fn solve_here(
        &self,
        on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
        stop: &AtomicBool,
    ) -> Result<Vec<OcpSolution>, OcpError> {
        let solve = |start| self.solve_one(start, super::stoppable(on_iteration, stop));
        self.starts.iter().map(solve).collect()
    }

    fn solve_one(
        &self,
        (guess, settings): &(InitialGuess, Settings),
        on_iteration: impl FnMut(IterationRecord) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let free = idle().pop();
        let mut program = free.map_or_else(|| self.model.program(self.grid), Ok)?;
        let solution = solve_from(guess.clone(), &mut program, settings, on_iteration);
        idle().push(program);
        solution
    }
}
