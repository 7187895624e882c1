//! Where Ipopt takes MA57 from.

use super::{ma57ad_t, ma57bd_t, ma57cd_t, ma57ed_t, ma57id_t};
use crate::LoadError;
use std::sync::OnceLock;
use thiserror::Error;

/// Makes these the MA57 of this process (`LSL_setMA57`).
pub type SetMa57 = unsafe extern "C" fn(
    ma57ad: ma57ad_t,
    ma57bd: ma57bd_t,
    ma57cd: ma57cd_t,
    ma57ed: ma57ed_t,
    ma57id: ma57id_t,
);

/// How Ipopt is given an MA57 of the program's own.
#[derive(Debug, Clone)]
pub struct Ma57Slot {
    /// To be called with all five routines before the first solve with them.
    pub set: SetMa57,
    /// What Ipopt's option `hsllib` must be in every such solve; none before Ipopt 3.14.
    pub hsllib: Option<String>,
}

/// Why Ipopt cannot be given an MA57.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SlotError {
    /// There is no Ipopt.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The library that passes Ipopt's calls on cannot be put into memory.
    #[error("cannot make the library in memory that Ipopt {} calls: {reason}", crate::VERSION)]
    NoMemoryLibrary {
        /// What the system says.
        reason: String,
    },
}

/// The slot, made ready by the first call.
///
/// # Errors
/// [`SlotError`], the same at every call.
pub fn ma57_slot() -> Result<&'static Ma57Slot, SlotError> {
    static SLOT: OnceLock<Result<Ma57Slot, SlotError>> = OnceLock::new();
    SLOT.get_or_init(make).as_ref().map_err(Clone::clone)
}

#[cfg(ipopt_hsl_loader)]
fn make() -> Result<Ma57Slot, SlotError> {
    Ok(Ma57Slot { set: super::hsl_loader()?.LSL_setMA57, hsllib: None })
}

#[cfg(not(ipopt_hsl_loader))]
fn make() -> Result<Ma57Slot, SlotError> {
    super::memory_library::make().map_err(|reason| SlotError::NoMemoryLibrary { reason })
}
