//! Branches on their way inward: what each hands to the joint or to the base where it begins.

use crate::algebra::{PlaneRotation, cross, scaled, sum};
use crate::sweep::{Moments, Pair};
use crate::tree::Tree;
use crate::turn::Turn;
use nalgebra::Matrix3;
use righting_scalar::Scalar;

/// What lies beyond a place of the tree: its moments, and its momenta or its force and moment.
#[derive(Clone, Copy)]
pub(crate) struct Beyond<T> {
    pub moments: Moments<T>,
    pub pair: Pair<T>,
}

impl<T: Scalar> Beyond<T> {
    pub fn nothing() -> Self {
        Self { moments: Moments::zero(), pair: Pair::zero() }
    }

    /// Without momenta.
    pub fn at_rest(moments: Moments<T>) -> Self {
        Self { moments, pair: Pair::zero() }
    }

    /// From the axes of the next group to those of K.
    pub fn twisted(self, twist: Turn) -> Self {
        Self { moments: self.moments.twisted(twist), pair: self.pair.twisted(twist) }
    }

    /// Seen from the axes into which `rotation` turns.
    pub fn rotated(self, rotation: &Matrix3<f64>) -> Self {
        Self { moments: self.moments.rotated(rotation), pair: self.pair.rotated(rotation) }
    }

    /// From the axes of K to those in which its group turns.
    pub fn turned(self, rotation: &PlaneRotation<T>) -> Self {
        Self { moments: self.moments.turned(rotation), pair: self.pair.turned(rotation) }
    }

    /// Both taken together, counted from the same origin in the same axes. Barycentric moments are not
    /// additive: with F of each and P its momentum or force,
    ///
    /// ```text
    /// S̃ = S̃₁ + S̃₂ − (F₁ F₂ᵀ + F₂ F₁ᵀ)/M,     H = H₁ + H₂ − (F₁ × P₂ + F₂ × P₁)/M
    /// ```
    fn joined(self, other: &Self, total_mass: f64) -> Self {
        let (own, others) = (&self.moments, &other.moments);
        let share = scaled(&others.first, T::from(-total_mass.recip()));
        let second = own.second.plus_matrix(&others.second).plus_outer(&own.first, &share);
        let mixed = sum(
            &cross(&share, &self.pair.linear),
            &scaled(&cross(&own.first, &other.pair.linear), T::from(-total_mass.recip())),
        );
        let Pair { linear, angular } = self.pair.plus(&other.pair);
        Self {
            moments: Moments { first: sum(&own.first, &others.first), second },
            pair: Pair { linear, angular: sum(&angular, &mixed) },
        }
    }
}

/// What the branches at each joint and at the base have handed over so far.
pub(crate) struct Branches<T> {
    total_mass: f64,
    at_joints: Vec<Option<Beyond<T>>>,
    at_base: Option<Beyond<T>>,
}

impl<T: Scalar> Branches<T> {
    pub fn of(tree: &Tree) -> Self {
        Self {
            total_mass: tree.total_mass,
            at_joints: tree.joints.iter().map(|_| None).collect(),
            at_base: None,
        }
    }

    /// Takes over a branch that begins at `parent`, in the axes of K of that or of the body.
    pub fn hand_over(&mut self, parent: Option<usize>, beyond: Beyond<T>) {
        let place = match parent {
            Some(joint) => &mut self.at_joints[joint],
            None => &mut self.at_base,
        };
        *place = Some(match place {
            Some(others) => others.joined(&beyond, self.total_mass),
            None => beyond,
        });
    }

    /// What goes on from `joint`, the base if none, together with the branches there.
    pub fn join(&self, joint: Option<usize>, onward: Beyond<T>) -> Beyond<T> {
        let branches = match joint {
            Some(joint) => &self.at_joints[joint],
            None => &self.at_base,
        };
        branches.as_ref().map_or(onward, |branches| onward.joined(branches, self.total_mass))
    }
}
