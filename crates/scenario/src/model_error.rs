//! Where in a system file the fault of a model lies.

use righting_multibody::{ModelError, Part};

use crate::error::Error;
use crate::json::{Location, Number};
use crate::system_description::{MASS_KG, SIZE_M};

/// The field that says what `part` is; `place` is the system's.
pub(crate) fn place_of(part: Part, place: &Location) -> Location {
    match part {
        Part::Base => place.key("base"),
        Part::Mount => place.key("mount"),
        Part::Link(index) => place.key("links").index(index),
        Part::Body(index) => place.key("bodies").index(index),
        Part::Payload => place.key("payload"),
    }
}

/// Says in the words of the system file at `place` what is wrong with its model. `way_out` follows
/// what is said about an inertia.
pub(crate) fn refuse(error: ModelError, place: &Location, way_out: &str) -> Error {
    let at = |part: Part| place_of(part, place);
    let principal_moments = |moments: [f64; 3]| {
        let [a, b, c] = moments.map(|moment| Number::rounded(moment, 6));
        format!("principal moments {a}, {b} and {c}")
    };
    match error {
        ModelError::NotSymmetric { part, row, column, upper, lower } => {
            let entry = at(part).key("inertia_kg_m2").index(row).index(column);
            let allowed = format!(
                "{}, the entry [{column}][{row}]: an inertia matrix is symmetric{way_out}",
                Number(lower)
            );
            entry.refuse(Number(upper), allowed)
        }
        ModelError::NotPositive { part, moments_kg_m2, zero_allowed } => {
            let least = if zero_allowed { "zero or more" } else { "more than zero" };
            let allowed = format!("the smallest to be {least}{way_out}");
            at(part).key("inertia_kg_m2").refuse(principal_moments(moments_kg_m2), allowed)
        }
        ModelError::TriangleInequality { part, moments_kg_m2 } => {
            let allowed = format!(
                "the largest to be at most the sum of the other two, {}{way_out}",
                Number::rounded(moments_kg_m2[0] + moments_kg_m2[1], 6)
            );
            at(part).key("inertia_kg_m2").refuse(principal_moments(moments_kg_m2), allowed)
        }
        ModelError::InertiaWithoutMass { part } => {
            at(part).key("inertia_kg_m2").refuse("an inertia", "none for a link without mass")
        }
        ModelError::PreviousFrame { part } => at(part).key("inertial_frame").refuse(
            "\"previous\"",
            "\"own\": with standard parameters the mass of row i moves with frame i",
        ),
        ModelError::MissingInertial { part, quantity } => at(part).key(quantity).missing(
            "one in the link's own frame: the segment that gives a default moves with the frame \
             before",
        ),
        ModelError::NotFinite { part, quantity, value } => {
            at(part).key(quantity).refuse(value, "a finite number")
        }
        ModelError::NegativeMass { part, mass_kg } => {
            at(part).key("mass_kg").refuse(Number(mass_kg), MASS_KG)
        }
        ModelError::Overflow { part } => {
            at(part).refuse("a mass or length this large", "numbers whose products are finite")
        }
        ModelError::EmptyChain => place.key("links").refuse("[]", "at least one link"),
        ModelError::NoWayToBase { part } => {
            at(part).key("parent").refuse("no way to the base", "a body that leads there")
        }
        ModelError::NoAxis { part } => {
            at(part).key("joint").key("axis").refuse("[0, 0, 0]", "a vector that is not zero")
        }
        ModelError::MasslessBase => place.key("base").key("mass_kg").refuse(0, "more than 0"),
        ModelError::CubeSide { side_m } => {
            place.key("base").key("cube_side_m").refuse(Number(side_m), SIZE_M)
        }
        ModelError::NotARotation { part, .. } => {
            at(part).key("rotation").refuse("a reflection", "a unit quaternion")
        }
    }
}
