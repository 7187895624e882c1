//! The reaction wheels of a maneuver, as states and controls: momenta and torques of those that work.

use std::sync::Arc;

use nalgebra::Vector3;
use righting_multibody::External;
use righting_scalar::Scalar;
use righting_scenario::scenario::Scenario;
use righting_scenario::wheels::{Wheel, reaction, stored};

/// The wheels of a scenario. Failed ones keep what they store, so it is no state.
#[derive(Clone)]
pub(crate) struct Wheels {
    all: Arc<[Wheel]>,
    working: Arc<[Wheel]>,
    /// What the wheels that have failed store, body axes.
    failed: Vector3<f64>,
}

impl Wheels {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let all = scenario.wheels();
        let (failed, working): (Vec<Wheel>, Vec<Wheel>) =
            all.iter().partition(|wheel| wheel.failed);
        let failed = stored(&failed, &at_start(&failed));
        Self { all: all.into(), working: working.into(), failed }
    }

    /// Those that work.
    pub(crate) fn working(&self) -> &[Wheel] {
        &self.working
    }

    /// The momenta at the start of those that work.
    pub(super) fn at_start(&self) -> Vec<f64> {
        at_start(&self.working)
    }

    /// What all store while those that work have these momenta, body axes.
    pub(crate) fn stored<T: Scalar>(&self, momenta: &[T]) -> Vector3<T> {
        let working = stored(&self.working, momenta);
        Vector3::from_fn(|i, _| working[i] + self.failed[i])
    }

    /// Momenta of those that work with what failed ones keep in between.
    pub(crate) fn all_momenta(&self, momenta: &[f64]) -> Vec<f64> {
        self.with_failed(momenta, |wheel| wheel.initial_momentum_n_m_s)
    }

    /// Torques of those that work with nothing for failed ones in between.
    pub(crate) fn all_torques(&self, torques: &[f64]) -> Vec<f64> {
        self.with_failed(torques, |_| 0.0)
    }

    fn with_failed(&self, working: &[f64], failed: impl Fn(&Wheel) -> f64) -> Vec<f64> {
        let mut working = working.iter();
        let value = |wheel: &Wheel| match wheel.failed {
            true => failed(wheel),
            false => *working.next().expect("one a wheel that works"),
        };
        self.all.iter().map(value).collect()
    }

    /// Takes off the torques of a step of length `step_s` what the optimizers let pass the limits of torque and
    /// momentum: as bounds of variables they are relaxed by 1e-8 of a maneuver's own measures, which may be much
    /// of what a wheel has.
    pub(crate) fn keep_within(&self, momenta: &[f64], torques: &mut [f64], step_s: f64) {
        for ((torque, momentum), wheel) in torques.iter_mut().zip(momenta).zip(&*self.working) {
            let most = wheel.momentum_max_n_m_s;
            let reached = (momentum + step_s * *torque).clamp(-most, most);
            *torque =
                ((reached - momentum) / step_s).clamp(-wheel.torque_max_n_m, wheel.torque_max_n_m);
        }
    }

    /// What acts from outside, and what the wheels do that have so much in store (body axes) and give these torques,
    /// where the base turns at `angular_rate`.
    pub(super) fn beside<T: Scalar>(
        &self,
        external: Option<External<T>>,
        angular_rate: &Vector3<T>,
        in_store: &Vector3<T>,
        torques: &[T],
    ) -> Option<External<T>> {
        if self.all.is_empty() {
            return external;
        }
        let given = stored(&self.working, torques);
        let reaction = reaction(angular_rate, in_store, &given);
        Some(match external {
            None => External { torque: reaction, gravity_gradient: None },
            Some(external) => External { torque: external.torque + reaction, ..external },
        })
    }
}

fn at_start(wheels: &[Wheel]) -> Vec<f64> {
    wheels.iter().map(|wheel| wheel.initial_momentum_n_m_s).collect()
}
