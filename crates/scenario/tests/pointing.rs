//! Cones that instruments keep out of, or stay in.

use std::path::Path;

use righting_multibody::Quaternion;
use righting_scenario::file::{DirectionTable, Pointing};
use righting_scenario::{ConeSide, Error, Scenario, schema};
use righting_test_support::json_schema::violation;
use righting_test_support::shipped;

/// A star tracker along x that keeps 30° from a direction straight up.
fn tracker() -> Pointing {
    Pointing {
        name: "star tracker".to_owned(),
        boresight_body: [2.0, 0.0, 0.0],
        direction_inertial: Some([0.0, 0.0, 5.0]),
        direction_table: None,
        keep_out_deg: Some(30.0),
        keep_in_deg: None,
    }
}

/// The 4-joint slew, 20° about [0.74, 0.02, 0.68], with instruments.
fn with(pointing: Vec<Pointing>) -> Result<Scenario, Error> {
    let mut file = shipped("slew_4dof").resolved().clone();
    file.pointing = pointing;
    Scenario::from_file(file, Path::new("plan.json"))
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-14, "{found} instead of {expected}");
}

#[track_caller]
fn assert_refused(pointing: Pointing, message: &str) {
    let refused = with(vec![tracker(), pointing]).expect_err(message).to_string();
    assert!(refused.contains(message), "`{refused}` does not say `{message}`");
}

fn other(change: impl FnOnce(&mut Pointing)) -> Pointing {
    let mut pointing = Pointing { name: "camera".to_owned(), ..tracker() };
    change(&mut pointing);
    pointing
}

#[test]
fn an_angle_is_that_of_the_turned_boresight_whatever_the_quaternion_s_length_and_sign() {
    let scenario = with(vec![tracker()]).unwrap();
    let [cone] = scenario.pointing() else { panic!("one") };
    assert_eq!((cone.name.as_str(), cone.side), ("star tracker", ConeSide::Outside));
    assert_close(cone.half_angle_rad, 30f64.to_radians());
    assert_close(cone.angle_rad(&Quaternion::identity(), 0.0), 90f64.to_radians());
    // 50° about −y brings x up to 40° from z.
    let half = 25f64.to_radians();
    for scale in [1.0, -1.0, 1.3] {
        let attitude = [half.cos(), 0.0, -half.sin(), 0.0].map(|entry| scale * entry);
        let angle_rad = cone.angle_rad(&Quaternion::from_array(attitude), 7.0);
        assert_close(angle_rad, 40f64.to_radians());
        assert_close(cone.excess_rad(angle_rad), -(10f64.to_radians()));
    }
    let text = serde_json::to_string(scenario.resolved()).unwrap();
    assert_eq!(Scenario::parse(&text, Path::new("plan.json")).unwrap(), scenario);
}

#[test]
fn what_is_no_cone_is_refused_by_its_field() {
    assert_refused(other(|p| p.name = " ".to_owned()), "pointing[1].name");
    assert_refused(other(|p| p.name = "star tracker".to_owned()), "found \"star tracker\" again");
    assert_refused(
        other(|p| p.boresight_body = [0.0; 3]),
        "pointing[1].boresight_body: found [0, 0, 0]",
    );
    assert_refused(other(|p| p.boresight_body[2] = f64::NAN), "pointing[1].boresight_body[2]");
    assert_refused(
        other(|p| p.direction_inertial = Some([0.0; 3])),
        "pointing[1].direction_inertial",
    );
    assert_refused(
        other(|p| p.direction_inertial = None),
        "pointing[1].direction_inertial: missing",
    );
    assert_refused(
        other(|p| p.direction_table = Some(DirectionTable { t_s: vec![], vectors: vec![] })),
        "both direction_inertial and direction_table",
    );
    for angle_deg in [0.0, -1.0, 180.1, f64::NAN] {
        assert_refused(other(|p| p.keep_out_deg = Some(angle_deg)), "pointing[1].keep_out_deg");
        let inside = |p: &mut Pointing| (p.keep_out_deg, p.keep_in_deg) = (None, Some(angle_deg));
        assert_refused(other(inside), "pointing[1].keep_in_deg");
    }
    assert_refused(other(|p| p.keep_out_deg = None), "pointing[1].keep_out_deg: missing");
    assert_refused(other(|p| p.keep_in_deg = Some(9.0)), "both keep_out_deg and keep_in_deg");
}

/// A camera with a direction that moves, in a maneuver of 30 s.
fn moving(t_s: &[f64], vectors: &[[f64; 3]]) -> Pointing {
    let table = DirectionTable { t_s: t_s.to_vec(), vectors: vectors.to_vec() };
    other(|p| (p.direction_inertial, p.direction_table) = (None, Some(table)))
}

