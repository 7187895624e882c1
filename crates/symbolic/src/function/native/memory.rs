//! Executable memory.
#![expect(unsafe_code, reason = "calls generated code")]

use memmap2::{Mmap, MmapMut};

/// The generated code preserves what the System V convention says it must.
#[cfg(target_arch = "x86_64")]
type Function = extern "sysv64" fn(*mut f64);
/// Never called: no instruction set that there is code for is available.
#[cfg(not(target_arch = "x86_64"))]
type Function = extern "C" fn(*mut f64);

/// Machine code of functions from one address to nothing, immutable.
#[derive(Debug)]
pub(super) struct Code(Mmap);

impl Code {
    /// Copies code into executable memory; `None` where the system forbids such memory.
    pub(super) fn new(code: &[u8]) -> Option<Self> {
        let mut map = MmapMut::map_anon(code.len().max(1)).ok()?;
        map[..code.len()].copy_from_slice(code);
        map.make_exec().ok().map(Code)
    }

    /// Calls the function that starts at `offset`.
    ///
    /// # Safety
    /// A function following the System V calling convention must start there, this machine must
    /// have its instructions, and `argument` must be what it expects.
    pub(super) unsafe fn call(&self, offset: usize, argument: *mut f64) {
        let address = self.0[offset..].as_ptr();
        // SAFETY: the caller vouches for what is at that address.
        let function: Function = unsafe { std::mem::transmute(address) };
        function(argument);
    }
}
