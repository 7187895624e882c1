//! The verifier passes a true maneuver and catches every way of tampering with it.

use std::f64::consts::TAU;

use righting_analysis::detumble;
use righting_results::{Check, Node, Terminal, Trajectory, Verification, objective};
use righting_scenario::{Maneuver, Scenario};
use righting_test_support::{motion, shipped, swing, tampered, true_slew, varied};
use righting_verifier::{simulate, verify};

fn failures(verification: &Verification) -> Vec<&str> {
    verification.failures().map(|check| check.name.as_str()).collect()
}

fn check<'a>(verification: &'a Verification, name: &str) -> &'a Check {
    verification.check(name).unwrap_or_else(|| panic!("no check is called {name}"))
}

#[test]
fn a_true_slew_of_every_system_passes() {
    for system in ["2dof", "4dof", "canadarm2_table", "canadarm2"] {
        let (scenario, trajectory) = true_slew(&shipped(&format!("slew_{system}")));
        let verification = verify(&scenario, &trajectory);
        assert!(verification.passed, "{system}: {:#?}", failures(&verification));
        assert!(verification.attitude_mismatch < 1e-9, "{}", verification.attitude_mismatch);
        assert!(verification.joint_mismatch < 1e-9);
        assert!(verification.position_mismatch < 1e-9);
        assert!(verification.momentum_drift < 1e-9);
        let Maneuver::Slew(slew) = scenario.maneuver() else { panic!("not a slew") };
        assert!(
            slew.angle_rad > 1e-5,
            "{system}: {}: the base must turn for the test to mean something",
            slew.angle_rad
        );
    }
}

/// A slew of the 4-DOF arm on a coarser grid, for the tampering.
fn example() -> (Scenario, Trajectory) {
    true_slew(&varied(&shipped("slew_4dof"), |file| file.horizon.steps = 100.0))
}

fn caught(
    change: impl FnOnce(&mut Vec<Node>, &mut Vec<righting_results::ControlInterval>),
) -> Vec<String> {
    let (scenario, trajectory) = example();
    assert!(verify(&scenario, &trajectory).passed);
    let verification = verify(&scenario, &tampered(&trajectory, change));
    failures(&verification).into_iter().map(str::to_owned).collect()
}

#[test]
fn a_changed_joint_angle_is_caught() {
    let names = caught(|nodes, _| nodes[37].joint_angles_rad[2] += 1e-4);
    assert!(names.contains(&"joint angle mismatch".to_owned()), "{names:?}");
}

#[test]
fn a_changed_control_is_caught_wherever_it_is() {
    for k in [0, 50, 99] {
        let names = caught(|_, intervals| intervals[k].joint_accelerations_rad_s2[1] += 1e-3);
        assert!(names.contains(&"joint rate mismatch".to_owned()), "{k}: {names:?}");
    }
}

#[test]
fn a_swapped_quaternion_order_is_caught() {
    let names = caught(|nodes, _| nodes.iter_mut().for_each(|node| node.attitude.rotate_left(1)));
    assert!(names.contains(&"start".to_owned()), "{names:?}");
    let names = caught(|nodes, _| {
        nodes.iter_mut().skip(1).for_each(|node| node.attitude.rotate_left(1));
    });
    assert!(names.contains(&"attitude mismatch".to_owned()), "{names:?}");
    let names = caught(|nodes, _| nodes[60].attitude.iter_mut().for_each(|part| *part *= 1.001));
    assert_eq!(names, ["quaternion norm error"]);
}

#[test]
fn the_same_attitude_with_the_other_sign_is_the_same_attitude() {
    let (scenario, trajectory) = example();
    let flipped = tampered(&trajectory, |nodes, _| {
        nodes
            .iter_mut()
            .skip(1)
            .flat_map(|node| &mut node.attitude)
            .for_each(|part| *part = -*part);
    });
    assert!(verify(&scenario, &flipped).passed);
}

#[test]
fn every_column_is_looked_at() {
    type Change = fn(&mut Node);
    let nodes: [(&str, Change); 6] = [
        ("time grid", |node| node.time_s += 1e-6),
        ("position mismatch", |node| node.position_m[1] += 1e-3),
        ("velocity mismatch", |node| node.velocity_m_s[0] += 1e-3),
        ("angular rate mismatch", |node| node.angular_rate_rad_s[2] += 1e-3),
        ("joint rate mismatch", |node| node.joint_rates_rad_s[3] += 1e-4),
        ("power mismatch", |node| node.power_w += 1e-5),
    ];
    for (name, change) in nodes {
        for k in [20, 100] {
            let names = caught(|nodes, _| change(&mut nodes[k]));
            assert!(names.contains(&name.to_owned()), "{name} at {k}: {names:?}");
        }
    }
    let names = caught(|_, intervals| intervals[99].joint_torques_n_m[0] += 1e-4);
    assert_eq!(names, ["joint torque mismatch"]);
}

