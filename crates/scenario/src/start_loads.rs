//! Limits of loads and rates that a start cannot keep, whatever the arm does.

use righting_multibody::System;

use crate::error::Error;
use crate::file;
use crate::initial::Initial;
use crate::json::{Location, Number};
use crate::rounding::PRINTED;
use crate::system_description::SystemDescription;

/// Refuses a base that turns too fast already, and a torque limit that no joint accelerations within their
/// limits keep at the start.
pub(crate) fn check(
    (system, file): (&SystemDescription, &file::System),
    initial: &Initial,
    rate_place: &Location,
    place: &Location,
) -> Result<(), Error> {
    let rate_rad_s = initial.angular_rate_rad_s.norm();
    let most_rad_s = system.load_limits.angular_rate_max_rad_s;
    if rate_rad_s > most_rad_s * (1.0 + PRINTED) {
        return Err(rate_place.refuse(
            format!("{} deg/s in all", Number::rounded(rate_rad_s.to_degrees(), 6)),
            format!(
                "at most base.angular_rate_max_deg_s, {}",
                Number::rounded(most_rad_s.to_degrees(), 6)
            ),
        ));
    }
    for (joint, row) in file.joints().iter().enumerate() {
        let limits = &system.joint_limits[joint];
        if limits.torque_max_n_m.is_infinite() {
            continue;
        }
        let needed_n_m = least_torque_n_m(system, initial, joint);
        if needed_n_m > limits.torque_max_n_m {
            return Err(row.at(place).key(row.words().effort_max).refuse(
                Number(limits.torque_max_n_m),
                format!(
                    "at least {}: {} needs as much at the start, whatever the joints' \
                     accelerations",
                    Number::rounded(needed_n_m, 4),
                    system.names.joint(joint)
                ),
            ));
        }
    }
    Ok(())
}

/// The least torque in magnitude that a joint can need at the start: torques are affine in the joints'
/// accelerations, each of which may be anything within its limits; with limited jerks they start at zero.
fn least_torque_n_m(system: &SystemDescription, initial: &Initial, joint: usize) -> f64 {
    let model: &System = &system.model;
    let mut accelerations = vec![0.0; system.joint_count()];
    let torque = |accelerations: &[f64]| {
        let torques = model.joint_torques(
            &initial.angular_rate_rad_s,
            &initial.joint_angles_rad,
            &initial.joint_rates_rad_s,
            accelerations,
            None,
        );
        let rate = initial.joint_rates_rad_s[joint];
        system.drives[joint].torque(torques[joint], rate, accelerations[joint])
    };
    let coasting = torque(&accelerations);
    let mut reach = 0.0;
    for (other, limits) in system.joint_limits.iter().enumerate() {
        if !limits.is_locked() && !system.limits_jerk() {
            accelerations[other] = 1.0;
            reach += (torque(&accelerations) - coasting).abs() * limits.acceleration_max_rad_s2;
            accelerations[other] = 0.0;
        }
    }
    (coasting.abs() - reach).max(0.0)
}
