//! Broken files: each is refused in one line that says where and what would be right.

use righting_import::{Options, ReadOptions, Robot};

const BODY: &str = "<inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";

fn link(name: &str) -> String {
    format!("<link name='{name}'>{BODY}</link>\n")
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, rest: &str) -> String {
    format!(
        "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\
         <origin xyz='0 0 1'/>{rest}</joint>\n"
    )
}

fn robot(elements: &[String]) -> String {
    format!("<robot name='r'>\n{}</robot>\n", elements.concat())
}

fn refusal(text: &str) -> String {
    Robot::from_urdf(text, &ReadOptions::default()).unwrap_err().to_string()
}

/// A robot of two links with this joint, or these contents of the second link.
fn with_joint(kind: &str, rest: &str) -> String {
    robot(&[link("a"), link("b"), joint("j", kind, "a", "b", rest)])
}

fn with_link(contents: &str) -> String {
    let second = format!("<link name='b'>{contents}</link>\n");
    robot(&[link("a"), second, joint("j", "fixed", "a", "b", "")])
}

#[test]
fn what_is_no_robot() {
    for (text, message) in [
        ("", "line 1, column 1: not XML that is read: the document does not have a root node"),
        ("{}", "line 1, column 1: not XML that is read: unknown token"),
        ("<sdf/>", "line 1: sdf: found <sdf>, expected <robot>: a URDF file"),
        ("<robot name='r'/>", "line 1: robot \"r\": found no link, expected at least one"),
        (
            "<!DOCTYPE a [<!ENTITY b \"ha\"><!ENTITY c \"&b;&b;&b;\">]>\n<robot name='&c;'/>",
            "line 1, column 1: not XML that is read: a document type (<!DOCTYPE>), which a robot's file \
             does not have",
        ),
    ] {
        assert_eq!(refusal(text), message);
    }
}

#[test]
fn what_is_no_tree() {
    let [a, b, c] = ["a", "b", "c"].map(link);
    let fixed = |name: &str, parent: &str, child: &str| joint(name, "fixed", parent, child, "");
    for (elements, message) in [
        (
            vec![a.clone(), b.clone()],
            "line 3: link \"b\": found the roots \"a\", \"b\", expected one link that is no joint's child",
        ),
        (
            vec![a.clone(), b.clone(), c.clone(), fixed("j", "b", "c"), fixed("k", "c", "b")],
            "line 5: joint \"j\": found a cycle of the links \"c\", \"b\", expected a tree",
        ),
        (
            vec![a.clone(), b.clone(), fixed("j", "a", "b"), fixed("k", "b", "a")],
            "line 4: joint \"j\": found a cycle of the links \"b\", \"a\", expected a tree",
        ),
        (
            vec![a.clone(), b.clone(), fixed("j", "a", "hand")],
            "line 4: joint \"j\", child link: found \"hand\", expected the name of a link",
        ),
        (
            vec![a.clone(), b.clone(), fixed("j", "arm", "b")],
            "line 4: joint \"j\", parent link: found \"arm\", expected the name of a link",
        ),
        (
            vec![a.clone(), a.clone()],
            "line 3: link \"a\": found the name of the link in line 2 again, expected a name of its own",
        ),
        (
            vec![a.clone(), b.clone(), c.clone(), fixed("j", "a", "b"), fixed("j", "a", "c")],
            "line 6: joint \"j\": found the name of the joint in line 5 again, expected a name of its own",
        ),
        (
            vec![a.clone(), b.clone(), c.clone(), fixed("j", "a", "b"), fixed("k", "c", "b")],
            "line 6: joint \"k\": found the link \"b\", which joint \"j\" has as its child already, \
             expected a child of no other joint",
        ),
        (
            vec![a.clone(), fixed("j", "a", "a")],
            "line 3: joint \"j\": found one link as parent and child, expected two",
        ),
        (vec!["<link/>".to_owned()], "line 2: link: found no name, expected one"),
    ] {
        assert_eq!(refusal(&robot(&elements)), message);
    }
}