#[test]
fn a_direction_moves_along_the_chords_between_the_given_ones() {
    let table = moving(&[-10.0, 10.0, 40.0], &[[0.0, 0.0, 3.0], [0.0, 2.0, 2.0], [0.0, 1.0, 0.0]]);
    let scenario = with(vec![table]).unwrap();
    let direction = &scenario.pointing()[0].direction;
    assert!(!direction.is_fixed());
    for (time_s, angle_deg) in
        [(-20.0, 90.0), (-10.0, 90.0), (0.0, 67.5), (10.0, 45.0), (25.0, 22.5), (50.0, 0.0)]
    {
        let expected = f64::to_radians(angle_deg);
        let found = direction.at(time_s);
        assert_close(found.norm(), 1.0);
        assert_close(found.z.atan2(found.y), expected);
    }
    let text = serde_json::to_string(scenario.resolved()).unwrap();
    assert_eq!(Scenario::parse(&text, Path::new("plan.json")).unwrap(), scenario);
    let schema = schema::scenario_schema();
    assert_eq!(violation(&schema, &serde_json::from_str(&text).unwrap()), None);
}

#[test]
fn a_table_that_does_not_cover_the_maneuver_is_refused() {
    let up = [0.0, 0.0, 1.0];
    let field = "pointing[1].direction_table";
    for (t_s, vectors, message) in [
        (vec![0.0], vec![up], "t_s: found an array of 1, expected 2 to 1000 times"),
        (
            vec![0.0, 30.0],
            vec![up],
            "vectors: found an array of 1, expected an array of 2, one a time",
        ),
        (vec![0.0, 0.0], vec![up; 2], "t_s[1]: found 0, expected more than 0"),
        (vec![0.0, f64::NAN], vec![up; 2], "t_s[1]: found NaN"),
        (vec![1.0, 30.0], vec![up; 2], "t_s[0]: found 1, expected 0 or less"),
        (
            vec![0.0, 29.0],
            vec![up; 2],
            "t_s[1]: found 29, expected 30, horizon.duration_s, or more",
        ),
        (vec![0.0, 30.0], vec![up, [0.0; 3]], "vectors[1]: found [0, 0, 0]"),
        (
            vec![0.0, 30.0],
            vec![up, [1.0, 0.0, 0.0]],
            "vectors[1]: found a direction 90\u{b0} from the one before",
        ),
    ] {
        assert_refused(moving(&t_s, &vectors), &format!("{field}.{message}"));
    }
}

#[test]
fn a_target_is_looked_at_when_it_is_reached() {
    // At the start the direction is straight up, 90° from the boresight; at the end on it.
    let ahead = [[0.0, 0.0, 1.0], [0.7, 0.0, 0.7], [0.97, 0.2, -0.1]];
    assert_refused(moving(&[0.0, 15.0, 30.0], &ahead), "pointing[1].keep_out_deg: found a target ");
}

#[test]
fn a_start_or_a_target_on_the_wrong_side_is_refused_with_the_angle() {
    assert_refused(
        other(|p| p.direction_inertial = Some([1.0, 0.0, 0.0])),
        "pointing[1].keep_out_deg: found a start 0\u{b0} from the direction of \"camera\", expected at least 30\u{b0}",
    );
    let inside = |p: &mut Pointing| (p.keep_out_deg, p.keep_in_deg) = (None, Some(30.0));
    assert_refused(
        other(inside),
        "pointing[1].keep_in_deg: found a start 90\u{b0} from the direction of \"camera\", expected at most 30\u{b0}",
    );
    // The target turns x by 13.4°.
    let nearly = |half_angle_deg: f64| {
        other(|p| {
            p.direction_inertial = Some([1.0, 0.0, 0.0]);
            (p.keep_out_deg, p.keep_in_deg) = (None, Some(half_angle_deg));
        })
    };
    with(vec![nearly(14.0)]).unwrap();
    assert_refused(nearly(13.0), "pointing[1].keep_in_deg: found a target 13.");
}

#[test]
fn the_schema_takes_one_direction_and_one_half_angle() {
    let schema = schema::scenario_schema();
    let check = |pointing: Pointing| {
        let mut file = shipped("slew_4dof").resolved().clone();
        file.pointing = vec![pointing];
        violation(&schema, &serde_json::to_value(file).unwrap())
    };
    assert_eq!(check(tracker()), None);
    assert_eq!(check(other(|p| (p.keep_out_deg, p.keep_in_deg) = (None, Some(5.0)))), None);
    assert!(check(other(|p| p.keep_in_deg = Some(5.0))).is_some());
    assert!(check(other(|p| p.keep_out_deg = None)).is_some());
    assert!(check(other(|p| p.direction_inertial = None)).is_some());
    assert!(check(other(|p| p.keep_out_deg = Some(0.0))).is_some());
}
