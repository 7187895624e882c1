//! Which rotations arms can make, against closed forms by hand and finer integrations.

use nalgebra::{Rotation3, Unit, UnitQuaternion, Vector3};
use righting_analysis::holonomy::{Curvature, SingleJoint, TurnRates, TurnableAxes, connection};
use righting_multibody::Quaternion;
use righting_scenario::{JointLimits, Maneuver, Scenario, SystemDescription};
use righting_test_support::by_hand::{link, on_a_cube};
use righting_test_support::{shipped, varied};
use serde_json::Value;

fn system(mount_m: [f64; 3], links: &[Value]) -> SystemDescription {
    on_a_cube(mount_m, links).system().clone()
}

fn assert_close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

#[test]
fn parallel_joints_in_the_plane_of_symmetry_turn_the_base_about_their_axis_alone() {
    let arm: Vec<Value> = (0..4).map(|_| link(10.0, 1.0, 0.0, None)).collect();
    let axes = TurnableAxes::new(&system([0.5, 0.0, 0.0], &arm));
    assert_eq!(axes.rank(), 1);
    assert_eq!(axes.only_axis(), Some(Vector3::z()));
    assert!(axes.are_joints_parallel);
    assert_eq!(axes.effective_joints, [0, 1, 2, 3]);
    assert_eq!(axes.singular_values[1..], [0.0, 0.0]);
    assert_eq!(axes.fastest_across_rad_s, 0.0);
}

/// Above that plane the arm's weight swings the base about x and y too.
#[test]
fn parallel_joints_off_the_plane_of_symmetry_turn_it_about_every_axis() {
    let arm: Vec<Value> = (0..4).map(|_| link(10.0, 1.0, 0.0, None)).collect();
    let axes = TurnableAxes::new(&system([0.5, 0.0, 0.5], &arm));
    assert_eq!(axes.rank(), 3);
    assert!(axes.are_joints_parallel && axes.only_axis().is_none());
}

#[test]
fn one_rod_turns_the_base_by_the_ratio_of_inertias() {
    let (m, l, mass) = (10.0, 2.0, 100.0);
    let system = system([0.0; 3], &[link(m, l, 0.0, None)]);
    let reduced = m * mass / (m + mass);
    let rod = m * l * l / 12.0 + reduced * (l / 2.0) * (l / 2.0);
    let base = mass / 6.0;
    let expected = rod / (base + rod);
    let axes = TurnableAxes::new(&system);
    assert_eq!((axes.rank(), axes.only_axis()), (1, Some(Vector3::z())));
    assert_close(axes.singular_values[0], expected, 1e-12);
    assert_close(axes.fastest_rad_s, expected * 20.0_f64.to_radians(), 1e-12);
    // Half a turn of the joint, the other way, however it gets there.
    let curve = SingleJoint::new(&system, &[0.3], 0, 1.0);
    assert_close(curve.largest_angle_rad(), expected, 1e-12);
    let found = curve.axes_at(0.5 * expected);
    assert!(found.len() == 2 && found.iter().all(|axis| axis.z.abs() > 1.0 - 1e-12), "{found:?}");
    // Round and round at its limit.
    let rates = TurnRates::new(&system, &[0.3]);
    assert_close(rates.rates_rad_s[0], expected * 20.0_f64.to_radians(), 1e-9);
    assert_eq!(rates.rates_rad_s[1..], [0.0, 0.0]);
}

#[test]
fn two_joints_that_are_not_parallel_turn_it_about_every_axis() {
    let arm = [link(1.0, 0.5, 90.0, Some(90.0)), link(5.0, 1.0, 0.0, Some(90.0))];
    let axes = TurnableAxes::new(&system([0.0, 0.0, 0.5], &arm));
    assert_eq!((axes.rank(), axes.are_joints_parallel), (3, false));
    assert!(axes.singular_values[2] > 1e-3 * axes.singular_values[0]);
}

