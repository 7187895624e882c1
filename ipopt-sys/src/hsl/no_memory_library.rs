//! Where the system has no files in memory that a library can be opened from.

use super::Ma57Slot;

pub(super) fn make() -> Result<Ma57Slot, String> {
    Err("this needs Linux".to_owned())
}
