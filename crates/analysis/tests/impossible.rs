//! Maneuvers that no motion makes are known, and none that some motion makes is among them.

use nalgebra::{UnitQuaternion, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use righting_analysis::Impossible;
use righting_analysis::detumble::{inertia_range_kg_m2, rate_bound_rad_s};
use righting_scenario::Scenario;
use righting_test_support::arms::arm;
use righting_test_support::{by_hand, shipped, varied};
use serde_json::{Value, json};

fn link(mass_kg: f64, a_m: f64, alpha_deg: f64) -> Value {
    by_hand::link(mass_kg, a_m, alpha_deg, None)
}

fn slew(mount_m: [f64; 3], links: &[Value], axis: [f64; 3], angle_deg: f64) -> Scenario {
    varied(&by_hand::on_a_cube(mount_m, links), |file| {
        file.maneuver.axis = Some(axis);
        file.maneuver.angle_deg = Some(angle_deg);
        file.horizon.duration_s = righting_scenario::file::Duration::Given(60.0);
    })
}

fn planar(axis: [f64; 3], angle_deg: f64) -> Option<Impossible> {
    let links = [link(10.0, 1.0, 0.0), link(10.0, 1.0, 0.0)];
    Impossible::of(&slew([0.5, 0.0, 0.0], &links, axis, angle_deg))
}

#[test]
fn parallel_joints_are_named_with_the_axis_and_the_angle_to_it() {
    let tilt = 62.0_f64.to_radians();
    let reason = planar([tilt.sin(), 0.0, tilt.cos()], 30.0).unwrap();
    assert_eq!(
        reason.to_string(),
        "this arm's joints are parallel: it turns the base about [0, 0, 1] only; the axis asked is \
         62.0\u{b0} from it"
    );
    assert_eq!(reason.possible_axes(), [Vector3::z()]);
    assert!(planar([1.0, 0.0, 0.0], -30.0).is_some());
    // Along it, either way, and wherever the target's tolerance is not left.
    assert_eq!(planar([0.0, 0.0, 1.0], 30.0), None);
    assert_eq!(planar([0.0, 0.0, -2.0], 30.0), None);
    assert_eq!(planar([1.0, 0.0, 0.0], 0.0), None);
    assert_eq!(planar([1.0, 0.0, 0.0], 0.1), None);
    assert_eq!(planar([1e-3, 0.0, 1.0], 30.0), None);
    assert!(planar([1e-2, 0.0, 1.0], 30.0).is_some());
}

/// A thousandth of a degree off the plane, the arm could turn the base about x in a year, not in a minute.
#[test]
fn an_arm_that_is_nearly_planar_is_told_in_the_time_there_is() {
    let links = [link(10.0, 1.0, 1e-3), link(10.0, 1.0, 0.0)];
    let scenario = slew([0.5, 0.0, 0.0], &links, [1.0, 0.0, 0.0], 30.0);
    let Some(Impossible::OneAxis { axis, off_deg, others_deg, are_joints_parallel }) =
        Impossible::of(&scenario)
    else {
        panic!("{:?}", Impossible::of(&scenario))
    };
    assert!(axis.z > 1.0 - 1e-6 && (off_deg - 90.0).abs() < 0.01 && !are_joints_parallel);
    assert!(0.0 < others_deg && others_deg < 1.0, "{others_deg}");
    let longer = varied(&scenario, |file| {
        file.horizon.duration_s = righting_scenario::file::Duration::Given(1e6)
    });
    assert_eq!(Impossible::of(&longer), None);
}

#[test]
fn an_arm_without_mass_turns_nothing() {
    let links = [link(0.0, 0.5, 90.0), link(0.0, 1.0, 0.0)];
    let asked =
        |angle_deg| Impossible::of(&slew([0.0, 0.0, 0.5], &links, [1.0, 1.0, 0.0], angle_deg));
    assert_eq!(asked(30.0), Some(Impossible::NothingTurns));
    assert_eq!(asked(0.0), None);
}

#[test]
fn one_joint_reaches_its_curve_and_nothing_else() {
    let of = |axis, angle_deg, range_deg: Option<f64>| {
        let mut only = link(20.0, 1.5, 0.0);
        only["angle_min_deg"] = json!(range_deg.map(|range| -range));
        only["angle_max_deg"] = json!(range_deg);
        Impossible::of(&slew([0.2, 0.0, 0.5], &[only], axis, angle_deg))
    };
    let Some(Impossible::OneJoint { name, nearest_deg, angle_deg, axes, largest_deg }) =
        of([1.0, 0.0, 0.0], 20.0, None)
    else {
        panic!("one joint turns the base, about no fixed axis")
    };
    assert_eq!(name, "joint 1");
    assert!(0.1 < nearest_deg && nearest_deg <= 20.0, "{nearest_deg}");
    assert!((angle_deg - 20.0).abs() < 1e-9 && largest_deg > 20.0);
    assert!(!axes.is_empty());
    // What it says is possible is.
    for axis in axes {
        assert_eq!(of(axis.into(), 20.0, None), None, "{axis}");
        assert!(of((-axis).into(), 20.0, Some(5.0)).is_some(), "{axis}");
    }
    let said = of([1.0, 0.0, 0.0], 20.0, Some(5.0)).unwrap().to_string();
    assert!(said.starts_with("only joint 1 of this arm turns the base, and not to the target; "));
    assert!(said.contains("it turns the base by ") && said.ends_with(" at most"), "{said}");
}

#[test]
fn a_duration_too_short_for_the_joints_rates_is_told() {
    let in_time = |duration_s| {
        let scenario = shipped("slew_4dof");
        Impossible::of(&varied(&scenario, |file| {
            file.horizon.duration_s = righting_scenario::file::Duration::Given(duration_s)
        }))
    };
    assert!(matches!(in_time(0.1), Some(Impossible::TooShort { .. })), "{:?}", in_time(0.1));
    let said = in_time(0.1).unwrap().to_string();
    assert!(said.starts_with("the duration is too short for this arm; in 0.1 s its joints turn"));
    assert!(said.ends_with("and the angle asked is 20.0\u{b0}"), "{said}");
    for possible_s in [8.8, 30.0] {
        assert_eq!(in_time(possible_s), None);
    }
}

#[test]
fn no_shipped_maneuver_is_called_impossible() {
    for name in ["2dof", "4dof", "canadarm2_table", "canadarm2"] {
        for maneuver in ["slew", "detumble"] {
            assert_eq!(Impossible::of(&shipped(&format!("{maneuver}_{name}"))), None, "{name}");
        }
    }
    assert_eq!(Impossible::of(&shipped("slew75_4dof")), None);
}

/// A detumble of a 2-joint planar arm about its own axis, from a posture of the second joint.
fn detumble(second_deg: f64, rates_deg_s: [f64; 2]) -> Scenario {
    let links = [link(10.0, 1.0, 0.0), link(10.0, 1.0, 0.0)];
    varied(&slew([0.5, 0.0, 0.0], &links, [0.0, 0.0, 1.0], 0.0), |file| {
        file.maneuver = serde_json::from_value(json!({ "type": "detumble" })).unwrap();
        file.weights = righting_scenario::file::Weights::default();
        file.initial.joint_angles_deg = vec![0.0, second_deg];
        file.initial.joint_rates_deg_s = Some(rates_deg_s.to_vec());
        file.initial.angular_rate_deg_s = Some([0.0, 0.0, 2.0]);
    })
}

#[test]
fn a_detumble_that_starts_with_the_largest_inertia_cannot_improve() {
    let straight = detumble(0.0, [0.0, 0.0]);
    let Some(Impossible::LargestInertia { inertia_kg_m2, stopped_deg_s }) =
        Impossible::of(&straight)
    else {
        panic!("the straight arm has the largest inertia: {:?}", Impossible::of(&straight))
    };
    assert!((stopped_deg_s - 2.0).abs() < 1e-9);
    let momentum = straight.initial().angular_momentum_n_m_s.norm();
    assert!((inertia_kg_m2 * 2.0_f64.to_radians() / momentum - 1.0).abs() < 1e-6);
    let [smallest, largest] = inertia_range_kg_m2(straight.system(), straight.collision());
    assert!((largest / inertia_kg_m2 - 1.0).abs() < 1e-6 && smallest < 0.9 * largest);
    let said = Impossible::of(&straight).unwrap().to_string();
    assert!(
        said.starts_with("the posture already has the largest inertia within reach; "),
        "{said}"
    );

    assert_eq!(Impossible::of(&detumble(60.0, [0.0, 0.0])), None);
}

/// Folded, the arm has less inertia than where it starts: the base cannot turn slower with it so.
#[test]
fn a_detumble_that_ends_in_a_posture_of_less_inertia_cannot_improve() {
    let ending = |end_deg: [Option<f64>; 2]| {
        varied(&detumble(60.0, [0.0, 0.0]), |file| {
            file.end.get_or_insert_default().joint_angles_deg = Some(end_deg.to_vec());
        })
    };
    assert_eq!(Impossible::of(&ending([Some(0.0), Some(30.0)])), None);
    assert_eq!(Impossible::of(&ending([Some(0.0), None])), None);
    let folded = ending([Some(0.0), Some(120.0)]);
    let Some(Impossible::EndPosture { least_deg_s, stopped_deg_s }) = Impossible::of(&folded)
    else {
        panic!("{:?}", Impossible::of(&folded))
    };
    let model = &folded.system().model;
    let [here, there] =
        [60.0_f64, 120.0].map(|second| model.locked_inertia(&[0.0, second.to_radians()])[(2, 2)]);
    assert!((stopped_deg_s - 2.0).abs() < 1e-9);
    assert!((least_deg_s - 2.0 * here / there).abs() < 1e-6, "{least_deg_s}");
    assert!((rate_bound_rad_s(&folded).to_degrees() - least_deg_s).abs() < 1e-9);
}

fn with_wheels(wheels: &[Value], angle_deg: f64) -> Option<Impossible> {
    let scenario = varied(&shipped("slew_4dof"), |file| {
        file.maneuver.axis = Some([1.0, 0.0, 0.0]);
        file.maneuver.angle_deg = Some(angle_deg);
        file.wheels = serde_json::from_value(json!(wheels)).unwrap();
    });
    Impossible::of(&scenario)
}

/// A wheel along z that spins and has failed: turned about x by α, H sin α is left across it and H (1 − cos α) along it.
#[test]
fn momentum_that_the_wheels_cannot_hold_turns_the_base() {
    let wheel = |axis: [f64; 3], momentum: f64, failed: bool| {
        json!({ "axis": axis, "momentum_max_n_m_s": 1.0, "torque_max_n_m": 0.1,
                "initial_momentum_n_m_s": momentum, "failed": failed })
    };
    let spinning = wheel([0.0, 0.0, 1.0], 0.9, true);
    let (y, z) = (wheel([0.0, 1.0, 0.0], 0.0, false), wheel([0.0, 0.0, 1.0], 0.0, false));
    let turn = 60.0_f64.to_radians();
    let (across, along) = (0.9 * turn.sin(), 0.9 * (1.0 - turn.cos()));
    for (others, left) in
        [(vec![], across.hypot(along)), (vec![y.clone()], along), (vec![z.clone()], across)]
    {
        let wheels = [std::slice::from_ref(&spinning), &others[..]].concat();
        let found = with_wheels(&wheels, 60.0);
        let Some(Impossible::Unheld { place, left_n_m_s, least_deg_s }) = found else {
            panic!("{others:?}: {found:?}")
        };
        assert_eq!(place, "the target");
        // Less what the attitude's tolerance lets pass.
        assert!(left_n_m_s <= left && left - left_n_m_s < 0.003 * 0.9, "{left_n_m_s} {left}");
        assert!(least_deg_s > 0.1 && least_deg_s < 5.0, "{least_deg_s}");
    }
    assert_eq!(with_wheels(&[spinning.clone(), y, z], 60.0), None);
    assert_eq!(with_wheels(&[spinning], 0.5), None);
}

/// What counts is the rate that stopping the arm leaves, not the rate that the base has first.
#[test]
fn joints_that_move_at_the_start_carry_momentum() {
    let still = detumble(60.0, [0.0, 0.0]);
    let moving = detumble(60.0, [15.0, 5.0]);
    let first_rad_s = 2.0_f64.to_radians();
    assert!((still.stopped_rate_rad_s() - first_rad_s).abs() < 1e-12);
    assert!(moving.stopped_rate_rad_s() > 2.0 * first_rad_s);
    assert!(rate_bound_rad_s(&moving) > first_rad_s, "no plan ends below the rate it begins with");
    assert_eq!(Impossible::of(&moving), None);
    assert!(matches!(
        Impossible::of(&detumble(0.0, [15.0, 5.0])),
        Some(Impossible::LargestInertia { .. })
    ));
}

#[test]
fn a_detumble_by_an_arm_without_mass_is_impossible_whatever_it_turns_about() {
    let links = [link(0.0, 0.5, 90.0), link(0.0, 1.0, 0.0)];
    let about = |rate_deg_s: [f64; 3]| {
        let scenario = slew([0.0, 0.0, 0.5], &links, [0.0, 0.0, 1.0], 0.0);
        let scenario = varied(&scenario, |file| {
            file.maneuver = serde_json::from_value(json!({ "type": "detumble" })).unwrap();
            file.weights = righting_scenario::file::Weights::default();
            file.initial.angular_rate_deg_s = Some(rate_deg_s);
            let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
                panic!("a resolved system is inline")
            };
            system.base.cube_side_m = None;
            system.base.inertia_kg_m2 =
                Some([[20.0, 0.0, 0.0], [0.0, 15.0, 0.0], [0.0, 0.0, 10.0]]);
        });
        Impossible::of(&scenario)
    };
    assert!(matches!(about([1.0, 0.0, 0.0]), Some(Impossible::LargestInertia { .. })));
    assert_eq!(about([0.0, 0.0, 1.0]), Some(Impossible::NothingSlows));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The attitude that joints reach in some motion of two strokes within their rates and the duration is a
    /// target that is not called impossible.
    #[test]
    fn what_some_motion_reaches_is_never_called_impossible(
        scenario in arm(1..=4),
        strokes in vec(vec(-1.0..1.0_f64, 4), 2),
        most_deg_s in 1.0..60.0_f64,
    ) {
        let scenario = varied(&scenario, |file| {
            let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
                panic!("a resolved system is inline")
            };
            system.links.iter_mut().for_each(|link| link.rate_max_deg_s = most_deg_s);
        });
        let duration_s = scenario.horizon().duration_s;
        let model = &scenario.system().model;
        let joints = scenario.system().joint_count();
        let steps = 2000;
        let step_s = duration_s / f64::from(steps);
        let mut angles = scenario.initial().joint_angles_rad.clone();
        let mut attitude = UnitQuaternion::identity();
        for k in 0..steps {
            let stroke = &strokes[usize::from(k >= steps / 2)];
            let rates: Vec<f64> =
                stroke[..joints].iter().map(|share| share * most_deg_s.to_radians()).collect();
            let half = |angles: &mut [f64]| {
                angles.iter_mut().zip(&rates).for_each(|(q, rate)| *q += 0.5 * step_s * rate);
            };
            half(&mut angles);
            let rate = model.reduced_angular_rate(&angles, &rates, &Vector3::zeros());
            half(&mut angles);
            attitude *= UnitQuaternion::new(rate * step_s);
        }
        let Some((axis, angle_rad)) = attitude.axis_angle() else { return Ok(()) };
        let reached = varied(&scenario, |file| {
            file.maneuver.axis = Some(axis.into_inner().into());
            file.maneuver.angle_deg = Some(angle_rad.to_degrees());
        });
        prop_assert_eq!(Impossible::of(&reached), None);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Where a detumble is called impossible, no posture drawn has more inertia.
    #[test]
    fn no_posture_beats_one_that_is_said_to_have_the_largest_inertia(
        scenario in arm(1..=4),
        rate_deg_s in prop::array::uniform3(-5.0..5.0_f64),
        postures in vec(vec(0.0..1.0_f64, 4), 300),
    ) {
        let detumble = varied(&scenario, |file| {
            file.maneuver = serde_json::from_value(json!({ "type": "detumble" })).unwrap();
            file.weights = righting_scenario::file::Weights::default();
            file.initial.angular_rate_deg_s = Some(rate_deg_s);
        });
        if let Some(Impossible::LargestInertia { inertia_kg_m2, .. }) = Impossible::of(&detumble) {
            let system = detumble.system();
            for unit in postures {
                let posture = system.joint_angles_at(&unit[..system.joint_count()]);
                let kinematics = system.model.kinematics(&posture);
                let mut clearances = detumble.collision().clearances(&kinematics);
                let is_clear = clearances.all(|kept| kept.distance_m >= kept.least_m);
                let inertia = system.model.locked_inertia(&posture).symmetric_eigenvalues().max();
                prop_assert!(!is_clear || inertia <= inertia_kg_m2 * (1.0 + 2e-6));
            }
        }
    }
}
