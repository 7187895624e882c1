//! Ctrl-C and termination, asked for once: stop cleanly; twice: at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use righting_ocp::Control;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

const EXIT_CODE: i32 = 130;

/// Whether the user has asked to stop.
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Watches for the signals from here on. Where that is impossible they end the process as usual.
    pub fn watch() -> Self {
        let asked = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            // In this order the first signal finds the flag unset, so only the second one exits.
            let at_once =
                flag::register_conditional_shutdown(signal, EXIT_CODE, Arc::clone(&asked));
            let cleanly = flag::register(signal, Arc::clone(&asked));
            debug_assert!(at_once.is_ok() && cleanly.is_ok());
        }
        Self(asked)
    }

    /// What a solve is told after an iteration: to stop once an interrupt is asked for.
    pub fn control(&self) -> Control {
        if self.is_asked() { Control::Stop } else { Control::Continue }
    }

    /// Whether to stop now.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
