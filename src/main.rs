//! Command line of Righting.
fn main() {}
