//! Shapes of links, payload and base: what is refused, what keeps apart, and which start is clear.

use std::fs;
use std::path::Path;

use righting_scenario::{Error, Scenario};
use righting_test_support::scenarios;
use serde_json::{Value, json};

/// The 20° slew of the four-joint arm with its system inline, and these fields of the system.
fn slew(fields: &[(&str, Value)]) -> Value {
    let read = |file: &str| -> Value {
        serde_json::from_str(&fs::read_to_string(scenarios().join(file)).unwrap()).unwrap()
    };
    let mut scenario = read("slew_4dof.json");
    scenario["system"] = read("systems/xlink_4dof.json");
    for (pointer, value) in fields {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        scenario["system"].pointer_mut(parent).unwrap()[key] = value.clone();
    }
    scenario
}

fn checked(fields: &[(&str, Value)]) -> Result<Scenario, Error> {
    Scenario::parse(&slew(fields).to_string(), Path::new("plan.json"))
}

/// The names of everything that keeps apart.
fn kept(scenario: &Scenario) -> Vec<String> {
    scenario.collision().pairs.iter().map(|pair| pair.between.to_string()).collect()
}

/// A bus that the arm stands on, and a panel beside it.
fn bus_and_panel() -> Value {
    json!([
        { "box": { "center_m": [0, 0, 0], "size_m": [0.5, 0.5, 0.5] } },
        { "box": { "center_m": [0, 0.8, 0.3], "size_m": [0.02, 1, 0.6] } },
    ])
}

#[test]
fn what_is_wrong_with_a_shape_is_named() {
    let capsule = json!({ "from_m": [0, 0, 0], "to_m": [0, 0, 1], "radius_m": 0.1 });
    let sphere = json!({ "center_m": [0, 0, 0], "radius_m": 0.1 });
    let keep_out = |shape: Value| ("/base/keep_out", json!([shape]));
    let shapes = |shape: Value| ("/links/2/shapes", json!([shape]));
    let pair = |names: Value| ("/ignored_pairs", json!([names]));
    for (field, path, message) in [
        (
            keep_out(json!({ "sphere": { "center_m": [0, 0, 9], "radius_m": -1 } })),
            "base.keep_out[0].sphere.radius_m",
            "found -1, expected a number from 0",
        ),
        (
            keep_out(json!({ "sphere": { "center_m": [0, 9], "radius_m": 1 } })),
            "base.keep_out[0].sphere.center_m",
            "an array of 3",
        ),
        (
            keep_out(json!({ "sphere": { "center_m": [0, 0, 1e308], "radius_m": 1 } })),
            "base.keep_out[0].sphere.center_m[2]",
            "found 1e308, expected a number from",
        ),
        (
            keep_out(json!({ "box": { "center_m": [0, 0, 9], "size_m": [1, -0.5, 1] } })),
            "base.keep_out[0].box.size_m[1]",
            "found -0.5, expected a number from 0",
        ),
        (
            keep_out(json!({ "box": { "center_m": [0, 0, 9] } })),
            "base.keep_out[0].box.size_m",
            "missing",
        ),
        (
            keep_out(json!({ "capsule": { "from_m": [0, 0, 9], "to_m": [0, 0], "radius_m": 1 } })),
            "base.keep_out[0].capsule.to_m",
            "an array of 3",
        ),
        (keep_out(json!({})), "base.keep_out[0]", "found no shape, expected one of"),
        (
            keep_out(json!({ "sphere": sphere, "capsule": capsule })),
            "base.keep_out[0]",
            "found 2 shapes, expected one of sphere, capsule and box",
        ),
        (keep_out(json!({ "boxx": 1 })), "base.keep_out[0].boxx", "did you mean `box`?"),
        (("/base/keep_out", sphere.clone()), "base.keep_out", "an array"),
        (("/links/2/radius_m", json!(-0.1)), "links[2].radius_m", "found -0.1, expected a number"),
        (("/links/2/radius_m", json!("thin")), "links[2].radius_m", "expected a number"),
        (shapes(json!({ "box": 1 })), "links[2].shapes[0].box", "expected one of sphere, capsule"),
        (shapes(json!({})), "links[2].shapes[0]", "found no shape, expected a sphere or a capsule"),
        (
            shapes(json!({ "sphere": { "center_m": [0, 0, 0], "radius_m": -1 } })),
            "links[2].shapes[0].sphere.radius_m",
            "found -1, expected a number from 0",
        ),
        (
            (
                "/payload",
                json!({ "mass_kg": 1, "radius_m": 0.1, "shapes": [{ "sphere": sphere }] }),
            ),
            "payload.shapes",
            "found both radius_m and shapes, expected one of them",
        ),
        (pair(json!(["links[0]"])), "ignored_pairs[0]", "an array of 2"),
        (
            pair(json!(["links[0]", "links[4]"])),
            "ignored_pairs[0][1]",
            "this system has links[0] to links[3]",
        ),
        (
            pair(json!(["links[0].shapes[0]", "links[3]"])),
            "ignored_pairs[0][0]",
            "this system has no links[0].shapes",
        ),
        (pair(json!(["links[0]", "payload"])), "ignored_pairs[0][1]", "this system has no payload"),
        (
            pair(json!(["links[0]", "base.keep_out[0]"])),
            "ignored_pairs[0][1]",
            "this system has no base.keep_out",
        ),
        (pair(json!(["link 1", "links[2]"])), "ignored_pairs[0][0]", "a name such as \"links[0]\""),
        (
            pair(json!(["links[1]", "links[1]"])),
            "ignored_pairs[0]",
            "found [\"links[1]\", \"links[1]\"], expected two parts that move apart",
        ),
        (
            pair(json!(["base.keep_out_radius_m", "base.keep_out_radius_m"])),
            "ignored_pairs[0]",
            "expected at least one link or the payload",
        ),
    ] {
        let refused = checked(&[field]).unwrap_err().to_string();
        let place = format!("plan.json: system.{path}: ");
        assert!(refused.starts_with(&place), "{refused} is not about {path}");
        assert!(refused.contains(message), "{refused} does not say {message}");
    }
    let text = slew(&[("/links/2/radius_m", json!(7.25))]).to_string().replace("7.25", "NaN");
    let refused = Scenario::parse(&text, Path::new("plan.json")).unwrap_err().to_string();
    assert!(refused.contains("system.links[2].radius_m: line 1"), "{refused}");
}

