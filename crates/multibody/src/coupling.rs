//! Constants of the recursion that gathers moments and momenta from the tip inward.

use crate::inertia::MassMoments;
use nalgebra::{Matrix3, Vector3};

/// How the moments of what lies beyond joint k change on the way from the origin of K(k+1) to that
/// of K(k), where they take in body k.
///
/// Every mass counts relative to the system's centre of mass (the barycentric or augmented-body
/// form: S̃ = S − F Fᵀ/M with F the first moment, S the second, M the total mass). The recursion is as
/// cheap as without, and no correction is left at the end:
///
/// ```text
/// F' = F + g,                       g = m o + f
/// S̃' = S̃ + F bᵀ + b Fᵀ + C,         b = o − g/M,   C = m o oᵀ + s − g gᵀ/M
/// ```
///
/// with m the mass beyond, o the offset, f and s the body's own moments. For a body whose mass lies
/// along its offset C = κ b bᵀ, so that S̃' = S̃ + G bᵀ + b Gᵀ with G = F + κ b/2.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coupling {
    /// g, kg m.
    pub first: Vector3<f64>,
    /// b, m.
    pub arm: Vector3<f64>,
    /// κ b/2, kg m; zero where the body's mass does not lie along its offset.
    pub half: Vector3<f64>,
    /// C, kg m²; none where κ b bᵀ is all of it.
    pub rest: Option<Matrix3<f64>>,
    /// g/b where both are parallel, kg.
    pub first_over_arm: Option<f64>,
}

/// Relative size of entries that are zero but for rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Coupling {
    /// Of nothing.
    pub fn none() -> Self {
        Self::new(Barycentric::new(&MassMoments::zero(), &Vector3::zeros(), 0.0, 1.0))
    }

    pub fn new(Barycentric { first, arm, second }: Barycentric) -> Self {
        let arm_squared = arm.norm_squared();
        let over_arm = |x: f64| if arm_squared > 0.0 { x / arm_squared } else { 0.0 };
        let ratio = over_arm(first.dot(&arm));
        let parallel = (first - arm * ratio).amax() <= ROUNDING * first.amax();
        let first_over_arm = parallel.then_some(ratio);

        let factor = over_arm(over_arm(arm.dot(&(second * arm))));
        let rounding = ROUNDING * second.amax();
        let along_arm = (second - arm * arm.transpose() * factor).amax() <= rounding;
        let (half, rest) = if along_arm {
            (arm * (factor / 2.0), None)
        } else {
            (Vector3::zeros(), Some(without_rounding(&second)))
        };
        Self { first, arm, half, rest, first_over_arm }
    }
}

/// g, b and C of [`Coupling`].
pub(crate) struct Barycentric {
    pub first: Vector3<f64>,
    pub arm: Vector3<f64>,
    pub second: Matrix3<f64>,
}

impl Barycentric {
    /// Of `body` with a mass `beyond` at `offset`, in a system of mass `total`.
    pub fn new(body: &MassMoments, offset: &Vector3<f64>, beyond: f64, total: f64) -> Self {
        let first = offset * beyond + body.first;
        let second =
            offset * offset.transpose() * beyond + body.second - first * first.transpose() / total;
        Self { first, arm: offset - first / total, second }
    }

    /// Whether no product of the system's numbers overflowed.
    pub fn is_finite(&self) -> bool {
        let vectors = self.first.iter().chain(&self.arm);
        vectors.chain(&self.second).all(|value| value.is_finite())
    }

    /// Counted about a point farther inward by `shift`, which turns with the body.
    pub fn shifted(self, shift: &Vector3<f64>) -> Self {
        let mixed = self.first * shift.transpose();
        Self {
            first: self.first,
            arm: self.arm + shift,
            second: self.second + mixed + mixed.transpose(),
        }
    }
}

/// How the base takes in the arm, in the axes that joint 1 turns in: a [`Coupling`] without the part
/// of its b that lies along joint 1.
///
/// That part may be taken in before joint 1 turns, so joint 1's coupling has it. Where the joint's
/// axis passes through the base's centre of mass it is all there is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RootCoupling {
    /// g, kg m.
    pub first: Vector3<f64>,
    /// C, kg m².
    pub second: Matrix3<f64>,
    /// b across joint 1, m.
    pub across: Vector3<f64>,
    /// Whether the base looks the same to joint 1 however it turns.
    pub symmetric: bool,
}

impl RootCoupling {
    pub fn none() -> Self {
        let zero = Vector3::zeros();
        Self { first: zero, second: Matrix3::zeros(), across: zero, symmetric: true }
    }

    /// From g, b and C in body axes, and the rotation from joint 1's axes to those. Also returns
    /// the part of b along joint 1.
    pub fn new(base: &Barycentric, root_rotation: &Matrix3<f64>) -> (Self, Vector3<f64>) {
        let back = root_rotation.transpose();
        let arm = back * base.arm;
        let across = Vector3::new(arm.x, arm.y, 0.0);
        let second = without_rounding(&(back * base.second * root_rotation));
        let diagonal = second == Matrix3::from_diagonal(&second.diagonal());
        let round = (second.m11 - second.m22).abs() <= ROUNDING * second.amax();
        let first = back * base.first;
        let on_axis = across.amax() == 0.0 && first.x == 0.0 && first.y == 0.0;
        let root = Self { first, second, across, symmetric: diagonal && round && on_axis };
        (root, Vector3::new(0.0, 0.0, arm.z))
    }

    /// With all of b: where more than one branch comes together at joint 1 or at the base.
    pub fn whole(base: &Barycentric, root_rotation: &Matrix3<f64>) -> Self {
        let (root, along) = Self::new(base, root_rotation);
        Self { across: root.across + along, symmetric: false, ..root }
    }
}

fn without_rounding(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let rounding = ROUNDING * matrix.amax();
    matrix.map(|entry| if entry.abs() > rounding { entry } else { 0.0 })
}
