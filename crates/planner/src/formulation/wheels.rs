//! The reaction wheels of a maneuver, as states and controls: of each that works its momentum as a share of the most
//! that it stores, and the rate of that share, which its torque decides.
//!
//! The optimizers relax bounds of one or less by 1e-8, and a maneuver's own measure of momentum may be a thousand
//! times what a wheel stores.

use std::sync::Arc;

use nalgebra::Vector3;
use righting_multibody::External;
use righting_ocp::ComponentBounds;
use righting_scalar::Scalar;
use righting_scenario::scenario::Scenario;
use righting_scenario::wheels::{Wheel, reaction, stored_at_start};

/// The wheels of a scenario. Failed ones keep what they store, so it is no state.
#[derive(Clone)]
pub(crate) struct Wheels {
    all: Arc<[Wheel]>,
    working: Arc<[Working]>,
    /// What the wheels that have failed store, body axes.
    failed: Vector3<f64>,
}

/// A wheel that works.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Working {
    /// What it stores at its limit, body axes.
    pub(crate) full: Vector3<f64>,
    /// The length of that.
    pub(crate) momentum_max: f64,
    /// How fast its share can change where it stores nothing.
    pub(crate) rate_max: f64,
    /// How fast friction lets it fall, as a share of the share.
    friction: f64,
    /// Its share at the start.
    at_start: f64,
}

impl Working {
    fn new(wheel: &Wheel) -> Self {
        let momentum_max = wheel.momentum_max_n_m_s;
        Self {
            full: Vector3::from(wheel.axis) * momentum_max,
            momentum_max,
            rate_max: wheel.torque_max_n_m / momentum_max,
            friction: wheel.friction_1_s(),
            at_start: wheel.initial_momentum_n_m_s / momentum_max,
        }
    }
}

impl Working {
    /// The least and the largest rate of its share in a step of length `step_s` that its motor gives.
    fn rates(&self, share: f64, step_s: f64) -> [f64; 2] {
        let most = |share: f64| {
            let left = self.rate_max - self.friction * share;
            left.min(left / (1.0 + self.friction * step_s))
        };
        // A motor that does not overcome friction lets the wheel fall.
        let (least, most) = (-most(-share), most(share));
        [least.min(most), most.max(least)]
    }
}

impl Wheels {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let all = scenario.wheels();
        Self {
            all: all.into(),
            working: all.iter().filter(|wheel| !wheel.failed).map(Working::new).collect(),
            failed: stored_at_start(all.iter().filter(|wheel| wheel.failed)),
        }
    }

    /// Those that work.
    pub(crate) fn working(&self) -> &[Working] {
        &self.working
    }

    /// The shares at the start.
    pub(crate) fn at_start(&self) -> Vec<f64> {
        self.working.iter().map(|wheel| wheel.at_start).collect()
    }

    /// What all store with these shares, body axes.
    pub(crate) fn stored<T: Scalar>(&self, shares: &[T]) -> Vector3<T> {
        let working = self.sum(shares);
        Vector3::from_fn(|i, _| working[i] + self.failed[i])
    }

    /// The sum of the squares of momenta of these shares, or of torques that give these rates.
    pub(super) fn sum_of_squares<T: Scalar>(&self, shares: &[T]) -> T {
        let squares = shares.iter().zip(&*self.working);
        squares.fold(T::from(0.0), |sum, (&share, wheel)| {
            sum + share * share * wheel.momentum_max.powi(2)
        })
    }

    /// Momenta of these shares, with what failed ones keep in between.
    pub(crate) fn momenta(&self, shares: &[f64]) -> Vec<f64> {
        self.of_all(shares, |wheel| wheel.initial_momentum_n_m_s)
    }

    /// Torques that give these rates, with nothing for failed ones in between.
    pub(crate) fn torques(&self, rates: &[f64]) -> Vec<f64> {
        self.of_all(rates, |_| 0.0)
    }

    fn of_all(&self, shares: &[f64], failed: impl Fn(&Wheel) -> f64) -> Vec<f64> {
        let mut shares = shares.iter();
        let value = |wheel: &Wheel| match wheel.failed {
            true => failed(wheel),
            false => wheel.momentum_max_n_m_s * shares.next().expect("one a wheel that works"),
        };
        self.all.iter().map(value).collect()
    }

    /// The shares that these momenta of all wheels are; failed ones have none.
    pub(crate) fn shares(&self, momenta: &[f64]) -> Vec<f64> {
        let all = self.all.iter().zip(momenta).filter(|(wheel, _)| !wheel.failed);
        all.map(|(wheel, momentum)| momentum / wheel.momentum_max_n_m_s).collect()
    }

    /// Takes off the rates of a step of length `step_s` what the optimizers let pass the limits.
    pub(crate) fn keep_within(&self, shares: &[f64], rates: &mut [f64], step_s: f64) {
        for ((rate, share), wheel) in rates.iter_mut().zip(shares).zip(&*self.working) {
            let reached = (share + step_s * *rate).clamp(-1.0, 1.0);
            let [least, most] = wheel.rates(*share, step_s);
            *rate = ((reached - share) / step_s).clamp(least, most);
        }
    }

    /// Bounds of the rates: whatever the wheels store.
    pub(super) fn rate_bounds(&self) -> impl Iterator<Item = f64> {
        self.working.iter().map(|wheel| wheel.rate_max + wheel.friction)
    }

    /// Bounds of [`motor_torques`](Self::motor_torques).
    pub(super) fn motor_bounds(&self) -> ComponentBounds {
        let limited = self.with_friction().count();
        ComponentBounds::symmetric(&vec![1.0; 2 * limited])
    }

    /// The torques of the motors of wheels with friction at both ends of a step of length `h`, as shares of their limits;
    /// in between they are linear.
    pub(super) fn motor_torques<T: Scalar>(&self, (shares, rates): (&[T], &[T]), h: T) -> Vec<T> {
        let limited = self.with_friction();
        let torques = limited.flat_map(|(place, wheel)| {
            let (share, rate) = (shares[place], rates[place]);
            [share, share + h * rate]
                .map(|share| (rate + share * wheel.friction) * wheel.rate_max.recip())
        });
        torques.collect()
    }

    /// The wheels whose motors have friction to overcome, by their place among those that work.
    fn with_friction(&self) -> impl Iterator<Item = (usize, &Working)> {
        self.working.iter().enumerate().filter(|(_, wheel)| wheel.friction > 0.0)
    }

    /// What acts from outside, and what the wheels do that have so much in store (body axes) and whose shares have
    /// these rates, where the base turns at `angular_rate`.
    pub(super) fn beside<T: Scalar>(
        &self,
        external: Option<External<T>>,
        angular_rate: &Vector3<T>,
        in_store: &Vector3<T>,
        rates: &[T],
    ) -> Option<External<T>> {
        if self.all.is_empty() {
            return external;
        }
        let reaction = reaction(angular_rate, in_store, &self.sum(rates));
        Some(match external {
            None => External { torque: reaction, gravity_gradient: None },
            Some(external) => External { torque: external.torque + reaction, ..external },
        })
    }

    fn sum<T: Scalar>(&self, shares: &[T]) -> Vector3<T> {
        let zero = Vector3::from_element(T::from(0.0));
        self.working.iter().zip(shares).fold(zero, |sum, (wheel, &share)| {
            Vector3::from_fn(|i, _| sum[i] + share * wheel.full[i])
        })
    }
}
