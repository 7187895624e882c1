//! How many threads a BLAS uses. Not part of Ipopt's interface, but only whoever opened the library
//! reaches the BLAS that came with it.

use crate::library::{LoadError, library};
use std::ffi::c_int;

/// Makes the BLAS of this process, if it is a threaded one that is known (OpenBLAS, MKL, BLIS), use
/// one thread; opens Ipopt's library unless that is done.
///
/// To be called before the first solve. It goes before what the environment says.
///
/// # Errors
/// [`LoadError`] when there is no Ipopt.
pub fn use_one_blas_thread() -> Result<(), LoadError> {
    type ByInt = unsafe extern "C" fn(c_int);
    /// With BLIS's `dim_t`.
    type ByDimension = unsafe extern "C" fn(i64);

    let library = library()?;
    // SAFETY: the functions have these types in every release of their libraries, and may be called
    // at any time.
    unsafe {
        for name in ["openblas_set_num_threads", "MKL_Set_Num_Threads"] {
            if let Some(set) = library.optional_function::<ByInt>(name) {
                set(1);
            }
        }
        if let Some(set) = library.optional_function::<ByDimension>("bli_thread_set_num_threads") {
            set(1);
        }
    }
    Ok(())
}
