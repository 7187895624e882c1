//! The recursions against the paper's sums, on random chains of every kind.

mod support;

use nalgebra::Vector3;
use proptest::prelude::*;
use righting_multibody::{DhConvention, State, System};
use support::{assert_near, definition, random, table_one};

/// Size of the largest momenta a system of these parameters has: what rounding is relative to.
fn inertia_scale(system: &System, q: &[f64]) -> f64 {
    system.locked_inertia(q).norm()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn momenta((system, state, _) in random::motion()) {
        let State { angular_rate, joint_angles: q, joint_rates: qdot, .. } = &state;
        let scale = inertia_scale(&system, q);
        let inertia = system.locked_inertia(q);
        assert_near(inertia.as_slice(), definition::locked_inertia(&system, q).as_slice(), 1e-12, 0.0);
        let h_tilde = system.h_tilde(q, qdot);
        let expected = definition::h_tilde(&system, q, qdot);
        assert_near(h_tilde.as_slice(), expected.as_slice(), 1e-12, scale);
        let total = system.angular_momentum(angular_rate, q, qdot);
        let expected = inertia * angular_rate + h_tilde;
        assert_near(total.as_slice(), expected.as_slice(), 1e-12, scale);
        let center = system.center_of_mass(q);
        assert_near(center.as_slice(), definition::center(&system, q).as_slice(), 1e-12, 1.0);
    }

    #[test]
    fn momentum_map((system, state, _) in random::motion()) {
        let State { joint_angles: q, joint_rates: qdot, .. } = &state;
        let map = system.momentum_map(q);
        let scale = inertia_scale(&system, q);
        assert_near(map.inertia.as_slice(), system.locked_inertia(q).as_slice(), 1e-12, 0.0);
        let rates = nalgebra::DVector::from_column_slice(qdot);
        let h_tilde = &map.joint_columns * rates;
        assert_near(h_tilde.as_slice(), system.h_tilde(q, qdot).as_slice(), 1e-12, scale);
    }

    #[test]
    fn accelerations((system, state, u) in random::motion()) {
        let State { angular_rate, joint_angles: q, joint_rates: qdot, .. } = &state;
        let base = system.base_acceleration(angular_rate, q, qdot, &u, None);
        let (angular, linear) =
            definition::base_acceleration(&system, angular_rate, q, qdot, &u);
        assert_near(base.angular.as_slice(), angular.as_slice(), 1e-10, 1.0);
        assert_near(base.linear.as_slice(), linear.as_slice(), 1e-10, 1.0);
    }

    #[test]
    fn kinetic_energy((system, state, _) in random::motion()) {
        let State { attitude, velocity, angular_rate, joint_angles: q, joint_rates: qdot, .. } =
            &state;
        let v = attitude.to_body(velocity);
        let expected = definition::kinetic_energy(&system, &v, angular_rate, q, qdot);
        assert_near(&[system.kinetic_energy(&state)], &[expected], 1e-12, 0.0);
    }

    #[test]
    fn kinematics((system, state, _) in random::motion()) {
        let q = &state.joint_angles;
        let kinematics = system.kinematics(q);
        let frames = definition::frames(&system, q);
        prop_assert_eq!(kinematics.frames.len(), frames.len());
        for (ours, (rotation, origin)) in kinematics.frames.iter().zip(&frames) {
            assert_near(ours.rotation().as_slice(), rotation.as_slice(), 1e-12, 1.0);
            assert_near(ours.origin.as_slice(), origin.as_slice(), 1e-12, 1.0);
        }
        let bodies = definition::bodies(&system, q);
        for (ours, body) in kinematics.centers_of_mass.iter().zip(&bodies[1..]) {
            assert_near(ours.as_slice(), body.center.as_slice(), 1e-12, 1.0);
        }
        let Some(rows) = system.rows() else { return Ok(()) };
        for (i, segment) in kinematics.segments.iter().enumerate() {
            assert_near(segment.start.as_slice(), frames[i].1.as_slice(), 1e-12, 1.0);
            assert_near(segment.end().as_slice(), frames[i + 1].1.as_slice(), 1e-12, 1.0);
            let squared = segment.direction.norm_squared();
            assert_near(&[segment.length_squared], &[squared], 1e-12, 1.0);
        }
        // The joint of a standard row turns about the frame before it, a modified row's about its own.
        let first = match rows.convention {
            DhConvention::Standard => 0,
            DhConvention::Modified => 1,
        };
        for (i, axis) in kinematics.joint_axes.iter().enumerate() {
            let (rotation, origin) = &frames[i + first];
            let z = rotation.column(2).into_owned();
            assert_near(axis.as_slice(), z.as_slice(), 1e-12, 1.0);
            let aside = (kinematics.joint_origins[i] - origin).cross(&z);
            assert_near(aside.as_slice(), &[0.0; 3], 1e-12, 1.0);
        }
    }
}

#[test]
fn the_paper_s_systems_stand_straight_up_where_it_draws_them() {
    for (name, system, reach) in
        [("2-DOF", table_one::single_link_2dof(), 1.0), ("4-DOF", table_one::xlink_4dof(), 1.0)]
    {
        let rest = vec![0.0; system.joint_count()];
        let tip = system.kinematics(&rest).frames.last().unwrap().origin;
        let top = Vector3::new(0.0, 0.0, 0.25 + reach);
        assert!((tip - top).norm() < 1e-14, "{name}: {tip}");
    }
    let arm = table_one::canadarm2();
    let bent = [0.0, 0.0, 97.5, 0.0, 90.0, 0.0, 0.0].map(f64::to_radians);
    let lengths: Vec<f64> = arm.rows().unwrap().links.iter().map(|link| link.length_m()).collect();
    let kinematics = arm.kinematics(&bent);
    for (segment, length) in kinematics.segments.iter().zip(lengths) {
        assert!((segment.direction.norm() - length).abs() < 1e-12);
    }
}
