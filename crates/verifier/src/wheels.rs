//! Reaction wheels: what they do to the base, and their limits.
//!
//! A wheel with the momentum h about its axis a, relative to the base, that gives the torque τ, ḣ = τ, turns the base
//! by −τ a − Ω × h a, whatever its inertia: what turns with the base is part of the base.

use nalgebra::Vector3;
use righting_results::trajectory::{ControlInterval, Node, Trajectory};
use righting_scenario::file;

use crate::ledger::{Ledger, Worst};
use crate::requirements::Requirements;

/// How far momenta and torques may be past their limits, or off, as a share of the limits.
const SHARE: f64 = 1e-6;

/// The wheels of a scenario.
#[derive(Clone, Debug, Default)]
pub(super) struct Wheels {
    wheels: Vec<Wheel>,
    /// The momentum in which each shall end, N m s.
    end: Vec<Option<f64>>,
}

#[derive(Clone, Copy, Debug)]
struct Wheel {
    /// Body axes, of unit length.
    axis: Vector3<f64>,
    momentum_max: f64,
    torque_max: f64,
    at_start: f64,
    /// Friction over inertia, 1/s.
    friction: f64,
    failed: bool,
}

/// What all wheels store and give together, body axes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Store {
    /// N m s.
    pub momentum: Vector3<f64>,
    /// N m.
    pub torque: Vector3<f64>,
}

impl Store {
    /// The same a time later.
    pub fn after(&self, after_s: f64) -> Self {
        Self { momentum: self.momentum + self.torque * after_s, ..*self }
    }
}

impl Wheels {
    /// Of a resolved scenario.
    pub fn new(scenario: &file::Scenario) -> Self {
        let wheel = |wheel: &file::Wheel| Wheel {
            axis: Vector3::from(wheel.axis).normalize(),
            momentum_max: wheel.momentum_max_n_m_s,
            torque_max: wheel.torque_max_n_m,
            at_start: wheel.initial_momentum_n_m_s.unwrap_or(0.0),
            friction: wheel
                .inertia_kg_m2
                .map_or(0.0, |inertia| wheel.viscous_friction_n_m_s.unwrap_or(0.0) / inertia),
            failed: wheel.failed,
        };
        let end = scenario.end.as_ref().and_then(|end| end.wheel_momenta_n_m_s.clone());
        Self {
            wheels: scenario.wheels.iter().map(wheel).collect(),
            end: end.unwrap_or_else(|| vec![None; scenario.wheels.len()]),
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.wheels.len()
    }

    /// Whether one works.
    pub fn work(&self) -> bool {
        self.wheels.iter().any(|wheel| !wheel.failed)
    }

    /// Whether nothing asks them to give up what they store.
    pub fn may_hold(&self, scenario: &file::Scenario) -> bool {
        scenario.weights.wheel_momentum.unwrap_or(0.0) == 0.0
            && self.end.iter().all(Option::is_none)
    }

    /// What they store at a node, and give in the interval after it.
    pub fn store(&self, node: &Node, interval: &ControlInterval) -> Store {
        Store {
            momentum: self.sum(&node.wheel_momenta_n_m_s),
            torque: self.sum(&interval.wheel_torques_n_m),
        }
    }

    /// The same at the beginnings of all intervals, from the momenta at the start and the torques alone.
    pub fn stores<'i>(
        &'i self,
        intervals: &'i [ControlInterval],
        step_s: impl Fn(usize) -> f64 + 'i,
    ) -> impl Iterator<Item = Store> + 'i {
        let mut momentum = self.at_start();
        intervals.iter().enumerate().map(move |(k, interval)| {
            let store = Store { momentum, torque: self.sum(&interval.wheel_torques_n_m) };
            momentum = store.after(step_s(k)).momentum;
            store
        })
    }

    /// The momentum that they store at the start, body axes, N m s.
    pub fn at_start(&self) -> Vector3<f64> {
        self.wheels.iter().map(|wheel| wheel.axis * wheel.at_start).sum()
    }

    /// Momenta or torques, one a wheel, as a vector in body axes.
    pub fn sum(&self, values: &[f64]) -> Vector3<f64> {
        self.wheels.iter().zip(values).map(|(wheel, value)| wheel.axis * *value).sum()
    }
}

/// Momenta follow from the torques, momenta and the motors' torques keep their limits, and a failed wheel gives nothing.
/// With a rotor that turns at h/J and friction b the motor gives ḣ + b h/J, which is linear within an interval.
pub(super) fn check(asked: &Requirements, trajectory: &Trajectory, ledger: &mut Ledger) {
    for (index, (wheel, end)) in asked.wheels.wheels.iter().zip(&asked.wheels.end).enumerate() {
        let Wheel { momentum_max, torque_max, at_start, friction, failed, .. } = *wheel;
        let subject = format!("wheel {}", index + 1);
        let mut mismatch = Worst::new("wheel momentum mismatch", "N m s", 0.0);
        let mut momentum = Worst::of_limit("wheel momentum", "N m s", SHARE * momentum_max);
        let mut torque = match failed {
            true => Worst::new("torque of a failed wheel", "N m", 0.0),
            false => Worst::of_limit("wheel torque", "N m", SHARE * torque_max),
        };
        let most = if failed { 0.0 } else { torque_max };
        let mut expected = at_start;
        for (k, node) in trajectory.nodes().iter().enumerate() {
            let time_s = Some(node.time_s);
            let found = node.wheel_momenta_n_m_s[index];
            mismatch.at_most((found - expected).abs(), SHARE * momentum_max, None, time_s);
            momentum.at_most(found.abs(), momentum_max, None, time_s);
            if let Some(interval) = trajectory.intervals().get(k) {
                let given = interval.wheel_torques_n_m[index];
                let gained = given * (asked.horizon.time_s(k + 1) - asked.horizon.time_s(k));
                let friction = if failed { 0.0 } else { friction };
                for stored in [found, found + gained] {
                    torque.at_most((given + friction * stored).abs(), most, None, time_s);
                }
                expected += gained;
            }
        }
        ledger.add_of(mismatch, &subject);
        ledger.add_of(momentum, &subject);
        ledger.add_of(torque, &subject);
        if let Some(asked_n_m_s) = end {
            let name = "wheel momentum off at the end";
            let mut missed = Worst::new(name, "N m s", 0.0);
            let found = trajectory.end().wheel_momenta_n_m_s[index];
            let time_s = Some(trajectory.end().time_s);
            missed.at_most((found - asked_n_m_s).abs(), SHARE * momentum_max, None, time_s);
            ledger.add_of(missed, &subject);
        }
    }
}
