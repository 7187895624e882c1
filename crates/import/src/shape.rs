//! What a link occupies.

use nalgebra::{Matrix3, Vector3};
use righting_multibody::Placement;

use crate::bounding_capsule::bounding_capsule;

/// All points no farther than a radius from a straight segment; a sphere where its ends are one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Ends of the segment, m.
    pub ends_m: [Vector3<f64>; 2],
    /// Radius, m.
    pub radius_m: f64,
}

/// A box, in any orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Its center, and the axes of its edges.
    pub placement: Placement,
    /// Lengths of its edges, m.
    pub size_m: Vector3<f64>,
}

/// A convex piece of a body, in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A capsule or a sphere.
    Capsule(Capsule),
    /// A box.
    Cuboid(Cuboid),
}

impl Capsule {
    pub(crate) fn placed(&self, placement: &Placement) -> Self {
        let placed = |end: Vector3<f64>| placement.rotation * end + placement.position_m;
        Self { ends_m: self.ends_m.map(placed), ..*self }
    }

    pub(crate) fn volume_m3(&self) -> f64 {
        let [from, to] = self.ends_m;
        let disc = std::f64::consts::PI * self.radius_m.powi(2);
        disc * ((to - from).norm() + 4.0 / 3.0 * self.radius_m)
    }
}

impl Cuboid {
    /// The eight corners, m.
    pub(crate) fn corners_m(&self) -> Vec<Vector3<f64>> {
        let corner = |index: usize| {
            let sign = |axis: usize| if index >> axis & 1 == 0 { -0.5 } else { 0.5 };
            let at = Vector3::new(sign(0), sign(1), sign(2)).component_mul(&self.size_m);
            self.placement.rotation * at + self.placement.position_m
        };
        (0..8).map(corner).collect()
    }

    /// The same box with its edges along the axes of the frame, where they are.
    pub fn aligned(&self) -> Option<Self> {
        /// What turning by right angles leaves of zeros and ones.
        const ROUNDING: f64 = 1e-9;
        let magnitudes = self.placement.rotation.abs();
        let is_aligned =
            magnitudes.iter().all(|entry| *entry <= ROUNDING || (entry - 1.0).abs() <= ROUNDING);
        is_aligned.then(|| Self {
            placement: Placement { rotation: Matrix3::identity(), ..self.placement },
            size_m: magnitudes.map(f64::round) * self.size_m,
        })
    }
}

impl Shape {
    pub(crate) fn placed(&self, placement: &Placement) -> Self {
        match self {
            Self::Capsule(capsule) => Self::Capsule(capsule.placed(placement)),
            Self::Cuboid(cuboid) => {
                Self::Cuboid(Cuboid { placement: placement.then(&cuboid.placement), ..*cuboid })
            }
        }
    }

    /// A capsule that holds all of it.
    pub fn bounding_capsule(&self) -> Capsule {
        match self {
            Self::Capsule(capsule) => *capsule,
            Self::Cuboid(cuboid) => bounding_capsule(&cuboid.corners_m()),
        }
    }
}
