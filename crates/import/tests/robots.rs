//! Random robots: the system is the robot of the file, in whichever way it is put together.

mod support;

use std::collections::BTreeMap;

use nalgebra::{Matrix4, Vector3};
use proptest::prelude::*;
use righting_import::{Options, ReadOptions, Robot, Shape, System};
use righting_multibody::Placement;
use support::{Kind, RandomRobot, homogeneous, random_robot};

/// Zeroth, first and second moments of a mass distribution, in one matrix: ∫ (x, 1)(x, 1)ᵀ dm.
type Moments = Matrix4<f64>;

/// Of every body of `system`, the base first, its frame in the base's.
fn frames(system: &System, coordinates: &BTreeMap<String, f64>) -> Vec<Matrix4<f64>> {
    let mut frames = vec![Matrix4::identity()];
    for body in &system.bodies {
        let parent = frames[body.parent.map_or(0, |index| index + 1)];
        let joint = &body.joint;
        let kind = if joint.is_sliding { Kind::Sliding } else { Kind::Turning };
        let motion = support::motion(kind, &joint.axis, coordinates[&joint.name]);
        frames.push(parent * of(&joint.placement) * motion);
    }
    frames
}

fn of(placement: &Placement) -> Matrix4<f64> {
    homogeneous(&placement.rotation, &placement.position_m)
}

fn moments_of_system(system: &System, frames: &[Matrix4<f64>]) -> Moments {
    let bodies = std::iter::once(&system.base).chain(system.bodies.iter().map(|body| &body.body));
    let moments = bodies.zip(frames).map(|(body, frame)| {
        let own = support::moments(body.mass_kg, &body.center_of_mass_m, &body.inertia_kg_m2);
        frame * own * frame.transpose()
    });
    moments.sum()
}

fn sphere_centers(system: &System, frames: &[Matrix4<f64>]) -> Vec<Vector3<f64>> {
    let shapes =
        std::iter::once(&system.base_shapes).chain(system.bodies.iter().map(|b| &b.shapes));
    let mut centers = Vec::new();
    for (shapes, frame) in shapes.zip(frames) {
        for shape in shapes {
            let Shape::Capsule(sphere) = shape else { panic!("a sphere") };
            centers.push((frame * sphere.ends_m[0].push(1.0)).xyz());
        }
    }
    centers.sort_by(|a, b| a.as_slice().partial_cmp(b.as_slice()).unwrap());
    centers
}

