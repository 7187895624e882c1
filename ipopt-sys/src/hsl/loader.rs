//! `HSLLoader.h` of Ipopt up to 3.13.

use super::{ma57ad_t, ma57bd_t, ma57cd_t, ma57ed_t, ma57id_t};
use crate::LoadError;
use crate::functions::functions;
use crate::library;
use std::ffi::{c_char, c_int};
use std::sync::OnceLock;

functions! {
    /// The loader of the HSL routines, a part of Ipopt's library.
    pub struct HslLoader;

    /// Makes these the MA57 of this process.
    fn LSL_setMA57(
        ma57ad: ma57ad_t,
        ma57bd: ma57bd_t,
        ma57cd: ma57cd_t,
        ma57ed: ma57ed_t,
        ma57id: ma57id_t,
    );

    /// Loads the HSL shared library (null: its default name) and every routine found in it, which
    /// replaces what was set before. Zero on success, else a message in `msgbuf`.
    fn LSL_loadHSL(libname: *const c_char, msgbuf: *mut c_char, msglen: c_int) -> c_int;
    /// Unloads it; every routine is then unset. Zero on success.
    fn LSL_unloadHSL() -> c_int;
    /// Nonzero when a shared library is loaded.
    fn LSL_isHSLLoaded() -> c_int;
    /// The name under which the shared library is looked for.
    fn LSL_HSLLibraryName() -> *mut c_char;

    /// Nonzero when all of MA27 is set.
    fn LSL_isMA27available() -> c_int;
    /// Nonzero when all of MA28 is set.
    fn LSL_isMA28available() -> c_int;
    /// Nonzero when all of MA57 is set.
    fn LSL_isMA57available() -> c_int;
    /// Nonzero when all of HSL_MA77 is set.
    fn LSL_isMA77available() -> c_int;
    /// Nonzero when all of HSL_MA86 is set.
    fn LSL_isMA86available() -> c_int;
    /// Nonzero when all of HSL_MA97 is set.
    fn LSL_isMA97available() -> c_int;
    /// Nonzero when MC19 is set.
    fn LSL_isMC19available() -> c_int;
    /// Nonzero when all of HSL_MC68 is set.
    fn LSL_isMC68available() -> c_int;
}

/// The loader's functions; the first call opens the library unless it is linked.
///
/// # Errors
/// [`LoadError`], the same at every call.
pub fn hsl_loader() -> Result<&'static HslLoader, LoadError> {
    static LOADER: OnceLock<Result<HslLoader, LoadError>> = OnceLock::new();
    // SAFETY: `tests/abi.rs` holds the declarations against the header of this version.
    LOADER
        .get_or_init(|| unsafe { HslLoader::resolve(library::library()?) })
        .as_ref()
        .map_err(Clone::clone)
}
