//! Mass, center of mass and inertia of every body, from the file.

use nalgebra::{Matrix3, Vector3};
use righting_scenario::file;

use super::row::{Convention, Row};

/// A rigid body.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// kg.
    pub mass: f64,
    /// What it moves with.
    pub carrier: Carrier,
    /// Center of mass in the carrier's axes, from the carrier's origin, m.
    pub center: Vector3<f64>,
    /// About the center of mass, in the carrier's axes, kg m².
    pub inertia: Matrix3<f64>,
}

/// What a body moves with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Carrier {
    /// The base's body frame.
    Base,
    /// A frame of the model; frame 0 moves with the base.
    Frame(usize),
}

impl Body {
    /// A uniform cube, or a body with the inertia that is given.
    pub fn base(base: &file::Base) -> Self {
        let inertia = match (base.inertia_kg_m2, base.cube_side_m) {
            (Some(rows), _) => matrix(rows),
            // Of a uniform cuboid m (y² + z²)/12 about x, and so on.
            (None, side_m) => {
                let square = side_m.unwrap_or(0.0).powi(2);
                Matrix3::from_diagonal_element(base.mass_kg * (square + square) / 12.0)
            }
        };
        let center = Vector3::from(base.center_of_mass_m.unwrap_or_default());
        Self { mass: base.mass_kg, carrier: Carrier::Base, center, inertia }
    }

    /// The mass of row `index`, counted from zero, whose segment lies between frames `index` and
    /// `index + 1`.
    pub fn link(link: &file::Link, row: &Row, convention: Convention, index: usize) -> Self {
        // Seen from the frame that the segment moves with, it is the same at every angle. In another
        // frame it gives no default: a mass in that has its center and inertia.
        let (outboard, arm) = row.follow(convention, &Matrix3::identity(), 0.0);
        let (carrier, inboard_end, outboard_end) = match convention {
            Convention::Distal => (index + 1, -(outboard.transpose() * arm), Vector3::zeros()),
            Convention::Proximal => (index, Vector3::zeros(), arm),
        };
        let carrier = match link.inertial_frame {
            None => carrier,
            Some(file::InertialFrame::Previous) => index,
            Some(file::InertialFrame::Own) => index + 1,
        };
        let middle = (inboard_end + outboard_end) / 2.0;
        Self {
            mass: link.mass_kg,
            carrier: Carrier::Frame(carrier),
            center: link.center_of_mass_m.map_or(middle, Vector3::from),
            inertia: link
                .inertia_kg_m2
                .map_or_else(|| rod(link.mass_kg, &(outboard_end - inboard_end)), matrix),
        }
    }

    /// A body of a list, whose frame is `frame`.
    pub fn listed(body: &file::Body, frame: usize) -> Self {
        Self {
            mass: body.mass_kg,
            carrier: Carrier::Frame(frame),
            center: Vector3::from(body.center_of_mass_m.unwrap_or_default()),
            inertia: body.inertia_kg_m2.map_or_else(Matrix3::zeros, matrix),
        }
    }

    /// What the last frame, `frame`, holds at its origin.
    pub fn payload(payload: &file::Payload, frame: usize) -> Self {
        Self {
            mass: payload.mass_kg,
            carrier: Carrier::Frame(frame),
            center: Vector3::zeros(),
            inertia: payload.inertia_kg_m2.map_or_else(Matrix3::zeros, matrix),
        }
    }
}

fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    let [x, y, z] = rows;
    Matrix3::from_rows(&[x.into(), y.into(), z.into()])
}

/// A uniform slender rod along `segment`: −∫ [s]×² dm = −m/12 [segment]×².
fn rod(mass: f64, segment: &Vector3<f64>) -> Matrix3<f64> {
    let across = segment.cross_matrix();
    across * across * (-mass / 12.0)
}
