//! Reaction wheels beside the arm.

use nalgebra::Vector3;
use righting_analysis::motors::Braking;
use righting_analysis::{PowerProfile, WheelMotors};
use righting_ocp::Control;
use righting_planner::planner::PlanError;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::{self, Duration, DurationRange, Formulation, SystemReference, Wheel};
use righting_test_support::{shipped, varied};

fn plan(scenario: &Scenario) -> Result<Planned, PlanError> {
    Planner::new().plan(scenario, &mut |_| Control::Continue)
}

#[track_caller]
fn verified(scenario: &Scenario) -> Planned {
    let planned = plan(scenario).unwrap();
    let verification = &planned.solution.verification;
    let failures: Vec<String> = verification.failures().map(ToString::to_string).collect();
    assert!(verification.passed, "{:?} {failures:?}", planned.solution.status);
    planned
}

fn wheel(axis: [f64; 3], momentum_max_n_m_s: f64, torque_max_n_m: f64) -> Wheel {
    Wheel {
        axis,
        momentum_max_n_m_s,
        torque_max_n_m,
        steady_power_w: None,
        initial_momentum_n_m_s: None,
        inertia_kg_m2: None,
        viscous_friction_n_m_s: None,
        failed: false,
    }
}

fn lock_arm(file: &mut file::Scenario) {
    let SystemReference::Inline(system) = &mut file.system else { panic!("resolved") };
    for (link, angle_deg) in system.links.iter_mut().zip(&file.initial.joint_angles_deg) {
        link.angle_min_deg = Some(*angle_deg);
        link.angle_max_deg = Some(*angle_deg);
    }
}

/// H of bodies and wheels, inertial axes.
fn momentum(scenario: &Scenario, planned: &Planned, node: usize) -> Vector3<f64> {
    let node = &planned.trajectory.nodes()[node];
    let state = node.state();
    let wheels = scenario.wheels().iter().zip(&node.wheel_momenta_n_m_s);
    let in_store: Vector3<f64> =
        wheels.map(|(wheel, momentum)| Vector3::from(wheel.axis) * *momentum).sum();
    scenario.system().model.inertial_angular_momentum(&state)
        + state.attitude.to_inertial(&in_store)
}

/// With the arm locked straight up, a wheel along z turns the base about z with the inertia I: from rest to rest in
/// 2 √(θ I/τ) where torque limits it, in θ I/H + H/τ where momentum does.
#[test]
fn the_fastest_turn_by_a_wheel_is_bang_bang() {
    let (torque, momentum_max) = (0.5, 1.0);
    for angle_deg in [3.0, 30.0] {
        let scenario = varied(&shipped("slew_2dof"), |file| {
            lock_arm(file);
            file.maneuver.axis = Some([0.0, 0.0, 1.0]);
            file.maneuver.angle_deg = Some(angle_deg);
            file.wheels = vec![wheel([0.0, 0.0, 1.0], momentum_max, torque)];
            file.horizon.duration_s = Duration::Free(DurationRange { min: 0.5, max: 60.0 });
            file.horizon.steps = 400.0;
            file.weights = file::Weights::default();
            file.end = None;
        });
        let posture = &scenario.initial().joint_angles_rad;
        let inertia = scenario.system().model.locked_inertia(posture)[(2, 2)];
        let needed = inertia * f64::to_radians(angle_deg);
        let expected_s = match needed > momentum_max * momentum_max / torque {
            false => 2.0 * (needed / torque).sqrt(),
            true => needed / momentum_max + momentum_max / torque,
        };
        let found_s = verified(&scenario).solution.duration_s.unwrap();
        let off = found_s / expected_s - 1.0;
        assert!(off.abs() < 5e-3, "{angle_deg}: {found_s} {expected_s}, {off:.1e}");
    }
}

