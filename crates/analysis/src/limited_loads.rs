//! Loads of a plan that have a limit, over time.

use righting_scenario::{LoadLimits, SystemDescription};

use crate::power::{Instant, PowerProfile};

/// What is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitedLoad {
    /// Torque of a joint's drive, counted from zero; N m, with its sign.
    JointTorque(usize),
    /// Length of the force at the mount, N.
    MountForce,
    /// Length of the moment at the mount, N m.
    MountMoment,
    /// Length of the base's angular rate, rad/s.
    BaseRate,
}

/// A load over a maneuver.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadHistory {
    /// Which.
    pub load: LimitedLoad,
    /// The most that it may be in magnitude.
    pub most: f64,
    /// At every point of the profile.
    pub values: Vec<f64>,
}

/// Every load of a system that has a limit.
///
/// # Panics
/// The profile is of another number of joints.
pub fn limited_loads(system: &SystemDescription, profile: &PowerProfile) -> Vec<LoadHistory> {
    let history = |load, most: f64, value: &dyn Fn(&Instant) -> f64| {
        let values = || profile.instants().iter().map(value).collect();
        most.is_finite().then(|| LoadHistory { load, most, values: values() })
    };
    let torques = system.joint_limits.iter().zip(&system.drives).enumerate();
    let torques = torques.map(|(joint, (limits, drive))| {
        history(LimitedLoad::JointTorque(joint), limits.torque_max_n_m, &|instant| {
            drive.torque(
                instant.joint_torques_n_m[joint],
                instant.joint_rates_rad_s[joint],
                instant.joint_accelerations_rad_s2[joint],
            )
        })
    });
    let LoadLimits { mount_force_max_n, mount_moment_max_n_m, angular_rate_max_rad_s } =
        system.load_limits;
    let others = [
        history(LimitedLoad::MountForce, mount_force_max_n, &|instant| instant.mount_force_n),
        history(LimitedLoad::MountMoment, mount_moment_max_n_m, &|instant| {
            instant.mount_moment_n_m
        }),
        history(LimitedLoad::BaseRate, angular_rate_max_rad_s, &|instant| instant.base_rate_rad_s),
    ];
    torques.chain(others).flatten().collect()
}
