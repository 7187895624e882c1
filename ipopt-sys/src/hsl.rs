//! The loader of the HSL linear solvers (`HSLLoader.h`), through which a program can bring its own.
//!
//! Ipopt calls the functions set by [`LSL_setMA57`] whenever `linear_solver` is `ma57`, and looks
//! for a shared library only while they are unset. They follow Fortran's conventions: every
//! argument is a pointer, indices count from one. Array lengths are those of the MA57
//! documentation; where Ipopt 3.11 reads a result, the comment says so.

use std::ffi::{c_char, c_int};

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

unsafe extern "C" {
    /// Makes these the MA57 of this process.
    pub fn LSL_setMA57(
        ma57ad: ma57ad_t,
        ma57bd: ma57bd_t,
        ma57cd: ma57cd_t,
        ma57ed: ma57ed_t,
        ma57id: ma57id_t,
    );

    /// Loads the HSL shared library (null: its default name) and every routine found in it, which
    /// replaces what was set before. Zero on success, else a message in `msgbuf`.
    pub fn LSL_loadHSL(libname: *const c_char, msgbuf: *mut c_char, msglen: c_int) -> c_int;
    /// Unloads it; every routine is then unset. Zero on success.
    pub fn LSL_unloadHSL() -> c_int;
    /// Nonzero when a shared library is loaded.
    pub fn LSL_isHSLLoaded() -> c_int;
    /// The name under which the shared library is looked for.
    pub fn LSL_HSLLibraryName() -> *mut c_char;

    /// Nonzero when all of MA27 is set.
    pub fn LSL_isMA27available() -> c_int;
    /// Nonzero when all of MA28 is set.
    pub fn LSL_isMA28available() -> c_int;
    /// Nonzero when all of MA57 is set.
    pub fn LSL_isMA57available() -> c_int;
    /// Nonzero when all of HSL_MA77 is set.
    pub fn LSL_isMA77available() -> c_int;
    /// Nonzero when all of HSL_MA86 is set.
    pub fn LSL_isMA86available() -> c_int;
    /// Nonzero when all of HSL_MA97 is set.
    pub fn LSL_isMA97available() -> c_int;
    /// Nonzero when MC19 is set.
    pub fn LSL_isMC19available() -> c_int;
    /// Nonzero when all of HSL_MC68 is set.
    pub fn LSL_isMC68available() -> c_int;
}
