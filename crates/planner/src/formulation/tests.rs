use std::path::Path;

use righting_ocp::{DerivativeErrors, Grid, MultipleShooting, StageFunctions};
use righting_scenario::file::{
    DirectionTable, Duration, DurationRange, End, Pointing, SystemReference, Waypoint,
};
use righting_scenario::halton::Halton;
use righting_scenario::scenario::Scenario;
use righting_test_support::varied;

use super::{Clearances, Cones, FormulatedManeuver, StageLimits};

/// The eight maneuvers of Table I.
const MANEUVERS: [&str; 8] = [
    "slew_2dof",
    "slew_4dof",
    "slew_canadarm2_table",
    "slew_canadarm2",
    "detumble_2dof",
    "detumble_4dof",
    "detumble_canadarm2_table",
    "detumble_canadarm2",
];

fn read(name: &str) -> Scenario {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    Scenario::read(&folder.join(format!("{name}.json"))).unwrap()
}

/// Numbers in (−1, 1), the same every time.
fn spread(len: usize, seed: usize) -> Vec<f64> {
    Halton::starting_after(3, (1 + seed * 7919) as u64)
        .flatten()
        .map(|x| 2.0 * x - 1.0)
        .take(len)
        .collect()
}

fn check(name: &str, steps: usize, with_stage_limits: bool) {
    check_scenario(name, &read(name), steps, with_stage_limits);
}

fn check_scenario(name: &str, scenario: &Scenario, steps: usize, with_stage_limits: bool) {
    let mut stage_limits = StageLimits::asked();
    if with_stage_limits {
        let joints = 0..scenario.system().joint_count();
        stage_limits.joints.extend(joints.map(|joint| (joint, 1 + joint % 3)));
        let clearances = 0..Clearances::new(scenario).len();
        stage_limits.clearances.extend(clearances.map(|place| (place, 2 + place % 2)));
        stage_limits.cones.extend((0..Cones::new(scenario).len()).map(|place| (place, 2 + place)));
    }
    let formulation = scenario.solver().formulation;
    let formulated = FormulatedManeuver::in_form(scenario, formulation, &stage_limits);
    let functions = StageFunctions::compile(&formulated.problem).unwrap();
    let grid = Grid::new(0.05 * steps as f64, steps).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &formulated.initial).unwrap();
    let layout = program.layout();
    let active = program.initial_state(&[]);
    for seed in 0..2 {
        // About the start: quaternions near unit length, joints near where they begin.
        let mut z = spread(layout.variables(), seed);
        for node in 1..=steps {
            for (value, start) in z[layout.state(node)].iter_mut().zip(&active) {
                *value = start + 0.3 * *value;
            }
        }
        let multipliers = spread(layout.constraints(), seed + 10);
        let direction = spread(layout.variables(), seed + 20);
        let errors =
            DerivativeErrors::along(&mut program, &z, &direction, &multipliers, 1e-5).unwrap();
        assert!(errors.gradient < 1e-8, "{name}, N = {steps}: {errors:?}");
        assert!(errors.jacobian < 1e-8, "{name}, N = {steps}: {errors:?}");
        assert!(errors.hessian < 1e-7, "{name}, N = {steps}: {errors:?}");
    }
}

#[test]
fn derivatives_of_every_maneuver_agree_with_finite_differences() {
    for name in MANEUVERS {
        for suffix in ["", "_full"] {
            for steps in [3, 600] {
                check(&format!("{name}{suffix}"), steps, false);
            }
            check(&format!("{name}{suffix}"), 5, true);
        }
    }
}

