//! What this binary was built from, stamped in by the build script.

/// Version and, where it was built from a checkout, revision: "0.1.0 (828d637)".
pub const VERSION: &str = env!("RIGHTING_VERSION");

/// The compiler: "1.95.0 (59807616e 2026-04-14)".
pub const RUSTC: &str = env!("RIGHTING_RUSTC");

/// The platform it was built for.
pub const TARGET: &str = env!("RIGHTING_TARGET");
