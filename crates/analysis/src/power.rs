//! What torque the joints of a plan give and what power that takes.
//!
//! Joint i does mechanical work at the rate τ_i q̇_i. The paper (its section V) takes Σ τ_i q̇_i / η
//! for the power drawn, with an overall actuator efficiency η = 0.1. That sum lets a joint that
//! brakes feed one that drives, at the price it was charged itself; an [`Accounting`] says what
//! becomes of braking instead.
//!
//! Although q̈ is held over an interval, τ is not constant in it. Each interval is integrated again
//! from its node, and torques are taken from the model at the five points of Gauss and Lobatto's
//! quadrature, both ends among them: exact for polynomials of degree seven. That the work of all
//! joints ∫ Σ τ q̇ dt is the change of the system's kinetic energy, which is computed from the nodes
//! without any torque, is the check.

use nalgebra::Vector3;
use righting_multibody::State;
use righting_results::FiniteOrNull;
use righting_results::trajectory::{Node, Trajectory};
use righting_scenario::error::ShapeError;
use righting_scenario::scenario::Scenario;
use righting_verifier::DormandPrince;
use serde::Serialize;

/// The paper's overall actuator efficiency η.
pub const PAPER_EFFICIENCY: f64 = 0.1;

/// Points of Gauss and Lobatto's quadrature on [0, 1] and their weights: (1 ∓ √(3/7))/2 between the
/// ends and the middle.
const QUADRATURE: [(f64, f64); 5] = [
    (0.0, 1.0 / 20.0),
    (0.172_673_164_646_011_43, 49.0 / 180.0),
    (0.5, 16.0 / 45.0),
    (0.827_326_835_353_988_6, 49.0 / 180.0),
    (1.0, 1.0 / 20.0),
];

/// What power a joint draws that does mechanical work at the rate p, η being its efficiency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accounting {
    /// p / η, as the paper does: a joint that brakes feeds the others, and the source.
    Signed,
    /// |p| / η: braking costs as much as driving.
    Absolute,
    /// max(p, 0) / η: braking costs nothing and gives nothing back.
    WithoutRegeneration,
    /// p / η when driving, η p when braking: what comes back has passed the same losses.
    WithRegeneration,
}

impl Accounting {
    /// All of them, the paper's first.
    pub const ALL: [Self; 4] =
        [Self::Signed, Self::Absolute, Self::WithoutRegeneration, Self::WithRegeneration];

    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Signed => "signed",
            Self::Absolute => "absolute",
            Self::WithoutRegeneration => "without_regeneration",
            Self::WithRegeneration => "with_regeneration",
        }
    }

    /// Power drawn, W, for the mechanical power of one joint.
    pub fn drawn_w(self, mechanical_w: f64, efficiency: f64) -> f64 {
        match self {
            Self::Signed => mechanical_w / efficiency,
            Self::Absolute => mechanical_w.abs() / efficiency,
            Self::WithoutRegeneration => mechanical_w.max(0.0) / efficiency,
            Self::WithRegeneration if mechanical_w < 0.0 => mechanical_w * efficiency,
            Self::WithRegeneration => mechanical_w / efficiency,
        }
    }
}

/// Power drawn over a whole maneuver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Consumption {
    /// The most at any time.
    #[serde(with = "FiniteOrNull")]
    pub peak_w: f64,
    /// When.
    #[serde(with = "FiniteOrNull")]
    pub peak_time_s: f64,
    /// Its mean over the maneuver.
    #[serde(with = "FiniteOrNull")]
    pub mean_w: f64,
    /// Its integral.
    #[serde(with = "FiniteOrNull")]
    pub energy_j: f64,
}

/// What joints and mount bear at one point of an interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// Time since the start; the same for the end of an interval and the start of the next.
    pub time_s: f64,
    /// Weight of this point in integrals over time, s.
    pub weight_s: f64,
    /// Torque of each joint, N m.
    pub joint_torques_n_m: Vec<f64>,
    /// Rate of each joint, rad/s.
    pub joint_rates_rad_s: Vec<f64>,
    /// Acceleration of each joint, rad/s².
    pub joint_accelerations_rad_s2: Vec<f64>,
    /// Mechanical power of each joint, W.
    pub joint_powers_w: Vec<f64>,
    /// Length of the force between base and arm, N.
    pub mount_force_n: f64,
    /// Length of the moment between them about the mount, N m.
    pub mount_moment_n_m: f64,
    /// Length of the base's angular rate, rad/s.
    pub base_rate_rad_s: f64,
}

/// Torques, loads and mechanical power over a maneuver, five points an interval.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerProfile {
    instants: Vec<Instant>,
    duration_s: f64,
    kinetic_energy_change_j: f64,
}

impl PowerProfile {
    /// Of a trajectory of the scenario's system on the scenario's grid.
    ///
    /// # Errors
    /// The trajectory has other joints or steps than the scenario.
    pub fn new(scenario: &Scenario, trajectory: &Trajectory) -> Result<Self, ShapeError> {
        let model = &scenario.system().model;
        let horizon = scenario.horizon();
        let counts = [
            ("joints", trajectory.joints(), model.joint_count()),
            ("steps", trajectory.steps(), horizon.steps),
        ];
        for (what, found, needed) in counts {
            if found != needed {
                return Err(ShapeError { what: what.to_owned(), found, needed });
            }
        }
        let mut integrator = DormandPrince::new(State::<f64>::dimension(model.joint_count()));
        let mut instants = Vec::with_capacity(QUADRATURE.len() * trajectory.steps());
        for k in 0..trajectory.steps() {
            let (start_s, end_s) = (horizon.time_s(k), horizon.time_s(k + 1));
            instants.extend(within(scenario, &mut integrator, trajectory, k, [start_s, end_s]));
        }
        let energy_j = |node: &Node| model.kinetic_energy(&node.state());
        Ok(Self {
            instants,
            duration_s: horizon.duration_s,
            kinetic_energy_change_j: energy_j(trajectory.end()) - energy_j(trajectory.start()),
        })
    }

