//! How the attitude at the end spreads with masses that are not known exactly.
//!
//! Beside the plan's attitude stand those that the same motion of the joints makes with one mass off by its standard
//! deviation, one for every mass and one for the base's inertia: four more states each, which follow their own
//! momentum. With φ_i the rotation from the plan's attitude at the end to the i-th, and masses off each by itself,
//!
//! ```text
//! variance = Σ ‖φ_i‖²                                       to first order in the deviations
//! ```

use righting_multibody::{MassFactors, ModelError};
use righting_scalar::Scalar;
use righting_scenario::file::Formulation;
use righting_scenario::{Robustness, Scenario};

use super::Coordinates;

/// A quaternion.
const STATES: usize = 4;

/// The plan's system with other masses, one of each kind.
#[derive(Clone)]
pub(crate) struct Spread {
    plan: Coordinates,
    others: Vec<Coordinates>,
}

impl Spread {
    /// Of a scenario, in the reduced form.
    ///
    /// # Errors
    /// [`ModelError`] where masses so far off are none that a system can have.
    pub(crate) fn new(scenario: &Scenario, robustness: Robustness) -> Result<Self, ModelError> {
        let model = &scenario.system().model;
        let parts = model.massive_part_count();
        let off = 1.0 + robustness.deviation;
        let with = |part: usize, factors: MassFactors| {
            let mut all = vec![MassFactors::ONE; parts];
            all[part] = factors;
            all
        };
        // A mass of a base says nothing of its inertia; one of a link goes with it.
        let of_base =
            [MassFactors { mass: off, inertia: 1.0 }, MassFactors { mass: 1.0, inertia: off }];
        let of_links = (1..parts).map(|part| with(part, MassFactors { mass: off, inertia: off }));
        let all = of_base.into_iter().map(|factors| with(0, factors)).chain(of_links);
        let others = all
            .map(|factors| {
                let other = scenario.clone().with_model(model.with_masses_multiplied(&factors)?);
                Ok(Coordinates::new(&other, Formulation::Reduced))
            })
            .collect::<Result<Vec<_>, ModelError>>()?;
        Ok(Self { plan: Coordinates::new(scenario, Formulation::Reduced), others })
    }

    /// Number of further states.
    pub(crate) fn states(&self) -> usize {
        STATES * self.others.len()
    }

    /// Where they start: all in the plan's attitude.
    pub(crate) fn start(&self, x: &[f64]) -> Vec<f64> {
        x[self.plan.attitude()].repeat(self.others.len())
    }

    /// ż of the further states z, beside the states x and the controls u.
    pub(crate) fn rates<T: Scalar>(&self, x: &[T], z: &[T], u: &[T]) -> Vec<T> {
        let attitude = self.plan.attitude();
        let mut other_x = x.to_vec();
        let mut rates = Vec::with_capacity(z.len());
        for (other, z) in self.others.iter().zip(z.chunks(STATES)) {
            other_x[attitude.clone()].copy_from_slice(z);
            rates.extend_from_slice(&other.rates(&other_x, u)[attitude.clone()]);
        }
        rates
    }

    /// The variance of the attitude, rad².
    pub(crate) fn variance<T: Scalar>(&self, x: &[T], z: &[T]) -> T {
        let plan = self.plan.attitude_of(x);
        let mut at = x.to_vec();
        let mut variance = T::from(0.0);
        for z in z.chunks(STATES) {
            at[self.plan.attitude()].copy_from_slice(z);
            let half = self.plan.attitude_of(&at).error_vector(&plan);
            // An error of a unit quaternion is half an angle.
            variance += half.iter().fold(T::from(0.0), |sum, &part| sum + part * part) * 4.0;
        }
        variance
    }
}
