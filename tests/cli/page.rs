//! The interactive page, in a browser.

use righting_results::Node;
use righting_scenario::Scenario;
use righting_verifier::verify_directory;
use serde_json::{Value, json};

use crate::browser::Browser;
use crate::program::{files_in, folder_with, righting, small_detumble, small_slew, solve};
use crate::sweep::{folder_with_sweep, results, small_sweep, sweep};
use crate::verify::{add, tamper};

const DESKTOP: [u32; 2] = [900, 600];
const PHONE: [u32; 2] = [390, 844];
/// The page keeps single precision.
const ROUNDING: f64 = 2e-6;

fn numbers(value: &Value) -> Vec<f64> {
    let values = value.as_array().unwrap_or_else(|| panic!("no list of numbers: {value}"));
    values.iter().map(|number| number.as_f64().expect("a number")).collect()
}

#[track_caller]
fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() <= ROUNDING * expected.abs().max(1.0),
            "{found} {expected}"
        );
    }
}

/// The page draws what a row of trajectory.csv says, base and arm.
#[track_caller]
fn assert_shows(page: &mut Browser, node: &Node, scenario: &Scenario) {
    let state = page.value("righting.state()");
    assert_close(&[state["time_s"].as_f64().expect("a time")], &[node.time_s]);
    assert_close(&numbers(&state["joint_angles_rad"]), &node.joint_angles_rad);
    assert_close(&numbers(&state["joint_rates_rad_s"]), &node.joint_rates_rad_s);
    assert_close(&numbers(&state["angular_rate_rad_s"]), &node.angular_rate_rad_s);
    let drawn = &state["drawn"];
    assert_close(&numbers(&drawn["position_m"]), &node.position_m);
    assert_close(&numbers(&drawn["attitude_wxyz"]), &node.attitude);
    let arm = drawn["arm_m"].as_array().expect("points");
    let posture = scenario.system().model.kinematics(&node.joint_angles_rad);
    assert_eq!(arm.len(), posture.frames.len());
    for (found, frame) in arm.iter().zip(&posture.frames) {
        let base = node.state();
        let expected = base.position + base.attitude.to_inertial(&frame.origin);
        assert_close(&numbers(found), expected.as_slice());
    }
}

#[test]
fn the_page_plays_and_scrubs_what_the_table_says() {
    for (name, scenario) in [("slew", small_slew()), ("detumble", small_detumble())] {
        let folder = folder_with(&scenario);
        assert_eq!(solve(folder.path()).code, 0);
        let out = folder.path().join("out");
        let mut page = Browser::open(&out.join("report.html"), DESKTOP);
        let plan = verify_directory(&out).expect("a plan");
        let nodes = plan.trajectory.nodes();

        assert_eq!(page.value("document.title"), "small");
        assert_eq!(page.value("document.querySelector('#verdict').textContent"), "Verified");
        assert_shows(&mut page, &nodes[0], &plan.scenario);
        for k in [1, 17, nodes.len() - 1, 20] {
            page.value(&format!(
                "{{ const slider = document.querySelector('#time'); slider.value = {:e}; \
                 slider.dispatchEvent(new Event('input')); }}",
                nodes[k].time_s
            ));
            assert_shows(&mut page, &nodes[k], &plan.scenario);
        }
        page.click("#forward", 0.5);
        assert_shows(&mut page, &nodes[21], &plan.scenario);
        // Off the middle first: pressing the slider's knob leaves it where it is.
        page.value("righting.seek(0)");
        page.click("#time", 0.5);
        let halfway = page.value("righting.state().time_s").as_f64().expect("a time");
        assert!((halfway - 10.0).abs() < 0.3, "{halfway}");
        page.click(".u-over", 0.25);
        let quarter = page.value("righting.state().time_s").as_f64().expect("a time");
        assert!((quarter - 5.0).abs() < 0.2, "{quarter}");

        page.value("righting.seek(0)");
        let still = page.picture("#view");
        page.click("#play", 0.5);
        page.wait_until("righting.state().time_s > 1");
        page.click("#play", 0.5);
        let state = page.value("righting.state()");
        assert_eq!(state["playing"], false);
        let tip = |arm: &Value| numbers(&arm[arm.as_array().map_or(0, |points| points.len() - 1)]);
        let posture = plan.scenario.system().model.kinematics(&nodes[0].joint_angles_rad);
        let start = posture.frames.last().expect("a tip").origin;
        let moved = tip(&state["drawn"]["arm_m"]);
        let way: f64 = moved.iter().zip(&start).map(|(a, b)| (a - b).abs()).sum();
        assert!(way > 1e-3, "{name}: {way}");
        assert_ne!(page.picture("#view"), still, "{name}: the arm moved unseen");

        let inertial = page.picture("#view");
        page.click("#frame-body", 0.5);
        assert_eq!(page.value("righting.state().frame"), "body");
        assert_ne!(page.picture("#view"), inertial, "{name}: frames look the same");
        assert_eq!(page.complaints(), [] as [String; 0], "{name}");
    }
}

