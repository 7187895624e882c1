//! How a solve is getting on, for someone who waits.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use righting_results::IterationRecord;

use crate::output;

const TEMPLATE: &str = "{spinner} {prefix}{msg}  {elapsed}";
const TICK: Duration = Duration::from_millis(100);

/// One line on stderr that keeps changing; nothing where stderr is not a terminal.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Starts the clock.
    pub fn start() -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
            bar.set_style(style);
        }
        bar.set_message("compiling");
        // A process that nobody watches is spared the thread.
        if !bar.is_hidden() {
            bar.enable_steady_tick(TICK);
        }
        Self { bar }
    }

    /// Shows an iteration.
    pub fn show(&self, record: &IterationRecord) {
        if !self.bar.is_hidden() {
            self.bar.set_message(format!(
                "iteration {:>4}  objective {:>12.5e}  infeasibility {:>8.1e}",
                record.iteration, record.objective, record.primal_infeasibility
            ));
        }
    }

    /// Says which of several solves this is.
    pub fn name(&self, name: String) {
        self.bar.set_prefix(name);
    }

    /// Prints a line that stays.
    pub fn say(&self, line: &str) {
        match self.bar.is_hidden() {
            true => output::complain(line),
            false => self.bar.println(line),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
