use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Holds a panic back while Ipopt's frames are on the stack.
///
/// All the callbacks of a solve share one: once it has caught something none of them runs the
/// user's code again, and Ipopt comes to its end.
#[derive(Default)]
pub(crate) struct Trap {
    sprung: Cell<bool>,
    payload: Cell<Option<Box<dyn Any + Send>>>,
}

impl Trap {
    /// Runs `body`; `None` when it panics or when something did before.
    pub(crate) fn run<T>(&self, body: impl FnOnce() -> T) -> Option<T> {
        if self.sprung.get() {
            return None;
        }
        // What `body` borrows may be left half-changed, but no more of it runs before the panic
        // goes on, as it would without Ipopt in between.
        match catch_unwind(AssertUnwindSafe(body)) {
            Ok(value) => Some(value),
            Err(payload) => {
                self.sprung.set(true);
                self.payload.set(Some(payload));
                None
            }
        }
    }

    /// Lets a panic go on that was held back.
    pub(crate) fn release(self) {
        if let Some(payload) = self.payload.into_inner() {
            resume_unwind(payload);
        }
    }
}
