/// From this size on the C library maps memory for each vector by itself, bytes: the most that it allows.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MAPPED_FROM: libc::c_int = 32 << 20;
/// So much freed memory it keeps, bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: libc::c_int = 512 << 20;

/// Lets this process keep the memory that it frees, up to half a gigabyte. A solve allocates and frees
/// vectors as long as its variables over and over, and glibc by itself returns them to the system, which
/// clears their pages anew each time: 3 to 6 % of a short solve. Does nothing with another C library.
pub fn keep_freed_memory() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: mallopt may be called at any time, from any thread, with any values; those it refuses
    // change nothing.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, MAPPED_FROM);
        libc::mallopt(libc::M_TRIM_THRESHOLD, KEPT);
    }
}
