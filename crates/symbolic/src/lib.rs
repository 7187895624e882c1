//! Symbolic expressions compiled to SIMD batch functions.
