//! Figures of sweeps: of well-formed XML, with a mark a slew.

use righting_report::{open_loop_errors_svg, slew_limits_svg, slews_html, slews_svg};
use righting_sweep::{CaseId, CaseStatus, Column, Flown, Kind, SlewLimit, SlewPoint, Slews};
use serde_json::json;

fn count(svg: &str, tag: &str) -> usize {
    let document = roxmltree::Document::parse(svg).expect("well-formed");
    document.descendants().filter(|node| node.has_tag_name(tag)).count()
}

/// Slews of 10° and 20° about two axes and for three durations; the last one fails.
fn slews() -> Slews {
    let column = |name: &str, kind| Column {
        name: name.to_owned(),
        field: name.to_owned(),
        relative: false,
        kind,
    };
    let columns = vec![column("axis", Kind::Vector(3)), column("time<s>", Kind::Number)];
    let (points, limits) = (Vec::new(), Vec::new());
    let mut slews = Slews { recorded: 12, succeeded: 11, points, columns, limits };
    for axis in [[1.0, 0.0, 0.0], [0.0, 0.6, 0.8]] {
        for time_s in [10, 20, 30] {
            let fails = axis[0] == 0.0 && time_s == 30;
            for angle_deg in [10.0, 20.0] {
                slews.points.push(SlewPoint {
                    case_id: CaseId(0),
                    settings: vec![json!(axis), json!(time_s)],
                    axis,
                    angle_deg,
                    succeeded: !(fails && angle_deg == 20.0),
                    status: CaseStatus::Flown(Flown::Flown),
                    attitude_error: f64::NAN,
                    objective: 1e-6 * angle_deg,
                    plan_page: None,
                });
            }
            slews.limits.push(SlewLimit {
                settings: vec![json!(axis), json!(time_s)],
                axis,
                tried: 2,
                succeeded: 2,
                max_angle_deg: 20.0,
                all_up_to_deg: if fails { 10.0 } else { 20.0 },
            });
        }
    }
    slews
}

#[test]
fn every_slew_is_a_disc_or_a_cross_in_both_views() {
    let svg = slews_svg("a & b", &slews());
    assert_eq!(count(&svg, "circle"), 2 * 11);
    assert!(svg.contains("11 of 12 slews succeed"), "{svg}");
    assert!(!svg.contains("drawn"), "{svg}");
    let mut none = slews();
    none.points.clear();
    assert_eq!(count(&slews_svg("none", &none), "circle"), 0);
}

#[test]
fn figure_and_page_say_that_they_show_a_sample() {
    let mut some = slews();
    (some.recorded, some.succeeded) = (1_000_000, 980_000);
    for shown in [slews_svg("many", &some), slews_html("many", &some)] {
        assert!(shown.contains("980000 of 1000000 slews succeed"));
        assert!(shown.contains("drawn: 11 of 980000 that succeed, 1 of 20000 that failed"));
    }
}

#[test]
fn the_page_of_slews_names_what_else_varies_and_where_plans_are() {
    let mut some = slews();
    some.points[0].plan_page = Some("plans/0000000000000000/report.html".to_owned());
    some.columns[0].field = "maneuver.axis".to_owned();
    let page = slews_html("some", &some);
    assert!(page.contains("\"columns\":[\"time\\u003cs>\"]"), "the axis is no filter");
    assert!(page.contains("\"settings\":[\"30\"]"));
    assert!(page.contains("\"plan_page\":\"plans/0000000000000000/report.html\""));
    assert_eq!(page.matches("\"plan_page\":null").count(), 11);
}

#[test]
fn a_name_cannot_end_the_element_it_stands_in() {
    let page = slews_html("</title></script><script>alert(1)", &slews());
    let harmless = slews_html("harmless", &slews());
    for end in ["</title", "</script", "<script"] {
        assert_eq!(page.matches(end).count(), harmless.matches(end).count(), "{end}");
    }
    assert!(page.contains("\"attitude_error_deg\":null"));
}

#[test]
fn limits_are_drawn_over_the_number_that_varies() {
    let svg = slew_limits_svg("limits", &slews()).expect("a number varies");
    assert_eq!(count(&svg, "circle"), 3);
    let mut fixed = slews();
    fixed.columns[1].kind = Kind::Text;
    assert_eq!(slew_limits_svg("limits", &fixed), None);
}

#[test]
fn limits_of_arms_are_curves_of_their_own_with_their_names() {
    let mut arms = slews();
    arms.columns.push(Column { kind: Kind::Named, ..arms.columns[1].clone() });
    let limits = std::mem::take(&mut arms.limits);
    for name in ["short arm", "long arm"] {
        for limit in &limits {
            let mut limit = limit.clone();
            limit.settings.push(json!({ "name": name, "links": [] }));
            arms.limits.push(limit);
        }
    }
    let svg = slew_limits_svg("limits", &arms).expect("a number varies");
    assert_eq!(count(&svg, "circle"), 2 * 3);
    assert!(svg.contains("short arm") && svg.contains("long arm"), "{svg}");
}

#[test]
fn limits_of_many_random_values_are_put_together() {
    let mut many = slews();
    let settings = |time: usize| vec![json!([1, 0, 0]), json!(time)];
    let limit = |time| SlewLimit {
        settings: settings(time),
        all_up_to_deg: time as f64,
        ..many.limits[0].clone()
    };
    many.limits = (1..=5000).rev().map(limit).collect();
    let svg = slew_limits_svg("limits", &many).expect("a number varies");
    assert_eq!(count(&svg, "circle"), 100);
    assert!(svg.contains("over the rest and 50 values next to each other"), "{svg}");
}

#[test]
fn errors_are_summed_up_by_their_quantiles() {
    let errors: Vec<f64> = (1..=100).map(|i| 0.01 * f64::from(i)).collect();
    let svg = open_loop_errors_svg("errors", &errors).expect("there are some");
    assert!(svg.contains("half end within 0.5°, 95 % within 0.95°, all within 1°"), "{svg}");
    assert_eq!(count(&svg, "svg"), 1);
    assert_eq!(open_loop_errors_svg("errors", &[f64::NAN]), None);
    let many: Vec<f64> = (1..=100_001).map(|i| 1e-5 * f64::from(i)).collect();
    let svg = open_loop_errors_svg("errors", &many).expect("there are some");
    assert!(svg.contains("100001 plans") && svg.len() < 100_000, "{}", svg.len());
    assert!(open_loop_errors_svg("errors", &[0.0, 0.0]).is_some_and(|svg| count(&svg, "path") > 0));
}
