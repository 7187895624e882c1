//! What a link occupies.

use nalgebra::{Matrix3, Vector3};
use righting_multibody::Placement;

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

    /// Whether `other` is inside.
    fn holds(&self, other: &Self) -> bool {
        let [from, to] = self.ends_m;
        let along = to - from;
        let length_squared = along.norm_squared().max(f64::MIN_POSITIVE);
        // Both are convex, and the other's ends are its farthest points from the segment.
        other.ends_m.iter().all(|end| {
            let share = (along.dot(&(end - from)) / length_squared).clamp(0.0, 1.0);
            (end - from - along * share).norm() + other.radius_m <= self.radius_m
        })
    }

    /// Those that no other one holds; of equal ones the first.
    pub fn outermost(capsules: &[Self]) -> Vec<Self> {
        let is_outermost = |index: usize| {
            capsules.iter().enumerate().all(|(other, capsule)| {
                let is_held = other != index && capsule.holds(&capsules[index]);
                !is_held || index < other && capsules[index].holds(capsule)
            })
        };
        (0..capsules.len())
            .filter(|&index| is_outermost(index))
            .map(|index| capsules[index])
            .collect()
    }

    pub(crate) fn volume_m3(&self) -> f64 {
        let [from, to] = self.ends_m;
        let disc = std::f64::consts::PI * self.radius_m.powi(2);
        disc * ((to - from).norm() + 4.0 / 3.0 * self.radius_m)
    }
}

impl Cuboid {
    /// The smallest capsule along one of its edges that holds it: its corners are all as far off the axis.
    fn bounding_capsule(&self) -> Capsule {
        let Placement { position_m, rotation } = self.placement;
        let half_m = self.size_m / 2.0;
        let along = |axis: usize| {
            let mut across_m = half_m;
            across_m[axis] = 0.0;
            let end = rotation.column(axis) * half_m[axis];
            Capsule { ends_m: [position_m - end, position_m + end], radius_m: across_m.norm() }
        };
        let ball = Capsule { ends_m: [position_m; 2], radius_m: half_m.norm() };
        let capsules = [along(0), along(1), along(2)].into_iter();
        let smaller = |a: Capsule, b: Capsule| if b.volume_m3() < a.volume_m3() { b } else { a };
        capsules.fold(ball, smaller)
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
            Self::Cuboid(cuboid) => cuboid.bounding_capsule(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_held_along_its_longest_edge_and_a_cube_by_a_ball() {
        let of = |size: [f64; 3]| {
            let placement = Placement { position_m: Vector3::x(), ..Placement::identity() };
            Shape::Cuboid(Cuboid { placement, size_m: size.into() }).bounding_capsule()
        };
        let long = of([0.06, 2.0, 0.08]);
        assert_eq!(long.ends_m, [Vector3::new(1.0, -1.0, 0.0), Vector3::new(1.0, 1.0, 0.0)]);
        assert!((long.radius_m - 0.05).abs() < 1e-15);
        let cube = of([2.0; 3]);
        assert_eq!(cube.ends_m, [Vector3::x(); 2]);
        assert!((cube.radius_m - 3.0_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn what_is_inside_another_is_left_out() {
        let end = Vector3::new(0.0, 0.0, 1.0);
        let rod = Capsule { ends_m: [Vector3::zeros(), end], radius_m: 0.1 };
        let cap = Capsule { ends_m: [end; 2], radius_m: 0.1 };
        let knob = Capsule { ends_m: [end; 2], radius_m: 0.11 };
        assert_eq!(Capsule::outermost(&[cap, rod, cap]), [rod]);
        assert_eq!(Capsule::outermost(&[knob, rod]), [knob, rod]);
        assert_eq!(Capsule::outermost(&[cap, cap, cap]), [cap]);
        assert_eq!(Capsule::outermost(&[]), []);
    }
}