/// With friction the motor gives ḣ + f h, f = b/J. At its limit T it speeds the wheel up to h₁ = (1 − exp(−f t₁)) T/f and slows it
/// down in t₂ = ln(1 + f h₁/T)/f: momentum over time is T (t₁ − t₂)/f, which the base has turned by its inertia.
#[test]
fn friction_is_part_of_what_the_motor_gives() {
    let (torque, friction_1_s) = (0.5, 0.2);
    let scenario = |angle_deg: f64| {
        varied(&shipped("slew_2dof"), |file| {
            lock_arm(file);
            file.maneuver.axis = Some([0.0, 0.0, 1.0]);
            file.maneuver.angle_deg = Some(angle_deg);
            file.wheels = vec![Wheel {
                inertia_kg_m2: Some(0.01),
                viscous_friction_n_m_s: Some(0.01 * friction_1_s),
                ..wheel([0.0, 0.0, 1.0], 10.0, torque)
            }];
            file.horizon.duration_s = Duration::Free(DurationRange { min: 0.5, max: 60.0 });
            file.horizon.steps = 400.0;
            file.weights = file::Weights::default();
            file.end = None;
        })
    };
    let turned = scenario(10.0);
    let posture = &turned.initial().joint_angles_rad;
    let inertia = turned.system().model.locked_inertia(posture)[(2, 2)];
    let speeding_up_s = 8.0_f64;
    let most = torque / friction_1_s * (1.0 - (-friction_1_s * speeding_up_s).exp());
    let slowing_down_s = (1.0 + friction_1_s * most / torque).ln() / friction_1_s;
    let angle = torque * (speeding_up_s - slowing_down_s) / (friction_1_s * inertia);
    let planned = verified(&scenario(angle.to_degrees()));
    let expected_s = speeding_up_s + slowing_down_s;
    let found_s = planned.solution.duration_s.unwrap();
    assert!((found_s / expected_s - 1.0).abs() < 5e-3, "{found_s} {expected_s}");

    // The motor's work is what friction takes, since the wheel ends as it starts.
    let slower = varied(&scenario(angle.to_degrees()), |file| {
        file.horizon.duration_s = Duration::Given(1.2 * expected_s);
        file.weights.time = None;
    });
    let planned = verified(&slower);
    let profile = PowerProfile::new(&slower, &planned.trajectory).unwrap();
    let motors = WheelMotors::new(slower.wheels(), &planned.trajectory, &profile).unwrap();
    let (work, heat) = (motors.consumption(Braking::FedBack).energy_j, motors.friction_j());
    let stored = motors.kinetic_energy_change_j();
    assert!((work - heat - stored).abs() < 1e-9 * work, "{work} {heat} {stored}");
    let burnt = motors.consumption(Braking::Burnt).energy_j;
    // What the end's attitude and rest leave in the wheel, which is empty at the start.
    let left = planned.trajectory.end().wheel_momenta_n_m_s[0].powi(2) / (2.0 * 0.01);
    assert!((stored - left).abs() < 1e-9 * work, "{stored} {left}");
    assert!(left < 1e-4 * work && burnt > work, "{left} {work} {burnt}");
    let fastest = planned.trajectory.nodes().iter().map(|node| node.wheel_momenta_n_m_s[0].abs());
    let [peak] = motors.peak_speeds_rad_s() else { panic!("one wheel") };
    assert!((peak / (fastest.fold(0.0, f64::max) / 0.01) - 1.0).abs() < 1e-9);
}

/// A pyramid of which two wheels have failed, one of them spinning: the arm turns what the others cannot.
fn two_failed(formulation: Formulation) -> Scenario {
    varied(&shipped("slew_4dof"), |file| {
        let axes = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [1.0, -1.0, 1.0]];
        file.wheels = axes.map(|axis| wheel(axis, 1.0, 0.1)).to_vec();
        file.wheels[1].failed = true;
        file.wheels[3].failed = true;
        file.wheels[3].initial_momentum_n_m_s = Some(0.02);
        file.solver.formulation = Some(formulation);
    })
}

