//! The quick-look figures of a made-up result, read back as XML.

mod common;

use righting_report::{attitude_svg, joints_svg};

/// Number of elements called `name` whose start tag contains `with`.
fn count(svg: &str, name: &str, with: &str) -> usize {
    let document = roxmltree::Document::parse(svg).expect("an SVG is well-formed XML");
    document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", name)))
        .filter(|node| svg[node.range()].split('>').next().is_some_and(|tag| tag.contains(with)))
        .count()
}

fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).expect("an SVG is well-formed XML");
    let texts = document.descendants().filter(|node| node.tag_name().name() == "text");
    texts.filter_map(|node| node.text().map(str::to_owned)).collect()
}

#[test]
fn every_joint_has_three_curves_and_their_limits() {
    for joints in [1, 2, 4, 7, 20] {
        let (solution, trajectory) = common::result("slew", joints, 600);
        let svg = joints_svg(&solution, &trajectory);
        assert_eq!(count(&svg, "path", "stroke=\"#0072B2\""), 3 * joints);
        assert_eq!(count(&svg, "path", "stroke-dasharray=\"6 4\""), 6 * joints);
        let texts = texts(&svg);
        for quantity in ["angle [deg]", "rate [deg/s]", "acceleration [deg/s²]"] {
            assert!(texts.contains(&format!("Joint {joints} {quantity}")), "{texts:?}");
        }
        assert_eq!(texts.iter().filter(|text| *text == "Time [s]").count(), 3);
    }
}

#[test]
fn a_limit_far_off_is_named_rather_than_left_out() {
    let (solution, trajectory) = common::result("slew", 2, 100);
    let texts = texts(&joints_svg(&solution, &trajectory));
    // Accelerations peak at 0.57 of 11.5 deg/s².
    assert_eq!(texts.iter().filter(|text| *text == "11.5 ↑ off scale").count(), 2);
    assert_eq!(texts.iter().filter(|text| *text == "−11.5 ↓ off scale").count(), 2);
    assert!(texts.contains(&"peak 0.573 of 11.5".to_owned()), "{texts:?}");
}

#[test]
fn joints_without_limits_are_drawn_without_them() {
    let (mut solution, trajectory) = common::result("slew", 1, 100);
    let righting_scenario::file::SystemReference::Inline(system) = &mut solution.scenario.system
    else {
        panic!("results hold their system inline");
    };
    system.links[0].angle_min_deg = None;
    system.links[0].angle_max_deg = None;
    let svg = joints_svg(&solution, &trajectory);
    assert_eq!(count(&svg, "path", "stroke-dasharray=\"6 4\""), 4);
}

#[test]
fn a_slew_shows_its_target_and_a_detumble_its_bound() {
    let (solution, trajectory) = common::result("slew", 4, 600);
    let svg = attitude_svg(&solution, &trajectory);
    assert_eq!(count(&svg, "path", "stroke-dasharray=\"1.5 3\""), 3);
    assert!(texts(&svg).contains(&"Error [deg]".to_owned()));

    let (solution, trajectory) = common::result("detumble", 4, 600);
    let svg = attitude_svg(&solution, &trajectory);
    assert_eq!(count(&svg, "path", "stroke-dasharray=\"6 4\""), 1);
    assert!(texts(&svg).iter().any(|text| text.ends_with("least with the arm at rest, 9.22")));
}

#[test]
fn hostile_names_and_broken_numbers_still_make_figures() {
    let (mut solution, trajectory) = common::result("slew", 2, 50);
    solution.scenario.name = "</text><script>&\u{1}".to_owned();
    let mut nodes = trajectory.nodes().to_vec();
    nodes[10].joint_angles_rad[0] = f64::NAN;
    nodes[11].angular_rate_rad_s[0] = f64::INFINITY;
    nodes.iter_mut().for_each(|node| node.joint_rates_rad_s[1] = f64::NAN);
    nodes[12].joint_angles_rad[1] = 1e308;
    let trajectory =
        righting_results::Trajectory::new(nodes, trajectory.intervals().to_vec()).unwrap();
    for svg in [attitude_svg(&solution, &trajectory), joints_svg(&solution, &trajectory)] {
        roxmltree::Document::parse(&svg).expect("well-formed");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}

#[test]
fn a_figure_does_not_grow_with_the_grid() {
    let size = |steps| {
        let (solution, trajectory) = common::result("slew", 7, steps);
        joints_svg(&solution, &trajectory).len()
    };
    assert!(size(100_000) < 4 * size(600));
}
