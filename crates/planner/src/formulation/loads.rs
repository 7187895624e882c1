//! What joints, mount and base bear within a step: torques of the drives, force and moment at the mount, and the
//! base's angular rate.
//!
//! Over a step the joints' acceleration is held, so at a time s after its beginning their angles and rates
//! are known exactly. The base's angular rate follows from them and the angular momentum,
//!
//! ```text
//! ω(s) = Ĩ⁻¹ (h_B(s) − H̃),   h_B(s) = C(q_BN(s))ᵀ h₀,   q_BN(s) ≈ q_BN + s q̇_BN,
//! ```
//!
//! with a quaternion that is off by the square of how far the base's rate changes within the step, and not
//! at all where there is no momentum. Torques jump from step to step with the accelerations and change
//! within one, so they are stated at both its ends, and at places between where that is not enough. Where
//! accelerations are continuous, so are torques, and the end of a step says the same as the beginning of the
//! next.

use std::sync::Arc;

use nalgebra::Vector3;
use righting_multibody::{External, System};
use righting_ocp::ComponentBounds;
use righting_scalar::Scalar;
use righting_scenario::scenario::Scenario;
use righting_scenario::{Drive, LoadLimits};

use super::{Coordinates, sum_of_squares};

/// The loads that have a limit, each measured by it.
#[derive(Clone)]
pub(crate) struct Loads {
    system: Arc<System>,
    /// Joints whose torque is limited, counted from zero, and the largest.
    torques: Vec<(usize, f64)>,
    /// One a joint.
    drives: Vec<Drive>,
    limits: LoadLimits,
    /// The first place of a step at which forces and torques are stated: its beginning, or after that.
    first_place: usize,
}

impl Loads {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let system = scenario.system();
        let torques = system.joint_limits.iter().map(|limits| limits.torque_max_n_m).enumerate();
        Self {
            system: Arc::new(system.model.clone()),
            torques: torques.filter(|(_, most)| most.is_finite()).collect(),
            drives: system.drives.clone(),
            limits: system.load_limits,
            first_place: usize::from(system.limits_jerk()),
        }
    }

    /// Whether nothing is limited.
    pub(crate) fn is_empty(&self) -> bool {
        !self.has_forces() && !self.has_rate()
    }

    fn has_forces(&self) -> bool {
        let LoadLimits { mount_force_max_n, mount_moment_max_n_m, .. } = self.limits;
        !self.torques.is_empty()
            || mount_force_max_n.is_finite()
            || mount_moment_max_n_m.is_finite()
    }

    fn has_rate(&self) -> bool {
        self.limits.angular_rate_max_rad_s.is_finite()
    }

    /// Bounds of [`values`](Self::values) in a step that is taken as so many equal parts.
    pub(super) fn bounds(&self, parts: usize) -> ComponentBounds {
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for place in self.first_place..=parts {
            let signed = self.torques.len();
            lower.extend(vec![-1.0; signed]);
            let squares = self.squares(place);
            lower.extend(vec![f64::NEG_INFINITY; squares]);
            upper.extend(vec![1.0; signed + squares]);
        }
        ComponentBounds::new(lower, upper)
    }

    /// How many squares of vectors are limited at a place within a step.
    fn squares(&self, place: usize) -> usize {
        let LoadLimits { mount_force_max_n, mount_moment_max_n_m, .. } = self.limits;
        let mount = [mount_force_max_n, mount_moment_max_n_m];
        let mount = mount.into_iter().filter(|most| most.is_finite()).count();
        mount + usize::from(self.has_rate() && place > 0)
    }

    /// The loads at the ends of the `parts` equal parts of a step of length `h` from state `x` with the
    /// controls `u`, as shares of their limits: torques with their sign, lengths of vectors squared. The
    /// base's rate where a step begins is the one where the last step ended.
    pub(super) fn values<T: Scalar>(
        &self,
        coordinates: &Coordinates,
        (x, u): (&[T], &[T]),
        h: T,
        parts: usize,
    ) -> Vec<T> {
        let mut values = Vec::new();
        if self.is_empty() {
            return values;
        }
        for place in self.first_place..=parts {
            let moment = coordinates.within(x, u, h * (place as f64 / parts as f64));
            values.extend(self.shares(&moment, place > 0));
        }
        values
    }

    /// The loads at a moment, as shares of their limits.
    fn shares<T: Scalar>(&self, moment: &Moment<T>, with_rate: bool) -> Vec<T> {
        let Moment { angular_rate, joint_angles, joint_rates, joint_accelerations, external } =
            moment;
        let square = |vector: &Vector3<T>, most: f64| {
            most.is_finite().then(|| sum_of_squares(vector.as_slice()) * most.powi(-2))
        };
        let mut shares = Vec::new();
        if self.has_forces() {
            let dynamics = self.system.free_floating_dynamics(
                angular_rate,
                joint_angles,
                joint_rates,
                joint_accelerations,
                external.as_ref(),
            );
            shares.extend(self.torques.iter().map(|&(joint, most)| {
                let (rate, acceleration) = (joint_rates[joint], joint_accelerations[joint]);
                let torque = dynamics.joint_torques[joint];
                self.drives[joint].torque(torque, rate, acceleration) * most.recip()
            }));
            shares.extend(square(&dynamics.mount.force, self.limits.mount_force_max_n));
            shares.extend(square(&dynamics.mount.moment, self.limits.mount_moment_max_n_m));
        }
        if with_rate {
            shares.extend(square(angular_rate, self.limits.angular_rate_max_rad_s));
        }
        shares
    }

    /// The largest share of a limit that a step reaches at the ends of `parts` equal parts of it, squares
    /// of vectors as their lengths.
    pub(crate) fn largest_share(
        &self,
        coordinates: &Coordinates,
        (x, u): (&[f64], &[f64]),
        h: f64,
        parts: usize,
    ) -> f64 {
        let mut largest: f64 = 0.0;
        for place in 0..=parts {
            let moment = coordinates.within(x, u, h * (place as f64 / parts as f64));
            for (index, share) in self.shares(&moment, place > 0).into_iter().enumerate() {
                let is_torque = index < self.torques.len();
                largest = largest.max(if is_torque { share.abs() } else { share.sqrt() });
            }
        }
        largest
    }
}

/// A moment within a step, as far as loads depend on it.
pub(crate) struct Moment<T> {
    /// Of the base, body axes.
    pub(crate) angular_rate: Vector3<T>,
    pub(crate) joint_angles: Vec<T>,
    pub(crate) joint_rates: Vec<T>,
    pub(crate) joint_accelerations: Vec<T>,
    /// What acts from outside, if anything does.
    pub(crate) external: Option<External<T>>,
}
