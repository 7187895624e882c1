//! Plans whose joints' jerks are limited, against closed forms and by differences of their tables.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::file::{self, Duration, DurationRange, SystemReference};
use righting_scenario::{Maneuver, Scenario};
use righting_test_support::by_hand::{link, on_a_cube};
use righting_test_support::{scenarios, shipped, varied};

const JERK_DEG_S3: f64 = 1.0;

fn plan(scenario: &Scenario) -> Planned {
    let planned = Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap();
    let verification = &planned.solution.verification;
    let failures: Vec<String> = verification.failures().map(ToString::to_string).collect();
    assert!(verification.passed, "{:?}: {failures:?}", planned.solution.status);
    planned
}

fn links(file: &mut file::Scenario) -> &mut [file::Link] {
    let SystemReference::Inline(system) = &mut file.system else { unreachable!("resolved") };
    &mut system.links
}

/// A rod of 50 kg and 2 m that turns about the center of a cube of 100 kg and 1 m: of a turn of the joint the
/// base makes J/(I + J), with the cube's inertia I and the rod's J about its end, by the reduced mass.
fn planar(change: impl FnOnce(&mut file::Scenario)) -> Scenario {
    let scenario = on_a_cube([0.0; 3], &[link(50.0, 2.0, 0.0, None)]);
    varied(&scenario, |file| {
        links(file)[0].jerk_max_deg_s3 = Some(JERK_DEG_S3);
        change(file);
    })
}

/// By how much the joint turns in a slew of the base by 10°, deg.
fn joint_turn_deg() -> f64 {
    let base = 100.0 / 6.0;
    let rod = 50.0 * 2.0_f64.powi(2) / 12.0 + 50.0 * 100.0 / 150.0;
    10.0 * (base + rod) / rod
}

/// The shortest motion from rest to rest with nothing but its jerk limited turns by Δ in (32 Δ/J)^⅓: the jerk is
/// at its limit all the time, and changes sign after a quarter and three quarters of it.
#[test]
fn the_fastest_slew_of_a_planar_arm_takes_as_long_as_its_jerk_asks() {
    let scenario = planar(|file| {
        file.horizon.duration_s = Duration::Free(DurationRange { min: 2.0, max: 30.0 });
        file.horizon.steps = 200.0;
        file.weights.control = Some(1e-9);
        file.weights.time = Some(1.0);
    });
    let planned = plan(&scenario);
    let expected_s = (32.0 * joint_turn_deg() / JERK_DEG_S3).cbrt();
    let found_s = planned.solution.duration_s.unwrap();
    assert!((found_s / expected_s - 1.0).abs() < 2e-3, "{found_s} {expected_s}");
    let jerks = planned.trajectory.intervals().iter().map(|i| i.joint_jerk_rad_s3(0).to_degrees());
    let at_limit = jerks.filter(|jerk| jerk.abs() > 0.99 * JERK_DEG_S3).count();
    assert!(at_limit > 180, "{at_limit} of 200");
}

/// The least ∫q̈² dt from rest to rest with q̈ = 0 at both ends and |q⃛| ≤ J has q̈ = c (1 − 2t/T) but near the
/// ends, where it changes at the rate J: t₁ = c/(J + 2c/T) after the start it is that line. It turns by
/// Δ = c T²/6 − c t₁ T/2 + c t₁²/3 · …, integrated here as it stands.
#[test]
fn the_gentlest_slew_of_a_planar_arm_is_the_trapezoid_of_its_closed_form() {
    let duration_s = 10.0;
    let steps = 200;
    let scenario = planar(|file| {
        file.horizon.duration_s = Duration::Given(duration_s);
        file.horizon.steps = steps as f64;
        // So dear that what the end costs less effort does not count.
        file.end =
            Some(file::End { hard: Some(false), joint_angles_deg: None, ..file::End::default() });
        file.weights.attitude = Some(1e6);
        file.weights.angular_rate = Some(1e6);
        file.weights.joint_rate = Some(1e6);
    });
    let planned = plan(&scenario);
    let acceleration_deg_s2 = |line: f64, time_s: f64| {
        let early = JERK_DEG_S3 * time_s;
        let late = JERK_DEG_S3 * (time_s - duration_s);
        (line * (1.0 - 2.0 * time_s / duration_s)).min(early).max(late)
    };
    // Turned by the moments of the acceleration about the end, by the midpoint rule.
    let turned_deg = |line: f64| -> f64 {
        let parts = 100_000;
        let part_s = duration_s / f64::from(parts);
        let times = (0..parts).map(|part| (f64::from(part) + 0.5) * part_s);
        times.map(|t| acceleration_deg_s2(line, t) * (duration_s - t)).sum::<f64>() * part_s
    };
    let (mut low, mut high) = (0.0, JERK_DEG_S3 * duration_s);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if turned_deg(middle) < joint_turn_deg() { low = middle } else { high = middle }
    }
    let sign = -planned.trajectory.end().joint_angles_rad[0].signum();
    let mut largest: f64 = 0.0;
    for (k, node) in planned.trajectory.nodes().iter().enumerate() {
        let found = planned.trajectory.joint_accelerations_at(k)[0].to_degrees();
        let expected = -sign * acceleration_deg_s2(low, node.time_s);
        largest = largest.max((found - expected).abs());
    }
    // Half of what the acceleration changes by in a step.
    assert!(
        low > 0.5 && largest < 0.5 * JERK_DEG_S3 * duration_s / steps as f64,
        "{low} {largest}"
    );
}

