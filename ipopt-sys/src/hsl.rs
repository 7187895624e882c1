//! MA57 of the HSL, which Ipopt calls when `linear_solver` is `ma57`, and the ways in which a
//! program can be that MA57.
//!
//! Up to Ipopt 3.13 its loader of HSL routines (`HSLLoader.h`) takes them from the program
//! (`LSL_setMA57`) and looks for a shared library only while they are unset. Ipopt 3.14 only looks
//! for the library, by the name in its option `hsllib`; that can be a file in memory, whose routines
//! pass every call on. [`ma57_slot`] is either.
//!
//! The routines follow Fortran's conventions: every argument is a pointer, indices count from one.
//! Array lengths are those of the MA57 documentation; where Ipopt (3.11 and 3.14 alike) reads a
//! result, the comment says so.

#[cfg(ipopt_hsl_loader)]
mod loader;
#[cfg(not(ipopt_hsl_loader))]
#[cfg_attr(not(target_os = "linux"), path = "hsl/no_memory_library.rs")]
mod memory_library;
mod slot;

#[cfg(ipopt_hsl_loader)]
pub use loader::{HslLoader, hsl_loader};
pub use slot::{Ma57Slot, SetMa57, SlotError, ma57_slot};

use std::ffi::c_int;

/// Fortran's `INTEGER`.
pub type ipfint = c_int;

/// Defaults, into `cntl` (5) and `icntl` (20).
pub type ma57id_t = Option<unsafe extern "C" fn(cntl: *mut f64, icntl: *mut ipfint)>;

/// Analysis of the pattern of `ne` triplets of one triangle. Ipopt reads `info(9)` and `info(10)`,
/// the lengths of `fact` and `ifact` it shall allocate, whatever `info(1)` says.
pub type ma57ad_t = Option<
    unsafe extern "C" fn(
        n: *mut ipfint,
        ne: *mut ipfint,
        irn: *const ipfint,
        jcn: *const ipfint,
        lkeep: *mut ipfint,
        keep: *mut ipfint,
        iwork: *mut ipfint,
        icntl: *mut ipfint,
        info: *mut ipfint,
        rinfo: *mut f64,
    ),
>;

/// Factorisation with the values `a`. Ipopt reads `info(1)`: 0 done, 4 singular, −3 and −4 more
/// room needed (`info(17)`, `info(18)`), anything else fatal; and `info(24)`, the number of
/// negative eigenvalues. `cntl(1)` is the pivot tolerance, which Ipopt may raise and try again.
pub type ma57bd_t = Option<
    unsafe extern "C" fn(
        n: *mut ipfint,
        ne: *mut ipfint,
        a: *mut f64,
        fact: *mut f64,
        lfact: *mut ipfint,
        ifact: *mut ipfint,
        lifact: *mut ipfint,
        lkeep: *mut ipfint,
        keep: *mut ipfint,
        iwork: *mut ipfint,
        icntl: *mut ipfint,
        cntl: *mut f64,
        info: *mut ipfint,
        rinfo: *mut f64,
    ),
>;

/// Solution for `nrhs` right-hand sides, columns of `rhs` that are `lrhs` apart, in place. A
/// nonzero `info(1)` is logged, no more.
pub type ma57cd_t = Option<
    unsafe extern "C" fn(
        job: *mut ipfint,
        n: *mut ipfint,
        fact: *mut f64,
        lfact: *mut ipfint,
        ifact: *mut ipfint,
        lifact: *mut ipfint,
        nrhs: *mut ipfint,
        rhs: *mut f64,
        lrhs: *mut ipfint,
        work: *mut f64,
        lwork: *mut ipfint,
        iwork: *mut ipfint,
        icntl: *mut ipfint,
        info: *mut ipfint,
    ),
>;

/// Copies factors into larger arrays, after −3 or −4 from the factorisation.
pub type ma57ed_t = Option<
    unsafe extern "C" fn(
        n: *mut ipfint,
        ic: *mut ipfint,
        keep: *mut ipfint,
        fact: *mut f64,
        lfact: *mut ipfint,
        newfac: *mut f64,
        lnew: *mut ipfint,
        ifact: *mut ipfint,
        lifact: *mut ipfint,
        newifc: *mut ipfint,
        linew: *mut ipfint,
        info: *mut ipfint,
    ),
>;
