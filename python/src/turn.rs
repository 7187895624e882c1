//! One solve at a time: MUMPS is not thread-safe, and Ipopt's linear-solver slot is one a process.

use std::cell::Cell;
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, TryLockError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::failure::{Failure, Outcome};

/// How long a thread that waits for its turn sleeps before it looks again, for Ctrl-C too.
const LOOK_EVERY: Duration = Duration::from_millis(20);

static TURN: Mutex<()> = Mutex::new(());
/// The process that used threads first; 0 before that.
static FIRST: AtomicU32 = AtomicU32::new(0);

thread_local! {
    static IS_SOLVING: Cell<bool> = const { Cell::new(false) };
}

/// Runs a solve while no other runs, Python's lock released. Other threads wait for their turn.
///
/// # Errors
/// [`Failure::NoTurn`] within a callback of a solve, and in a process forked from one that solved: its
/// threads are gone. [`Failure::NoOptimizer`] without Ipopt. What a signal handler raises while waiting.
pub fn alone<T: Send>(py: Python<'_>, solve: impl FnOnce() -> T + Send) -> Outcome<T> {
    if IS_SOLVING.get() {
        return Err(Failure::NoTurn {
            reason: "a callback of a solve cannot solve",
            hint: "keep what it needs, and solve after the first solve has returned",
        });
    }
    refuse_fork()?;
    py.detach(|| {
        let _turn = wait()?;
        righting_ipopt::use_one_blas_thread()?;
        let _mark = Mark::set();
        Ok(solve())
    })
}

/// Everything that uses threads begins so.
///
/// # Errors
/// [`Failure::NoTurn`] in a process forked from one that has begun so: its threads are gone, and would be waited for.
pub fn refuse_fork() -> Outcome<()> {
    let this = process::id();
    let first = FIRST.compare_exchange(0, this, Ordering::Relaxed, Ordering::Relaxed);
    match first.is_err_and(|first| first != this) {
        true => Err(Failure::NoTurn {
            reason: "this process was forked from one that had solved",
            hint: "use multiprocessing.get_context(\"spawn\")",
        }),
        false => Ok(()),
    }
}

/// The turn of this thread.
fn wait() -> Outcome<MutexGuard<'static, ()>> {
    loop {
        match TURN.try_lock() {
            Ok(turn) => return Ok(turn),
            // Nothing is kept in it that a panic could have left half done.
            Err(TryLockError::Poisoned(poisoned)) => return Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => {
                thread::sleep(LOOK_EVERY);
                Python::attach(|py| py.check_signals())?;
            }
        }
    }
}

/// Marks this thread as one that solves, as long as it lives.
struct Mark;

impl Mark {
    fn set() -> Self {
        IS_SOLVING.set(true);
        Self
    }
}

impl Drop for Mark {
    fn drop(&mut self) {
        IS_SOLVING.set(false);
    }
}