#[test]
fn numbers_that_are_none_are_caught() {
    for value in [f64::NAN, f64::INFINITY, 1e300] {
        let names = caught(|_, intervals| intervals[10].joint_accelerations_rad_s2[0] = value);
        assert!(names.contains(&"joint acceleration".to_owned()), "{names:?}");
        let names = caught(|nodes, _| nodes[10].position_m[0] = value);
        assert!(names.contains(&"position mismatch".to_owned()), "{names:?}");
    }
}

#[test]
fn another_target_or_another_start_is_caught() {
    let (scenario, trajectory) = example();
    let asked_for_more = varied(&scenario, |file| {
        let angle_deg = file.maneuver.angle_deg.unwrap();
        file.maneuver.angle_deg = Some(angle_deg + 0.2);
    });
    let verification = verify(&asked_for_more, &trajectory);
    assert_eq!(failures(&verification), ["attitude error at the end"]);
    let end = check(&verification, "attitude error at the end");
    assert!((end.value - 0.1_f64.to_radians().sin()).abs() < 1e-7);

    let elsewhere = varied(&scenario, |file| file.initial.joint_angles_deg[3] = 1.0);
    assert!(failures(&verify(&elsewhere, &trajectory)).contains(&"start"));

    let longer = varied(&scenario, |file| file.horizon.steps = 101.0);
    assert_eq!(failures(&verify(&longer, &trajectory)), ["number of steps"]);
    let other_arm = true_slew(&shipped("slew_2dof")).0;
    assert_eq!(failures(&verify(&other_arm, &trajectory)), ["number of joints"]);
}

#[test]
fn a_motion_that_does_not_stop_is_caught() {
    let scenario = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 100.0);
    let mut controls = swing(&scenario);
    controls[99][0] += 1.0_f64.to_radians() / scenario.horizon().step_s() * 2.0;
    let verification = verify(&scenario, &motion(&scenario, &controls));
    let names = failures(&verification);
    assert!(names.contains(&"joint rate at the end"), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("mismatch")), "{names:?}");
    let rate = check(&verification, "joint rate at the end");
    assert!((rate.value - 2.0).abs() < 0.01, "{}", rate.value);
}

/// Limits tightened until the swing breaks them, one at a time.
#[test]
fn broken_limits_are_named_with_joint_time_and_value() {
    let (scenario, trajectory) = example();
    let with_joint = |joint: usize, change: &dyn Fn(&mut righting_scenario::file::Link)| {
        let scenario = varied(&scenario, |file| {
            let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
                panic!("a resolved system is inline")
            };
            change(&mut system.links[joint]);
        });
        verify(&scenario, &trajectory)
    };
    let largest = |values: &dyn Fn(&Node) -> f64| {
        trajectory.nodes().iter().map(values).fold(f64::NEG_INFINITY, f64::max)
    };

    let highest = largest(&|node| node.joint_angles_rad[2]);
    let verification = with_joint(2, &|link| link.angle_max_deg = Some(highest.to_degrees() - 0.5));
    let names = failures(&verification);
    assert_eq!(names, ["joint angle at nodes", "joint angle between nodes"]);
    let angle = check(&verification, "joint angle at nodes");
    assert_eq!(angle.subject.as_deref(), Some("joint 3"));
    assert!((angle.value - highest).abs() < 1e-12);
    assert!((angle.value - angle.limit - 0.5_f64.to_radians()).abs() < 1e-9);
    let at = angle.time_s.unwrap();
    let node = trajectory.nodes().iter().find(|node| node.time_s == at).unwrap();
    assert_eq!(node.joint_angles_rad[2], highest);

    let fastest = largest(&|node| node.joint_rates_rad_s[1].abs());
    let verification = with_joint(1, &|link| link.rate_max_deg_s = fastest.to_degrees() - 0.1);
    let names = failures(&verification);
    assert_eq!(names, ["joint rate at nodes", "joint rate between nodes"]);
    assert_eq!(check(&verification, names[0]).subject.as_deref(), Some("joint 2"));

    let verification = with_joint(0, &|link| link.acceleration_max_deg_s2 = 0.5);
    assert_eq!(failures(&verification), ["joint acceleration"]);
    let acceleration = check(&verification, "joint acceleration");
    assert_eq!(acceleration.subject.as_deref(), Some("joint 1"));
}

