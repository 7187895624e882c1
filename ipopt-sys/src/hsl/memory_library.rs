//! The shared library that Ipopt 3.14 opens for MA57 (`ma57_library.c`), as a file in memory.
//!
//! It is opened here first. The loader of shared libraries knows a file that is open already, so
//! that Ipopt, which opens and closes it in every solve, gets the one that knows the program's
//! routines.

use super::{Ma57Slot, SetMa57};
use rustix::fs::{MemfdFlags, memfd_create};
use rustix::io::Errno;
use std::fs::File;
use std::io::Write;
use std::mem::forget;
use std::os::fd::{AsRawFd, OwnedFd};

const LIBRARY: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/ma57_library.so"));

pub(super) fn make() -> Result<Ma57Slot, String> {
    let mut file = File::from(memory_file().map_err(|error| error.to_string())?);
    file.write_all(LIBRARY).map_err(|error| error.to_string())?;
    let name = format!("/proc/self/fd/{}", file.as_raw_fd());
    // SAFETY: what was written holds six functions and five pointers; nothing runs when it opens.
    let library = unsafe { libloading::Library::new(&name) };
    let library = library.map_err(|error| format!("{name}: {error}"))?;
    // SAFETY: `ma57_library.c` defines it with this type.
    let set = unsafe { library.get::<SetMa57>("LSL_setMA57") };
    let set = *set.map_err(|error| error.to_string())?;
    // Ipopt opens it by this name as long as the process lives, and `set` points into it.
    forget(file);
    forget(library);
    Ok(Ma57Slot { set, hsllib: Some(name) })
}

/// Linux from 6.3 on wants to be told that nobody will execute the file as a program, and may refuse
/// it otherwise; older ones do not know the word.
fn memory_file() -> Result<OwnedFd, Errno> {
    let create = |flags| memfd_create("ma57", MemfdFlags::CLOEXEC | flags);
    match create(MemfdFlags::NOEXEC_SEAL) {
        Err(Errno::INVAL) => create(MemfdFlags::empty()),
        made => made,
    }
}