#[test]
fn a_massless_arm_turns_nothing_and_joints_without_effect_are_told() {
    let massless =
        system([0.0, 0.0, 0.5], &[link(0.0, 0.5, 90.0, None), link(0.0, 1.0, 0.0, None)]);
    let axes = TurnableAxes::new(&massless);
    assert_eq!((axes.rank(), axes.idle_joints), (0, vec![0, 1]));
    assert_eq!((axes.singular_values, axes.fastest_rad_s), ([0.0; 3], 0.0));
    assert_eq!(TurnRates::new(&massless, &[0.0, 0.0]).rates_rad_s, [0.0; 3]);

    // The last link has no mass; the joint before it does all. Inboard, a massless link counts.
    let tip = system([0.5, 0.0, 0.5], &[link(5.0, 1.0, 90.0, None), link(0.0, 1.0, 0.0, None)]);
    let axes = TurnableAxes::new(&tip);
    assert_eq!((axes.effective_joints, axes.idle_joints), (vec![0], vec![1]));
    let root = system([0.5, 0.0, 0.5], &[link(0.0, 1.0, 90.0, None), link(5.0, 1.0, 0.0, None)]);
    assert_eq!(TurnableAxes::new(&root).effective_joints, [0, 1]);
}

#[test]
fn a_locked_joint_does_not_move() {
    let arm = [link(1.0, 0.5, 90.0, Some(90.0)), link(5.0, 1.0, 0.0, Some(90.0))];
    let mut locked = system([0.0, 0.0, 0.5], &arm);
    locked.joint_limits[1] =
        JointLimits { angle_min_rad: 0.4, angle_max_rad: 0.4, ..locked.joint_limits[1] };
    let axes = TurnableAxes::new(&locked);
    assert_eq!((axes.locked_joints, axes.effective_joints), (vec![1], vec![0]));
    let rates = TurnRates::new(&locked, &[0.0, 0.4]);
    assert!(rates.turns_rad.iter().all(|turn| *turn < 1e-9), "{:?}", rates.turns_rad);
}

/// The attitude after the joint has turned by `by_rad`, in many small steps of constant rate.
fn turned(system: &SystemDescription, start: &[f64], joint: usize, by_rad: f64) -> Quaternion<f64> {
    let steps = 20_000;
    let step = by_rad / f64::from(steps);
    let mut attitude = UnitQuaternion::identity();
    let mut angles = start.to_vec();
    for k in 0..steps {
        angles[joint] = start[joint] + (f64::from(k) + 0.5) * step;
        let rate = connection(&system.model, &angles)[joint];
        attitude *= UnitQuaternion::new(rate * step);
    }
    Quaternion::new(attitude.w, attitude.i, attitude.j, attitude.k)
}

#[test]
fn the_curve_of_one_joint_is_that_of_a_finer_integration() {
    // A bent arm above the base: the axis that the base turns about moves with the joint.
    let arm = [link(4.0, 0.7, 60.0, Some(150.0)), link(6.0, 1.0, 20.0, Some(100.0))];
    let system = system([0.4, 0.1, 0.5], &arm);
    let start = [0.2, 0.8];
    let curve = SingleJoint::new(&system, &start, 0, f64::INFINITY);
    assert!(curve.is_whole);
    for by_rad in [-2.5, -1.0, 0.3, 2.0] {
        let reached = turned(&system, &start, 0, by_rad);
        let miss = curve.smallest_miss_rad(&reached);
        assert!(miss < 2e-5, "{by_rad}: {miss}");
        let (axis, angle) = reached.to_axis_angle();
        let found = curve.axes_at(angle);
        assert!(found.iter().any(|other| other.angle(&axis) < 1e-3), "{axis} {found:?}");
    }
    // Beyond the joint's limit, and across.
    let beyond = turned(&system, &start, 0, 150.0_f64.to_radians() - 0.2 + 0.3);
    assert!(curve.smallest_miss_rad(&beyond) > 0.01);
    let across = turned(&system, &start, 1, -1.0);
    assert!(curve.smallest_miss_rad(&across) > 0.05);
}

