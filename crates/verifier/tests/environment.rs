//! What acts from outside, by the verifier's formulas and the planner's.

use nalgebra::{Quaternion, Vector3};
use proptest::prelude::*;
use righting_multibody as multibody;
use righting_scenario::file::{Environment, GravityGradient, OrbitalElements, Wheel};
use righting_scenario::{Maneuver, Scenario};
use righting_test_support::arms::rotation;
use righting_test_support::{motion, shipped, swing, varied};
use righting_verifier::model::{Model, Motion, Outside, State, Surroundings};
use righting_verifier::verify;

fn environment() -> impl Strategy<Value = Environment> {
    let torque = || prop::option::of(prop::array::uniform3(-0.1..0.1_f64));
    let elements = (0.0..180.0_f64, -360.0..360.0_f64, -360.0..360.0_f64).prop_map(
        |(inclination_deg, right_ascension_deg, argument_of_latitude_deg)| OrbitalElements {
            inclination_deg,
            right_ascension_deg,
            argument_of_latitude_deg,
        },
    );
    let frame = prop_oneof![
        elements.prop_map(|elements| (None, Some(elements))),
        prop::option::of(rotation()).prop_map(|attitude| (attitude, None)),
    ];
    // So low an orbit pulls as nothing else does.
    let gradient =
        (0.1..1000.0_f64, frame).prop_map(|(altitude_km, (orbit_attitude, elements))| {
            GravityGradient { altitude_km, orbit_attitude, elements }
        });
    (torque(), torque(), prop::option::of(gradient)).prop_map(
        |(torque_body_n_m, torque_inertial_n_m, gravity_gradient)| Environment {
            gravity_gradient,
            torque_body_n_m,
            torque_inertial_n_m,
        },
    )
}

fn wheel(axis: [f64; 3]) -> Wheel {
    Wheel {
        axis,
        momentum_max_n_m_s: 1.0,
        torque_max_n_m: 1.0,
        steady_power_w: None,
        initial_momentum_n_m_s: None,
        inertia_kg_m2: None,
        viscous_friction_n_m_s: None,
        failed: false,
    }
}

