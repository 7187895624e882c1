//! Systems to test with, and the equations as they are defined.
#![allow(dead_code)]

pub mod definition;
pub mod random;
pub mod table_one;

/// Asserts that two vectors agree, relative to `scale` or the larger norm.
#[track_caller]
pub fn assert_near(ours: &[f64], theirs: &[f64], tolerance: f64, scale: f64) {
    assert_eq!(ours.len(), theirs.len());
    let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let gap: Vec<f64> = ours.iter().zip(theirs).map(|(a, b)| a - b).collect();
    let size = scale.max(norm(ours)).max(norm(theirs));
    assert!(norm(&gap) <= tolerance * size, "{ours:?} against {theirs:?}, scale {size:e}");
}