/// The nearest attitude of the curve, looked for by force.
#[test]
fn the_smallest_miss_is_the_smallest() {
    let arm = [link(4.0, 0.7, 60.0, Some(150.0)), link(6.0, 1.0, 20.0, Some(100.0))];
    let system = system([0.4, 0.1, 0.5], &arm);
    let start = [0.2, 0.8];
    let curve = SingleJoint::new(&system, &start, 1, 1.0);
    let target = Quaternion::from_axis_angle(&Vector3::new(0.6, 0.0, 0.8), 0.1);
    let angles = (-200..=200).map(|k| f64::from(k) / 200.0);
    let least = angles.map(|by| turned_coarsely(&system, &start, by).angle_to(&target));
    let least = least.fold(f64::INFINITY, f64::min);
    let found = curve.smallest_miss_rad(&target);
    assert!(found <= least + 1e-6 && found > least - 1e-4, "{found} {least}");
}

fn turned_coarsely(system: &SystemDescription, start: &[f64], by_rad: f64) -> Quaternion<f64> {
    let mut attitude = UnitQuaternion::identity();
    let mut angles = start.to_vec();
    for k in 0..200 {
        angles[1] = start[1] + by_rad * (f64::from(k) + 0.5) / 200.0;
        attitude *= UnitQuaternion::new(connection(&system.model, &angles)[1] * (by_rad / 200.0));
    }
    Quaternion::new(attitude.w, attitude.i, attitude.j, attitude.k)
}

/// The same arm and base, seen in body axes that are turned.
fn in_other_axes(scenario: &Scenario, turn: UnitQuaternion<f64>) -> Scenario {
    varied(scenario, |file| {
        let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
            panic!("a resolved system is inline")
        };
        let matrix = turn.to_rotation_matrix();
        system.mount.as_mut().unwrap().position_m =
            (matrix * Vector3::from(system.mount.as_mut().unwrap().position_m)).into();
        let [w, x, y, z] = system.mount.as_mut().unwrap().rotation.unwrap_or([1.0, 0.0, 0.0, 0.0]);
        let mount = turn * UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        system.mount.as_mut().unwrap().rotation = Some([mount.w, mount.i, mount.j, mount.k]);
        // A cube's inertia is the same in all axes.
        assert!(system.base.cube_side_m.is_some());
    })
}

#[test]
fn other_body_axes_and_units_change_nothing_but_the_components() {
    let turn =
        UnitQuaternion::from_axis_angle(&Unit::new_normalize(Vector3::new(1.0, 2.0, -0.5)), 1.1);
    let matrix: Rotation3<f64> = turn.to_rotation_matrix();
    let scenario = varied(&shipped("slew_4dof"), |_| {});
    let start = &scenario.initial().joint_angles_rad;
    let plain = TurnableAxes::new(scenario.system());
    let plain_rates = TurnRates::new(scenario.system(), start);

    let seen = in_other_axes(&scenario, turn);
    let axes = TurnableAxes::new(seen.system());
    let rates = TurnRates::new(seen.system(), start);
    for k in 0..3 {
        assert_close(axes.singular_values[k], plain.singular_values[k], 1e-12);
        assert_close(rates.turns_rad[k], plain_rates.turns_rad[k], 1e-9);
        let expected = plain_rates.rates_rad_s[k];
        assert_close(rates.rates_rad_s[k], expected, 1e-6 * expected);
        let along = rates.principal_axes[k].dot(&(matrix * plain_rates.principal_axes[k])).abs();
        assert_close(along, 1.0, 1e-9);
    }
    let asked = Vector3::new(0.0, 0.6, 0.8);
    let expected = plain_rates.duration_s(&asked, 0.3).unwrap();
    assert_close(rates.duration_s(&(matrix * asked), 0.3).unwrap(), expected, 1e-6 * expected);

    for (mass, length) in [(1e6, 1e3), (1e-6, 1e-3), (1.0, 1e3)] {
        let scaled = varied(&scenario, |file| {
            let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
                panic!("a resolved system is inline")
            };
            system.base.mass_kg *= mass;
            system.base.cube_side_m = system.base.cube_side_m.map(|side| side * length);
            system.mount.as_mut().unwrap().position_m =
                system.mount.as_mut().unwrap().position_m.map(|x| x * length);
            for link in &mut system.links {
                link.mass_kg *= mass;
                link.a_m *= length;
                link.d_m *= length;
            }
            file.collision.clearance_m = Some(0.01 * length.min(1.0));
        });
        let axes = TurnableAxes::new(scaled.system());
        let rates = TurnRates::new(scaled.system(), start);
        for k in 0..3 {
            assert_close(axes.singular_values[k], plain.singular_values[k], 1e-12);
            assert_close(rates.rates_rad_s[k], plain_rates.rates_rad_s[k], 1e-9);
        }
    }
}

