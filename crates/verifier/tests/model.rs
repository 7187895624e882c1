//! The verifier's own model against the planner's, which shares nothing with it, and against
//! Pinocchio, another group's library.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::{Quaternion, Vector3};
use proptest::prelude::*;
use righting_multibody as multibody;
use righting_scenario::{Scenario, file};
use righting_test_support::arms::{self, arm};
use righting_test_support::bodies::bodies;
use righting_test_support::trees::tree;
use righting_test_support::{motion, scenarios};
use righting_verifier::model::{
    BaseAcceleration, Cuboid, Model, Motion, Outside, Pose, Segment, State,
};
use righting_verifier::verify;
use serde::Deserialize;

/// Agreement of two vectors relative to the larger one and to `scale`.
#[track_caller]
fn assert_near(what: &str, ours: &[f64], theirs: &[f64], tolerance: f64, scale: f64) {
    assert_eq!(ours.len(), theirs.len(), "{what}");
    let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let gap: Vec<f64> = ours.iter().zip(theirs).map(|(ours, theirs)| ours - theirs).collect();
    let size = scale.max(norm(ours)).max(norm(theirs));
    assert!(
        norm(&gap) <= tolerance * size,
        "{what}: {ours:?} against {theirs:?}, {:.1e} of {size:.1e}",
        norm(&gap) / size
    );
}

/// Joint angles, rates and accelerations, and the base's motion.
#[derive(Clone, Debug)]
struct Sample {
    position: [f64; 3],
    attitude: [f64; 4],
    velocity: [f64; 3],
    angular_rate: [f64; 3],
    joints: [Vec<f64>; 3],
}

fn sample(joints: usize) -> impl Strategy<Value = Sample> {
    let vector = || prop::array::uniform3(-2.0..2.0_f64);
    let values = |size: f64| prop::collection::vec(-size..size, joints);
    let joints = (values(3.2), values(2.0), values(2.0));
    (vector(), arms::rotation(), vector(), vector(), joints).prop_map(
        |(position, attitude, velocity, angular_rate, (q, qdot, u))| Sample {
            position,
            attitude,
            velocity,
            angular_rate,
            joints: [q, qdot, u],
        },
    )
}

impl Sample {
    fn state(&self) -> State<'_> {
        let [w, x, y, z] = self.attitude;
        State {
            position: self.position.into(),
            attitude: Quaternion::new(w, x, y, z),
            velocity: self.velocity.into(),
            angular_rate: self.angular_rate.into(),
            joint_angles: &self.joints[0],
            joint_rates: &self.joints[1],
        }
    }
}

