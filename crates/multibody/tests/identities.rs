//! What every free-floating system satisfies, on random chains.

mod support;

use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual, Dual64};
use proptest::prelude::*;
use righting_multibody::{External, GravityGradient, Quaternion, State, System};
use support::{assert_near, random, table_one};

/// The state on its way: every element with its time derivative.
fn moving(system: &System, state: &State<f64>, u: &[f64]) -> State<Dual64> {
    let x = state.to_vec();
    let xdot = system.state_derivative(&x, u, None);
    let dual: Vec<Dual64> = x.iter().zip(&xdot).map(|(x, v)| Dual::new(*x, *v)).collect();
    State::from_slice(&dual).unwrap()
}

fn momentum_scale(system: &System, q: &[f64]) -> f64 {
    system.locked_inertia(q).norm() + system.total_mass()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn momentum_is_conserved((system, state, u) in random::motion()) {
        let scale = momentum_scale(&system, &state.joint_angles);
        let moving = moving(&system, &state, &u);
        let angular = system.inertial_angular_momentum(&moving).map(|x| x.eps);
        assert_near(angular.as_slice(), &[0.0; 3], 1e-11, 10.0 * scale);
        let linear = system.linear_momentum(&moving).map(|x| x.eps);
        assert_near(linear.as_slice(), &[0.0; 3], 1e-11, 10.0 * scale);
        let center = system.inertial_center_of_mass(&moving).map(|x| x.eps);
        let expected = system.linear_momentum(&state) / system.total_mass();
        assert_near(center.as_slice(), expected.as_slice(), 1e-11, 1.0);
    }

    #[test]
    fn work_is_the_change_of_energy((system, state, u) in random::motion()) {
        let State { angular_rate, joint_angles: q, joint_rates: qdot, .. } = &state;
        let torques = system.joint_torques(angular_rate, q, qdot, &u, None);
        let power: f64 = torques.iter().zip(qdot).map(|(torque, rate)| torque * rate).sum();
        let energy = system.kinetic_energy(&moving(&system, &state, &u));
        assert_near(&[power], &[energy.eps], 1e-10, energy.re);
    }

    /// d/dt ∂T/∂q̇ − ∂T/∂q = τ: a rule for each joint, where energy gives one for all.
    #[test]
    fn torques_are_lagrange_s((system, state, u) in random::motion()) {
        let State { attitude, velocity, angular_rate, joint_angles: q, joint_rates: qdot, .. } =
            &state;
        let base = system.base_acceleration(angular_rate, q, qdot, &u, None);
        let torques = system.joint_torques(angular_rate, q, qdot, &u, None);
        let v = attitude.to_body(velocity);
        let v_dot = base.linear - angular_rate.cross(&v);
        let along = |x: &[f64], dx: &[f64]| -> Vec<Dual<Dual64>> {
            x.iter().zip(dx).map(|(x, dx)| Dual::from_re(Dual64::new(*x, *dx))).collect()
        };
        // Inner part: time. Outer part: the coordinate or rate of one joint.
        let body = along(v.as_slice(), v_dot.as_slice());
        let turning = along(angular_rate.as_slice(), base.angular.as_slice());
        let (angles, rates) = (along(q, qdot), along(qdot, &u));
        let energy = |angles: &[Dual<Dual64>], rates: &[Dual<Dual64>]| {
            system.kinetic_energy(&State {
                position: Vector3::from_element(Dual::from(0.0)),
                attitude: Quaternion::identity(),
                velocity: Vector3::from_column_slice(&body),
                angular_rate: Vector3::from_column_slice(&turning),
                joint_angles: angles.to_vec(),
                joint_rates: rates.to_vec(),
            })
        };
        let scale = momentum_scale(&system, q);
        for (k, torque) in torques.iter().enumerate() {
            let one = Dual64::from(1.0);
            let (mut angles_k, mut rates_k) = (angles.clone(), rates.clone());
            angles_k[k].eps = one;
            rates_k[k].eps = one;
            let momentum = energy(&angles, &rates_k).eps;
            let force = energy(&angles_k, &rates).eps;
            assert_near(&[*torque], &[momentum.eps - force.re], 1e-10, scale);
        }
    }

    #[test]
    fn nothing_pushes_a_free_floating_base((system, state, u) in random::motion()) {
        let State { angular_rate, joint_angles: q, joint_rates: qdot, .. } = &state;
        let base = system.base_acceleration(angular_rate, q, qdot, &u, None);
        let load = system.inverse_dynamics(&base, angular_rate, q, qdot, &u, None);
        let scale = momentum_scale(&system, q);
        assert_near(load.base_force.as_slice(), &[0.0; 3], 1e-11, 10.0 * scale);
        assert_near(load.base_moment.as_slice(), &[0.0; 3], 1e-11, 10.0 * scale);
    }

    /// Two recursions that share nothing: a couple on the base is all that is left of what acts from outside once
    /// the gravity gradient has pulled at every body.
    #[test]
    fn what_acts_from_outside_is_all_that_pushes_the_base((system, state, u) in random::motion()) {
        let State { attitude, angular_rate, joint_angles: q, joint_rates: qdot, .. } = &state;
        let external = External {
            torque: Vector3::new(0.3, -0.2, 0.5),
            gravity_gradient: Some(GravityGradient {
                nadir: attitude.to_body(&Vector3::new(0.6, 0.0, -0.8)),
                rate_squared: 0.7,
            }),
        };
        let load = system.free_floating_dynamics(angular_rate, q, qdot, &u, Some(&external));
        let scale = momentum_scale(&system, q);
        assert_near(load.base_force.as_slice(), &[0.0; 3], 1e-11, 10.0 * scale);
        assert_near(load.base_moment.as_slice(), external.torque.as_slice(), 1e-11, 10.0 * scale);
        // Momentum changes by their moment.
        let moment = attitude.to_inertial(&system.external_moment(&external, q));
        let xdot = system.state_derivative(&state.to_vec(), &u, Some(&external));
        let x = state.to_vec().into_iter().zip(xdot).map(|(x, v)| Dual::new(x, v));
        let moving = State::from_slice(&x.collect::<Vec<Dual64>>()).unwrap();
        let momentum = system.inertial_angular_momentum(&moving).map(|x| x.eps);
        assert_near(momentum.as_slice(), moment.as_slice(), 1e-11, 10.0 * scale);
    }

    #[test]
    fn locked_inertia_is_symmetric_positive_definite((system, state, _) in random::motion()) {
        let inertia = system.locked_inertia(&state.joint_angles);
        prop_assert_eq!(inertia, inertia.transpose());
        let smallest = inertia.symmetric_eigenvalues().min();
        let base = system.base().inertia_kg_m2.symmetric_eigenvalues().min();
        prop_assert!(smallest >= base * (1.0 - 1e-12), "{} below the base's {}", smallest, base);
    }

    #[test]
    fn the_reduced_rate_is_the_one_with_that_momentum((system, state, _) in random::motion()) {
        let State { attitude, angular_rate, joint_angles: q, joint_rates: qdot, .. } = &state;
        let h0 = system.inertial_angular_momentum(&state);
        let omega = system.reduced_angular_rate(q, qdot, &attitude.to_body(&h0));
        assert_near(omega.as_slice(), angular_rate.as_slice(), 1e-10, 1.0);
    }

    #[test]
    fn turning_the_world_turns_the_motion(
        (system, state, u) in random::motion(),
        world in random::attitude(),
    ) {
        let turn = |v: &Vector3<f64>| world.to_inertial(v);
        let turned = State {
            position: turn(&state.position),
            attitude: world.product(&state.attitude),
            velocity: turn(&state.velocity),
            ..state.clone()
        };
        let derivative = |state: &State<f64>| {
            State::from_slice(&system.state_derivative(&state.to_vec(), &u, None)).unwrap()
        };
        let (before, after) = (derivative(&state), derivative(&turned));
        let expected = State {
            position: turn(&before.position),
            attitude: world.product(&before.attitude),
            velocity: turn(&before.velocity),
            ..before
        };
        assert_near(&after.to_vec(), &expected.to_vec(), 1e-12, 1.0);
        assert_near(
            &[system.kinetic_energy(&turned)],
            &[system.kinetic_energy(&state)],
            1e-12,
            0.0,
        );
    }

    #[test]
    fn the_base_follows_from_the_centre_of_mass((system, state, _) in random::motion()) {
        let State { position, attitude, velocity, angular_rate, joint_angles: q, joint_rates } =
            &state;
        let center = system.inertial_center_of_mass(&state);
        let found = system.base_position(attitude, q, &center);
        assert_near(found.as_slice(), position.as_slice(), 1e-12, 1.0);
        let center_velocity = system.linear_momentum(&state) / system.total_mass();
        let found =
            system.base_velocity(attitude, angular_rate, q, joint_rates, &center_velocity);
        assert_near(found.as_slice(), velocity.as_slice(), 1e-12, 1.0);
        let rate = system.center_of_mass_rate(q, joint_rates);
        let moving: Vec<Dual64> = q.iter().zip(joint_rates).map(|(q, v)| Dual::new(*q, *v)).collect();
        let expected = system.center_of_mass(&moving).map(|x| x.eps);
        assert_near(rate.as_slice(), expected.as_slice(), 1e-12, 1.0);
    }
}