#[test]
fn what_no_joint_can_have() {
    for (kind, rest, message) in [
        (
            "hinge",
            "",
            "line 4: joint \"j\" type: found \"hinge\", expected revolute, continuous, prismatic, fixed, \
             floating or planar",
        ),
        (
            "continuous",
            "<axis xyz='0 0 0'/>",
            "line 4: joint \"j\", axis xyz: found [0, 0, 0], expected an axis of any length but zero",
        ),
        (
            "continuous",
            "<axis xyz='0 1'/>",
            "line 4: joint \"j\", axis xyz: found \"0 1\", expected three numbers",
        ),
        (
            "continuous",
            "<axis xyz='0 1 nan'/>",
            "line 4: joint \"j\", axis xyz: found \"0 1 nan\", expected a number",
        ),
        (
            "continuous",
            "<axis xyz='0 1 1e999'/>",
            "line 4: joint \"j\", axis xyz: found \"0 1 1e999\", expected three finite numbers",
        ),
        (
            "revolute",
            "<limit lower='1' upper='-1'/>",
            "line 4: joint \"j\", limit lower: found 1, expected at most the upper limit, -1",
        ),
        (
            "revolute",
            "<limit lower='-3600' upper='3600'/>",
            "line 4: joint \"j\", limit lower: found -3600, expected at most 1000 in magnitude: URDF is in \
             rad and m",
        ),
        (
            "revolute",
            "<limit velocity='-1'/>",
            "line 4: joint \"j\", limit velocity: found -1, expected a largest velocity, zero or more",
        ),
        (
            "revolute",
            "<limit effort='${max}'/>",
            "line 4: joint \"j\", limit effort: found \"${max}\", expected a number: expand the file first, \
             with `xacro robot.xacro > robot.urdf`",
        ),
        (
            "revolute",
            "<mimic joint='nobody'/>",
            "line 4: joint \"j\", mimic joint: found \"nobody\", expected the name of a joint",
        ),
        (
            "revolute",
            "<axis/><axis/>",
            "line 4: joint \"j\", axis: found a second <axis>, expected one",
        ),
    ] {
        assert_eq!(refusal(&with_joint(kind, rest)), message);
    }
    // Many files have an axis of zeros where nothing moves.
    assert!(
        Robot::from_urdf(&with_joint("fixed", "<axis xyz='0 0 0'/>"), &ReadOptions::default())
            .is_ok()
    );
    let far = with_joint("fixed", "").replace("0 0 1", "0 0 1500");
    assert_eq!(
        refusal(&far),
        "line 4: joint \"j\", origin xyz: found 1500, expected at most 1000: URDF is in m"
    );
    let called = with_joint("fixed", "").replace(
        "<robot name='r'>",
        "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:arm/>",
    );
    assert_eq!(
        refusal(&called),
        "line 1: arm: found <xacro:arm>, expected no macros: expand the file first, with `xacro \
         robot.xacro > robot.urdf`"
    );
}

#[test]
fn what_no_link_can_have() {
    let inertial = |mass: &str, xx: &str, zz: &str| {
        format!(
            "<inertial><mass value='{mass}'/><inertia ixx='{xx}' iyy='1' izz='{zz}'/></inertial>"
        )
    };
    for (contents, message) in [
        (
            "<inertial><mass value='2'/></inertial>".to_owned(),
            "line 3: link \"b\", inertial: found a mass of 2 kg without inertia, expected an inertia that \
             is not zero, or the option that takes such links as point masses",
        ),
        (
            inertial("-1", "1", "1"),
            "line 3: link \"b\", inertial, mass value: found -1, expected a mass from 0 to 1000000: URDF \
             is in kg",
        ),
        (
            inertial("nan", "1", "1"),
            "line 3: link \"b\", inertial, mass value: found \"nan\", expected a number",
        ),
        (
            inertial("1", "-1", "1"),
            "line 3: link \"b\", inertial: found principal moments of inertia -1e0, 1e0, 1e0 kg m², \
             expected none below zero and none above the sum of the others, or the option that takes the \
             nearest inertia that a rigid body can have",
        ),
        (
            inertial("0", "1", "1"),
            "line 3: link \"b\", inertial: found an inertia without a mass, expected both or neither",
        ),
        (
            inertial("1", "1000000", "1000000"),
            "line 3: link \"b\": found an inertia of 1e6 kg m² at a mass of 1 kg, a radius of gyration of \
             1000.000 m, expected less than 30 times the size of the robot, 1.000 m: URDF is in kg, m and \
             kg m²",
        ),
        (
            "<inertial><inertia ixx='1' iyy='1' izz='1'/></inertial>".to_owned(),
            "line 3: link \"b\", inertial: found no <mass>, expected one",
        ),
        (
            "<collision><geometry><cone/></geometry></collision>".to_owned(),
            "line 3: link \"b\", collision, geometry, cone: found <cone>, expected box, capsule, cylinder, \
             mesh or sphere",
        ),
        (
            "<collision><geometry/></collision>".to_owned(),
            "line 3: link \"b\", collision, geometry: found no element, expected one",
        ),
        (
            "<collision><geometry><sphere radius='-1'/></geometry></collision>".to_owned(),
            "line 3: link \"b\", collision, geometry, sphere radius: found -1, expected a length from 0 to \
             1000: URDF is in m",
        ),
    ] {
        assert_eq!(refusal(&with_link(&contents)), message);
    }
}