/// A fixed cone and a moving one, and a posture at the end.
#[test]
fn derivatives_of_cones_and_postures_agree_with_finite_differences() {
    for name in ["slew_4dof", "detumble_2dof_full"] {
        let scenario = varied(&read(name), |file| {
            let fixed = Pointing {
                name: "fixed".to_owned(),
                boresight_body: [1.0, 0.2, -0.3],
                direction_inertial: Some([-1.0, 0.5, 0.2]),
                direction_table: None,
                keep_out_deg: Some(30.0),
                keep_in_deg: None,
            };
            let table = DirectionTable {
                t_s: vec![-1.0, 0.1, 12.0, 60.0],
                vectors: vec![[0.0, 0.0, 1.0], [0.0, 0.5, 1.0], [0.5, 0.5, 0.7], [1.0, 0.0, 0.5]],
            };
            let moving = Pointing {
                name: "moving".to_owned(),
                direction_inertial: None,
                direction_table: Some(table),
                keep_out_deg: None,
                keep_in_deg: Some(170.0),
                ..fixed.clone()
            };
            file.pointing = vec![fixed, moving];
            let mut angles = vec![None; file.initial.joint_angles_deg.len()];
            angles[1] = Some(12.0);
            file.end = Some(End { hard: None, joint_angles_deg: Some(angles), ..End::default() });
        });
        check_scenario(name, &scenario, 5, false);
        check_scenario(name, &scenario, 5, true);
    }
}

/// Accelerations as states, with loads, a free duration, and limits within the steps.
#[test]
fn derivatives_of_jerk_limited_maneuvers_agree_with_finite_differences() {
    for name in ["slew_4dof", "detumble_2dof_full"] {
        let scenario = varied(&read(name), |file| {
            let duration_s = file.horizon.duration_s.longest_s();
            file.horizon.duration_s =
                Duration::Free(DurationRange { min: 0.5 * duration_s, max: duration_s });
            let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
            system.links[1].jerk_max_deg_s3 = Some(2.0);
            system.links[1].torque_max_n_m = Some(100.0);
        });
        check_scenario(name, &scenario, 5, false);
        check_scenario(name, &scenario, 5, true);
    }
}

/// A waypoint that is held and one that is passed, with accelerations as states.
#[test]
fn derivatives_of_waypoints_agree_with_finite_differences() {
    let waypoint = |angle_deg: f64, rest: bool| Waypoint {
        axis: Some([0.0, 0.6, 0.8]),
        angle_deg: Some(angle_deg),
        dwell_s: Some(10.0),
        rest: Some(rest),
        ..Waypoint::default()
    };
    for name in ["slew_4dof", "slew_2dof_full"] {
        let scenario = varied(&read(name), |file| {
            file.maneuver.waypoints = vec![waypoint(10.0, true), waypoint(-5.0, false)];
            let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
            system.links[1].jerk_max_deg_s3 = Some(2.0);
        });
        check_scenario(name, &scenario, 12, false);
    }
}

#[test]
fn position_and_velocity_are_left_to_the_end_of_a_full_form_that_does_not_weigh_them() {
    let formulated = FormulatedManeuver::new(&read("slew_4dof_full"));
    let functions = StageFunctions::compile(&formulated.problem).unwrap();
    let program =
        MultipleShooting::new(&functions, Grid::new(30.0, 2).unwrap(), &formulated.initial)
            .unwrap();
    assert_eq!(formulated.initial.len(), 13 + 2 * 4);
    assert_eq!(program.layout().dimensions().states, 13 + 2 * 4 - 6);
}

/// The two forms are the same motion: ẋ of the full form at a state of the reduced one.
#[test]
fn both_forms_turn_the_base_alike() {
    let reduced = FormulatedManeuver::new(&read("detumble_canadarm2")).coordinates;
    let full = FormulatedManeuver::new(&read("detumble_canadarm2_full")).coordinates;
    let u = spread(7, 3);
    let mut x = [vec![0.5, 0.5, -0.5, 0.5], spread(14, 4)].concat();
    let rates = reduced.rates(&x, &u);
    let state = reduced.free_floating_state(&x);
    let full_rates = full.rates(&state.to_vec(), &u);
    for i in 0..4 {
        assert!((rates[i] - full_rates[3 + i]).abs() < 1e-13);
    }
    // ω̇ and the base's velocity and acceleration along the reduced motion, by differences.
    let step = 1e-5;
    x.iter_mut().zip(&rates).for_each(|(x, rate)| *x += step * rate);
    let ahead = reduced.free_floating_state(&x).to_vec();
    x.iter_mut().zip(&rates).for_each(|(x, rate)| *x -= 2.0 * step * rate);
    let behind = reduced.free_floating_state(&x).to_vec();
    for i in 0..full_rates.len() {
        let difference = (ahead[i] - behind[i]) / (2.0 * step);
        assert!((difference - full_rates[i]).abs() < 1e-8, "{i}: {difference} {}", full_rates[i]);
    }
}