/// Compares robot and system as seen from the base, at coordinates of the joints that move.
fn assert_same(robot: &RandomRobot, system: &System, base: usize, pose: &Placement, seed: f64) {
    let mut coordinates = robot.coordinates(seed);
    let moving: Vec<&str> = system.bodies.iter().map(|body| body.joint.name.as_str()).collect();
    for (name, at) in &mut coordinates {
        if !moving.contains(&name.as_str()) {
            *at = robot.held.get(name).copied().unwrap_or(0.0);
        }
    }
    let links = robot.link_frames(&coordinates);
    let from_base = of(pose) * links[base].try_inverse().unwrap();
    let expected: Moments = robot
        .links
        .iter()
        .zip(&links)
        .map(|(link, frame)| {
            let frame = from_base * frame;
            let own = support::moments(link.mass_kg, &link.center_m, &link.inertia_kg_m2);
            frame * own * frame.transpose()
        })
        .sum();
    let frames = frames(system, &coordinates);
    let found = moments_of_system(system, &frames);
    assert!(
        (found - expected).amax() <= 1e-12 * expected.amax(),
        "{found} {expected} {}",
        robot.urdf()
    );
    let mut centers: Vec<Vector3<f64>> = robot
        .links
        .iter()
        .zip(&links)
        .map(|(link, frame)| (from_base * frame * link.sphere_m.push(1.0)).xyz())
        .collect();
    centers.sort_by(|a, b| a.as_slice().partial_cmp(b.as_slice()).unwrap());
    for (found, expected) in sphere_centers(system, &frames).iter().zip(&centers) {
        assert!((found - expected).amax() < 1e-11, "{found} {expected}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_link_can_be_the_base(robot in random_robot(), base in any::<prop::sample::Index>(), seed in -1.0..1.0) {
        let base = base.index(robot.links.len());
        let read = Robot::from_urdf(&robot.urdf(), &ReadOptions::default()).unwrap();
        let mut options = Options::floating(robot.links[base].name.as_str());
        options.locked = robot.held.clone();
        let system = read.system(&options).unwrap();
        let movable = robot.joints.iter().filter(|joint| joint.kind != Kind::Fixed).count();
        prop_assert_eq!(system.bodies.len(), movable - robot.held.len());
        for seed in [seed, 0.3 - seed] {
            assert_same(&robot, &system, base, &Placement::identity(), seed);
        }
    }

    #[test]
    fn a_robot_on_another_body_is_the_same_robot(robot in random_robot(), seed in -1.0..1.0) {
        let mount = Placement::from_roll_pitch_yaw(Vector3::new(0.3, -0.2, 0.5), [0.4, 1.2, -2.0]);
        let read = Robot::from_urdf(&robot.urdf(), &ReadOptions::default()).unwrap();
        let system = read.system(&Options::mounted(mount)).unwrap();
        let robot = RandomRobot { held: BTreeMap::new(), ..robot };
        assert_same(&robot, &system, 0, &mount, seed);
    }

    /// Whatever is not between base and tip is held, and nothing is lost.
    #[test]
    fn a_tip_leaves_one_arm(
        robot in random_robot(),
        base in any::<prop::sample::Index>(),
        tip in any::<prop::sample::Index>(),
        seed in -1.0..1.0,
    ) {
        let [base, tip] = [base, tip].map(|index| index.index(robot.links.len()));
        let read = Robot::from_urdf(&robot.urdf(), &ReadOptions::default()).unwrap();
        let mut options = Options::floating(robot.links[base].name.as_str());
        options.tip = Some(robot.links[tip].name.clone());
        let system = read.system(&options).unwrap();
        for (index, body) in system.bodies.iter().enumerate() {
            prop_assert_eq!(body.parent, index.checked_sub(1));
        }
        let robot = RandomRobot { held: BTreeMap::new(), ..robot };
        assert_same(&robot, &system, base, &Placement::identity(), seed);
    }

    #[test]
    fn what_is_left_out_takes_its_mass_along(
        robot in random_robot(),
        dropped in any::<prop::sample::Index>(),
    ) {
        let dropped = dropped.index(robot.links.len());
        let read = Robot::from_urdf(&robot.urdf(), &ReadOptions::default()).unwrap();
        let mut options = Options::floating("l0");
        options.dropped = vec![robot.links[dropped].name.clone()];
        let system = read.system(&options);
        if dropped == 0 {
            prop_assert!(system.is_err());
            return Ok(());
        }
        let system = system.unwrap();
        let kept: f64 = (0..robot.links.len())
            .filter(|&link| !robot.hangs_on(link, dropped))
            .map(|link| robot.links[link].mass_kg)
            .sum();
        let found: f64 =
            system.base.mass_kg + system.bodies.iter().map(|body| body.body.mass_kg).sum::<f64>();
        prop_assert!((found - kept).abs() < 1e-12);
        let lost = robot.links.iter().map(|link| link.mass_kg).sum::<f64>() - kept;
        let note = system.notes.iter().find(|note| note.contains("left out")).unwrap();
        prop_assert!(note.contains(&format!("\"{}\"", robot.links[dropped].name)), "{}", note);
        let said: f64 = note.rsplit(", ").next().unwrap().trim_end_matches(" kg").parse().unwrap();
        prop_assert!((said - lost).abs() < 1e-9);
    }
}
