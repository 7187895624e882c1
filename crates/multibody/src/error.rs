//! What can be wrong with a multibody model.

use std::fmt;

/// The part of a system that an error is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The free-floating base body.
    Base,
    /// The place where the arm is fixed to the base.
    Mount,
    /// A link, counted from zero at the base.
    Link(usize),
    /// A body of a list, counted from zero.
    Body(usize),
    /// The payload at the last origin.
    Payload,
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Part::Base => write!(f, "base"),
            Part::Mount => write!(f, "mount"),
            Part::Link(index) => write!(f, "link {}", index + 1),
            Part::Body(index) => write!(f, "body {}", index + 1),
            Part::Payload => write!(f, "payload"),
        }
    }
}

/// A model that no rigid-body system can have.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// The arm has no joint that moves.
    #[error("joints: found none, expected at least one")]
    EmptyChain,
    /// A number of the model is NaN or infinite.
    #[error("{part}: {quantity}: found {value}, expected a finite number")]
    NotFinite {
        /// Whose number.
        part: Part,
        /// Name of the field.
        quantity: &'static str,
        /// The number.
        value: f64,
    },
    /// The numbers are finite, a product or sum of them is not.
    #[error("{part}: found masses or lengths whose products overflow, expected smaller ones")]
    Overflow {
        /// Where the arithmetic overflows.
        part: Part,
    },
    /// A mass below zero.
    #[error("{part}: mass_kg: found {mass_kg}, expected zero or more")]
    NegativeMass {
        /// Whose mass.
        part: Part,
        /// The mass.
        mass_kg: f64,
    },
    /// A base with no mass, so that the system may have none.
    #[error("base: mass_kg: found 0, expected more than zero")]
    MasslessBase,
    /// A cube with no size.
    #[error("base: side of the cube: found {side_m} m, expected more than zero")]
    CubeSide {
        /// The side length.
        side_m: f64,
    },
    /// A body with moments of inertia and no mass.
    #[error("{part}: found an inertia without a mass, expected both or neither")]
    InertiaWithoutMass {
        /// Whose inertia.
        part: Part,
    },
    /// A row of standard parameters whose mass moves with the frame before.
    #[error(
        "{part}: inertial_frame: found the previous frame, expected the link's own: with standard \
         parameters link i moves with joint i"
    )]
    PreviousFrame {
        /// Whose mass.
        part: Part,
    },
    /// A row of modified parameters with its mass in its own frame, which does not say where.
    #[error(
        "{part}: {quantity}: missing, expected one in the link's own frame, where no segment gives \
         a default"
    )]
    MissingInertial {
        /// Whose mass.
        part: Part,
        /// Name of the field.
        quantity: &'static str,
    },
    /// An inertia matrix that differs from its transpose.
    #[error(
        "{part}: inertia_kg_m2[{row}][{column}]: found {upper}, expected {lower}, the entry \
         [{column}][{row}]: an inertia matrix is symmetric"
    )]
    NotSymmetric {
        /// Whose inertia.
        part: Part,
        /// Row of the upper entry, from zero.
        row: usize,
        /// Column of the upper entry, from zero.
        column: usize,
        /// The entry above the diagonal.
        upper: f64,
        /// The entry below the diagonal.
        lower: f64,
    },
    /// An inertia matrix with a principal moment that is too small.
    #[error(
        "{part}: smallest principal moment of inertia_kg_m2: found {}, expected {}",
        .moments_kg_m2[0],
        if *.zero_allowed { "zero or more" } else { "more than zero" }
    )]
    NotPositive {
        /// Whose inertia.
        part: Part,
        /// The principal moments, smallest first.
        moments_kg_m2: [f64; 3],
        /// True where a moment of zero is allowed (a thin rod has one).
        zero_allowed: bool,
    },
    /// Principal moments that no distribution of mass has: one exceeds the sum of the others.
    #[error(
        "{part}: largest principal moment of inertia_kg_m2: found {}, expected at most the sum of \
         the other two, {}",
        .moments_kg_m2[2],
        .moments_kg_m2[0] + .moments_kg_m2[1]
    )]
    TriangleInequality {
        /// Whose inertia.
        part: Part,
        /// The principal moments, smallest first.
        moments_kg_m2: [f64; 3],
    },
    /// A body that is carried by itself, over others or not, or by one that there is not.
    #[error("{part}: parent: found no way to the base, expected a body that leads there")]
    NoWayToBase {
        /// Whose parent.
        part: Part,
    },
    /// A joint's axis without a direction.
    #[error("{part}: joint.axis: found a length of 0, expected a direction")]
    NoAxis {
        /// Whose joint.
        part: Part,
    },
    /// A matrix that is not a rotation.
    #[error("{part}: the rotation matrix is off an orthonormal right-handed one by {deviation}")]
    NotARotation {
        /// Whose orientation.
        part: Part,
        /// Largest entry of `RᵀR − 1`, or 2 for a reflection.
        deviation: f64,
    },
}
