//! Masses, momenta and forces of a system at random states, one JSON object a line: what
//! `scripts/check_exports.py` and `scripts/check_import.py` compare with what other programs find in
//! models. With a folder, the system's exported models are written to it too.
//!
//! ```sh
//! cargo run --release -p righting-export --example reference -- scenarios/slew_4dof.json 20
//! cargo run --release -p righting-export --example reference -- scenarios/systems/canadarm2.json 20 out
//! ```

use std::f64::consts::PI;
use std::path::Path;

use nalgebra::Vector3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_export::{mjcf, urdf};
use righting_multibody::{BaseAcceleration, Quaternion, State};
use righting_results::{ControlInterval, Node, Trajectory};
use righting_scenario::SystemDescription;
use righting_scenario::system_or_scenario::read_system_or_scenario;
use serde_json::json;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (file, count, folder) = match arguments.as_slice() {
        [file, count] => (file, count, None),
        [file, count, folder] => (file, count, Some(Path::new(folder))),
        _ => return Err("expected a system or scenario, a number of states, and a folder".into()),
    };
    let system = read_system_or_scenario(Path::new(file))?;
    let mut random = ChaCha8Rng::seed_from_u64(15);
    for _ in 0..count.parse::<usize>()? {
        println!("{}", sample(&system, &mut || random.random_range(-1.0..1.0)));
    }
    if let Some(folder) = folder {
        std::fs::write(folder.join("system.urdf"), urdf(&system))?;
        std::fs::write(folder.join("system.xml"), mjcf(&system, &at_rest(&system)?))?;
    }
    Ok(())
}

/// A motion that is none, for the key frames of a model.
fn at_rest(system: &SystemDescription) -> Result<Trajectory, Box<dyn std::error::Error>> {
    let j = system.joint_count();
    let node = Node {
        time_s: 0.0,
        position_m: [0.0; 3],
        attitude: [1.0, 0.0, 0.0, 0.0],
        velocity_m_s: [0.0; 3],
        angular_rate_rad_s: [0.0; 3],
        joint_angles_rad: vec![0.0; j],
        joint_rates_rad_s: vec![0.0; j],
        power_w: 0.0,
        wheel_momenta_n_m_s: Vec::new(),
    };
    let after = Node { time_s: 1.0, ..node.clone() };
    let still = ControlInterval {
        joint_accelerations_rad_s2: vec![0.0; j],
        joint_jerks_rad_s3: Vec::new(),
        joint_torques_n_m: vec![0.0; j],
        wheel_torques_n_m: Vec::new(),
    };
    Ok(Trajectory::new(vec![node, after], vec![still])?)
}

/// A state, an acceleration, and what belongs to them. `random` draws from −1 to 1.
fn sample(system: &SystemDescription, random: &mut dyn FnMut() -> f64) -> serde_json::Value {
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
            let found = model.inverse_dynamics(base, omega, &q, rates, joints, None);
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
    // Column by column too: the momentum of one unit of each velocity.
    let momentum_map = (0..6 + q.len()).map(|index| {
        let unit = |i: usize| if i == index { 1.0 } else { 0.0 };
        let state = State {
            velocity: attitude.to_inertial(&Vector3::from_fn(|i, _| unit(i))),
            angular_rate: Vector3::from_fn(|i, _| unit(3 + i)),
            joint_rates: (0..q.len()).map(|i| unit(6 + i)).collect(),
            ..state.clone()
        };
        let linear = model.linear_momentum(&state);
        let angular = model.inertial_angular_momentum(&state);
        linear.iter().chain(&angular).copied().collect::<Vec<f64>>()
    });
    let momentum_map: Vec<Vec<f64>> = momentum_map.collect();
    json!({
        "joint_names": (0..q.len()).map(|joint| system.names.of_joint(joint)).collect::<Vec<_>>(),
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
        "momentum_map": momentum_map,
        "inverse_dynamics": inverse_dynamics,
        "center_of_mass_m": model.inertial_center_of_mass(&state).as_slice(),
        "linear_momentum": model.linear_momentum(&state).as_slice(),
        "angular_momentum": model.inertial_angular_momentum(&state).as_slice(),
    })
}