#[test]
fn the_page_works_on_a_phone() {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let mut page = Browser::open(&folder.path().join("out/report.html"), PHONE);
    assert_eq!(page.value("document.documentElement.scrollWidth <= innerWidth"), true);
    let before = page.picture("#view");
    page.swipe("#view", 80.0);
    assert_ne!(page.picture("#view"), before, "touch does not turn the view");
    assert_eq!(page.value("righting.state().time_s"), 0.0);
    page.swipe("#time", 80.0);
    assert!(page.value("righting.state().time_s").as_f64().is_some_and(|time| time > 5.0));
    assert_eq!(page.complaints(), [] as [String; 0]);
}

/// Small numbers that JavaScript counts bytes in.
fn size_of(page: &mut Browser, blob: &str) -> (String, u64) {
    let found = page.value(&format!("righting.{blob}().then(blob => [blob.type, blob.size])"));
    (found[0].as_str().expect("a type").to_owned(), found[1].as_u64().expect("a size"))
}

#[test]
fn the_page_reads_plots_gives_link_picture_and_video_and_helps() {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let out = folder.path().join("out");
    let plan = verify_directory(&out).expect("a plan");
    for size in [[1400, 900], [390, 844], [844, 390]] {
        let mut page = Browser::open(&out.join("report.html"), size);
        assert_eq!(page.value("document.documentElement.scrollWidth <= innerWidth"), true);
        let no_tool_is_cut_off = "(tools => [...tools.querySelectorAll('button')].every(button => \
             button.getBoundingClientRect().right <= tools.getBoundingClientRect().right))\
             (document.querySelector('#tools'))";
        assert_eq!(page.value(no_tool_is_cut_off), true);

        // Values under the pointer, and the player's again when it has left.
        page.value("document.querySelector('.u-over').scrollIntoView({ block: 'end' })");
        let readout =
            "document.querySelectorAll('#plots figure')[2].querySelector('.chip b').textContent";
        let at_start = page.value(readout);
        let place = page.value(
            "(r => [r.x + 0.5 * r.width, r.y + 0.5 * r.height])\
             (document.querySelector('.u-over').getBoundingClientRect())",
        );
        let place = numbers(&place);
        page.move_to([place[0], place[1]]);
        let middle = &plan.trajectory.nodes()[plan.trajectory.steps() / 2];
        let pointed = page.value(readout);
        let expected = middle.joint_angles_rad[0].to_degrees();
        let shown: f64 = pointed.as_str().and_then(|text| text.parse().ok()).expect("a number");
        assert!((shown - expected).abs() < 0.05 * expected.abs() + 0.02, "{shown} {expected}");
        assert_eq!(page.value("document.querySelector('.at').textContent.endsWith(' s')"), true);
        assert_eq!(page.value("righting.state().time_s"), 0.0);
        page.move_to([1.0, 1.0]);
        assert_eq!(page.value(readout), at_start);

        // The link opens what is shown.
        page.value("scrollTo(0, 0), righting.seek(7)");
        page.click("#view-y", 0.5);
        page.click("#frame-body", 0.5);
        let link = page.value("righting.link()");
        let hash =
            link.as_str().and_then(|link| link.split_once('#')).expect("a hash").1.to_owned();
        page.value("righting.seek(0), righting.setFrame('inertial')");
        page.click("#view-iso", 0.5);
        page.value(&format!("location.hash = '{hash}', 0"));
        page.wait_until("righting.state().time_s === 7");
        let state = page.value("righting.state()");
        assert_eq!((state["frame"].as_str(), state["time_s"].as_f64()), (Some("body"), Some(7.0)));
        let from = numbers(&state["from"]);
        assert!((from[1] - 1.0).abs() < 1e-3, "{from:?}");

        let (kind, bytes) = size_of(&mut page, "picture");
        assert!(kind == "image/png" && bytes > 2_000, "{kind} {bytes}");
        page.value("righting.setSpeed(5)");
        let (kind, bytes) = size_of(&mut page, "video");
        assert!(kind == "video/webm" && bytes > 1_000, "{kind} {bytes}");
        assert_eq!(page.value("righting.state().time_s"), 20.0);

        page.click("#open-help", 0.5);
        assert_eq!(page.value("document.querySelector('#help').open"), true);
        page.value("document.querySelector('#help').close()");

        // Every check can be read without scrolling sideways.
        page.value("document.querySelector('#checks').closest('details').open = true, 0");
        let fits = "(t => t.scrollWidth <= t.parentElement.clientWidth)(document.querySelector('#checks'))";
        assert_eq!(page.value(fits), true, "{size:?}");
        assert_eq!(page.complaints(), [] as [String; 0]);
    }
}

