//! Arms of thin links that can get past each other.

use righting_scenario::Scenario;
use righting_scenario::file::{Horizon, Link, SystemReference};

use crate::{shipped, varied};

/// A link without offset that turns without end, at most at this rate and acceleration (deg/s, deg/s²).
pub fn thin_link(mass_kg: f64, a_m: f64, alpha_deg: f64, limits: [f64; 2]) -> Link {
    let [rate_max_deg_s, acceleration_max_deg_s2] = limits;
    Link {
        name: None,
        mass_kg,
        a_m,
        alpha_deg,
        d_m: 0.0,
        theta_deg: 0.0,
        angle_min_deg: None,
        angle_max_deg: None,
        rate_max_deg_s,
        acceleration_max_deg_s2,
        jerk_max_deg_s3: None,
        torque_max_n_m: None,
        drive: None,
        body_exempt: false,
        center_of_mass_m: None,
        inertia_kg_m2: None,
        inertial_frame: None,
        radius_m: None,
        shapes: None,
    }
}

/// Two links of 2 m that lie in the plane of the mount, the second turned back by 120°, and a last one
/// hanging from the end of the second. It swings about the direction of the first, whose middle it
/// reaches if it is 1.732 m long: a pendulum through a rod.
pub fn pendulum(length_m: f64) -> Scenario {
    let link = |mass_kg, a_m, alpha_deg| thin_link(mass_kg, a_m, alpha_deg, [100.0, 100.0]);
    varied(&shipped("slew_4dof"), |file| {
        let SystemReference::Inline(system) = &mut file.system else {
            unreachable!("a resolved system is inline")
        };
        system.links = vec![
            link(3.0, 2.0, 0.0),
            link(3.0, 2.0, 0.0),
            link(0.0, 0.0, 90.0),
            link(3.0, length_m, 0.0),
        ];
        system.base.keep_out_radius_m = Some(0.05);
        system.base.inertia_kg_m2 = Some([[50.0, 0.0, 0.0], [0.0, 50.0, 0.0], [0.0, 0.0, 50.0]]);
        system.base.cube_side_m = None;
        file.initial.joint_angles_deg = vec![0.0, 120.0, 150.0, -60.0];
        file.horizon =
            Horizon { duration_s: righting_scenario::file::Duration::Given(3.0), steps: 3.0 };
        file.collision.clearance_m = Some(0.01);
    })
}
