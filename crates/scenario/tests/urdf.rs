//! Systems from URDF files: what they become, and what is said of options.

use std::fs;

use nalgebra::Vector3;
use righting_scenario::file::{Base, KeepOut, Sphere, SystemOptions};
use righting_scenario::{Error, Scenario, SystemFile, import_urdf};

/// A bus, an arm on a hinge and a camera fixed to its tip.
const ROBOT: &str = r#"<robot name="camera_arm">
  <link name="bus"><inertial><origin xyz="0.1 0 0"/><mass value="50"/>
    <inertia ixx="4" iyy="5" izz="6" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="1 1 0.6"/></geometry></collision></link>
  <link name="arm"><inertial><origin xyz="0 0 0.5"/><mass value="4"/>
    <inertia ixx="0.4" iyy="0.4" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.5"/><geometry><cylinder radius="0.05" length="1"/></geometry></collision></link>
  <link name="camera"><inertial><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="revolute"><origin xyz="0 0 0.3" rpy="0 1.5707963267948966 0"/>
    <parent link="bus"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" velocity="0.5" effort="20"/></joint>
  <joint name="bracket" type="fixed"><origin xyz="0 0 1"/><parent link="arm"/><child link="camera"/></joint>
</robot>"#;

fn options() -> SystemOptions {
    SystemOptions {
        base: Some("bus".to_owned()),
        acceleration_max_deg_s2: Some(10.0),
        ..SystemOptions::default()
    }
}

fn import(urdf: &str, options: &SystemOptions) -> Result<SystemFile, Error> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.urdf");
    fs::write(&file, urdf).unwrap();
    import_urdf(&file, options)
}

/// The message of a refusal, without the folder.
fn refusal(urdf: &str, options: &SystemOptions) -> String {
    let message = import(urdf, options).unwrap_err().to_string();
    message.split_once("robot.urdf: ").unwrap().1.to_owned()
}

#[test]
fn a_link_as_base() {
    let SystemFile { resolved: system, description, notes } = import(ROBOT, &options()).unwrap();
    assert_eq!(system.name, "camera_arm");
    assert_eq!(system.base.name.as_deref(), Some("bus"));
    assert_eq!(system.base.center_of_mass_m, Some([0.1, 0.0, 0.0]));
    let bus = system.base.keep_out.as_ref().unwrap()[0].cuboid.as_ref().unwrap();
    assert_eq!(bus.size_m, [1.0, 1.0, 0.6]);
    let bodies = system.bodies.unwrap();
    assert_eq!(bodies.len(), 1);
    let arm = &bodies[0];
    assert_eq!((arm.name.as_str(), arm.parent.as_str(), arm.mass_kg), ("arm", "bus", 5.0));
    assert_eq!(arm.center_of_mass_m, Some([0.0, 0.0, 0.6]));
    assert_eq!(arm.joint.name.as_deref(), Some("hinge"));
    assert_eq!(arm.joint.rpy_deg, Some([0.0, 90.0, 0.0]));
    assert!((arm.joint.angle_max_deg.unwrap() - 1.5_f64.to_degrees()).abs() < 1e-12);
    assert_eq!(arm.joint.torque_max_n_m, Some(20.0));
    let capsule = arm.shapes.as_ref().unwrap()[0].capsule.as_ref().unwrap();
    assert_eq!((capsule.to_m, capsule.radius_m), ([0.0, 0.0, 1.0], 0.05));
    assert_eq!(notes, ["robot.urdf: fixed to \"arm\", 1 kg: \"camera\""]);
    // The arm points along x at angle zero, and turns about y: at 0.4 rad its tip has gone down.
    let center_m = description.model.center_of_mass(&[0.4]);
    let arm_m = Vector3::new(0.4_f64.cos() * 0.6, 0.0, 0.3 - 0.4_f64.sin() * 0.6);
    let expected_m = (Vector3::new(5.0, 0.0, 0.0) + arm_m * 5.0) / 55.0;
    assert!((center_m - expected_m).norm() < 1e-15, "{center_m} {expected_m}");
}

#[test]
fn a_robot_on_a_cube_keeps_what_the_cube_keeps_out() {
    let cube = Base { mass_kg: 100.0, cube_side_m: Some(1.0), ..Base::default() };
    let mounted = SystemOptions {
        base: None,
        on: Some(cube.clone()),
        mount_position_m: Some([0.0, 0.0, 0.8]),
        mount_rpy_deg: Some([0.0, 0.0, 90.0]),
        ..options()
    };
    let SystemFile { resolved: system, .. } = import(ROBOT, &mounted).unwrap();
    let base = &system.base;
    assert_eq!((base.mass_kg, base.cube_side_m), (150.0, None));
    assert!((base.keep_out_radius_m.unwrap() - 0.75_f64.sqrt()).abs() < 1e-15);
    // 50 kg at (0, 0.1, 0.8), for the quarter turn about z.
    let center_m = Vector3::from(base.center_of_mass_m.unwrap());
    assert!((center_m - Vector3::new(0.0, 0.1, 0.8) / 3.0).norm() < 1e-15);
    let reduced_kg = 100.0 * 50.0 / 150.0;
    let expected = 100.0 / 6.0 + 6.0 + reduced_kg * 0.01;
    assert!((base.inertia_kg_m2.unwrap()[2][2] - expected).abs() < 1e-12);
    // The robot's own bus is a box on the base, its sides exchanged.
    assert_eq!(base.keep_out.as_ref().unwrap().len(), 1);

    // A root without mass leaves the base as it was given.
    let massless = ROBOT.replace("<link name=\"bus\">", "<link name=\"bus\"/><link name=\"x\">");
    let joint = "<joint name=\"j\" type=\"fixed\"><parent link=\"bus\"/><child link=\"x\"/></joint></robot>";
    let massless = massless.replace("</robot>", joint);
    let without = SystemOptions { dropped: vec!["x".to_owned()], ..mounted };
    let SystemFile { resolved: system, .. } = import(&massless, &without).unwrap();
    assert_eq!(system.base, cube);
}