#[test]
fn arm_and_wheels_share_a_slew() {
    let scenario = two_failed(Formulation::Reduced);
    let planned = verified(&scenario);
    let steps = planned.trajectory.steps();
    let [first, last] = [0, steps].map(|node| momentum(&scenario, &planned, node));
    assert!((first - last).norm() < 1e-5 * first.norm(), "{first} {last}");
    for (nodes, interval) in
        planned.trajectory.nodes().windows(2).zip(planned.trajectory.intervals())
    {
        assert_eq!(nodes[1].wheel_momenta_n_m_s[1], 0.0);
        assert_eq!(nodes[1].wheel_momenta_n_m_s[3], 0.02);
        assert_eq!([1, 3].map(|wheel| interval.wheel_torques_n_m[wheel]), [0.0; 2]);
    }
    let used = planned.trajectory.nodes().iter().map(|node| node.wheel_momenta_n_m_s[0].abs());
    assert!(used.fold(0.0, f64::max) > 0.01, "the wheels are used");
    // Two wheels more are never in the way.
    let alone = plan(&shipped("slew_4dof")).unwrap().solution.objective;
    let resting = varied(&scenario, |file| file.wheels[3].initial_momentum_n_m_s = None);
    let together = verified(&resting).solution.objective;
    assert!(together <= alone * (1.0 + 1e-4), "{together} {alone}");
}

#[test]
fn both_forms_have_the_same_optimum() {
    let [reduced, full] = [Formulation::Reduced, Formulation::Full]
        .map(|formulation| verified(&two_failed(formulation)).solution.objective);
    assert!((full / reduced - 1.0).abs() < 1e-3, "{full} {reduced}");
}

/// What the wheels store at the end is met where it is given, and conserved momentum then says how the base drifts.
#[test]
fn momenta_at_the_end_are_met() {
    let scenario = varied(&shipped("slew_2dof"), |file| {
        file.wheels = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|axis| wheel(axis, 1.0, 0.1))
            .to_vec();
        file.wheels[0].initial_momentum_n_m_s = Some(0.1);
        let end = file.end.get_or_insert_default();
        end.wheel_momenta_n_m_s = Some(vec![None, Some(0.02), None]);
    });
    let planned = verified(&scenario);
    let end = planned.trajectory.end().wheel_momenta_n_m_s[1];
    assert!((end - 0.02).abs() < 1e-6, "{end}");
}

/// Desaturation: what leaves the wheels turns the base and the arm with it, at the rate that momentum has.
#[test]
fn wheels_are_emptied() {
    let scenario = varied(&shipped("slew_2dof"), |file| {
        file.wheels = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|axis| wheel(axis, 1.0, 0.1))
            .to_vec();
        file.wheels[2].initial_momentum_n_m_s = Some(0.3);
        file.environment = Some(file::Environment::default());
        let end = file.end.get_or_insert_default();
        end.wheel_momenta_n_m_s = Some(vec![Some(0.0); 3]);
    });
    let planned = verified(&scenario);
    let end = planned.trajectory.end();
    assert!(end.wheel_momenta_n_m_s.iter().all(|momentum| momentum.abs() < 1e-6));
    let inertia = scenario.system().model.locked_inertia(&end.joint_angles_rad);
    let rate = Vector3::from(end.angular_rate_rad_s);
    assert!(((inertia * rate).norm() - 0.3).abs() < 1e-3, "{rate}");
}

#[test]
fn one_wheel_alone_turns_the_base_about_one_axis() {
    let about = |axis: [f64; 3]| {
        varied(&shipped("slew_2dof"), |file| {
            lock_arm(file);
            file.maneuver.axis = Some(axis);
            file.wheels = vec![wheel([0.0, 0.0, 1.0], 1.0, 0.5)];
        })
    };
    verified(&about([0.0, 0.0, 1.0]));
    let Err(PlanError::Impossible(reason)) = plan(&about([1.0, 0.0, 1.0])) else {
        panic!("the axis is out of reach")
    };
    let reason = reason.to_string();
    assert!(reason.contains("the one wheel that works turns it about"), "{reason}");
    assert!(reason.contains("45.0"), "{reason}");
}
