//! What the motors of the joints draw: currents, voltages, losses.
//!
//! A motor with torque constant k and winding resistance R behind a gear of ratio n and efficiency η gives
//!
//! ```text
//! τ_m = n J q̈ + (τ + b q̇) / (n η)     where the joint drives, (τ + b q̇) q̇ ≥ 0
//! τ_m = n J q̈ + (τ + b q̇) η / n       where it brakes
//! i = τ_m / k,   v = R i + k n q̇,   p = v i = R i² + τ_m n q̇
//! ```
//!
//! (Siciliano et al., *Robotics: Modelling, Planning and Control*, section 5.2). Over a maneuver ∫ p dt is
//! the work of the joints, what friction, gear and windings turn into heat, and the change of the rotors'
//! kinetic energy.

use righting_scenario::Drive;
use righting_scenario::drive::Motor;
use serde::Serialize;

use crate::power::{Consumption, Instant, PowerProfile};

/// What becomes of the power that a braking motor gives back to its drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Braking {
    /// It is turned into heat there, joint by joint.
    Burnt,
    /// It feeds the other joints, and the source.
    FedBack,
}

/// Where the energy of a maneuver goes that is not work of the arm, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Losses {
    /// Heat of the windings.
    pub windings_j: f64,
    /// Heat of the gears.
    pub gears_j: f64,
    /// Heat of the joints' friction.
    pub friction_j: f64,
    /// Of the electronics, and of what holds joints that stand still.
    pub standing_j: f64,
}

/// One motor at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Draw {
    current_a: f64,
    voltage_v: f64,
    /// v i, W; negative where the motor gives power back.
    motor_w: f64,
    windings_w: f64,
    gear_w: f64,
    friction_w: f64,
    /// Of electronics and brake, W.
    standing_w: f64,
}

/// What the motors of all joints draw over a maneuver.
#[derive(Clone, Debug, PartialEq)]
pub struct Motors<'a> {
    profile: &'a PowerProfile,
    /// One a joint, at every point of the profile.
    draws: Vec<Vec<Draw>>,
}

impl<'a> Motors<'a> {
    /// Of the drives (one a joint) in a profile's motion; `None` where a drive's motor is not known.
    ///
    /// # Panics
    /// There is not one drive a joint.
    pub fn new(drives: &[Drive], profile: &'a PowerProfile) -> Option<Self> {
        let motors: Option<Vec<Motor>> = drives.iter().map(|drive| drive.motor).collect();
        let motors = motors?;
        let of_instant = |instant: &Instant| {
            assert_eq!(instant.joint_torques_n_m.len(), drives.len(), "one drive a joint");
            let draws = drives.iter().zip(&motors).enumerate();
            draws.map(|(joint, (drive, motor))| Draw::new(drive, motor, instant, joint)).collect()
        };
        Some(Self { profile, draws: profile.instants().iter().map(of_instant).collect() })
    }

    /// Power drawn by all joints at every point of the profile, W.
    pub fn drawn_w(&self, braking: Braking) -> Vec<f64> {
        let drawn = |draw: &Draw| {
            let motor_w = match braking {
                Braking::Burnt => draw.motor_w.max(0.0),
                Braking::FedBack => draw.motor_w,
            };
            motor_w + draw.standing_w
        };
        self.draws.iter().map(|draws| draws.iter().map(drawn).sum()).collect()
    }

    /// What all joints draw over the maneuver.
    pub fn consumption(&self, braking: Braking) -> Consumption {
        self.profile.consumption_of(&self.drawn_w(braking))
    }

    /// Where energy goes that is not work of the arm.
    pub fn losses(&self) -> Losses {
        Losses {
            windings_j: self.integral(|draw| draw.windings_w),
            gears_j: self.integral(|draw| draw.gear_w),
            friction_j: self.integral(|draw| draw.friction_w),
            standing_j: self.integral(|draw| draw.standing_w),
        }
    }

    /// The largest current of each motor in magnitude, A.
    pub fn peak_currents_a(&self) -> Vec<f64> {
        self.largest(|draw| draw.current_a)
    }

    /// The largest voltage at each motor in magnitude, V.
    pub fn peak_voltages_v(&self) -> Vec<f64> {
        self.largest(|draw| draw.voltage_v)
    }

    fn integral(&self, of: impl Fn(&Draw) -> f64) -> f64 {
        let points = self.profile.instants().iter().zip(&self.draws);
        points.map(|(at, draws)| at.weight_s * draws.iter().map(&of).sum::<f64>()).sum()
    }

    fn largest(&self, of: impl Fn(&Draw) -> f64) -> Vec<f64> {
        let joints = self.draws.first().map_or(0, Vec::len);
        let largest = |joint: usize| {
            self.draws.iter().map(|draws| of(&draws[joint]).abs()).fold(0.0, f64::max)
        };
        (0..joints).map(largest).collect()
    }
}

impl Draw {
    fn new(drive: &Drive, motor: &Motor, instant: &Instant, joint: usize) -> Self {
        let rate = instant.joint_rates_rad_s[joint];
        let acceleration = instant.joint_accelerations_rad_s2[joint];
        let friction_n_m = drive.viscous_friction_n_m_s * rate;
        let friction_w = friction_n_m * rate;
        let standing_w = drive.idle_power_w;
        if let (Some(holding_w), true) = (drive.holding_power_w, rate == 0.0 && acceleration == 0.0)
        {
            let standing_w = standing_w + holding_w;
            return Self {
                current_a: 0.0,
                voltage_v: 0.0,
                motor_w: 0.0,
                windings_w: 0.0,
                gear_w: 0.0,
                friction_w,
                standing_w,
            };
        }
        let output_n_m = instant.joint_torques_n_m[joint] + friction_n_m;
        let output_w = output_n_m * rate;
        let passed = match output_w >= 0.0 {
            true => drive.gear_efficiency.recip(),
            false => drive.gear_efficiency,
        };
        let ratio = drive.gear_ratio;
        let motor_n_m =
            ratio * drive.rotor_inertia_kg_m2 * acceleration + output_n_m * passed / ratio;
        let current_a = motor_n_m / motor.torque_constant_n_m_a;
        let windings_w = motor.resistance_ohm * current_a.powi(2);
        let shaft_rate = ratio * rate;
        Self {
            current_a,
            voltage_v: motor.resistance_ohm * current_a + motor.torque_constant_n_m_a * shaft_rate,
            motor_w: windings_w + motor_n_m * shaft_rate,
            windings_w,
            gear_w: output_w * (passed - 1.0),
            friction_w,
            standing_w,
        }
    }
}
