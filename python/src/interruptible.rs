//! Work in a thread of its own, while the calling one looks for Ctrl-C and passes on what happens.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::failure::{Failure, Outcome};

/// How often Ctrl-C is looked for while nothing happens.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// Does `work`, which sends events and ends early once its flag is set. To be called without Python's lock.
///
/// # Errors
/// What `on_event` or a signal handler raises: then the flag is set, and the work waited for.
pub fn interruptible<T: Send, E: Send>(
    work: impl FnOnce(&AtomicBool, Sender<E>) -> T + Send,
    mut on_event: impl FnMut(Python<'_>, E) -> PyResult<()>,
) -> Outcome<T> {
    let halted = AtomicBool::new(false);
    let (sender, events) = mpsc::channel();
    thread::scope(|scope| {
        let running = scope.spawn(|| work(&halted, sender));
        let mut raised = None;
        loop {
            let event = match events.recv_timeout(LOOK_EVERY) {
                Ok(event) => Some(event),
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => break,
            };
            let looked = Python::attach(|py| {
                py.check_signals()?;
                event.map_or(Ok(()), |event| on_event(py, event))
            });
            if let Err(error) = looked {
                raised.get_or_insert(error);
                halted.store(true, Ordering::Relaxed);
            }
        }
        let done = running.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        raised.map_or(Ok(done), |error| Err(Failure::Python(error)))
    })
}
