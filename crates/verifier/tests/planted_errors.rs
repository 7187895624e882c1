//! An error in the planner's model cannot pass: trajectories that obey wrong equations are consistent
//! in themselves, and the verifier's own model rejects each by name.

use nalgebra::{Matrix3, Vector3};
use righting_multibody::{BaseAcceleration, State, System};
use righting_results::{Trajectory, Verification};
use righting_scenario::Scenario;
use righting_scenario::file::{Link, SystemReference};
use righting_test_support::{Equations, motion_by, shipped, swing, trajectory_of, varied};
use righting_verifier::verify;

/// By how many times its limit a planted error shall miss a check.
const CLEARLY: f64 = 10.0;

/// A detumble, in which everything moves: 20 °/s and the arm swinging.
fn tumbling() -> Scenario {
    varied(&shipped("detumble_4dof"), |file| {
        file.horizon.steps = 200.0;
        file.horizon.duration_s = righting_scenario::file::Duration::Given(20.0);
    })
}

/// A slew from rest, in which momentum is zero.
fn resting() -> Scenario {
    varied(&shipped("slew_4dof"), |file| file.horizon.steps = 100.0)
}

/// What the verifier says of a motion by these equations.
fn verified(scenario: &Scenario, equations: &impl Equations) -> Verification {
    verify(scenario, &motion_by(equations, scenario, &swing(scenario)))
}

/// The checks that failed, but those of what the maneuver was asked to reach.
fn caught(verification: &Verification) -> Vec<&str> {
    let failures = verification.failures().map(|check| check.name.as_str());
    failures.filter(|name| !name.ends_with("at the end") && !name.contains("joint angle")).collect()
}

#[track_caller]
fn assert_caught(verification: &Verification, names: &[&str]) {
    for name in names {
        let check = verification.check(name).unwrap();
        let ratio = check.value / check.limit;
        assert!(ratio > CLEARLY, "{check}: all that failed: {:?}", caught(verification));
    }
}

#[test]
fn the_right_equations_pass() {
    for scenario in [tumbling(), resting()] {
        let names = verified(&scenario, &scenario.system().model);
        assert!(caught(&names).is_empty(), "{:?}", caught(&names));
    }
}

/// ω = Ĩ⁻¹ (Cᵀ h₀ + H̃): the arm drags the base along.
#[test]
fn a_sign_in_the_arm_s_momentum_is_caught() {
    struct WrongSign<'a> {
        model: &'a System,
        momentum: Vector3<f64>,
    }
    impl WrongSign<'_> {
        /// ω and ṙ of the reduced form.
        fn base_rates(&self, state: &State<f64>) -> (Vector3<f64>, Vector3<f64>) {
            let State { attitude, joint_angles: q, joint_rates, .. } = state;
            let wrong: Vec<f64> = joint_rates.iter().map(|rate| -rate).collect();
            let h_body = attitude.to_body(&self.momentum);
            let omega = self.model.reduced_angular_rate(q, &wrong, &h_body);
            let at_rest = Vector3::zeros();
            (omega, self.model.base_velocity(attitude, &omega, q, joint_rates, &at_rest))
        }
    }
    impl Equations for WrongSign<'_> {
        fn state_derivative(&self, x: &[f64], u: &[f64]) -> Vec<f64> {
            let state = State::from_slice(x).unwrap();
            let (omega, velocity) = self.base_rates(&state);
            State {
                position: velocity,
                attitude: state.attitude.rate(&omega),
                velocity: Vector3::zeros(),
                angular_rate: Vector3::zeros(),
                joint_angles: state.joint_rates,
                joint_rates: u.to_vec(),
            }
            .to_vec()
        }

        fn joint_torques(&self, state: &State<f64>, u: &[f64]) -> Vec<f64> {
            Equations::joint_torques(self.model, state, u)
        }
    }

    for scenario in [tumbling(), resting()] {
        let model = &scenario.system().model;
        let momentum = scenario.initial().angular_momentum_n_m_s;
        let equations = WrongSign { model, momentum };
        let controls = swing(&scenario);
        let integrated = motion_by(&equations, &scenario, &controls);
        // The reduced form integrates attitude and joints; the rates follow at every node.
        let states: Vec<State<f64>> = integrated
            .nodes()
            .iter()
            .map(|node| {
                let state = node.state();
                let (angular_rate, velocity) = equations.base_rates(&state);
                State { angular_rate, velocity, ..state }
            })
            .collect();
        let trajectory = trajectory_of(&equations, &scenario, &controls, &states);
        let verification = verify(&scenario, &trajectory);
        assert_caught(
            &verification,
            &["attitude mismatch", "angular rate mismatch", "angular momentum drift"],
        );
    }
}