/// One classical Runge-Kutta step.
fn runge_kutta(x: &[f64], h: f64, f: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let at =
        |k: &[f64], c: f64| -> Vec<f64> { x.iter().zip(k).map(|(x, k)| x + c * h * k).collect() };
    let k1 = f(x);
    let k2 = f(&at(&k1, 0.5));
    let k3 = f(&at(&k2, 0.5));
    let k4 = f(&at(&k3, 1.0));
    (0..x.len()).map(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])).collect()
}

/// The full form and the reduced form integrate to the same motion.
#[test]
fn both_forms_move_alike() {
    for (name, system) in table_one::all() {
        let j = system.joint_count();
        let u: Vec<f64> = (0..j).map(|i| 0.05 * (i as f64 + 1.0).sin()).collect();
        let start = State {
            position: Vector3::zeros(),
            attitude: Quaternion::identity(),
            velocity: Vector3::zeros(),
            angular_rate: Vector3::new(0.02, -0.05, 0.1),
            joint_angles: (0..j).map(|i| 0.3 - 0.2 * i as f64).collect(),
            joint_rates: vec![0.0; j],
        };
        let h0 = system.inertial_angular_momentum(&start);
        let mut full = start.to_vec();
        let mut reduced: Vec<f64> = start.attitude.to_array().to_vec();
        reduced.extend(start.joint_angles.iter().chain(&start.joint_rates));
        for _ in 0..200 {
            full = runge_kutta(&full, 0.025, |x| system.state_derivative(x, &u, None));
            reduced = runge_kutta(&reduced, 0.025, |y| {
                let attitude = Quaternion::new(y[0], y[1], y[2], y[3]);
                let (q, qdot) = y[4..].split_at(j);
                let omega = system.reduced_angular_rate(q, qdot, &attitude.to_body(&h0));
                let mut rate = attitude.rate(&omega).to_array().to_vec();
                rate.extend(qdot.iter().chain(&u));
                rate
            });
        }
        let end = State::from_slice(&full).unwrap();
        assert_near(&end.attitude.to_array(), &reduced[..4], 1e-8, 1.0);
        let drift = system.inertial_angular_momentum(&end) - h0;
        assert!(drift.norm() < 1e-7 * h0.norm(), "{name}: momentum drifts by {drift}");
        // The arm has moved the base away from where its own rate would have taken it.
        let turned = end.attitude.angle_to(&start.attitude);
        assert!(turned > 0.1, "{name}: {turned}");
        assert_ne!(system.locked_inertia(&end.joint_angles), Matrix3::identity());
    }
}
