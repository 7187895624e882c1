//! Reaction wheels as the page draws and plots them.

use righting_scenario::wheels;
use serde::Serialize;

/// A wheel and what it can do.
#[derive(Debug, Serialize)]
pub(super) struct Wheel {
    /// Unit vector, body axes.
    axis: [f64; 3],
    momentum_max_n_m_s: f64,
    torque_max_n_m: f64,
    failed: bool,
}

impl Wheel {
    pub fn of(wheel: &wheels::Wheel) -> Self {
        Self {
            axis: wheel.axis,
            momentum_max_n_m_s: wheel.momentum_max_n_m_s,
            torque_max_n_m: wheel.torque_max_n_m,
            failed: wheel.failed,
        }
    }
}