#[test]
fn the_page_of_a_sweep_draws_every_case_and_says_which_is_which() {
    let mut mixed = small_sweep(2);
    mixed["vary"][1] = json!({ "zip": [
        { "field": "maneuver.angle_deg", "values": [1, 3, 5] },
        { "field": "solver.max_iterations", "values": [100, 101, 1] }
    ] });
    let folder = folder_with_sweep(&mixed);
    assert_eq!(sweep(folder.path(), "out", &[]).code, 0);
    let rows = results(folder.path(), "out");
    let cases = &rows[1..];
    assert_eq!(cases.iter().filter(|row| row.contains("iteration_limit")).count(), 2);
    for size in [DESKTOP, PHONE] {
        let mut page = Browser::open(&folder.path().join("out/slews.html"), size);
        assert_eq!(page.value("document.title"), "small");
        assert_eq!(page.value("document.documentElement.scrollWidth <= innerWidth"), true);
        page.wait_until("slews.state().drawn > 0");
        assert_eq!(page.value("slews.state().drawn"), cases.len());
        for (i, case) in cases.iter().enumerate() {
            let place = numbers(&page.value(&format!("slews.place({i})")));
            page.click_at([place[0], place[1]]);
            let card = page.value("document.querySelector('#card').innerText");
            let card = card.as_str().expect("text");
            let id = case.split(',').next().expect("a column");
            assert!(card.contains(id), "{id}: {card}");
            let fails = case.contains("iteration_limit");
            assert_eq!(card.contains("iteration_limit, failed"), fails, "{card}");
        }
        let by_outcome = page.picture("#view");
        page.click("#color-objective", 0.5);
        assert_ne!(page.picture("#view"), by_outcome, "the colours are the same");
        assert_eq!(page.complaints(), [] as [String; 0]);
    }
}

#[test]
fn the_page_of_a_sweep_filters_what_varies_and_opens_the_plans_that_were_kept() {
    let mut durations = small_sweep(2);
    durations["vary"]
        .as_array_mut()
        .expect("a list")
        .push(json!({ "field": "horizon.duration_s", "name": "duration", "values": [20, 25] }));
    let folder = folder_with_sweep(&durations);
    assert_eq!(sweep(folder.path(), "out", &["--keep-plans"]).code, 0);
    let out = folder.path().join("out");
    assert_eq!(files_in(&out.join("plans")).len(), 8);
    for size in [[1400, 900], PHONE] {
        let mut page = Browser::open(&out.join("slews.html"), size);
        page.wait_until("slews.state().drawn === 8");
        page.value("slews.filter(0, '25'), 0");
        page.wait_until("slews.state().drawn === 4");
        let first = "slews.data.points.findIndex(point => point.settings[0] === '25')";
        let place = numbers(&page.value(&format!("slews.place({first})")));
        page.click_at([place[0], place[1]]);
        let card = page.value("document.querySelector('#card').innerText");
        let card = card.as_str().expect("text");
        assert!(card.contains("duration") && card.contains("25"), "{card}");
        let target = page.value("document.querySelector('#plan').getAttribute('href')");
        let target = target.as_str().expect("a link");
        let plan = out.join(target);
        assert!(target.starts_with("plans/") && plan.exists(), "{target}");
        let kept = verify_directory(plan.parent().expect("a folder")).expect("a plan");
        assert_eq!(kept.scenario.horizon().duration_s, 25.0);
        page.value("slews.filter(0, ''), 0");
        // All of them, and the ring around the one that is selected.
        page.wait_until("slews.state().drawn === 8 + 1");
        assert_eq!(page.complaints(), [] as [String; 0]);
    }
    // Nobody asked for plans: none are kept, and no point has one.
    assert_eq!(sweep(folder.path(), "bare", &[]).code, 0);
    assert!(!folder.path().join("bare/plans").exists());
}

#[test]
fn the_page_is_made_again_from_a_folder_and_says_what_is_wrong_in_it() {
    let folder = folder_with(&small_slew());
    let run = righting(
        folder.path(),
        &["solve", "scenario.json", "--out", "out", "--no-report", "--json"],
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(run.json()["files"]["report"], Value::Null);
    let out = folder.path().join("out");
    assert!(!files_in(&out).contains(&"report.html".to_owned()));

    let run = righting(folder.path(), &["report", "out"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, "out/report.html\n"), "{}", run.stderr);
    let page = std::fs::read_to_string(out.join("report.html")).expect("a page");
    assert!(page.contains("\"passed\":true"));
    assert!(page.len() < 1_000_000, "{}", page.len());
    let json = righting(folder.path(), &["report", "out", "--json"]).json();
    assert_eq!(json["report"], "out/report.html");

    tamper(folder.path(), 20, add("q2_rad", 0.01));
    let run = righting(folder.path(), &["report", "out"]);
    assert_eq!(run.code, 4, "{}", run.stderr);
    let page = std::fs::read_to_string(out.join("report.html")).expect("a page");
    assert!(page.contains("\"passed\":false") && page.contains("NOT VERIFIED"));

    std::fs::remove_file(out.join("trajectory.csv")).expect("removable");
    righting(folder.path(), &["report", "out"]).assert_refused("trajectory.csv: cannot be read");
    righting(folder.path(), &["report", "absent"]).assert_refused("no such file");
}