#[test]
fn the_sphere_of_a_cube_gives_way_to_shapes_and_a_given_one_does_not() {
    let exempt = ("/ignored_pairs", json!([["links[0]", "base.keep_out[0]"]]));
    let no_flag = ("/links/0/body_exempt", json!(false));
    let shapes = checked(&[("/base/keep_out", bus_and_panel()), exempt.clone(), no_flag.clone()]);
    let between = ["links 1 and 3", "links 1 and 4", "links 2 and 4"];
    let bus = ["link 2 and keep-out 1", "link 3 and keep-out 1", "link 4 and keep-out 1"];
    let panel = [1, 2, 3, 4].map(|link| format!("link {link} and keep-out 2"));
    let panel = panel.each_ref().map(String::as_str);
    let shapes = shapes.unwrap();
    assert_eq!(shapes.system().keep_out_radius_m, None);
    assert_eq!(kept(&shapes), [&bus[..], &panel, &between].concat());

    let both = checked(&[
        ("/base/keep_out", bus_and_panel()),
        ("/base/keep_out_radius_m", json!(0.2)),
        exempt,
        no_flag,
    ])
    .unwrap();
    let sphere = [1, 2, 3, 4].map(|link| format!("link {link} and body"));
    let sphere = sphere.each_ref().map(String::as_str);
    assert_eq!(kept(&both), [&sphere, &bus[..], &panel, &between].concat());

    // A link that may be inside is not kept from the base at all.
    let flagged = checked(&[("/base/keep_out", bus_and_panel())]).unwrap();
    assert!(!kept(&flagged).iter().any(|name| name.starts_with("link 1 and")), "{flagged:?}");
    // Nothing to keep out of, nothing to be exempt from.
    let refused = checked(&[("/base/keep_out", json!([]))]).unwrap_err().to_string();
    assert!(refused.contains("links[0].body_exempt: found true, expected false"), "{refused}");
    let none = [("/base/keep_out", json!([])), ("/links/0/body_exempt", json!(false))];
    assert_eq!(kept(&checked(&none).unwrap()), between);
}

#[test]
fn thick_links_share_a_joint_across_what_is_no_longer_than_they_are_thick() {
    let thick = |radius_m: f64| {
        let mut fields = vec![("/base/keep_out_radius_m", json!(0.3))];
        let links =
            ["/links/0/radius_m", "/links/1/radius_m", "/links/2/radius_m", "/links/3/radius_m"];
        fields.extend(links.map(|field| (field, json!(radius_m))));
        checked(&fields).unwrap()
    };
    let arm = |scenario: &Scenario| -> Vec<String> {
        kept(scenario).into_iter().filter(|name| name.starts_with("links")).collect()
    };
    let thin = thick(0.05);
    assert_eq!(arm(&thin), ["links 1 and 3", "links 1 and 4", "links 2 and 4"]);
    let posture = thin.system().model.kinematics(&[0.0; 4]);
    let clearances: Vec<_> = thin.collision().clearances(&posture).collect();
    // From the base's center to the surface of link 2, which starts 0.5 m up; 0.25 m of link 2 lie
    // between links 1 and 3.
    assert!((clearances[0].distance_m - 0.45).abs() < 1e-15);
    assert!((clearances[3].distance_m - 0.15).abs() < 1e-15);
    assert_eq!((thin.collision().clearance_m, clearances[3].least_m), (0.01, 0.01));
    // 0.12 m twice and 0.01 m leave nothing of 0.25 m, 0.1201 m do.
    assert_eq!(arm(&thick(0.1199)).len(), 3);
    let thickest = thick(0.1201);
    assert_eq!(arm(&thickest), ["links 1 and 4"]);
    let notes = thickest.notes();
    assert!(notes[0].contains("links 1 and 3 are never farther apart"), "{notes:?}");
}