#[test]
fn what_urdf_lacks_is_asked_for() {
    let without_rate = ROBOT.replace(" velocity=\"0.5\"", "");
    let sliding = ROBOT.replace("\"revolute\"", "\"prismatic\"");
    for (urdf, options, message) in [
        (
            ROBOT,
            SystemOptions { acceleration_max_deg_s2: None, ..options() },
            "acceleration_max_deg_s2: missing, expected the largest acceleration of joints that turn, \
             deg/s², which URDF does not have",
        ),
        (
            without_rate.as_str(),
            options(),
            "rate_max_deg_s: missing, expected the largest rate of joints like \"hinge\", deg/s, for which \
             the file has no velocity limit",
        ),
        (
            sliding.as_str(),
            options(),
            "acceleration_max_m_s2: missing, expected the largest acceleration of joints that slide, m/s², \
             which URDF does not have",
        ),
        (
            ROBOT,
            SystemOptions { base: None, ..options() },
            "base: missing, expected the link that floats, such as the root \"bus\", or `on` with the base \
             that the root is fixed to",
        ),
        (
            ROBOT,
            SystemOptions { mount_rpy_deg: Some([0.0; 3]), ..options() },
            "mount_rpy_deg: found a mount without `on`, expected `on`, the base to mount the robot on",
        ),
        (
            ROBOT,
            SystemOptions { tip: Some("hand".to_owned()), ..options() },
            "tip: found \"hand\", expected a link of the robot: \"bus\", \"arm\", \"camera\"",
        ),
        (
            "<robot name='r'><link name='a'/><link name='b'/></robot>",
            options(),
            "line 1: link \"b\": found the roots \"a\", \"b\", expected one link that is no joint's child",
        ),
    ] {
        assert_eq!(refusal(urdf, &options), message);
    }
    let faster = SystemOptions { rate_max_deg_s: Some(7.0), ..options() };
    let imported = import(&without_rate, &faster).unwrap();
    assert_eq!(imported.resolved.bodies.unwrap()[0].joint.rate_max_deg_s, Some(7.0));
}

fn scenario(system: &str, options: &str) -> String {
    format!(
        r#"{{ "name": "slew", "system": "{system}", {options}
            "initial": {{ "joint_angles_deg": [30] }},
            "maneuver": {{ "type": "slew", "axis": [0, 1, 0], "angle_deg": 5 }},
            "horizon": {{ "duration_s": 30, "steps": 60 }} }}"#
    )
}

#[test]
fn a_scenario_takes_a_urdf_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("robot.urdf"), ROBOT).unwrap();
    let file = folder.path().join("slew.json");
    let options_text = r#""system_options": { "base": "bus", "acceleration_max_deg_s2": 10 },"#;
    let read = Scenario::parse(&scenario("robot.urdf", options_text), &file).unwrap();
    let imported = import_urdf(&folder.path().join("robot.urdf"), &options()).unwrap();
    assert_eq!(*read.system(), imported.description);
    assert_eq!(*read.resolved_system(), imported.resolved);
    assert_eq!(read.resolved().system_options, None);
    assert!(read.notes().iter().any(|note| note.contains("fixed to \"arm\"")));

    let refusal = |system: &str, options: &str| {
        let refused = Scenario::parse(&scenario(system, options), &file).unwrap_err().to_string();
        refused.split_once(".json: ").map_or(refused.clone(), |(_, message)| message.to_owned())
    };
    assert_eq!(
        refusal("robot.urdf", ""),
        "system_options: missing, expected `base`, the link that floats, or `on`, and limits"
    );
    assert_eq!(
        refusal("system.json", options_text),
        "system_options: found options of a system file, expected none, or the path of a URDF file \
         (ending in .urdf) as `system`"
    );
    assert!(refusal("missing.urdf", options_text).contains("no such file"));
    let misspelt = r#""system_options": { "base": "buss", "acceleration_max_deg_s2": 10 },"#;
    assert_eq!(
        refusal("robot.urdf", misspelt),
        "system_options.base: found \"buss\", expected a link of the robot: \"bus\", \"arm\", \"camera\""
    );
    // What is wrong with the robot is said with its own file and line.
    fs::write(folder.path().join("robot.urdf"), ROBOT.replace("\"50\"", "\"-50\"")).unwrap();
    let refused = Scenario::parse(&scenario("robot.urdf", options_text), &file).unwrap_err();
    let message = refused.to_string();
    assert!(message.starts_with(&*folder.path().join("robot.urdf").to_string_lossy()));
    assert!(message.ends_with(
        "line 2: link \"bus\", inertial, mass value: found -50, expected a mass from 0 to 1000000: URDF \
         is in kg"
    ));
}

#[test]
fn a_base_may_have_shapes_of_its_own() {
    let sphere = Sphere { center_m: [0.0; 3], radius_m: 0.4 };
    let on = Base {
        mass_kg: 100.0,
        inertia_kg_m2: Some([[9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]]),
        keep_out: Some(vec![KeepOut { sphere: Some(sphere), ..KeepOut::default() }]),
        ..Base::default()
    };
    let mounted = SystemOptions { base: None, on: Some(on), ..options() };
    let shapes = import(ROBOT, &mounted).unwrap().resolved.base.keep_out.unwrap();
    assert!(shapes[0].sphere.is_some() && shapes[1].cuboid.is_some());
}