fn moving_arm() -> impl Strategy<Value = (Scenario, Sample)> {
    prop_oneof![arm(1..=8).boxed(), tree(1..=8).boxed()].prop_flat_map(|scenario| {
        let joints = scenario.system().joint_count();
        (Just(scenario), sample(joints))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn momenta_motion_and_torques_are_the_planner_s((scenario, sample) in moving_arm()) {
        let theirs = &scenario.system().model;
        let ours = Model::new(scenario.resolved_system());
        let mut room = Motion::new(&ours);
        let state = sample.state();
        let x = state.to_vec();
        let their_state = multibody::State::from_slice(&x).unwrap();
        let [q, qdot, u] = &sample.joints;
        let omega = Vector3::from(sample.angular_rate);
        prop_assert!((ours.total_mass() / theirs.total_mass() - 1.0).abs() < 1e-14);

        room.set(&ours, &state, &BaseAcceleration::default(), u);
        let (c, p, h) = (room.center_of_mass(), room.linear_momentum(), room.angular_momentum());
        let near = |what: &str, ours: Vector3<f64>, theirs: Vector3<f64>, scale: f64| {
            assert_near(what, ours.as_slice(), theirs.as_slice(), 1e-12, scale);
        };
        near("center of mass", c, theirs.inertial_center_of_mass(&their_state), 1.0);
        near("P", p, theirs.linear_momentum(&their_state), ours.total_mass());
        near("H", h, theirs.inertial_angular_momentum(&their_state), 1.0);

        let mut rate = vec![0.0; x.len()];
        ours.state_derivative(&x, u, &Outside::default(), &mut room, &mut rate);
        assert_near("the state's derivative", &rate, &theirs.state_derivative(&x, u, None), 1e-12, 1.0);

        let mut torques = vec![0.0; q.len()];
        let mount = ours.joint_torques(&state, u, &Outside::default(), &mut room, &mut torques);
        let base = theirs.base_acceleration(&omega, q, qdot, u, None);
        let theirs = theirs.inverse_dynamics(&base, &omega, q, qdot, u, None);
        assert_near("torques", &torques, &theirs.joint_torques, 1e-12, 10.0);
        let rotation = room.base().rotation;
        near("force at the mount", mount.force, rotation * theirs.mount.force, 10.0);
        near("moment at the mount", mount.moment, rotation * theirs.mount.moment, 10.0);
        // No load from outside.
        let force: Vector3<f64> = room.bodies().iter().map(|body| body.force).sum();
        let moment: Vector3<f64> =
            room.bodies().iter().map(|body| body.center.cross(&body.force) + body.moment).sum();
        let largest = room.bodies().iter().map(|body| body.force.norm()).fold(1.0, f64::max);
        prop_assert!(force.norm() < 1e-12 * largest && moment.norm() < 1e-11 * largest);
    }

    #[test]
    fn links_are_where_the_planner_s_are((scenario, sample) in moving_arm()) {
        let system = scenario.system();
        let q = &sample.joints[0];
        let posture = system.model.kinematics(q);
        let model = Model::new(scenario.resolved_system());
        let mut frames = vec![Pose::identity(); model.frame_count()];
        model.frames(q, &mut frames);
        prop_assert_eq!(frames.len(), posture.frames.len());
        for (Pose { rotation, origin }, frame) in frames.iter().zip(&posture.frames) {
            assert_near("origin", origin.as_slice(), frame.origin.as_slice(), 1e-13, 1.0);
            let axes = frame.rotation();
            assert_near("axes", rotation.as_slice(), axes.as_slice(), 1e-13, 1.0);
        }
    }

    /// By the planner's equations a random arm moves from a random start, and the verifier agrees
    /// with all but the limits.
    #[test]
    fn a_motion_by_the_planner_s_model_passes(
        (scenario, sample) in moving_arm(),
        clearance_m in 0.0..0.2_f64,
        bodies in prop::option::of(bodies()),
    ) {
        let mut resolved = scenario.resolved().clone();
        let kinds = scenario.system().model.joint_kinds();
        let [angles_deg, rates_deg_s] = [0, 1].map(|k| {
            let angles = file::of_kind(&kinds, file::JointKind::Revolute, &sample.joints[k]);
            angles.into_iter().map(f64::to_degrees).collect::<Vec<_>>()
        });
        let [travels_m, speeds_m_s] =
            [0, 1].map(|k| file::of_kind(&kinds, file::JointKind::Prismatic, &sample.joints[k]));
        resolved.initial = file::Initial {
            joint_angles_deg: angles_deg,
            joint_rates_deg_s: Some(rates_deg_s),
            joint_travels_m: travels_m,
            joint_speeds_m_s: Some(speeds_m_s),
            angular_rate_deg_s: Some(sample.angular_rate.map(f64::to_degrees)),
            attitude: Some(sample.attitude),
        };
        resolved.maneuver = file::Maneuver {
            kind: file::ManeuverType::Detumble,
            axis: None,
            angle_deg: None,
            target_attitude: None,
            waypoints: Vec::new(),
        };
        resolved.horizon = file::Horizon { duration_s: file::Duration::Given(0.2), steps: 4.0 };
        resolved.collision.clearance_m = Some(clearance_m);
        if let Some(bodies) = bodies {
            bodies.give(&mut resolved);
        }
        // A start inside the clearance is refused when the scenario is read.
        let Ok(scenario) = Scenario::from_file(resolved, Path::new("arm.json")) else {
            return Ok(());
        };
        let trajectory = motion(&scenario, &vec![sample.joints[2].clone(); 4]);
        let verification = verify(&scenario, &trajectory);
        for check in &verification.checks {
            let is_limit = check.name.contains("clearance") || check.name.ends_with("at the end");
            prop_assert!(check.passed || is_limit, "{check}");
        }
        // The verdicts on clearances are the planner's.
        let closest = trajectory
            .nodes()
            .iter()
            .flat_map(|node| {
                let posture = scenario.system().model.kinematics(&node.joint_angles_rad);
                let pairs = scenario.collision().pairs.iter();
                pairs.map(move |pair| (pair.clearance(&posture), pair.covered_m()))
            })
            // Inside a box, theirs says how deep.
            .map(|(found, covered_m)| found.distance_m.max(-covered_m) - found.least_m)
            .fold(f64::INFINITY, f64::min);
        let ours = ["clearance from body at nodes", "clearance between links at nodes"]
            .iter()
            .filter_map(|name| verification.check(name))
            .map(|check| check.value - check.limit)
            .fold(f64::INFINITY, f64::min);
        prop_assert!(ours == closest || (ours - closest).abs() < 1e-9, "{ours} {closest}");
    }

    #[test]
    fn distances_from_boxes_are_the_planner_s(
        [low, size, start, end] in prop::array::uniform4(prop::array::uniform3(0.0..1.0_f64)),
        lattice in prop::option::of(1_u8..4),
    ) {
        // On a lattice segments are often parallel to edges, in a face, or of no length.
        let point = |entries: [f64; 3]| match lattice {
            Some(count) => Vector3::from(entries.map(|entry| (entry * f64::from(count)).round())),
            None => Vector3::from(entries),
        };
        let [low, size, start, end] = [low, size, start, end].map(point);
        let ours = Cuboid { low, high: low + size };
        let theirs = multibody::Cuboid { center_m: low + size / 2.0, half_m: size / 2.0 };
        let way = ours.shortest_to_segment(&Segment { start, end });
        let segment = multibody::Segment::new(start, end);
        prop_assert!((way.norm() - theirs.signed_distance(&segment).max(0.0)).abs() < 1e-8);
        prop_assert!((way.norm() - theirs.shortest_to_segment(&segment).norm()).abs() < 1e-8);
        let direction = Vector3::new(1.0, -2.0, 0.5).normalize();
        let (ours, theirs) = (ours.extent(&direction), theirs.extent_m(&direction));
        prop_assert!((ours[0] - theirs[0]).abs() < 1e-14 && (ours[1] - theirs[1]).abs() < 1e-14);
    }

    #[test]
    fn distances_are_the_planner_s(
        ends in prop::array::uniform4(prop::array::uniform3(-2_i8..=2)),
        shifts in prop::array::uniform4(prop::array::uniform3(-0.1..0.1_f64)),
        shifted in any::<bool>(),
    ) {
        // On a lattice segments are often parallel, collinear, crossing or of no length.
        let point = |i: usize| {
            Vector3::from_fn(|k, _| f64::from(ends[i][k]) + f64::from(u8::from(shifted)) * shifts[i][k])
        };
        let [a, b, c, d] = [0, 1, 2, 3].map(point);
        let (ours, other) = (Segment { start: a, end: b }, Segment { start: c, end: d });
        let theirs = multibody::Segment::new(a, b);
        let distance = theirs.distance_to_segment(&multibody::Segment::new(c, d));
        // Theirs loses half the digits where lines are nearly parallel.
        prop_assert!((ours.distance_to_segment(&other) - distance).abs() < 1e-5);
        prop_assert!((other.distance_to_segment(&ours) - distance).abs() < 1e-5);
        prop_assert!((ours.distance_to_point(&c) - theirs.distance_to_point(&c)).abs() < 1e-14);
        // No two points of the segments are closer, and some are as close.
        let places = || (0..=40).map(|i| f64::from(i) / 40.0);
        let nearest = places()
            .map(|s| other.distance_to_point(&(a + (b - a) * s)))
            .fold(f64::INFINITY, f64::min);
        let found = ours.distance_to_segment(&other);
        prop_assert!(found <= nearest + 1e-12 && nearest - found <= (b - a).norm() / 80.0 + 1e-12);
    }
}

#[derive(Deserialize)]
struct Reference {
    systems: BTreeMap<String, Vec<PinocchioSample>>,
}

#[derive(Deserialize)]
struct PinocchioSample {
    x: Vec<f64>,
    u: Vec<f64>,
    xdot: Vec<f64>,
    angular_momentum_inertial: [f64; 3],
    linear_momentum_inertial: [f64; 3],
    center_of_mass_inertial: [f64; 3],
    joint_torque: Vec<f64>,
}

#[test]
fn agrees_with_pinocchio() {
    let text = include_str!("../../multibody/tests/data/dynamics.json");
    let reference: Reference = serde_json::from_str(text).unwrap();
    assert!(reference.systems.len() >= 2);
    for (name, samples) in &reference.systems {
        let file = scenarios().join(format!("systems/{name}.json"));
        let system: file::System =
            serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
        let model = Model::new(&system);
        let mut room = Motion::new(&model);
        assert!(samples.len() >= 12);
        for sample in samples {
            let state = State::from_slice(&sample.x);
            let mut rate = vec![0.0; sample.x.len()];
            model.state_derivative(&sample.x, &sample.u, &Outside::default(), &mut room, &mut rate);
            assert_near("x'", &rate, &sample.xdot, 1e-11, 0.0);
            let mut torques = vec![0.0; sample.u.len()];
            model.joint_torques(&state, &sample.u, &Outside::default(), &mut room, &mut torques);
            assert_near("torque", &torques, &sample.joint_torque, 1e-10, 0.0);
            let pairs = [
                ("H", room.angular_momentum(), sample.angular_momentum_inertial),
                ("P", room.linear_momentum(), sample.linear_momentum_inertial),
                ("center of mass", room.center_of_mass(), sample.center_of_mass_inertial),
            ];
            for (what, ours, theirs) in pairs {
                assert_near(what, ours.as_slice(), &theirs, 1e-10, 0.0);
            }
        }
    }
}