#[test]
fn a_start_inside_a_shape_names_the_link_and_the_shape() {
    let refused = |fields: &[(&str, Value)]| checked(fields).unwrap_err().to_string();
    let base = ("/base/keep_out", bus_and_panel());
    let no_flag = ("/links/0/body_exempt", json!(false));
    assert_eq!(
        refused(&[base.clone(), no_flag.clone()]),
        "plan.json: initial.joint_angles_deg: found a start with link 1 0 m from base.keep_out[0], \
         expected at least the clearance, 0.01 m (or set system.links[0].body_exempt, or \
         collision.clearance_m to 0, or system.ignored_pairs to [[\"links[0]\", \"base.keep_out[0]\"]])"
    );
    assert_eq!(
        refused(&[base, no_flag, ("/links/0/radius_m", json!(0.03))]),
        "plan.json: initial.joint_angles_deg: found a start with link 1 0.03 m inside base.keep_out[0], \
         expected at least the clearance, 0.01 m (or set system.links[0].body_exempt, or \
         system.ignored_pairs to [[\"links[0]\", \"base.keep_out[0]\"]])"
    );
    let held = json!({ "mass_kg": 1, "shapes": [
        { "sphere": { "center_m": [0, 0, 0], "radius_m": 0.1 } },
        { "capsule": { "from_m": [-0.35, 0, 0], "to_m": [-0.35, 0, 0], "radius_m": 0.1 } },
    ] });
    assert_eq!(
        refused(&[("/payload", held)]),
        "plan.json: initial.joint_angles_deg: found a start with link 3 and payload shape 2 0.1 m into \
         each other, expected at least the clearance, 0.01 m (or set system.ignored_pairs to \
         [[\"links[2]\", \"payload.shapes[1]\"]])"
    );
    let exempt =
        [("/base/keep_out", json!([{ "sphere": { "center_m": [0, 0, -1], "radius_m": 0.2 } }]))];
    assert_eq!(
        refused(&exempt),
        "plan.json: system.links[0].body_exempt: found true, expected false: link 1 1.05 m from \
         base.keep_out[0], the nearest of what the base keeps out, at the start, and the clearance is \
         0.01 m"
    );
}

#[test]
fn shapes_take_the_place_of_the_segment_in_the_frame_of_the_mass() {
    // The frame of link 4 is at the tip; its x axis points along the link, away from the base.
    let shapes = json!([{ "capsule": { "from_m": [-0.05, 0, 0.2], "to_m": [0, 0, 0.2], "radius_m": 0.02 } }]);
    let scenario = checked(&[("/links/3/shapes", shapes)]).unwrap();
    let names = kept(&scenario);
    assert!(names.contains(&"link 4 shape 1 and body".to_owned()), "{names:?}");
    assert!(names.contains(&"link 2 and link 4 shape 1".to_owned()), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("link 3 and link 4")), "{names:?}");
    let posture = scenario.system().model.kinematics(&[0.0; 4]);
    let (name, clearance) = names
        .iter()
        .zip(scenario.collision().clearances(&posture))
        .find(|(name, _)| *name == "link 2 and link 4 shape 1")
        .unwrap();
    // From the end of link 2 at 0.75 m to 1.2 m and 0.2 m aside.
    let expected_m = 0.45_f64.hypot(0.2) - 0.02;
    assert!((clearance.distance_m - expected_m).abs() < 1e-12, "{name}: {}", clearance.distance_m);

    let none = checked(&[("/links/3/shapes", json!([]))]).unwrap();
    assert!(!kept(&none).iter().any(|name| name.contains('4')));
    let ball = json!({ "mass_kg": 2, "radius_m": 0.1 });
    let held = kept(&checked(&[("/payload", ball)]).unwrap());
    let of_ball: Vec<&str> =
        held.iter().map(String::as_str).filter(|name| name.contains("payload")).collect();
    assert_eq!(
        of_ball,
        ["payload and body", "link 1 and payload", "link 2 and payload", "link 3 and payload"]
    );
}
