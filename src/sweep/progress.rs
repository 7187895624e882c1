//! How far a sweep is: rate, time left, solved and failed.

use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use righting_sweep::Record;

use crate::output;

/// How often a line is printed where nobody watches, such as to a batch system's log.
const PRINT_EVERY: Duration = Duration::from_secs(30);

/// A bar on a terminal, a line now and then elsewhere.
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    printed: Instant,
    left: usize,
    recorded: usize,
    solved: usize,
}

impl Progress {
    /// Starts the clock: so many cases to go, so many recorded before.
    pub fn start(left: usize, before: usize) -> Self {
        let bar = ProgressBar::new(left as u64);
        if let Ok(style) = ProgressStyle::with_template("{bar:24} {pos}/{len}  {msg}") {
            bar.set_style(style);
        }
        if before > 0 {
            let line = format!("{before} cases are recorded already, {left} to go");
            if bar.is_hidden() { output::complain(&line) } else { bar.println(line) }
        }
        let now = Instant::now();
        Self { bar, started: now, printed: now, left, recorded: 0, solved: 0 }
    }

    /// One more case.
    pub fn count(&mut self, record: &Record) {
        self.recorded += 1;
        self.solved += usize::from(record.outcome.succeeded());
        if !self.bar.is_hidden() {
            self.bar.set_message(self.state());
            self.bar.set_position(self.recorded as u64);
        } else if self.printed.elapsed() >= PRINT_EVERY {
            self.printed = Instant::now();
            output::complain(&format!("{}/{}  {}", self.recorded, self.left, self.state()));
        }
    }

    fn state(&self) -> String {
        let elapsed_s = self.started.elapsed().as_secs_f64();
        let rate = self.recorded as f64 / elapsed_s.max(1e-3);
        let left = Duration::from_secs_f64((self.left - self.recorded) as f64 / rate);
        let failed = self.recorded - self.solved;
        format!(
            "{} solved, {failed} failed  {rate:.1} cases/s, {} left",
            self.solved,
            HumanDuration(left)
        )
    }

    /// Removes the bar; how many cases were recorded.
    pub fn finish(self) -> usize {
        self.bar.finish_and_clear();
        self.recorded
    }
}
