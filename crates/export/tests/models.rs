//! Exported models read back by other means: the same masses, momenta and energies at any state.

mod tree;

use std::path::Path;

use nalgebra::Vector3;
use proptest::prelude::*;
use righting_export::{mjcf, urdf};
use righting_multibody::{Quaternion, State};
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_scenario::file::{Duration, JointKind, Payload, SystemReference, of_kind};
use righting_test_support::arms::arm;
use righting_test_support::trees;
use righting_test_support::{motion, shipped, varied};
use tree::Tree;

const RELATIVE: f64 = 1e-12;

/// A plan that only starts to move.
fn moved(scenario: &Scenario) -> Trajectory {
    let scenario = varied(scenario, |file| {
        file.horizon.duration_s = Duration::Given(0.2);
        file.horizon.steps = 2.0;
    });
    let joints = scenario.system().joint_count();
    motion(&scenario, &vec![vec![1e-3; joints]; 2])
}

/// Both formats against the model, at some joint angles and rates; locked joints at their angle.
fn check(scenario: &Scenario, seed: f64) {
    let system = scenario.system();
    let (mut q, mut qdot) = (Vec::new(), Vec::new());
    for (index, limits) in system.joint_limits.iter().enumerate() {
        let phase = seed + 1.7 * index as f64;
        q.push(if limits.is_locked() { limits.angle_min_rad } else { 2.0 * phase.sin() });
        qdot.push(if limits.is_locked() { 0.0 } else { (1.3 * phase).cos() });
    }
    let state = State {
        position: Vector3::zeros(),
        attitude: Quaternion::identity(),
        velocity: Vector3::new(0.3, -0.2, 0.1),
        angular_rate: Vector3::new(-0.2, 0.5, 0.7),
        joint_angles: q.clone(),
        joint_rates: qdot.clone(),
    };
    let model = &system.model;
    // Joints that slide go farther than the size that a system is measured by.
    let kinds = model.joint_kinds();
    let travels = of_kind(&kinds, JointKind::Prismatic, &q);
    let size_m = model.size_m() + travels.iter().map(|travel| travel.abs()).sum::<f64>();
    let momentum = model.angular_momentum(&state.angular_rate, &q, &qdot);
    let energy_j = model.kinetic_energy(&state);
    for (format, tree) in [
        ("URDF", Tree::of_urdf(&urdf(system))),
        ("MJCF", Tree::of_mjcf(&mjcf(system, &moved(scenario)))),
    ] {
        let name = format!("{format} of {}", scenario.name());
        let found = tree.at(&q, &qdot, &state.velocity, &state.angular_rate);
        let close = |what: &str, found: f64, expected: f64, scale: f64| {
            let error = (found - expected).abs();
            assert!(error <= RELATIVE * scale, "{name}: {what}: {found}, expected {expected}");
        };
        close("mass", found.mass_kg, model.total_mass(), model.total_mass());
        let center = (found.center_m - model.center_of_mass(&q)).norm();
        close("center of mass", center, 0.0, size_m);
        let rate = 1.0 + qdot.iter().map(|rate| rate.abs()).sum::<f64>();
        let inertia = model.locked_inertia(&q).amax();
        close("momentum", (found.momentum - momentum).norm(), 0.0, rate * inertia);
        close("energy", found.energy_j, energy_j, energy_j);
    }
}

#[test]
fn shipped_systems_and_public_arms_are_what_their_models_say() {
    for name in ["slew_2dof", "slew_4dof", "slew_canadarm2", "detumble_canadarm2_table"] {
        check(&shipped(name), 0.3);
    }
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/cases");
    let mut seen = 0;
    for entry in std::fs::read_dir(cases).expect("a folder") {
        let file = entry.expect("a file").path();
        // Some of the cases are there to be refused.
        if let Ok(scenario) = Scenario::read(&file) {
            check(&scenario, 1.1);
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn any_arm_is_what_its_model_says(
        scenario in prop_oneof![arm(1..=8).boxed(), trees::tree(1..=8).boxed()],
        seed in -3.0..3.0,
    ) {
        check(&scenario, seed);
    }
}

#[test]
fn a_payload_a_turned_mount_and_a_locked_joint_are_in_the_models() {
    let scenario = varied(&shipped("slew_4dof"), |file| {
        let SystemReference::Inline(system) = &mut file.system else {
            panic!("a resolved scenario")
        };
        system.mount.as_mut().unwrap().rotation = Some([0.6, 0.0, 0.0, 0.8]);
        system.links[2].angle_min_deg = Some(25.0);
        system.links[2].angle_max_deg = Some(25.0);
        system.payload = Some(Payload {
            mass_kg: 12.0,
            inertia_kg_m2: Some([[1.0, 0.1, 0.0], [0.1, 1.5, 0.2], [0.0, 0.2, 2.0]]),
            radius_m: None,
            shapes: None,
        });
        file.initial.joint_angles_deg[2] = 25.0;
    });
    check(&scenario, 0.9);
    let text = urdf(scenario.system());
    let document = roxmltree::Document::parse(&text).expect("well formed");
    let kinds: Vec<Option<&str>> = document
        .descendants()
        .filter(|node| node.has_tag_name("joint"))
        .map(|joint| joint.attribute("type"))
        .collect();
    let expected = ["continuous", "revolute", "fixed", "revolute", "fixed"].map(Some);
    assert_eq!(kinds, expected);
}

#[test]
fn limits_are_in_the_models() {
    let scenario = varied(&shipped("slew_2dof"), |file| {
        let SystemReference::Inline(system) = &mut file.system else {
            panic!("a resolved scenario")
        };
        system.links[1].torque_max_n_m = Some(42.0);
    });
    let rate = 17.2_f64.to_radians();
    let text = urdf(scenario.system());
    let document = roxmltree::Document::parse(&text).expect("well formed");
    let limits: Vec<_> = document.descendants().filter(|node| node.has_tag_name("limit")).collect();
    let number = |node: &roxmltree::Node<'_, '_>, name: &str| -> Option<f64> {
        node.attribute(name).map(|text| text.parse().expect("a number"))
    };
    assert_eq!(limits.len(), 2);
    let limits_of_joints = &scenario.system().joint_limits;
    for (limit, (expected, effort)) in limits.iter().zip(limits_of_joints.iter().zip([1e9, 42.0])) {
        assert_eq!(number(limit, "velocity"), Some(rate));
        assert_eq!(number(limit, "effort"), Some(effort));
        let finite = |angle: f64| angle.is_finite().then_some(angle);
        assert_eq!(number(limit, "lower"), finite(expected.angle_min_rad));
        assert_eq!(number(limit, "upper"), finite(expected.angle_max_rad));
    }
    let text = mjcf(scenario.system(), &moved(&scenario));
    let document = roxmltree::Document::parse(&text).expect("well formed");
    let numeric =
        document.descendants().find(|node| node.attribute("name") == Some("rate_max_rad_s"));
    let data = numeric.and_then(|node| node.attribute("data"));
    assert_eq!(data, Some(format!("{rate:?} {rate:?}").as_str()));
    let motors: Vec<Option<&str>> = document
        .descendants()
        .filter(|node| node.has_tag_name("motor"))
        .map(|motor| motor.attribute("ctrlrange"))
        .collect();
    assert_eq!(motors, [None, Some("-42.0 42.0")]);
}