/// Rates, accelerations and jerks of the table, from angles, rates and accelerations by differences, which are
/// exact for cubics: Simpson's rule and the trapezoidal rule.
fn assert_consistent(scenario: &Scenario, planned: &Planned) {
    let table = &planned.trajectory;
    assert!(table.has_jerks());
    let limits = &scenario.system().joint_limits;
    for (joint, limits) in limits.iter().enumerate() {
        assert_eq!(table.joint_accelerations_at(0)[joint], 0.0);
        assert!(table.joint_accelerations_at(table.steps())[joint].abs() < 1e-6);
        for k in 0..table.steps() {
            let [before, after] = [k, k + 1].map(|node| &table.nodes()[node]);
            let step_s = after.time_s - before.time_s;
            let [u, next] = [k, k + 1].map(|node| table.joint_accelerations_at(node)[joint]);
            let jerk = table.intervals()[k].joint_jerk_rad_s3(joint);
            assert!(((next - u) / step_s - jerk).abs() < 1e-6, "joint {joint}, step {k}");
            assert!(jerk.abs() <= limits.jerk_max_rad_s3 * (1.0 + 1e-6));
            let gained = after.joint_rates_rad_s[joint] - before.joint_rates_rad_s[joint];
            assert!((gained / step_s - 0.5 * (u + next)).abs() < 1e-9, "joint {joint}, step {k}");
            let turned = after.joint_angles_rad[joint] - before.joint_angles_rad[joint];
            let mean_rate = before.joint_rates_rad_s[joint] + step_s * (2.0 * u + next) / 6.0;
            assert!((turned / step_s - mean_rate).abs() < 1e-9, "joint {joint}, step {k}");
        }
    }
}

#[test]
fn the_shipped_slew_keeps_its_jerks() {
    let file = scenarios().join("real/slew_canadarm2_jerk.json");
    let scenario = Scenario::read(&file).unwrap();
    let planned = plan(&scenario);
    assert_consistent(&scenario, &planned);
    let limits = planned.solution.limits.iter();
    let jerk = limits.clone().find(|limit| limit.name == "joint jerk").unwrap();
    assert!(jerk.value > 0.99 * jerk.bound, "{jerk:?}");
    assert!(planned.solution.verification.check("jump of joint acceleration at nodes").is_some());
}

/// Both forms, a detumble with a limit on one joint only, loads, a locked joint and the paper's guess.
#[test]
fn jerks_go_with_everything_else() {
    type Change = fn(&mut file::Scenario);
    let cases: [(&str, Change); 6] = [
        ("slew_4dof", |file| links(file)[2].jerk_max_deg_s3 = Some(0.5)),
        ("slew_4dof_full", |file| links(file)[2].jerk_max_deg_s3 = Some(0.5)),
        ("detumble_2dof", |file| links(file)[1].jerk_max_deg_s3 = Some(3.0)),
        ("slew_4dof", |file| {
            links(file).iter_mut().for_each(|link| link.jerk_max_deg_s3 = Some(0.5));
            links(file).iter_mut().for_each(|link| link.torque_max_n_m = Some(0.2));
        }),
        ("slew_4dof", |file| {
            links(file).iter_mut().for_each(|link| link.jerk_max_deg_s3 = Some(0.5));
            (links(file)[3].angle_min_deg, links(file)[3].angle_max_deg) = (Some(0.0), Some(0.0));
        }),
        ("slew_2dof", |file| {
            links(file)[0].jerk_max_deg_s3 = Some(1.0);
            file.solver.guess = Some(file::Guess::Named(file::NamedGuess::Constant));
        }),
    ];
    for (name, change) in cases {
        let scenario = varied(&shipped(name), |file| {
            file.horizon.steps = 120.0;
            change(file);
        });
        assert_consistent(&scenario, &plan(&scenario));
    }
}

/// Either kind of plan starts the other, and a plan with jerks starts itself.
#[test]
fn plans_with_and_without_jerks_start_each_other() {
    let held = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 120.0);
    let linear = varied(&held, |file| links(file)[1].jerk_max_deg_s3 = Some(0.3));
    let [first, second] = [&held, &linear].map(plan);
    for (scenario, earlier) in [(&linear, &first), (&held, &second), (&linear, &second)] {
        let warm = Planner::new().warm_start(&earlier.trajectory);
        let planned = { warm }.plan(scenario, &mut |_| Control::Continue).unwrap();
        assert!(planned.solution.verification.passed, "{:?}", planned.solution.status);
        let own = if std::ptr::eq(scenario, &raw const held) { &first } else { &second };
        assert!(planned.solution.objective <= own.solution.objective * (1.0 + 1e-3));
    }
    assert!(matches!(held.maneuver(), Maneuver::Slew(_)));
    assert!(second.solution.objective > first.solution.objective);
}