/// The planner takes one link's moments of inertia about y and z for each other.
#[test]
fn a_swapped_axis_in_one_inertia_is_caught() {
    // A boom on link 3.
    let with_boom = |scenario: &Scenario, moments: [f64; 3]| {
        varied(scenario, |file| {
            let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
            let link: &mut Link = &mut system.links[2];
            let [x, y, z] = moments;
            link.inertia_kg_m2 = Some([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
        })
    };
    for scenario in [tumbling(), resting()] {
        let right = with_boom(&scenario, [1.0, 0.1, 1.0]);
        let swapped = with_boom(&scenario, [1.0, 1.0, 0.1]);
        let passes = verified(&right, &right.system().model);
        assert!(caught(&passes).is_empty(), "{:?}", caught(&passes));
        let verification = verified(&right, &swapped.system().model);
        assert_caught(&verification, &["attitude mismatch", "joint torque mismatch"]);
    }
}

/// Base accelerations by the planner's model with something left out.
struct Without<F> {
    model: System,
    accelerations: F,
}

impl<F: Fn(&System, &State<f64>, &[f64]) -> BaseAcceleration<f64>> Equations for Without<F> {
    fn state_derivative(&self, x: &[f64], u: &[f64]) -> Vec<f64> {
        let state = State::from_slice(x).unwrap();
        let base = (self.accelerations)(&self.model, &state, u);
        State {
            position: state.velocity,
            attitude: state.attitude.rate(&state.angular_rate),
            velocity: state.attitude.to_inertial(&base.linear),
            angular_rate: base.angular,
            joint_angles: state.joint_rates,
            joint_rates: u.to_vec(),
        }
        .to_vec()
    }

    fn joint_torques(&self, state: &State<f64>, u: &[f64]) -> Vec<f64> {
        let base = (self.accelerations)(&self.model, state, u);
        let State { angular_rate, joint_angles, joint_rates, .. } = state;
        let inverse =
            self.model.inverse_dynamics(&base, angular_rate, joint_angles, joint_rates, u, None);
        inverse.joint_torques
    }
}

/// dH/dt = 0 in body axes instead of dH/dt + ω × H = 0.
#[test]
fn a_dropped_gyroscopic_term_is_caught() {
    let scenario = tumbling();
    let equations = Without {
        model: scenario.system().model.clone(),
        accelerations: |model: &System, state: &State<f64>, u: &[f64]| {
            let State { angular_rate: omega, joint_angles: q, joint_rates: qdot, .. } = state;
            let base = model.base_acceleration(omega, q, qdot, u, None);
            let gyroscopic = omega.cross(&model.angular_momentum(omega, q, qdot));
            let inertia: Matrix3<f64> = model.locked_inertia(q);
            let left_out = inertia.try_inverse().unwrap() * gyroscopic;
            BaseAcceleration { angular: base.angular + left_out, ..base }
        },
    };
    assert_caught(
        &verified(&scenario, &equations),
        &[
            "attitude mismatch",
            "angular rate mismatch",
            "angular momentum drift",
            "joint torque mismatch",
        ],
    );
}

/// Every term in a joint's rate is left out of the base's accelerations, as for an arm at rest.
#[test]
fn dropped_coriolis_terms_are_caught() {
    for scenario in [tumbling(), resting()] {
        let equations = Without {
            model: scenario.system().model.clone(),
            accelerations: |model: &System, state: &State<f64>, u: &[f64]| {
                let State { angular_rate: omega, joint_angles: q, .. } = state;
                model.base_acceleration(omega, q, &vec![0.0; q.len()], u, None)
            },
        };
        assert_caught(
            &verified(&scenario, &equations),
            &[
                "attitude mismatch",
                "angular rate mismatch",
                "angular momentum drift",
                "joint torque mismatch",
            ],
        );
    }
}

/// The motion is right, and the torques are those of an arm at rest.
#[test]
fn torques_without_coriolis_terms_are_caught_alone() {
    struct AtRest(System);
    impl Equations for AtRest {
        fn state_derivative(&self, x: &[f64], u: &[f64]) -> Vec<f64> {
            self.0.state_derivative(x, u, None)
        }

        fn joint_torques(&self, state: &State<f64>, u: &[f64]) -> Vec<f64> {
            let still = vec![0.0; u.len()];
            let State { angular_rate, joint_angles, .. } = state;
            self.0.joint_torques(angular_rate, joint_angles, &still, u, None)
        }
    }
    for scenario in [tumbling(), resting()] {
        let verification = verified(&scenario, &AtRest(scenario.system().model.clone()));
        assert_caught(&verification, &["joint torque mismatch", "power mismatch"]);
        assert_eq!(caught(&verification), ["joint torque mismatch", "power mismatch"]);
    }
}

/// The planner takes a link to be longer than it is.
#[test]
fn a_wrong_length_is_caught() {
    let scenario = resting();
    let longer = varied(&scenario, |file| {
        let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
        system.links[1].a_m += 0.1;
    });
    let trajectory: Trajectory = motion_by(&longer.system().model, &longer, &swing(&longer));
    assert_caught(&verify(&scenario, &trajectory), &["attitude mismatch", "joint torque mismatch"]);
}
