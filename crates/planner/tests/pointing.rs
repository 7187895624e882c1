//! Plans keep instruments on their side of cones, between the nodes too: judged from quaternions alone.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_results::Trajectory;
use righting_scenario::file::{DirectionTable, Pointing};
use righting_scenario::{Scenario, file};
use righting_test_support::{scenarios, shipped, varied};

/// Places looked at in every step.
const PLACES: usize = 10;
/// What the verifier tolerates, deg.
const TOLERANCE_DEG: f64 = 0.058;

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

/// Times and attitudes along a plan: within a step the cubic through its ends with q̇ = ½ q ⊗ ω there.
fn attitudes(plan: &Trajectory) -> Vec<(f64, UnitQuaternion<f64>)> {
    let nodes: Vec<(f64, Quaternion<f64>, Quaternion<f64>)> = plan
        .nodes()
        .iter()
        .map(|node| {
            let [w, x, y, z] = node.attitude;
            let attitude = Quaternion::new(w, x, y, z);
            let half_rate = Quaternion::from_imag(Vector3::from(node.angular_rate_rad_s) * 0.5);
            (node.time_s, attitude, attitude * half_rate)
        })
        .collect();
    let mut attitudes = Vec::new();
    for ends in nodes.windows(2) {
        let ((start_s, start, start_rate), (end_s, end, end_rate)) = (ends[0], ends[1]);
        let duration_s = end_s - start_s;
        for place in 0..=PLACES {
            let s = place as f64 / PLACES as f64;
            let attitude = start * ((1.0 + 2.0 * s) * (1.0 - s).powi(2))
                + start_rate * (duration_s * s * (1.0 - s).powi(2))
                + end * (s * s * (3.0 - 2.0 * s))
                + end_rate * (duration_s * s * s * (s - 1.0));
            let attitude = UnitQuaternion::from_quaternion(attitude);
            attitudes.push((start_s + s * duration_s, attitude));
        }
    }
    attitudes
}

/// The axis of a cone; a table's two directions are gone through in equal times.
fn direction(pointing: &Pointing, time_s: f64) -> Vector3<f64> {
    let Some(table) = &pointing.direction_table else {
        return Vector3::from(pointing.direction_inertial.unwrap()).normalize();
    };
    let [from, to] = [0, 1].map(|row| Vector3::from(table.vectors[row]).normalize());
    let share = (time_s - table.t_s[0]) / (table.t_s[1] - table.t_s[0]);
    (from + (to - from) * share).normalize()
}

/// By how much an instrument is on the wrong side of its cone at the worst place of a plan, deg.
fn excess_deg(pointing: &Pointing, plan: &Trajectory) -> f64 {
    let boresight = Vector3::from(pointing.boresight_body).normalize();
    let angles = attitudes(plan).into_iter().map(|(time_s, attitude)| {
        let cosine = (attitude * boresight).dot(&direction(pointing, time_s));
        cosine.clamp(-1.0, 1.0).acos().to_degrees()
    });
    angles
        .map(|angle| match (pointing.keep_out_deg, pointing.keep_in_deg) {
            (Some(least), _) => least - angle,
            (None, Some(most)) => angle - most,
            (None, None) => unreachable!("a cone has a half-angle"),
        })
        .fold(f64::NEG_INFINITY, f64::max)
}

#[track_caller]
fn assert_kept(scenario: &Scenario, planned: &Planned) {
    let Planned { solution, trajectory } = planned;
    let failures: Vec<String> = solution.verification.failures().map(ToString::to_string).collect();
    assert!(
        solution.verification.passed,
        "{:?} {failures:?} {:?}",
        solution.status, solution.notes
    );
    for pointing in &scenario.resolved().pointing {
        let excess_deg = excess_deg(pointing, trajectory);
        assert!(excess_deg <= TOLERANCE_DEG, "{}: {excess_deg}", pointing.name);
    }
    let checks = solution.verification.checks.iter();
    let looks = checks.filter(|check| check.name.starts_with("pointing")).count();
    assert_eq!(looks, 2 * scenario.resolved().pointing.len());
}

#[test]
fn a_slew_goes_around_the_sun_and_keeps_its_antenna_on_the_ground() {
    let scenario = Scenario::read(&scenarios().join("real/slew_4dof_sun.json")).unwrap();
    let free = plan(&varied(&scenario, |file| file.pointing.clear()));
    let sun = &scenario.resolved().pointing[0];
    assert!(excess_deg(sun, &free.trajectory) > 5.0, "the Sun must stand in the way");
    let planned = plan(&scenario);
    assert_kept(&scenario, &planned);
    assert!(planned.solution.objective > free.solution.objective);
}

fn keep_out(boresight_body: [f64; 3], direction: [f64; 3], half_angle_deg: f64) -> Pointing {
    Pointing {
        name: "camera".to_owned(),
        boresight_body,
        direction_inertial: Some(direction),
        direction_table: None,
        keep_out_deg: Some(half_angle_deg),
        keep_in_deg: None,
    }
}

/// The 2-joint slew turns by 20° about an axis, on long steps.
fn on_long_steps(pointing: Pointing, change: impl FnOnce(&mut file::Scenario)) -> Scenario {
    varied(&shipped("slew_2dof"), |file| {
        file.horizon.steps = 24.0;
        change(file);
        file.pointing = vec![pointing];
    })
}

#[test]
fn cones_are_kept_between_the_nodes_of_long_steps() {
    let free = shipped("slew_2dof");
    let axis = Vector3::from(free.resolved().maneuver.axis.unwrap()).normalize();
    let across = axis.cross(&Vector3::x()).normalize();
    let halfway = UnitQuaternion::from_scaled_axis(axis * 10f64.to_radians()) * across;
    for half_angle_deg in [5.0, 9.5] {
        let pointing = keep_out(across.into(), halfway.into(), half_angle_deg);
        let scenario = on_long_steps(pointing, |_| {});
        assert_kept(&scenario, &plan(&scenario));
    }
}

#[test]
fn a_camera_follows_a_direction_that_moves() {
    let scenario = Scenario::read(&scenarios().join("real/slew_4dof_sun.json")).unwrap();
    let scenario = varied(&scenario, |file| {
        let camera = &mut file.pointing[1];
        camera.direction_inertial = None;
        camera.direction_table = Some(DirectionTable {
            t_s: vec![0.0, 120.0],
            vectors: vec![[0.3, 0.0, 1.0], [-0.1, 0.25, 1.0]],
        });
        camera.keep_in_deg = Some(18.0);
        file.pointing.swap_remove(0);
    });
    let free = plan(&varied(&scenario, |file| file.pointing.clear()));
    assert!(excess_deg(&scenario.resolved().pointing[0], &free.trajectory) > 1.0);
    assert_kept(&scenario, &plan(&scenario));
}

#[test]
fn a_detumble_keeps_out_of_a_cone() {
    let pointing = keep_out([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 150.0);
    let scenario = varied(&shipped("detumble_4dof"), |file| {
        file.horizon.steps = 200.0;
        file.pointing = vec![pointing];
    });
    let free = plan(&varied(&scenario, |file| file.pointing.clear()));
    let pointing = &scenario.resolved().pointing[0];
    assert!(excess_deg(pointing, &free.trajectory) > 1.0);
    assert_kept(&scenario, &plan(&scenario));
}
