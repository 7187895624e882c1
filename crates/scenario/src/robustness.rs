//! Masses that a plan shall not depend on more than it must.

use crate::error::Error;
use crate::file::{self, Formulation};
use crate::json::{Bounds, Location};
use crate::maneuver::Maneuver;
use crate::solver_settings::SolverSettings;

/// Farther off the attitudes of other masses are no longer near to the plan's.
const MASS_PERCENT: Bounds = Bounds::Above(0.0, 50.0);
const WEIGHT: Bounds = Bounds::Above(0.0, 1e6);

/// Masses that are not known exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Robustness {
    /// Standard deviation of every mass and of the base's inertia, as a share.
    pub deviation: f64,
    /// What the variance of the attitude at the end counts, relative to the effort.
    pub weight: f64,
}

impl Robustness {
    pub(crate) fn from_file(
        given: &mut file::Robustness,
        (maneuver, solver): (&Maneuver, SolverSettings),
        place: &Location,
    ) -> Result<Self, Error> {
        let percent = place.key("mass_percent").within(given.mass_percent, MASS_PERCENT)?;
        let weight = place.key("weight").within(given.weight.unwrap_or(1.0), WEIGHT)?;
        given.weight = Some(weight);
        if *maneuver == Maneuver::Detumble {
            return Err(place
                .refuse("robustness of a detumble", "that of a slew, whose end is an attitude"));
        }
        if solver.formulation != Formulation::Reduced || solver.is_paper() {
            let expected = "the reduced form, and not the paper's guess \"constant\"";
            return Err(place.refuse("robustness in another form", expected));
        }
        // Numbers drawn evenly within a range.
        Ok(Self { deviation: percent / 100.0 / 3f64.sqrt(), weight })
    }
}
