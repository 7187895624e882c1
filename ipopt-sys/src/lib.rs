//! Raw bindings of Ipopt's C interface (`IpStdCInterface.h`) and of the hooks through which a
//! program brings its own linear solver (`HSLLoader.h`).
//!
//! Written by hand against Ipopt 3.11.9, checked against the installed headers by `tests/abi.rs`.
//! Names follow the headers, so that Ipopt's own documentation applies; the safe layer is
//! `righting-ipopt`. Everything of the header is here; 3.11 has no `GetIpoptCurrentIterate`.
//!
//! Two things changed in Ipopt 3.14. [`Bool`] became C's one-byte `bool`, which the build script
//! follows by the version that pkg-config reports. And the loader hooks are gone (`LSL_…`): the
//! module `hsl` then does not exist, and neither does the slot for an own linear solver.
#![allow(non_snake_case, non_camel_case_types)]

mod interface;
mod return_codes;

#[cfg(ipopt_ma57_slot)]
pub mod hsl;

pub use interface::*;
pub use return_codes::{AlgorithmMode, ApplicationReturnStatus};

/// The version of the Ipopt that this crate was built against, as pkg-config reports it.
pub const VERSION: &str = env!("IPOPT_VERSION");

/// Whether that Ipopt has the loader hooks of the module `hsl`.
pub const HAS_MA57_SLOT: bool = cfg!(ipopt_ma57_slot);
