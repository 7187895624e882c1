//! Masses, momenta and forces of a scenario's system at random states, one JSON object a line: what
//! `scripts/check_models.py` compares with what other programs find in the exported models.
//!
//! ```sh
//! cargo run --release -p righting-export --example reference -- scenarios/slew_4dof.json 20
//! ```

use std::f64::consts::PI;
use std::path::Path;

use nalgebra::Vector3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_multibody::{BaseAcceleration, Quaternion, State};
use righting_scenario::Scenario;
use serde_json::json;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, count] = arguments.as_slice() else {
        return Err("expected a scenario file and a number of states".into());
    };
    let scenario = Scenario::read(Path::new(file))?;
    let mut random = ChaCha8Rng::seed_from_u64(15);
    for _ in 0..count.parse::<usize>()? {
        println!("{}", sample(&scenario, &mut || random.random_range(-1.0..1.0)));
    }
    Ok(())
}

/// A state, an acceleration, and what belongs to them. `random` draws from −1 to 1.
fn sample(scenario: &Scenario, random: &mut dyn FnMut() -> f64) -> serde_json::Value {
    let system = scenario.system();
    let model = &system.model;
    let mut vector = || Vector3::new(random(), random(), random());
    let (position, velocity, angular_rate) = (vector(), vector(), vector());
    let base = BaseAcceleration { angular: vector(), linear: vector() };
    let attitude = Quaternion::new(random(), random(), random(), random()).normalized();
    let (mut q, mut qdot, mut qddot) = (Vec::new(), Vec::new(), Vec::new());
    for limits in &system.joint_limits {
        let drawn = [PI * random(), random(), random()];
        let [angle, rate, acceleration] = match limits.is_locked() {
            true => [limits.angle_min_rad, 0.0, 0.0],
            false => drawn,
        };
        q.push(angle);
        qdot.push(rate);
        qddot.push(acceleration);
    }
    let forces =
        |omega: &Vector3<f64>, base: &BaseAcceleration<f64>, rates: &[f64], joints: &[f64]| {
            let found = model.inverse_dynamics(base, omega, &q, rates, joints);
            let of_base = found.base_force.iter().chain(found.base_moment.iter()).copied();
            of_base.chain(found.joint_torques).collect::<Vec<f64>>()
        };
    // Column by column: what accelerates the resting system by one unit.
    let mass_matrix = (0..6 + q.len()).map(|index| {
        let unit = |i: usize| if i == index { 1.0 } else { 0.0 };
        let base = BaseAcceleration {
            linear: Vector3::from_fn(|i, _| unit(i)),
            angular: Vector3::from_fn(|i, _| unit(3 + i)),
        };
        let joints: Vec<f64> = (0..q.len()).map(|i| unit(6 + i)).collect();
        forces(&Vector3::zeros(), &base, &vec![0.0; q.len()], &joints)
    });
    let mass_matrix: Vec<Vec<f64>> = mass_matrix.collect();
    let inverse_dynamics = forces(&angular_rate, &base, &qdot, &qddot);
    let state = State {
        position,
        attitude,
        velocity: attitude.to_inertial(&velocity),
        angular_rate,
        joint_angles: q.clone(),
        joint_rates: qdot.clone(),
    };
    json!({
        "position_m": position.as_slice(),
        "attitude_wxyz": attitude.to_array(),
        "velocity_body_m_s": velocity.as_slice(),
        "angular_rate_body_rad_s": angular_rate.as_slice(),
        "joint_angles_rad": q,
        "joint_rates_rad_s": qdot,
        "is_locked": system.joint_limits.iter().map(|limits| limits.is_locked()).collect::<Vec<_>>(),
        "acceleration_body_m_s2": base.linear.as_slice(),
        "angular_acceleration_body_rad_s2": base.angular.as_slice(),
        "joint_accelerations_rad_s2": qddot,
        "mass_matrix": mass_matrix,
        "inverse_dynamics": inverse_dynamics,
        "center_of_mass_m": model.inertial_center_of_mass(&state).as_slice(),
        "linear_momentum": model.linear_momentum(&state).as_slice(),
        "angular_momentum": model.inertial_angular_momentum(&state).as_slice(),
    })
}