#[test]
fn what_options_cannot_name() {
    let text = with_joint("revolute", "<limit lower='-1' upper='1' velocity='1'/>");
    let robot = Robot::from_urdf(&text, &ReadOptions::default()).unwrap();
    let refusal = |change: &dyn Fn(&mut Options)| {
        let mut options = Options::floating("a");
        change(&mut options);
        robot.system(&options).unwrap_err().to_string()
    };
    assert_eq!(
        refusal(&|options| *options = Options::floating("c")),
        "base: found \"c\", expected a link of the robot: \"a\", \"b\""
    );
    assert_eq!(
        refusal(&|options| options.tip = Some("c".to_owned())),
        "tip: found \"c\", expected a link of the robot: \"a\", \"b\""
    );
    assert_eq!(
        refusal(&|options| options.dropped = vec!["a".to_owned()]),
        "dropped: found \"a\", the base, expected links that hang on it"
    );
    assert_eq!(
        refusal(&|options| options.locked = [("k".to_owned(), 0.0)].into()),
        "locked: found \"k\", expected joints of the robot that move: \"j\""
    );
    assert_eq!(
        refusal(&|options| options.locked = [("j".to_owned(), 1.5)].into()),
        "locked: found \"j\" at 85.94366927 deg, expected its limits kept: -57.295779513 deg to \
         57.295779513 deg"
    );
    assert_eq!(
        refusal(&|options| {
            options.tip = Some("b".to_owned());
            options.dropped = vec!["b".to_owned()];
        }),
        "tip: found \"b\", which is left out, expected a link that is not"
    );
    let loose = Robot::from_urdf(&with_joint("floating", ""), &ReadOptions::default()).unwrap();
    assert_eq!(
        loose.system(&Options::floating("a")).unwrap_err().to_string(),
        "line 4: joint \"j\": found a joint of more than one coordinate, expected a joint that is \
         revolute, continuous, prismatic or fixed, or the link beyond it as base, or left out"
    );
}

/// Sizes that no file has take neither the stack nor the time.
#[test]
fn what_is_far_too_large() {
    let many: Vec<String> = (0..10_001).map(|index| format!("<link name='l{index}'/>\n")).collect();
    assert_eq!(
        refusal(&robot(&many)),
        "line 10002: link \"l10000\": found one more link, expected at most 10000"
    );
    let deep = format!("<robot>{}{}</robot>", "<a>".repeat(300_000), "</a>".repeat(300_000));
    assert_eq!(refusal(&deep), "line 1: robot: found no link, expected at least one");
    let wide = format!("<robot>{}</robot>", "<a/>".repeat(1_000_001));
    assert!(refusal(&wide).ends_with("more than 1000000 elements and texts"));
    // A chain as long as may be, from either end.
    let mut chain: Vec<String> = (0..10_000).map(|index| link(&format!("l{index}"))).collect();
    chain.extend((1..10_000).map(|index| {
        let [parent, child] = [index - 1, index].map(|index| format!("l{index}"));
        joint(&format!("j{index}"), "continuous", &parent, &child, "")
    }));
    let robot = Robot::from_urdf(&robot(&chain), &ReadOptions::default()).unwrap();
    for base in ["l0", "l9999", "l5000"] {
        assert_eq!(robot.system(&Options::floating(base)).unwrap().bodies.len(), 9_999);
    }
}
