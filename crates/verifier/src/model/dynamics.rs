//! What the base does when the joints accelerate, and the torques it takes.

use nalgebra::{Matrix3, Quaternion, Vector3};

use super::body::Carrier;
use super::{Model, Motion, Outside, State};

/// Acceleration of the base, in inertial axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BaseAcceleration {
    /// Ω̇, rad/s².
    pub angular: Vector3<f64>,
    /// r̈ of the origin of the body frame, m/s².
    pub linear: Vector3<f64>,
}

/// What the base does to all that lies beyond the mount, in inertial axes; to all bodies of a list, which has
/// no mount.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MountLoad {
    /// Force, N.
    pub force: Vector3<f64>,
    /// Moment about the mount, or about the origin of the body frame, N m.
    pub moment: Vector3<f64>,
}

impl Model {
    /// The acceleration of the free-floating base in the state `state` while its joints accelerate
    /// by `u` (j, rad/s²) and nothing acts from outside but `outside`; NaN if the system has no motion. Leaves in `motion` the motion of an
    /// unaccelerated base.
    ///
    /// # Panics
    /// A slice does not have one value a joint, or `motion` is another model's.
    pub fn base_acceleration(
        &self,
        state: &State<'_>,
        u: &[f64],
        outside: &Outside,
        motion: &mut Motion,
    ) -> BaseAcceleration {
        motion.set(self, state, &BaseAcceleration::default(), u);
        motion.take_off(outside);
        let center = motion.center_of_mass();
        let mut force = Vector3::zeros();
        let mut moment = -outside.torque;
        let mut inertia = Matrix3::zeros();
        for body in motion.bodies() {
            let arm = body.center - center;
            force += body.force;
            moment += arm.cross(&body.force) + body.moment;
            let parallel_axes =
                Matrix3::from_diagonal_element(arm.norm_squared()) - arm * arm.transpose();
            inertia += body.inertia + parallel_axes * body.mass;
        }
        let angular = inertia
            .cholesky()
            .map_or_else(|| Vector3::repeat(f64::NAN), |factor| factor.solve(&-moment));
        let linear = -force / self.total_mass - angular.cross(&(center - state.position));
        BaseAcceleration { angular, linear }
    }

    /// Writes ẋ of the state vector `x` ∈ R^{13+2j} under joint accelerations `u` (j, rad/s²) and what acts from
    /// outside into `rate`.
    ///
    /// # Panics
    /// A slice has another length, or `motion` is another model's.
    pub fn state_derivative(
        &self,
        x: &[f64],
        u: &[f64],
        outside: &Outside,
        motion: &mut Motion,
        rate: &mut [f64],
    ) {
        let state = State::from_slice(x);
        let base = self.base_acceleration(&state, u, outside, motion);
        State {
            position: state.velocity,
            attitude: state.attitude * Quaternion::from_imag(state.angular_rate) * 0.5,
            velocity: base.linear,
            // Ω = C ω, so Ω̇ = C ω̇ + Ω × Ω.
            angular_rate: motion.base().rotation.tr_mul(&base.angular),
            joint_angles: state.joint_rates,
            joint_rates: u,
        }
        .write(rate);
    }

    /// Writes the torques (N m; forces, N, where they slide) of the joints' motors into `torques` (j): of the free-floating system
    /// in the state `state` while its joints accelerate by `u` (j, rad/s²) and nothing acts from outside but
    /// `outside`. Returns what the base does to the arm at the mount.
    ///
    /// # Panics
    /// A slice does not have one value a joint, or `motion` is another model's.
    pub fn joint_torques(
        &self,
        state: &State<'_>,
        u: &[f64],
        outside: &Outside,
        motion: &mut Motion,
        torques: &mut [f64],
    ) -> MountLoad {
        assert_eq!(torques.len(), self.joint_count());
        let base = self.base_acceleration(state, u, outside, motion);
        motion.set(self, state, &base, u);
        motion.take_off(outside);
        // Force and moment about the origin of the body frame on all that each frame carries.
        let mut carried = std::mem::take(&mut motion.carried);
        carried.fill([Vector3::zeros(); 2]);
        for (body, moving) in self.bodies.iter().zip(motion.bodies()) {
            if let Carrier::Frame(frame) = body.carrier {
                let [force, moment] = &mut carried[frame];
                *force += moving.force;
                *moment += (moving.center - state.position).cross(&moving.force) + moving.moment;
            }
        }
        for step in self.steps.iter().rev() {
            let [force, moment] = carried[step.frame];
            if let Some(joint) = step.joint {
                let (point, axis) = motion.joint_axis(step);
                torques[joint] = match step.slides() {
                    true => axis.dot(&force),
                    false => axis.dot(&(moment - (point - state.position).cross(&force))),
                };
            }
            carried[step.parent][0] += force;
            carried[step.parent][1] += moment;
        }
        let [force, moment] = carried[0];
        motion.carried = carried;
        let mount = motion.frames()[0].origin - state.position;
        MountLoad { force, moment: moment - mount.cross(&force) }
    }
}
