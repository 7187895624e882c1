//! What a system is put together from.

use crate::error::{ModelError, Part};
use crate::inertia::{self, Definiteness};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// The base body.
#[derive(Debug, Clone, PartialEq)]
pub struct Base {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass from the origin of the body frame, body axes, m.
    pub center_of_mass_m: Vector3<f64>,
    /// Inertia about the centre of mass, body axes, kg m².
    pub inertia_kg_m2: Matrix3<f64>,
}

impl Base {
    /// A uniform cube of side `side_m` about the origin: inertia m s²/6 about every axis.
    ///
    /// # Errors
    /// The side is not a positive, finite number.
    pub fn uniform_cube(mass_kg: f64, side_m: f64) -> Result<Self, ModelError> {
        if !(side_m > 0.0 && side_m.is_finite()) {
            return Err(ModelError::CubeSide { side_m });
        }
        let moment = mass_kg * side_m * side_m / 6.0;
        let inertia_kg_m2 = Matrix3::from_diagonal_element(moment);
        Ok(Self { mass_kg, center_of_mass_m: Vector3::zeros(), inertia_kg_m2 })
    }

    pub(crate) fn check(&self) -> Result<(), ModelError> {
        check_mass(Part::Base, self.mass_kg)?;
        if self.mass_kg == 0.0 {
            return Err(ModelError::MasslessBase);
        }
        for value in &self.center_of_mass_m {
            check_finite(Part::Base, "center_of_mass_m", *value)?;
        }
        inertia::check(Part::Base, &self.inertia_kg_m2, Definiteness::Positive)
    }
}

/// Where the arm's frame 0 sits on the base.
#[derive(Debug, Clone, PartialEq)]
pub struct Mount {
    /// Origin 0 from the body-frame origin, body axes, m.
    pub position_m: Vector3<f64>,
    /// Turns vectors of frame 0 into body axes.
    pub rotation: Rotation3<f64>,
}

impl Mount {
    /// Frame 0 parallel to the body frame, its origin at `position_m`.
    pub fn at(position_m: Vector3<f64>) -> Self {
        Self { position_m, rotation: Rotation3::identity() }
    }

    pub(crate) fn check(&self) -> Result<(), ModelError> {
        for value in &self.position_m {
            check_finite(Part::Mount, "position_m", *value)?;
        }
        check_rotation(Part::Mount, "rotation", self.rotation.matrix())
    }
}

/// Which frame a row of Denavit-Hartenberg parameters places.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhConvention {
    /// Distal: T(i−1→i) = Rz(θ + q) Tz(d) Tx(a) Rx(α). Joint i turns about z(i−1), and link i moves
    /// with frame i.
    Standard,
    /// Proximal (Craig): T(i−1→i) = Rx(α) Tx(a) Rz(θ + q) Tz(d), α and a of the same row. Joint i
    /// turns about z(i); the segment of row i lies between origins i−1 and i and moves with
    /// frame i−1, so that of row 1 is fixed to the base. So does the mass of row i, unless its
    /// [`InertialFrame`] says otherwise.
    Modified,
}

impl DhConvention {
    /// The frame that a row's mass moves with where the row does not say: the one that its segment
    /// moves with.
    pub fn inertial_frame(self) -> InertialFrame {
        match self {
            Self::Standard => InertialFrame::Own,
            Self::Modified => InertialFrame::Previous,
        }
    }
}

/// The frame that the mass of row i moves with, and that its center of mass and inertia are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InertialFrame {
    /// Frame i, which joint i moves: what Craig's tables and ROS files mean by the mass of link i.
    Own,
    /// Frame i−1, which joint i does not move. Not with standard parameters.
    Previous,
}

/// One row of Denavit-Hartenberg parameters and the link that spans it.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Length along x, m.
    pub a_m: f64,
    /// Twist about x, rad.
    pub alpha_rad: f64,
    /// Offset along z, m.
    pub d_m: f64,
    /// Angle about z where the joint coordinate is zero, rad.
    pub theta_rad: f64,
    /// The frame that the mass moves with; the convention's if not given (see
    /// [`DhConvention::inertial_frame`]).
    pub inertial_frame: Option<InertialFrame>,
    /// Centre of mass in the frame that the mass moves with, m. Half way between the two origins if
    /// not given.
    pub center_of_mass_m: Option<Vector3<f64>>,
    /// Inertia about the centre of mass in the axes of the frame that the mass moves with, kg m².
    /// That of a uniform slender rod between the two origins if not given: zero where they coincide.
    pub inertia_kg_m2: Option<Matrix3<f64>>,
}

