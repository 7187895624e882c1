#[cfg(all(target_os = "linux", target_env = "gnu"))]
use std::hint::black_box;

/// From this size on the C library maps memory for each vector by itself, bytes: the most that it allows.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MAPPED_FROM: libc::c_int = 32 << 20;
/// So much freed memory it keeps, bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: libc::c_int = 512 << 20;
/// So much address space the heap gets in one piece, bytes; memory only where it is used.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const HEAP: libc::c_int = 256 << 20;
/// What glibc takes beyond a request by itself, bytes (`M_TOP_PAD`).
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const USUAL_PAD: libc::c_int = 128 << 10;
/// Larger than what the heap has left when the process starts, smaller than what is mapped apart, bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const PROBE: usize = 1 << 20;

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

/// Asks the system for huge pages in the first quarter of a gigabyte of this process's heap, so that a
/// short solve does not spend a sixth of its time on the first use of 3,000 small ones. To be called once,
/// before there is much on the heap. Does nothing with another C library, or where the system has none to
/// give.
pub fn prefer_huge_pages() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: as above for mallopt; sbrk(0) only reads; the probe is freed at once; and the advice covers
    // the pages that the heap grew by in between, whole ones, and changes nothing of what they hold.
    unsafe {
        let end_of_heap = || libc::sbrk(0) as usize;
        let start = end_of_heap();
        libc::mallopt(libc::M_TOP_PAD, HEAP);
        libc::free(black_box(libc::malloc(black_box(PROBE))));
        libc::mallopt(libc::M_TOP_PAD, USUAL_PAD);
        let grown = end_of_heap().saturating_sub(start);
        if grown > 0 {
            libc::madvise(start as *mut libc::c_void, grown, libc::MADV_HUGEPAGE);
        }
    }
}
