//! Plans go around what the base keeps out, by the verifier's own distances.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::{self, SystemReference};
use righting_test_support::{scenarios, shipped, varied};

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

fn with_system(scenario: &Scenario, change: impl FnOnce(&mut file::System)) -> Scenario {
    varied(scenario, |file| {
        let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
        change(system);
    })
}

/// The clearance from the base at the nodes: what it is of, and how much more it is than is asked, m.
fn from_base(planned: &Planned) -> (String, f64) {
    let verification = &planned.solution.verification;
    assert!(verification.passed, "{:?}", planned.solution.notes);
    let check = verification.check("clearance from body at nodes").unwrap();
    (check.subject.clone().unwrap(), check.value - check.limit)
}

#[test]
fn an_arm_goes_around_a_solar_array() {
    let scenario = Scenario::read(&scenarios().join("real/slew_4dof_solar_arrays.json")).unwrap();
    let around = plan(&scenario);
    let (subject, room_m) = from_base(&around);
    // It goes as near as it may, …
    assert!(
        subject.ends_with("and keep-out 2") || subject.ends_with("and keep-out 3"),
        "{subject}"
    );
    assert!(room_m < 1e-5, "{room_m}");
    // … which costs effort: without the arrays the arm goes where they are.
    let bus = with_system(&scenario, |system| {
        system.base.keep_out.as_mut().unwrap().truncate(1);
    });
    let through = plan(&bus);
    assert!(from_base(&through).1 > 0.01);
    let (with, without) = (around.solution.objective, through.solution.objective);
    assert!(with > 1.02 * without && with < 1.5 * without, "{with} {without}");
    let trajectory = &through.trajectory;
    let nearest_m = trajectory
        .nodes()
        .iter()
        .flat_map(|node| {
            let posture = scenario.system().model.kinematics(&node.joint_angles_rad);
            let pairs = scenario.collision().pairs.iter();
            pairs.map(move |pair| pair.clearance(&posture).distance_m)
        })
        .fold(f64::INFINITY, f64::min);
    assert!(nearest_m < 0.0, "{nearest_m}");
}

/// The keep-out sphere given as a shape is the same sphere, and so is a capsule whose ends are the same.
#[test]
fn a_sphere_is_a_sphere_however_it_is_given() {
    let scenario = varied(&shipped("slew75_4dof"), |file| file.horizon.steps = 150.0);
    let radius_m = scenario.system().keep_out_radius_m.unwrap();
    let center_m = [0.0; 3];
    let sphere = file::KeepOut {
        sphere: Some(file::Sphere { center_m, radius_m }),
        ..file::KeepOut::default()
    };
    let capsule = file::KeepOut {
        capsule: Some(file::Capsule { from_m: center_m, to_m: center_m, radius_m }),
        ..file::KeepOut::default()
    };
    let expected = plan(&scenario);
    for shape in [sphere, capsule] {
        let shaped = with_system(&scenario, |system| system.base.keep_out = Some(vec![shape]));
        assert_eq!(shaped.system().keep_out_radius_m, None);
        let found = plan(&shaped);
        let (found, expected) = (found.solution.objective, expected.solution.objective);
        assert!((found - expected).abs() < 1e-6 * expected, "{found} {expected}");
    }
}

/// Links as capsules, a link of two shapes, a payload, and every kind of thing on the base at once.
#[test]
fn everything_at_once_is_kept_apart() {
    let scenario = with_system(&shipped("slew_4dof"), |system| {
        let link = |shapes: serde_json::Value| Some(serde_json::from_value(shapes).unwrap());
        system.links[1].radius_m = Some(0.03);
        system.links[2].shapes = link(serde_json::json!([
            { "capsule": { "from_m": [-0.25, 0, 0.03], "to_m": [0, 0, 0.03], "radius_m": 0.02 } },
            { "sphere": { "center_m": [-0.1, 0, 0], "radius_m": 0.05 } },
        ]));
        system.payload = Some(file::Payload {
            mass_kg: 2.0,
            inertia_kg_m2: None,
            radius_m: Some(0.08),
            shapes: None,
        });
        system.base.keep_out = Some(
            serde_json::from_value(serde_json::json!([
                { "box": { "center_m": [0, 0, 0], "size_m": [0.5, 0.5, 0.5] } },
                { "capsule": { "from_m": [0.2, 0.2, 0.25], "to_m": [0.2, 0.2, 0.7], "radius_m": 0.03 } },
                { "sphere": { "center_m": [-0.2, 0.1, 0.4], "radius_m": 0.1 } },
            ]))
            .unwrap(),
        );
    });
    let planned = plan(&scenario);
    assert!(planned.solution.verification.passed, "{:?}", planned.solution.verification.checks);
}