#[test]
fn loops_of_an_arm_with_one_axis_turn_the_base_about_it_alone() {
    let arm: Vec<Value> = (0..3).map(|_| link(10.0, 1.0, 0.0, Some(120.0))).collect();
    let planar = system([0.5, 0.0, 0.0], &arm);
    let rates = TurnRates::new(&planar, &[0.0; 3]);
    assert_eq!(rates.principal_axes[0], Vector3::z());
    assert!(rates.turns_rad[0] > 0.05, "{:?}", rates.turns_rad);
    assert!(rates.turns_rad[1] < 1e-12 && rates.rates_rad_s[1..] == [0.0, 0.0]);
    assert!(rates.duration_s(&Vector3::z(), 0.5).is_some());
    assert!(rates.duration_s(&-Vector3::z(), 0.5).is_some());
    assert_eq!(rates.duration_s(&Vector3::x(), 0.5), None);
    assert_eq!(rates.duration_s(&Vector3::z(), 0.0), Some(0.0));
}

/// In the plane the curvature is the curl of A's z component, which Green's theorem integrates over a
/// rectangle's inside.
#[test]
fn the_curvature_is_the_curl_of_the_connection_where_rotations_commute() {
    let arm: Vec<Value> = (0..2).map(|_| link(10.0, 1.0, 0.0, Some(120.0))).collect();
    let planar = system([0.5, 0.0, 0.0], &arm);
    let (low, size, count) = ([0.2, 0.5], 0.4, 40);
    let step = size / f64::from(count);
    let at = |joint: usize, q: [f64; 2]| connection(&planar.model, &q)[joint].z;
    let middle = |k: i32| (f64::from(k) + 0.5) * step;
    let around: f64 = (0..count)
        .map(|k| {
            let [x, y] = low.map(|low: f64| low + middle(k));
            step * (at(0, [x, low[1]]) - at(0, [x, low[1] + size]) + at(1, [low[0] + size, y])
                - at(1, [low[0], y]))
        })
        .sum();
    let inside: f64 = (0..count * count)
        .map(|k| {
            let q = [low[0] + middle(k / count), low[1] + middle(k % count)];
            step * step * Curvature::at(&planar.model, &q).between(0, 1).z
        })
        .sum();
    assert_close(around, inside, 1e-4 * inside.abs());
    assert!(inside.abs() > 1e-3);
}

/// Beside the shortest durations that docs/reach.md gives, effort nearly free; of the last one to 10 %.
#[test]
fn the_estimated_durations_are_as_rough_as_they_are_said_to_be() {
    for (name, shortest_s, times) in [
        ("slew_2dof", 7.92, 1.0),
        ("slew_4dof", 8.77, 2.5),
        ("slew_canadarm2_table", 7.77, 4.2),
        ("slew75_4dof", 33.0, 4.0),
        ("slew_canadarm2", 10.3, 0.6),
    ] {
        let scenario = shipped(name);
        let Maneuver::Slew(slew) = scenario.maneuver() else { panic!("{name} is a slew") };
        let rates = TurnRates::new(scenario.system(), &scenario.initial().joint_angles_rad);
        let estimated_s = rates.duration_s(&slew.axis, slew.angle_rad).unwrap();
        assert_close(estimated_s / shortest_s, times, 0.06);
        let least_s = slew.angle_rad / TurnableAxes::new(scenario.system()).fastest_rad_s;
        assert!(0.0 < least_s && least_s < shortest_s, "{name}: {least_s}");
    }
}
