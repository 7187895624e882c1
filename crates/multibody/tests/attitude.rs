//! Quaternions against nalgebra's and against their definition.

mod support;

use approx::assert_relative_eq;
use nalgebra::{Quaternion as Reference, UnitQuaternion, Vector3};
use num_dual::Dual64;
use proptest::prelude::*;
use righting_multibody::Quaternion;
use std::f64::consts::PI;
use support::{assert_near, random};

fn reference(q: &Quaternion<f64>) -> UnitQuaternion<f64> {
    let [w, x, y, z] = q.to_array();
    UnitQuaternion::new_unchecked(Reference::new(w, x, y, z))
}

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    [-3.0..3.0, -3.0..3.0, -3.0..3.0_f64].prop_map(Vector3::from)
}

proptest! {
    #[test]
    fn turns_vectors_as_the_matrix_does(q in random::attitude(), v in vector()) {
        let expected = reference(&q) * v;
        assert_near(q.to_inertial(&v).as_slice(), expected.as_slice(), 1e-14, 1.0);
        assert_near((q.rotation_matrix() * v).as_slice(), expected.as_slice(), 1e-14, 1.0);
        assert_near(q.to_body(&expected).as_slice(), v.as_slice(), 1e-14, 1.0);
        let back = q.rotation_matrix().transpose() * expected;
        assert_near(back.as_slice(), v.as_slice(), 1e-14, 1.0);
    }

    #[test]
    fn products_are_hamilton_s(a in random::attitude(), b in random::attitude()) {
        let expected = reference(&a) * reference(&b);
        let expected = [expected.w, expected.i, expected.j, expected.k];
        assert_near(&a.product(&b).to_array(), &expected, 1e-14, 1.0);
        let none = a.product(&a.conjugate()).to_array();
        assert_near(&none, &[1.0, 0.0, 0.0, 0.0], 1e-14, 1.0);
    }

    /// q(t) = q ⊗ exp(ω t/2) has the derivative that `rate` gives at t = 0.
    #[test]
    fn rates_are_those_of_a_body_turning(q in random::attitude(), omega in vector()) {
        let t = Dual64::from_re(0.0).derivative();
        let speed = omega.norm();
        prop_assume!(speed > 1e-3);
        let axis = (omega / speed).map(Dual64::from);
        let moving = Quaternion::from_axis_angle(&axis, t * speed);
        let start = Quaternion::from_array(q.to_array().map(Dual64::from));
        let derivative = start.product(&moving).to_array().map(|x| x.eps);
        assert_near(&q.rate(&omega).to_array(), &derivative, 1e-14, 1.0);
    }

    #[test]
    fn errors_are_half_angle_sines_about_the_axis_between(
        desired in random::attitude(),
        axis in vector(),
        angle in -PI..PI,
    ) {
        prop_assume!(axis.norm() > 1e-3);
        let axis = axis.normalize();
        let reached = desired.product(&Quaternion::from_axis_angle(&axis, angle));
        let error = reached.error_vector(&desired);
        let expected = axis * (angle / 2.0).sin();
        assert_near(error.as_slice(), expected.as_slice(), 1e-13, 1.0);
        let between = desired.angle_to(&reached);
        assert_relative_eq!(between, angle.abs(), epsilon = 1e-12);
    }

    #[test]
    fn axis_and_angle_come_back(q in random::attitude()) {
        let (axis, angle) = q.to_axis_angle();
        prop_assert!((0.0..=PI).contains(&angle));
        let again = Quaternion::from_axis_angle(&axis, angle);
        // A quaternion and its negative are the same attitude.
        let sign = if again.w * q.w < 0.0 { -1.0 } else { 1.0 };
        assert_near(&again.to_array().map(|x| x * sign), &q.to_array(), 1e-14, 1.0);
    }

    #[test]
    fn normalizing_keeps_the_direction(q in random::attitude(), length in 0.1..10.0_f64) {
        let long = Quaternion::from_array(q.to_array().map(|x| x * length));
        assert_relative_eq!(long.norm_squared(), length * length, max_relative = 1e-13);
        assert_near(&long.normalized().to_array(), &q.to_array(), 1e-14, 1.0);
    }
}

#[test]
fn no_rotation_has_some_axis_and_no_angle() {
    let (axis, angle) = Quaternion::<f64>::identity().to_axis_angle();
    assert_eq!((axis.norm(), angle), (1.0, 0.0));
}
