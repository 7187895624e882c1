//! What the motors of reaction wheels do along a plan, where the inertias of their rotors are known.
//!
//! A rotor of inertia J that stores h turns at Ω = h/J relative to the base. With the viscous friction b of its bearing its
//! motor gives
//!
//! ```text
//! τ_m = ḣ + b Ω,   p = τ_m Ω,   ∫ p dt = Δ(J Ω²/2) + ∫ b Ω² dt.
//! ```
//!
//! What turns the rotor along with the base, J a·ω̇, is not counted. Mechanical power at the shaft: what windings and
//! electronics take comes on top, and while a wheel spins steadily that is in its `steady_power_w`.

use righting_results::Trajectory;
use righting_scenario::wheels::Wheel;

use crate::motors::Braking;
use crate::power::{Consumption, PowerProfile};

/// The motors of all wheels that work.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelMotors<'a> {
    profile: &'a PowerProfile,
    /// One a wheel, at every point of the profile, W.
    powers_w: Vec<Vec<f64>>,
    /// What friction turns into heat in all of them, at every point, W.
    friction_w: Vec<f64>,
    /// The largest speed of each, rad/s.
    peak_speeds_rad_s: Vec<f64>,
    /// The change of the rotors' kinetic energy relative to the base, J.
    kinetic_energy_change_j: f64,
}

impl<'a> WheelMotors<'a> {
    /// Of a plan's wheels and its profile; `None` where no wheel works, or the inertia of one that does is not known.
    pub fn new(
        wheels: &[Wheel],
        trajectory: &Trajectory,
        profile: &'a PowerProfile,
    ) -> Option<Self> {
        let working = wheels.iter().enumerate().filter(|(_, wheel)| !wheel.failed);
        let working = working.map(|(index, wheel)| Some((index, wheel, wheel.inertia_kg_m2?)));
        let working: Vec<(usize, &Wheel, f64)> = working.collect::<Option<_>>()?;
        if working.is_empty() || trajectory.wheels() != wheels.len() {
            return None;
        }
        let (mut powers_w, mut friction_w) = (Vec::new(), Vec::new());
        let mut peak_speeds_rad_s = vec![0.0; working.len()];
        let instants = profile.instants();
        for (place, instant) in instants.iter().enumerate() {
            let k = place * trajectory.steps() / instants.len();
            let (node, interval) = (&trajectory.nodes()[k], &trajectory.intervals()[k]);
            let (mut powers, mut lost_w) = (Vec::with_capacity(working.len()), 0.0);
            for (&(index, wheel, inertia), peak) in working.iter().zip(&mut peak_speeds_rad_s) {
                let torque = interval.wheel_torques_n_m[index];
                let stored =
                    node.wheel_momenta_n_m_s[index] + (instant.time_s - node.time_s) * torque;
                let speed = stored / inertia;
                powers.push(wheel.motor_torque_n_m(torque, stored) * speed);
                lost_w += wheel.viscous_friction_n_m_s * speed * speed;
                *peak = f64::max(*peak, speed.abs());
            }
            powers_w.push(powers);
            friction_w.push(lost_w);
        }
        let energy_j = |node: &righting_results::Node| -> f64 {
            let energies = working.iter().map(|&(index, _, inertia)| {
                node.wheel_momenta_n_m_s[index].powi(2) / (2.0 * inertia)
            });
            energies.sum()
        };
        let kinetic_energy_change_j = energy_j(trajectory.end()) - energy_j(trajectory.start());
        Some(Self { profile, powers_w, friction_w, peak_speeds_rad_s, kinetic_energy_change_j })
    }

    /// Mechanical power of all motors at every point of the profile, W.
    pub fn drawn_w(&self, braking: Braking) -> Vec<f64> {
        let drawn = |&power_w: &f64| match braking {
            Braking::Burnt => power_w.max(0.0),
            Braking::FedBack => power_w,
        };
        self.powers_w.iter().map(|powers| powers.iter().map(drawn).sum()).collect()
    }

    /// What all motors draw over the maneuver.
    pub fn consumption(&self, braking: Braking) -> Consumption {
        self.profile.consumption_of(&self.drawn_w(braking))
    }

    /// What friction turns into heat, J.
    pub fn friction_j(&self) -> f64 {
        self.profile.consumption_of(&self.friction_w).energy_j
    }

    /// The largest speed of each wheel that works, rad/s.
    pub fn peak_speeds_rad_s(&self) -> &[f64] {
        &self.peak_speeds_rad_s
    }

    /// Kinetic energy of the rotors relative to the base, the last node's less the first's, J: what the motors' work is
    /// beyond [`friction_j`](Self::friction_j).
    pub fn kinetic_energy_change_j(&self) -> f64 {
        self.kinetic_energy_change_j
    }
}
