//! Raw bindings of Ipopt's C interface (`IpStdCInterface.h`) and of the ways in which a program brings
//! its own linear solver ([`hsl`]).
//!
//! Written by hand against Ipopt 3.11.9 and 3.14.17, checked against the installed headers by
//! `tests/abi.rs`. Names follow the headers, so that Ipopt's own documentation applies; the safe layer
//! is `righting-ipopt`. Everything of the header is here.
//!
//! The functions are in a table, [`api`]. With the feature `dlopen`, which is on by default, the first
//! call opens the library that pkg-config found when this crate was built: a program that does not
//! solve does not pay for it (Debian 13's starts MPI, 0.2 s), and runs where there is none. Without
//! the feature the program is linked to the library and the table holds the linked functions.
//!
//! Two things changed in Ipopt 3.14, which the build script follows by the version that pkg-config
//! reports. [`Bool`] became C's one-byte `bool`. And the hooks of the HSL loader are gone (`LSL_…`),
//! so that an own linear solver goes another way.
#![allow(non_snake_case, non_camel_case_types)]

mod api;
mod blas;
mod functions;
mod interface;
mod library;
mod return_codes;

pub mod hsl;

pub use api::*;
pub use blas::use_one_blas_thread;
pub use interface::*;
pub use library::LoadError;
pub use return_codes::{AlgorithmMode, ApplicationReturnStatus};

/// The version of the Ipopt that this crate was built against, as pkg-config reports it.
pub const VERSION: &str = env!("IPOPT_VERSION");

/// The file that held its library then, such as `libipopt.so.3.14.17`; none if it was linked.
pub const LIBRARY_FILE: Option<&str> = option_env!("IPOPT_FILE");

/// Whether opening it starts MPI, as Debian 13's does for MUMPS; false if it was linked.
pub const STARTS_MPI: bool = cfg!(ipopt_mpi);

/// Whether that Ipopt has the hooks of the HSL loader, as all have up to 3.13.
pub const HAS_HSL_LOADER: bool = cfg!(ipopt_hsl_loader);
