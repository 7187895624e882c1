//! Instruments on the wrong side of a cone are found, at the nodes and between them.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_results::{Trajectory, Verification};
use righting_scenario::Scenario;
use righting_scenario::file::Pointing;
use righting_test_support::{shipped, true_slew, varied};
use righting_verifier::verify;

/// A true motion of the 4-joint arm, on as many steps.
fn motion(steps: f64) -> (Scenario, Trajectory) {
    true_slew(&varied(&shipped("slew_4dof"), |file| file.horizon.steps = steps))
}

/// Angles of a boresight from a direction at the nodes, deg: the arc cosine, which no other code here takes.
fn angles_deg(trajectory: &Trajectory, boresight: [f64; 3], direction: [f64; 3]) -> Vec<f64> {
    let [boresight, direction] = [boresight, direction].map(|v| Vector3::from(v).normalize());
    let angle = |[w, x, y, z]: [f64; 4]| {
        let attitude = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        (attitude * boresight).dot(&direction).clamp(-1.0, 1.0).acos().to_degrees()
    };
    trajectory.nodes().iter().map(|node| angle(node.attitude)).collect()
}

fn pointing(direction: [f64; 3], keep_out_deg: Option<f64>, keep_in_deg: Option<f64>) -> Pointing {
    Pointing {
        name: "camera".to_owned(),
        boresight_body: [3.0, -1.0, 2.0],
        direction_inertial: Some(direction),
        direction_table: None,
        keep_out_deg,
        keep_in_deg,
    }
}

/// Whether the checks at and between the nodes passed.
fn passed(verification: &Verification) -> [bool; 2] {
    ["pointing at nodes", "pointing between nodes"].map(|name| {
        let check = verification.check(name).unwrap();
        assert_eq!(check.subject.as_deref(), Some("camera"));
        check.passed
    })
}

#[test]
fn the_least_and_the_largest_angle_decide() {
    let (scenario, trajectory) = motion(100.0);
    let direction = [0.3, -0.2, 1.0];
    let angles = angles_deg(&trajectory, [3.0, -1.0, 2.0], direction);
    let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
    let most = angles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(
        most - least > 0.5,
        "{least} to {most}: the base must turn for the test to mean something"
    );
    // 1e-4 rad is 0.0057° at the nodes, 1e-3 rad is 0.057° between them.
    for (beyond_deg, expected) in
        [(-0.1, [true; 2]), (0.003, [true; 2]), (0.03, [false, true]), (0.1, [false; 2])]
    {
        let out = pointing(direction, Some(least + beyond_deg), None);
        let inside = pointing(direction, None, Some(most - beyond_deg));
        for pointing in [out, inside] {
            // The start may be on the wrong side of the cone: that is refused when a scenario is read.
            let Ok(scenario) = scenario.varied(|file| file.pointing = vec![pointing]) else {
                assert!(beyond_deg > 0.0);
                continue;
            };
            assert_eq!(passed(&verify(&scenario, &trajectory)), expected, "{beyond_deg}");
        }
    }
}

/// A step of a motion in whose middle the boresight is where it is at no node: the way in it, deg, and the
/// direction in its middle.
fn jumped(trajectory: &Trajectory) -> Option<(f64, Vector3<f64>)> {
    let boresight = Vector3::new(3.0, -1.0, 2.0).normalize();
    let looks = trajectory.nodes().iter().map(|node| {
        let [w, x, y, z] = node.attitude;
        UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)) * boresight
    });
    let looks: Vec<Vector3<f64>> = looks.collect();
    looks.windows(2).find_map(|ends| {
        let (turn_deg, middle) = (ends[0].angle(&ends[1]).to_degrees(), ends[0] + ends[1]);
        let nearest = looks.iter().map(|other| other.angle(&middle).to_degrees());
        let nearest_deg = nearest.fold(f64::INFINITY, f64::min);
        (nearest_deg > 0.4 * turn_deg && turn_deg > 0.4).then_some((turn_deg, middle))
    })
}

#[test]
fn a_cone_that_is_jumped_over_between_two_nodes_is_found() {
    let motions = (5..25).map(|steps| motion(f64::from(steps)));
    let found = motions.filter_map(|(scenario, trajectory)| {
        let (turn_deg, middle) = jumped(&trajectory)?;
        let narrow = pointing(middle.into(), Some(0.3 * turn_deg), None);
        let scenario = scenario.varied(|file| file.pointing = vec![narrow]).ok()?;
        assert_eq!(passed(&verify(&scenario, &trajectory)), [true, false]);
        Some(())
    });
    assert!(found.count() >= 3);
}
