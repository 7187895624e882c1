//! A free-floating base with an arm: the validated model.

use crate::chain::Chain;
use crate::error::{ModelError, Part};
use crate::inertia::{self, Definiteness};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// The base body. Its centre of mass is the origin of the body frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Base {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Inertia about the centre of mass, body axes, kg m².
    pub inertia_kg_m2: Matrix3<f64>,
}

impl Base {
    /// A uniform cube of side `side_m`: inertia m s²/6 about every axis.
    ///
    /// # Errors
    /// The side is not a positive, finite number.
    pub fn uniform_cube(mass_kg: f64, side_m: f64) -> Result<Self, ModelError> {
        if !(side_m > 0.0 && side_m.is_finite()) {
            return Err(ModelError::CubeSide { side_m });
        }
        let moment = mass_kg * side_m * side_m / 6.0;
        Ok(Self { mass_kg, inertia_kg_m2: Matrix3::from_diagonal_element(moment) })
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
}

/// Which frame a row of Denavit-Hartenberg parameters places.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhConvention {
    /// Distal: T(i−1→i) = Rz(θ + q) Tz(d) Tx(a) Rx(α). Joint i turns about z(i−1), and link i moves
    /// with frame i.
    Standard,
    /// Proximal (Craig): T(i−1→i) = Rx(α) Tx(a) Rz(θ + q) Tz(d), α and a of the same row. Joint i
    /// turns about z(i); the link of row i lies between origins i−1 and i and moves with
    /// frame i−1, so that of row 1 is fixed to the base.
    Modified,
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
    /// Centre of mass in the link's own frame, the one it moves with (see [`DhConvention`]), m.
    /// Half way between the two origins if not given.
    pub center_of_mass_m: Option<Vector3<f64>>,
    /// Inertia about the centre of mass in the axes of the link's own frame, kg m². That of a
    /// uniform slender rod between the two origins if not given: zero where they coincide.
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
            center_of_mass_m: None,
            inertia_kg_m2: None,
        }
    }

    /// Distance between the link's two origins, m.
    pub fn length_m(&self) -> f64 {
        self.a_m.hypot(self.d_m)
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

/// A free-floating base and its chain of revolute joints, checked once and immutable.
///
/// Joint i of the chain is element i−1 of every slice of joint coordinates; angles in rad.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    base: Base,
    mount: Mount,
    convention: DhConvention,
    links: Vec<Link>,
    payload: Option<Payload>,
    pub(crate) chain: Chain,
}

impl System {
    /// Checks a model and prepares its constants.
    ///
    /// # Errors
    /// [`ModelError`] names the part, the value and what is allowed: no links, a number that is not
    /// finite, a negative mass, a base without mass, an inertia that is not symmetric, not positive
    /// (zero is allowed for links and payload), or beyond the triangle inequality by more than one
    /// part in 10⁹, a mount that is not rotated by a rotation.
    pub fn new(
        base: Base,
        mount: Mount,
        convention: DhConvention,
        links: Vec<Link>,
        payload: Option<Payload>,
    ) -> Result<Self, ModelError> {
        check_base(&base)?;
        check_mount(&mount)?;
        if links.is_empty() {
            return Err(ModelError::EmptyChain);
        }
        for (index, link) in links.iter().enumerate() {
            check_link(Part::Link(index), link)?;
        }
        if let Some(payload) = &payload {
            check_mass(Part::Payload, payload.mass_kg)?;
            check_inertia(Part::Payload, payload.mass_kg, payload.inertia_kg_m2.as_ref())?;
        }
        let chain = Chain::new(&base, &mount, convention, &links, payload.as_ref())?;
        Ok(Self { base, mount, convention, links, payload, chain })
    }

    /// Number of joints j, which is also the number of links.
    pub fn joint_count(&self) -> usize {
        self.links.len()
    }

    /// Mass of base, links and payload, kg.
    pub fn total_mass(&self) -> f64 {
        self.chain.total_mass
    }

    /// The base body.
    pub fn base(&self) -> &Base {
        &self.base
    }

    /// Where the arm is fixed.
    pub fn mount(&self) -> &Mount {
        &self.mount
    }

    /// How the rows of parameters are read.
    pub fn convention(&self) -> DhConvention {
        self.convention
    }

    /// The links, from the base outward.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// What the arm holds.
    pub fn payload(&self) -> Option<&Payload> {
        self.payload.as_ref()
    }

    /// Whether two links (counted from zero) touch at a joint by construction: every link between
    /// them has no length. Also true of a link and itself.
    pub fn links_meet(&self, a: usize, b: usize) -> bool {
        let (inboard, outboard) = (a.min(b), a.max(b));
        let between = self.links.get(inboard + 1..outboard).unwrap_or_default();
        between.iter().all(|link| link.length_m() == 0.0)
    }
}

fn check_base(base: &Base) -> Result<(), ModelError> {
    check_mass(Part::Base, base.mass_kg)?;
    if base.mass_kg == 0.0 {
        return Err(ModelError::MasslessBase);
    }
    inertia::check(Part::Base, &base.inertia_kg_m2, Definiteness::Positive)
}

fn check_mount(mount: &Mount) -> Result<(), ModelError> {
    for value in &mount.position_m {
        check_finite(Part::Mount, "position_m", *value)?;
    }
    for value in mount.rotation.matrix() {
        check_finite(Part::Mount, "rotation", *value)?;
    }
    let matrix = mount.rotation.matrix();
    let mut deviation = (matrix.transpose() * matrix - Matrix3::identity()).amax();
    if matrix.determinant() < 0.0 {
        deviation = deviation.max(2.0);
    }
    if deviation > 1e-9 {
        return Err(ModelError::NotARotation { deviation });
    }
    Ok(())
}

fn check_link(part: Part, link: &Link) -> Result<(), ModelError> {
    check_mass(part, link.mass_kg)?;
    for (quantity, value) in [
        ("a_m", link.a_m),
        ("alpha_rad", link.alpha_rad),
        ("d_m", link.d_m),
        ("theta_rad", link.theta_rad),
    ] {
        check_finite(part, quantity, value)?;
    }
    for value in link.center_of_mass_m.iter().flatten() {
        check_finite(part, "center_of_mass_m", *value)?;
    }
    check_inertia(part, link.mass_kg, link.inertia_kg_m2.as_ref())
}

fn check_inertia(
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

fn check_mass(part: Part, mass_kg: f64) -> Result<(), ModelError> {
    check_finite(part, "mass_kg", mass_kg)?;
    if mass_kg < 0.0 {
        return Err(ModelError::NegativeMass { part, mass_kg });
    }
    Ok(())
}

fn check_finite(part: Part, quantity: &'static str, value: f64) -> Result<(), ModelError> {
    if value.is_finite() { Ok(()) } else { Err(ModelError::NotFinite { part, quantity, value }) }
}
