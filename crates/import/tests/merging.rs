//! What is held, cut and assumed, and what is said of it.

use righting_import::{Options, ReadOptions, Robot, Shape, System};

fn gripper(options: &Options) -> System {
    let robot =
        Robot::from_urdf(include_str!("data/gripper.urdf"), &ReadOptions::default()).unwrap();
    robot.system(options).unwrap()
}

fn without_fingers() -> Options {
    let mut options = Options::floating("bus");
    options.dropped = vec!["finger_l".to_owned(), "finger_r".to_owned()];
    options
}

fn says(system: &System, part: &str) -> bool {
    system.notes.iter().any(|note| note.contains(part))
}

#[test]
fn a_joint_that_mimics_is_held_where_the_other_one_is() {
    let mut options = Options::floating("bus");
    options.locked = [("left".to_owned(), 0.03)].into();
    let system = gripper(&options);
    assert_eq!(system.bodies.len(), 1);
    // Both fingers are 60 mm off the middle, on either side.
    let arm = &system.bodies[0];
    assert_eq!(arm.body.mass_kg, 6.4);
    assert!(arm.body.center_of_mass_m.y.abs() < 1e-15);
    let steiner = 2.0 * 0.2 * 0.06_f64.powi(2);
    assert!((arm.body.inertia_kg_m2[(2, 2)] - (0.02 + 2.0 * 0.0002 + steiner)).abs() < 1e-15);
    assert!(says(
        &system,
        "joint \"left\": held at 0.03 m, as asked; 0.2 kg beyond it move with \"arm\""
    ));
    assert!(says(
        &system,
        "joint \"right\": held at 0.03 m, since it mimics another joint, whose motion it would follow"
    ));
    assert!(says(&system, "without <inertial>, taken without mass: \"sensor\""));
    assert!(says(
        &system,
        "meshes that are not read, so that nothing stands for them: \"package://gripper"
    ));
}

#[test]
fn off_the_way_to_the_tip_all_is_held() {
    let mut options = Options::floating("bus");
    options.tip = Some("finger_l".to_owned());
    let system = gripper(&options);
    let names: Vec<&str> = system.bodies.iter().map(|body| body.joint.name.as_str()).collect();
    assert_eq!(names, ["shoulder", "left"]);
    options.tip = Some("sensor".to_owned());
    let system = gripper(&options);
    assert_eq!(system.bodies.len(), 1);
    assert!(says(
        &system,
        "joint \"left\": held at 0 m, since it is not on the way from base to tip"
    ));
}

#[test]
fn shapes_go_with_their_bodies() {
    let mut options = Options::floating("bus");
    options.tip = Some("sensor".to_owned());
    let system = gripper(&options);
    let Shape::Cuboid(bus) = &system.base_shapes[0] else { panic!("a box") };
    // A quarter turn about z, from file to file.
    let aligned = bus.aligned().unwrap();
    assert!((aligned.size_m - nalgebra::Vector3::new(0.8, 1.0, 0.6)).amax() < 1e-15);
    let radii: Vec<f64> =
        system.bodies[0].shapes.iter().map(|shape| shape.bounding_capsule().radius_m).collect();
    assert_eq!(radii, [0.05, 0.02, 0.02]);
}

#[test]
fn a_world_above_the_base_is_left_out() {
    let text = include_str!("data/gripper.urdf").replace(
        "</robot>",
        "<link name=\"world\"/><joint name=\"float\" type=\"floating\"><parent link=\"world\"/>\
         <child link=\"bus\"/></joint></robot>",
    );
    let robot = Robot::from_urdf(&text, &ReadOptions::default()).unwrap();
    let system = robot.system(&Options::floating("bus")).unwrap();
    assert_eq!(system.bodies.len(), 2);
    assert!(says(&system, "the link \"world\" is left out with all that hangs on it, 0 kg"));
}

#[test]
fn masses_without_inertia_are_points_on_request() {
    let text = include_str!("data/gripper.urdf")
        .replace("<inertia ixx=\"0.5\" iyy=\"0.5\" izz=\"0.02\"/>", "");
    assert!(Robot::from_urdf(&text, &ReadOptions::default()).is_err());
    let options = ReadOptions { point_masses: true, ..ReadOptions::default() };
    let system = Robot::from_urdf(&text, &options).unwrap().system(&without_fingers()).unwrap();
    assert_eq!(system.bodies[0].body.inertia_kg_m2, nalgebra::Matrix3::zeros());
}

#[test]
fn the_nearest_inertia_is_taken_on_request() {
    let text = include_str!("data/gripper.urdf")
        .replace("ixx=\"0.5\" iyy=\"0.5\" izz=\"0.02\"", "ixx=\"1\" iyy=\"1\" izz=\"2.3\"");
    assert!(Robot::from_urdf(&text, &ReadOptions::default()).is_err());
    let options = ReadOptions { project_inertias: true, ..ReadOptions::default() };
    let system = Robot::from_urdf(&text, &options).unwrap().system(&without_fingers()).unwrap();
    let expected = nalgebra::Vector3::new(1.1, 1.1, 2.2);
    assert!((system.bodies[0].body.inertia_kg_m2.diagonal() - expected).amax() < 1e-14);
    assert!(says(&system, "link \"arm\", inertial: inertia changed by 7.53e-2 of its size"));
}
