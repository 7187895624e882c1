//! Ipopt, loaded by the commands that solve and by no other: loading it takes longer than most of them.

use crate::failure::Failure;

/// Loads Ipopt, so that a machine without it says so before anything is written.
///
/// Its BLAS gets one thread: more of them make the small fronts of these problems slower and the
/// rounding depend on the machine.
pub fn load() -> Result<(), Failure> {
    Ok(righting_ipopt::use_one_blas_thread()?)
}