fn in_environment(name: &str, environment: &Environment) -> Scenario {
    varied(&shipped(name), |file| file.environment = Some(environment.clone()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn both_models_move_alike(
        environment in environment(),
        attitude in rotation(),
        joints in prop::collection::vec(-1.5..1.5_f64, 12),
        time_s in 0.0..9000.0_f64,
        wheels in prop::collection::vec((prop::array::uniform3(0.1..1.0_f64), -1.0..1.0_f64, -1.0..1.0_f64), 0..5),
    ) {
        let scenario = varied(&in_environment("detumble_4dof", &environment), |file| {
            file.wheels = wheels.iter().map(|(axis, ..)| wheel(*axis)).collect();
        });
        let (momenta, given): (Vec<f64>, Vec<f64>) =
            wheels.iter().map(|(_, momentum, torque)| (*momentum, *torque)).unzip();
        let sum = |values: &[f64]| -> Vector3<f64> {
            let axes = scenario.wheels().iter().map(|wheel| Vector3::from(wheel.axis));
            axes.zip(values).map(|(axis, value)| axis * *value).sum()
        };
        let theirs = &scenario.system().model;
        let ours = Model::new(scenario.resolved_system());
        let surroundings = Surroundings::new(scenario.resolved().environment.as_ref());
        let [w, x, y, z] = attitude;
        let state = State {
            attitude: Quaternion::new(w, x, y, z),
            joint_angles: &joints[..4],
            joint_rates: &joints[4..8],
            ..State::from_slice(&[0.1; 21])
        };
        let (x, u) = (state.to_vec(), &joints[8..]);
        let outside = surroundings.at(&state.attitude, time_s);
        let outside = outside.with_wheels(&state, &sum(&momenta), &sum(&given));
        let attitude = multibody::Quaternion::from_array(attitude);
        let external = scenario.external(&attitude, &state.angular_rate, time_s, (&momenta, &given));
        let mut room = Motion::new(&ours);
        let mut rate = vec![0.0; x.len()];
        ours.state_derivative(&x, u, &outside, &mut room, &mut rate);
        let expected = theirs.state_derivative(&x, u, external.as_ref());
        for (ours, theirs) in rate.iter().zip(&expected) {
            prop_assert!((ours - theirs).abs() < 1e-12, "{rate:?} {expected:?}");
        }
        let mut torques = vec![0.0; 4];
        ours.joint_torques(&state, u, &outside, &mut room, &mut torques);
        let rate = &state.angular_rate;
        let expected =
            theirs.joint_torques(rate, &joints[..4], &joints[4..8], u, external.as_ref());
        for (ours, theirs) in torques.iter().zip(&expected) {
            prop_assert!((ours - theirs).abs() < 1e-11, "{torques:?} {expected:?}");
        }
    }
}

/// A motion of another environment is refused by its momentum: 1e-3 N m over 30 s.
#[test]
fn momentum_that_comes_from_nowhere_is_found() {
    let torque =
        Environment { torque_inertial_n_m: Some([0.0, 1e-3, 0.0]), ..Environment::default() };
    let pushed = in_environment("slew_4dof", &torque);
    let quiet = in_environment("slew_4dof", &Environment::default());
    assert!(matches!(pushed.maneuver(), Maneuver::Slew(_)));
    let trajectory = motion(&quiet, &swing(&quiet));
    let failed = |scenario: &Scenario| -> Vec<String> {
        let verification = verify(scenario, &trajectory);
        verification.failures().map(|check| check.name.clone()).collect()
    };
    let momentum = "angular momentum drift".to_owned();
    assert!(!failed(&quiet).contains(&momentum), "{:?}", failed(&quiet));
    assert!(failed(&pushed).contains(&momentum), "{:?}", failed(&pushed));
}

/// The gravity gradient at 400 km on a body of 3 and 1 kg m² about the axes beside the nadir, 10° off, is the one of
/// the textbooks: 3 n² (I_z − I_x) sin θ cos θ, n = 1.131e-3 rad/s.
#[test]
fn the_gravity_gradient_of_a_low_orbit_is_known() {
    let gradient = GravityGradient { altitude_km: 400.0, orbit_attitude: None, elements: None };
    let environment = Environment { gravity_gradient: Some(gradient), ..Environment::default() };
    let scenario = in_environment("slew_2dof", &environment);
    let model = Model::new(scenario.resolved_system());
    let tilt = 10.0_f64.to_radians();
    let attitude = nalgebra::UnitQuaternion::from_axis_angle(&nalgebra::Vector3::y_axis(), tilt);
    let surroundings = Surroundings::new(scenario.resolved().environment.as_ref());
    let outside: Outside = surroundings.at(&attitude, 0.0);
    let mut motion = Motion::new(&model);
    let still = [0.0; 2];
    let zero = [0.0; 17];
    let state = State {
        attitude: attitude.into_inner(),
        joint_angles: &still,
        joint_rates: &still,
        ..State::from_slice(&zero)
    };
    motion.set(&model, &state, &Default::default(), &still);
    let inertia = scenario.system().model.locked_inertia(&still);
    let rate_squared: f64 = (1.131_366e-3_f64).powi(2);
    // Straight up, the arm is about the axis z: the inertia is diagonal.
    let expected =
        3.0 * rate_squared * (inertia[(2, 2)] - inertia[(0, 0)]) * tilt.sin() * tilt.cos();
    let found = motion.moment_of(&outside);
    assert!((found.y / expected - 1.0).abs() < 1e-4, "{found} {expected}");
    assert!(found.x.abs() < 1e-9 * expected.abs() && found.z.abs() < 1e-9 * expected.abs());
}