#[test]
fn a_collision_is_named_with_its_links() {
    // The arm folds down over the base until its tip is inside the clearance.
    let scenario = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 100.0);
    let bends = [90.0_f64, 50.0, 35.0].map(f64::to_radians);
    let duration_s = scenario.horizon().duration_s;
    let controls: Vec<Vec<f64>> = (0..100)
        .map(|k| {
            let phase = TAU * (f64::from(k) + 0.5) / 100.0;
            let bend = |angle_rad| angle_rad * TAU / duration_s.powi(2) * phase.sin();
            vec![0.0, bend(bends[0]), bend(bends[1]), bend(bends[2])]
        })
        .collect();
    let trajectory = motion(&scenario, &controls);
    let verification = verify(&scenario, &trajectory);
    let mut tip = [0.0, 0.5];
    let mut direction = 0.0;
    for bend in &trajectory.end().joint_angles_rad[1..] {
        direction += bend;
        tip = [tip[0] + 0.25 * f64::sin(direction), tip[1] + 0.25 * f64::cos(direction)];
    }
    let expected = f64::hypot(tip[0], tip[1]);
    for name in ["clearance from body at nodes", "clearance from body between nodes"] {
        let collision = check(&verification, name);
        assert!(!collision.passed);
        assert_eq!(collision.subject.as_deref(), Some("link 4 and body"));
        let tolerance = if name.contains("between") { 1e-5 } else { 1e-12 };
        assert!((collision.value - expected).abs() < tolerance, "{name}: {}", collision.value);
        let least = 0.25 * 3.0_f64.sqrt() + 0.01;
        assert!((collision.limit - least).abs() < 1e-15);
        assert!(collision.time_s.unwrap() > 0.99 * duration_s);
    }
    assert!(check(&verification, "clearance between links at nodes").passed);
}

#[test]
fn a_joint_that_turns_back_between_two_nodes_is_followed_to_the_turn() {
    let scenario = varied(&shipped("slew_2dof"), |file| {
        file.horizon.steps = 3.0;
        file.horizon.duration_s = righting_scenario::file::Duration::Given(3.0);
        let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
            panic!("a resolved system is inline")
        };
        system.links[1].angle_max_deg = Some(0.06_f64.to_degrees());
    });
    // After 1 s the joint is at 0.05 rad with 0.1 rad/s; braked at 0.2 rad/s² it turns back 0.5 s
    // later at 0.075 rad.
    let controls = [0.1, -0.2, 0.1].map(|u| vec![0.0, u]).to_vec();
    let verification = verify(&scenario, &motion(&scenario, &controls));
    let between = check(&verification, "joint angle between nodes");
    assert!(!between.passed);
    assert!((between.value - 0.075).abs() < 1e-12);
    assert!((between.time_s.unwrap() - 1.5).abs() < 1e-12);
    assert!(check(&verification, "joint angle at nodes").passed);
}

#[test]
fn a_detumble_is_bounded_by_the_largest_inertia() {
    // Closed form for the single link: straight up, the largest principal inertia; h₀ from the
    // inclined start.
    let (base, link, length) = (12.5, 25.0, 1.0);
    let reduced = 300.0 * link / (300.0 + link);
    let rod = link * length * length / 12.0;
    let largest = base + reduced * 0.75 * 0.75 + rod;
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let (x, z) = (0.5 * sin, 0.25 + 0.5 * cos);
    let about_z = base + reduced * x * x + rod * sin * sin;
    let across = reduced * x * z + rod * sin * cos;
    let bound = detumble::rate_bound_rad_s(&shipped("detumble_2dof")).to_degrees();
    assert!((bound - 20.0 * about_z.hypot(across) / largest).abs() < 1e-9, "{bound}");

    let straight_up = varied(&shipped("detumble_4dof"), |file| {
        file.initial.joint_angles_deg = vec![0.0; 4];
    });
    let bound = detumble::rate_bound_rad_s(&straight_up).to_degrees();
    assert!((bound - 9.22).abs() < 0.005, "{bound}");
}