impl Link {
    /// A uniform slender rod along the straight segment between the link's two origins; a point
    /// mass where they coincide.
    pub fn rod(mass_kg: f64, a_m: f64, alpha_rad: f64, d_m: f64, theta_rad: f64) -> Self {
        Self {
            mass_kg,
            a_m,
            alpha_rad,
            d_m,
            theta_rad,
            inertial_frame: None,
            center_of_mass_m: None,
            inertia_kg_m2: None,
        }
    }

    /// Distance between the link's two origins, m.
    pub fn length_m(&self) -> f64 {
        self.a_m.hypot(self.d_m)
    }

    pub(crate) fn check(&self, part: Part, convention: DhConvention) -> Result<(), ModelError> {
        check_mass(part, self.mass_kg)?;
        self.check_inertial_frame(part, convention)?;
        for (quantity, value) in [
            ("a_m", self.a_m),
            ("alpha_rad", self.alpha_rad),
            ("d_m", self.d_m),
            ("theta_rad", self.theta_rad),
        ] {
            check_finite(part, quantity, value)?;
        }
        for value in self.center_of_mass_m.iter().flatten() {
            check_finite(part, "center_of_mass_m", *value)?;
        }
        check_inertia(part, self.mass_kg, self.inertia_kg_m2.as_ref())
    }

    /// The segment between the two origins, from which the defaults come, moves with the convention's
    /// frame: in another one nothing says where the mass is.
    fn check_inertial_frame(&self, part: Part, convention: DhConvention) -> Result<(), ModelError> {
        let usual = convention.inertial_frame();
        let frame = self.inertial_frame.unwrap_or(usual);
        match (convention, frame) {
            _ if frame == usual => Ok(()),
            (DhConvention::Standard, _) => Err(ModelError::PreviousFrame { part }),
            (DhConvention::Modified, _) => {
                let missing = [
                    ("center_of_mass_m", self.center_of_mass_m.is_none()),
                    ("inertia_kg_m2", self.inertia_kg_m2.is_none()),
                ];
                match missing.into_iter().find(|(_, is_missing)| *is_missing) {
                    Some((quantity, _)) if self.mass_kg > 0.0 => {
                        Err(ModelError::MissingInertial { part, quantity })
                    }
                    _ => Ok(()),
                }
            }
        }
    }
}

/// A body held rigidly at the last origin, moving with the last frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Payload {
    /// Mass, kg. Its centre is the last origin.
    pub mass_kg: f64,
    /// Inertia about its centre, axes of the last frame, kg m². A point mass if not given.
    pub inertia_kg_m2: Option<Matrix3<f64>>,
}

impl Payload {
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        check_mass(Part::Payload, self.mass_kg)?;
        check_inertia(Part::Payload, self.mass_kg, self.inertia_kg_m2.as_ref())
    }
}

/// Checks that a matrix turns vectors.
pub(crate) fn check_rotation(
    part: Part,
    quantity: &'static str,
    matrix: &Matrix3<f64>,
) -> Result<(), ModelError> {
    for value in matrix {
        check_finite(part, quantity, *value)?;
    }
    let mut deviation = (matrix.transpose() * matrix - Matrix3::identity()).amax();
    if matrix.determinant() < 0.0 {
        deviation = deviation.max(2.0);
    }
    match deviation > 1e-9 {
        true => Err(ModelError::NotARotation { part, deviation }),
        false => Ok(()),
    }
}

pub(crate) fn check_inertia(
    part: Part,
    mass_kg: f64,
    inertia_kg_m2: Option<&Matrix3<f64>>,
) -> Result<(), ModelError> {
    let Some(matrix) = inertia_kg_m2 else { return Ok(()) };
    inertia::check(part, matrix, Definiteness::Semidefinite)?;
    if mass_kg == 0.0 && matrix.amax() > 0.0 {
        return Err(ModelError::InertiaWithoutMass { part });
    }
    Ok(())
}

pub(crate) fn check_mass(part: Part, mass_kg: f64) -> Result<(), ModelError> {
    check_finite(part, "mass_kg", mass_kg)?;
    if mass_kg < 0.0 {
        return Err(ModelError::NegativeMass { part, mass_kg });
    }
    Ok(())
}

pub(crate) fn check_finite(
    part: Part,
    quantity: &'static str,
    value: f64,
) -> Result<(), ModelError> {
    if value.is_finite() { Ok(()) } else { Err(ModelError::NotFinite { part, quantity, value }) }
}
