//! The compiled part of the Python package `righting`.
//!
//! Every class here holds what a library of the workspace made, and every function calls one: scenarios are
//! checked by `righting-scenario`, plans made by `righting-planner` and checked by `righting-verifier`. What is
//! done here is what Python asks for: arrays, exceptions, interrupts, and one solve at a time. `package/righting`
//! says what of it is public.

mod argument;
mod check;
mod columns;
mod comparison;
mod envelope;
mod export;
mod failure;
mod flights;
mod function;
mod input;
mod interruptible;
mod iteration;
mod json;
mod mechanics;
mod plan;
mod power;
mod reach;
mod scenario;
mod schema;
mod solve;
mod sweep;
mod system;
mod turn;
mod verification;
mod watch;
mod wheels;

/// Everything that the package takes from here.
#[pyo3::pymodule]
mod _righting {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::check::Check;
    #[pymodule_export]
    use crate::comparison::{Comparison, compare};
    #[pymodule_export]
    use crate::envelope::{Envelope, Envelopes, envelope};
    #[pymodule_export]
    use crate::flights::Flights;
    #[pymodule_export]
    use crate::function::Function;
    #[pymodule_export]
    use crate::iteration::Iteration;
    #[pymodule_export]
    use crate::plan::Plan;
    #[pymodule_export]
    use crate::power::Power;
    #[pymodule_export]
    use crate::reach::{Reach, reach};
    #[pymodule_export]
    use crate::scenario::Scenario;
    #[pymodule_export]
    use crate::schema::schema;
    #[pymodule_export]
    use crate::solve::solve;
    #[pymodule_export]
    use crate::sweep::{SweepTable, plan_sweep, run_shard, serve_sweep};
    #[pymodule_export]
    use crate::system::System;
    #[pymodule_export]
    use crate::verification::Verification;

    #[pymodule_init]
    fn add_version(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
