//! What Python wants of a solve while it runs: to be told, and to interrupt it.

use std::time::{Duration, Instant};

use pyo3::prelude::*;
use righting_ocp::Control;
use righting_results::IterationRecord;

use crate::failure::{Failure, Outcome};
use crate::iteration::Iteration;

/// How often a solve looks for Ctrl-C: taking Python's lock takes longer than some iterations.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// Shows iterations to a callback and looks for signals.
pub struct Watch {
    on_iteration: Option<Py<PyAny>>,
    looked: Instant,
    raised: Option<PyErr>,
}

impl Watch {
    /// One that calls `on_iteration` with every [`Iteration`], if there is a callback.
    pub fn new(on_iteration: Option<Py<PyAny>>) -> Self {
        Self { on_iteration, looked: Instant::now(), raised: None }
    }

    /// Sees an iteration; a callback or a signal handler that raises stops the solve.
    pub fn see(&mut self, record: &IterationRecord) -> Control {
        let on_iteration = self.on_iteration.as_ref();
        if on_iteration.is_none() && self.looked.elapsed() < LOOK_EVERY {
            return self.control();
        }
        self.looked = Instant::now();
        let looked = Python::attach(|py| {
            py.check_signals()?;
            match on_iteration {
                Some(callback) => callback.call1(py, (Iteration::of(record),)).map(drop),
                None => Ok(()),
            }
        });
        if let Err(error) = looked {
            self.raised.get_or_insert(error);
        }
        self.control()
    }

    fn control(&self) -> Control {
        match self.raised {
            Some(_) => Control::Stop,
            None => Control::Continue,
        }
    }

    /// What was raised on the way, if anything was.
    pub fn end(self) -> Outcome<()> {
        self.raised.map_or(Ok(()), |error| Err(Failure::Python(error)))
    }
}