#[test]
fn doing_nothing_is_a_poor_but_true_detumble() {
    for system in ["2dof", "4dof", "canadarm2_table", "canadarm2"] {
        let scenario = varied(&shipped(&format!("detumble_{system}")), |file| {
            file.horizon.steps = 60.0;
        });
        let joints = scenario.system().joint_count();
        let idle = motion(&scenario, &vec![vec![0.0; joints]; 60]);
        let verification = verify(&scenario, &idle);
        let mut names = failures(&verification);
        names.retain(|name| *name != "angular rate at the end");
        assert!(names.is_empty(), "{system}: {names:?}");
        let reached = Terminal::reached(&scenario, &idle);
        assert!(reached.angular_rate_deg_s > 19.0);
        assert!(reached.reduction_percent(&scenario) < 5.0);
        let bound = detumble::rate_bound_rad_s(&scenario).to_degrees();
        assert!(bound < reached.angular_rate_deg_s && bound > 8.0, "{system}: {bound}");
    }
}

#[test]
fn a_plan_is_simulated_in_the_system_that_is_given() {
    let (scenario, plan) = example();
    let (reached, verification) = simulate(&scenario, &plan);
    assert!(verification.passed && reached.attitude_error < 1e-9, "{}", reached.attitude_error);

    let heavier = varied(&scenario, |file| {
        let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
            panic!("a resolved system is inline")
        };
        system.links[1].mass_kg *= 10.0;
    });
    let (reached, _) = simulate(&heavier, &plan);
    assert!(reached.attitude_error > 1e-6, "{}", reached.attitude_error);
    // What the planner's model makes of the same controls.
    let controls: Vec<_> =
        plan.intervals().iter().map(|i| i.joint_accelerations_rad_s2.clone()).collect();
    let expected = Terminal::reached(&heavier, &motion(&heavier, &controls));
    assert!((reached.attitude_error - expected.attitude_error).abs() < 1e-9);
    assert!((reached.attitude_error_deg - expected.attitude_error_deg).abs() < 1e-7);

    let (_, verification) = simulate(&shipped("slew_2dof"), &plan);
    assert_eq!(failures(&verification), ["number of joints"]);
}

#[test]
fn the_objective_is_the_one_of_the_weights() {
    let (scenario, trajectory) = example();
    let effort: f64 = trajectory
        .intervals()
        .iter()
        .flat_map(|interval| &interval.joint_accelerations_rad_s2)
        .map(|u| u * u)
        .sum();
    let cost = objective(&scenario, &trajectory);
    // The weight is that of the integral, over 0.05 s.
    let weighted = 0.01 * effort * scenario.horizon().step_s() / 0.05;
    assert!((cost - weighted).abs() < 1e-12, "at rest at the target only effort is left");
    let heavier = varied(&scenario, |file| file.weights.joint_angle = Some(2.0));
    let moved: f64 = trajectory.end().joint_angles_rad.iter().map(|angle| angle * angle).sum();
    assert!((objective(&heavier, &trajectory) - cost - 2.0 * moved).abs() < 1e-12);
}

/// With the arm moving at the start, the base's first rate says nothing: stopping the arm leaves what
/// momentum has, and that is what a detumble is judged by.
#[test]
fn a_detumble_is_judged_against_stopping_the_arm() {
    let scenario = varied(&shipped("detumble_4dof"), |file| {
        file.initial.joint_rates_deg_s = Some(vec![10.0, -5.0, 8.0, 3.0]);
        file.horizon.steps = 60.0;
    });
    let initial = scenario.initial();
    let model = &scenario.system().model;
    let momentum = initial.attitude.to_body(&initial.angular_momentum_n_m_s);
    let still = [0.0; 4];
    let angles = &initial.joint_angles_rad;
    let expected = model.reduced_angular_rate(angles, &still, &momentum).norm().to_degrees();
    let first = initial.angular_rate_rad_s.norm().to_degrees();
    assert!((expected - first).abs() > 0.1, "{expected} {first}");

    let idle = motion(&scenario, &vec![vec![0.0; 4]; 60]);
    let verification = verify(&scenario, &idle);
    let check = verification.check("angular rate at the end").unwrap();
    assert!((check.limit - expected).abs() < 1e-9, "{} {expected}", check.limit);
    let reached = Terminal::reached(&scenario, &idle);
    let percent = 100.0 * (1.0 - reached.angular_rate_deg_s / expected);
    assert!((reached.reduction_percent(&scenario) - percent).abs() < 1e-9);

    // With the arm at rest it is the first rate.
    let at_rest = varied(&scenario, |file| file.initial.joint_rates_deg_s = None);
    let verification = verify(&at_rest, &motion(&at_rest, &vec![vec![0.0; 4]; 60]));
    let check = verification.check("angular rate at the end").unwrap();
    assert!((check.limit - first).abs() < 1e-9, "{} {first}", check.limit);
}
