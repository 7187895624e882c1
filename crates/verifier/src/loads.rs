//! Loads and the base's rate against their limits, at the nodes and between them: torques of the joints'
//! drives, force and moment at the mount.
//!
//! The motion between two nodes is integrated from the first of them. A step's torques jump where it
//! begins, so both its ends are looked at with its own accelerations.

use righting_results::trajectory::Trajectory;
use righting_scenario::file;

use crate::ledger::{Ledger, Subject, Worst};
use crate::model::State;
use crate::requirements::Requirements;
use crate::simulation::{Follower, Simulation};

/// Equal parts of a step at whose ends loads are looked at.
const PARTS: usize = 5;
/// How much of its limit a load may be past it.
const SHARE: f64 = 0.01;

/// The limits of a system, where it has any.
#[derive(Clone, Debug)]
pub(super) struct LoadLimits {
    /// One a joint, N m or N.
    torques_n_m: Vec<Option<f64>>,
    /// One a joint.
    drives: Vec<DriveTorque>,
    mount_force_n: Option<f64>,
    mount_moment_n_m: Option<f64>,
    base_rate_rad_s: Option<f64>,
}

/// What a drive gives beside the torque that moves the arm.
#[derive(Clone, Copy, Debug)]
struct DriveTorque {
    /// N m s.
    friction: f64,
    /// Of the rotor, at the joint, kg m².
    inertia: f64,
}

impl DriveTorque {
    fn new(joint: &file::JointRow) -> Self {
        let drive = joint.drive.as_ref();
        let of = |value: fn(&file::Drive) -> Option<f64>| drive.and_then(value).unwrap_or(0.0);
        let ratio = drive.and_then(|drive| drive.gear_ratio).unwrap_or(1.0);
        // The rotor's kinetic energy J (n q̇)² / 2 is that of an inertia n² J at the joint.
        Self {
            friction: of(|drive| drive.viscous_friction_n_m_s),
            inertia: of(|drive| drive.rotor_inertia_kg_m2) * ratio * ratio,
        }
    }
}

impl LoadLimits {
    pub fn new(system: &file::System) -> Self {
        Self {
            torques_n_m: system.joints().iter().map(|joint| joint.effort_max).collect(),
            drives: system.joints().iter().map(DriveTorque::new).collect(),
            mount_force_n: system.mount.as_ref().and_then(|mount| mount.force_max_n),
            mount_moment_n_m: system.mount.as_ref().and_then(|mount| mount.moment_max_n_m),
            base_rate_rad_s: system.base.angular_rate_max_deg_s.map(f64::to_radians),
        }
    }

    fn is_empty(&self) -> bool {
        let Self { torques_n_m, mount_force_n, mount_moment_n_m, base_rate_rad_s, .. } = self;
        let others = [mount_force_n, mount_moment_n_m, base_rate_rad_s];
        torques_n_m.iter().chain(others).all(Option::is_none)
    }
}

/// The worst place of each limit.
struct Loads {
    /// One a joint.
    torques: Vec<Option<Worst>>,
    mount_force: Option<Worst>,
    mount_moment: Option<Worst>,
    base_rate: Option<Worst>,
}

impl Loads {
    fn new(limits: &LoadLimits, slides: &[bool]) -> Self {
        let worst = |name, unit, limit: Option<f64>| {
            limit.map(|limit| Worst::of_limit(name, unit, SHARE * limit))
        };
        let torques = limits.torques_n_m.iter();
        Self {
            torques: torques
                .zip(slides)
                .map(|(&limit, slides)| match slides {
                    true => worst("joint force", "N", limit),
                    false => worst("joint torque", "N m", limit),
                })
                .collect(),
            mount_force: worst("force at the mount", "N", limits.mount_force_n),
            mount_moment: worst("moment at the mount", "N m", limits.mount_moment_n_m),
            base_rate: worst("angular rate of the base", "rad/s", limits.base_rate_rad_s),
        }
    }
}

pub(super) fn check(
    asked: &Requirements,
    trajectory: &Trajectory,
    simulation: &Simulation,
    ledger: &mut Ledger,
) {
    let limits = &asked.load_limits;
    if limits.is_empty() {
        return;
    }
    let model = &asked.model;
    let mut worst = Loads::new(limits, &asked.slides);
    let mut follower = Follower::new(model, &asked.surroundings);
    let mut torques = vec![0.0; model.joint_count()];
    for (k, (interval, node)) in trajectory.intervals().iter().zip(simulation.nodes()).enumerate() {
        let span = simulation.span(asked, k, interval);
        let accelerations = span.accelerations;
        let start_s = asked.horizon.time_s(k);
        let part_s = (asked.horizon.time_s(k + 1) - start_s) / PARTS as f64;
        let mut x = node.to_vec();
        for part in 0..=PARTS {
            if part > 0 {
                let before_s = (part - 1) as f64 * part_s;
                follower.advance(&mut x, span, before_s, part_s);
            }
            let state = State::from_slice(&x);
            let Follower { motion, control, .. } = &mut follower;
            let after_s = part as f64 * part_s;
            accelerations.write(after_s, control);
            let outside = span.outside(&asked.surroundings, &state, after_s);
            let mount = model.joint_torques(&state, control, &outside, motion, &mut torques);
            let time_s = Some(start_s + after_s);
            let of_joints = worst.torques.iter_mut().zip(&limits.torques_n_m).zip(&torques);
            for (joint, ((worst, limit), torque)) in of_joints.enumerate() {
                if let (Some(worst), Some(limit)) = (worst, limit) {
                    let drive = &limits.drives[joint];
                    let beside =
                        drive.friction * state.joint_rates[joint] + drive.inertia * control[joint];
                    let torque_n_m = (torque + beside).abs();
                    worst.at_most(torque_n_m, *limit, Some(Subject::Joint(joint)), time_s);
                }
            }
            let others = [
                (&mut worst.mount_force, limits.mount_force_n, mount.force.norm()),
                (&mut worst.mount_moment, limits.mount_moment_n_m, mount.moment.norm()),
                (&mut worst.base_rate, limits.base_rate_rad_s, state.angular_rate.norm()),
            ];
            for (worst, limit, value) in others {
                if let (Some(worst), Some(limit)) = (worst, limit) {
                    worst.at_most(value, limit, None, time_s);
                }
            }
        }
    }
    let Loads { torques, mount_force, mount_moment, base_rate } = worst;
    for worst in torques.into_iter().chain([mount_force, mount_moment, base_rate]).flatten() {
        ledger.add(worst);
    }
}