    /// All points in the order of time.
    pub fn instants(&self) -> &[Instant] {
        &self.instants
    }

    /// Length of the maneuver, s.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Mechanical work of all joints ∫ Σ τ q̇ dt, J.
    pub fn work_j(&self) -> f64 {
        let mechanical_w = |instant: &Instant| instant.joint_powers_w.iter().sum::<f64>();
        self.instants.iter().map(|instant| instant.weight_s * mechanical_w(instant)).sum()
    }

    /// Effort of the joints ∫ ‖q̈‖² dt, rad²/s³; exact, since accelerations are at most linear in an interval.
    pub fn effort_rad2_s3(&self) -> f64 {
        let squared = |instant: &Instant| -> f64 {
            instant.joint_accelerations_rad_s2.iter().map(|u| u * u).sum()
        };
        self.instants.iter().map(|instant| instant.weight_s * squared(instant)).sum()
    }

    /// Kinetic energy of the last node less that of the first, J: what [`work_j`](Self::work_j) must
    /// be.
    pub fn kinetic_energy_change_j(&self) -> f64 {
        self.kinetic_energy_change_j
    }

    /// Power drawn by all joints at every point, W.
    pub fn drawn_w(&self, accounting: Accounting, efficiency: f64) -> Vec<f64> {
        let drawn = |&power: &f64| accounting.drawn_w(power, efficiency);
        self.instants.iter().map(|i| i.joint_powers_w.iter().map(drawn).sum()).collect()
    }

    /// What all joints draw over the maneuver.
    pub fn consumption(&self, accounting: Accounting, efficiency: f64) -> Consumption {
        self.consumption_of(&self.drawn_w(accounting, efficiency))
    }

    /// Of power drawn at every point (W).
    pub(crate) fn consumption_of(&self, drawn_w: &[f64]) -> Consumption {
        let energy_j = self.instants.iter().zip(drawn_w).map(|(i, w)| i.weight_s * w).sum();
        let highest = (0..drawn_w.len()).max_by(|&a, &b| drawn_w[a].total_cmp(&drawn_w[b]));
        let (peak_w, peak_time_s) =
            highest.map_or((f64::NAN, f64::NAN), |i| (drawn_w[i], self.instants[i].time_s));
        Consumption { peak_w, peak_time_s, mean_w: energy_j / self.duration_s, energy_j }
    }

    /// The largest torque of each joint in magnitude, N m.
    pub fn peak_torques_n_m(&self) -> Vec<f64> {
        self.largest(|instant| &instant.joint_torques_n_m)
    }

    /// The largest mechanical power of each joint in magnitude, W.
    pub fn peak_joint_powers_w(&self) -> Vec<f64> {
        self.largest(|instant| &instant.joint_powers_w)
    }

    fn largest(&self, of: impl Fn(&Instant) -> &Vec<f64>) -> Vec<f64> {
        let joints = self.instants.first().map_or(0, |instant| of(instant).len());
        let largest = |joint: usize| {
            self.instants.iter().map(|instant| of(instant)[joint].abs()).fold(0.0, f64::max)
        };
        (0..joints).map(largest).collect()
    }
}

/// The joints at the points of interval `k`, from `start_s` to `end_s`. From a state that cannot be
/// followed, all later ones are NaN.
fn within(
    scenario: &Scenario,
    integrator: &mut DormandPrince,
    trajectory: &Trajectory,
    k: usize,
    [start_s, end_s]: [f64; 2],
) -> Vec<Instant> {
    let model = &scenario.system().model;
    let length_s = end_s - start_s;
    let mut reached = 0.0;
    let interval = &trajectory.intervals()[k];
    let mut x = trajectory.nodes()[k].state().to_vec();
    let mut at = |(place, weight): (f64, f64)| {
        if place > reached {
            let before_s = reached * length_s;
            let duration_s = (place - reached) * length_s;
            let followed = integrator.advance(&mut x, duration_s, |after_s, x, rate| {
                let control = interval.joint_accelerations_after(before_s + after_s);
                let external = trajectory.external(scenario, (k, before_s + after_s), x);
                let derivative = model.state_derivative(x, &control, external.as_ref());
                rate.copy_from_slice(&derivative);
            });
            if !followed {
                x.fill(f64::NAN);
            }
            reached = place;
        }
        let state = State::from_slice(&x)?;
        let rate: &Vector3<f64> = &state.angular_rate;
        let control = interval.joint_accelerations_after(place * length_s);
        let (angles, rates) = (&state.joint_angles, &state.joint_rates);
        let time_s = if place == 1.0 { end_s } else { start_s + place * length_s };
        let external = trajectory.external(scenario, (k, place * length_s), &x);
        let dynamics =
            model.free_floating_dynamics(rate, angles, rates, &control, external.as_ref());
        let torques = dynamics.joint_torques;
        let powers = torques.iter().zip(&state.joint_rates).map(|(torque, rate)| torque * rate);
        Some(Instant {
            time_s,
            weight_s: weight * length_s,
            joint_powers_w: powers.collect(),
            joint_torques_n_m: torques,
            joint_accelerations_rad_s2: control,
            mount_force_n: dynamics.mount.force.norm(),
            mount_moment_n_m: dynamics.mount.moment.norm(),
            base_rate_rad_s: rate.norm(),
            joint_rates_rad_s: state.joint_rates,
        })
    };
    QUADRATURE.into_iter().filter_map(&mut at).collect()
}
