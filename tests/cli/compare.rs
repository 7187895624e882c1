//! Plans side by side.

use serde_json::{Value, json};

use crate::program::{Run, files_in, folder_with, righting, small_slew};
use crate::verify::{add, tamper};

/// A folder with the same slew planned in 20 s (`out`) and in 40 s (`slow`).
fn two_plans() -> tempfile::TempDir {
    let folder = folder_with(&small_slew());
    let mut slow = small_slew();
    slow["horizon"]["duration_s"] = json!(40);
    std::fs::write(folder.path().join("slow.json"), slow.to_string()).expect("writable");
    for (scenario, out) in [("scenario.json", "out"), ("slow.json", "slow")] {
        let arguments = ["solve", scenario, "--out", out, "--no-report", "--figures", "none"];
        assert_eq!(righting(folder.path(), &arguments).code, 0);
    }
    folder
}

fn compare(folder: &tempfile::TempDir, arguments: &[&str]) -> Run {
    righting(folder.path(), &[&["compare"], arguments].concat())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn numbers_of_plans_stand_side_by_side() {
    let folder = two_plans();
    let run = compare(&folder, &["out", "slow", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let found = run.json();
    assert_eq!(found["schema"], "righting.compare/1");
    let [fast, slow] = [&found["plans"][0], &found["plans"][1]];
    assert_eq!([number(&fast["duration_s"]), number(&slow["duration_s"])], [20.0, 40.0]);
    // In twice the time the same motion needs a quarter of the acceleration: effort goes with the inverse cube of
    // the duration, energy and torque with its inverse square, power with its inverse cube.
    for (name, power) in
        [("effort_rad2_s3", 3), ("peak_torque_n_m", 2), ("energy_j", 2), ("peak_power_w", 3)]
    {
        let ratio = number(&fast[name]) / number(&slow[name]);
        let expected = 2f64.powi(power);
        assert!((ratio / expected - 1.0).abs() < 0.15, "{name}: {ratio}, expected {expected}");
    }
    // Effort is what the table of a plan sums up to.
    let table = std::fs::read_to_string(folder.path().join("out/trajectory.csv")).expect("a plan");
    let mut rows = table.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let head = rows.next().expect("a head");
    let controls: Vec<usize> = (0..head.len()).filter(|&i| head[i].starts_with('u')).collect();
    let rows: Vec<Vec<&str>> = rows.collect();
    let step_s = 20.0 / (rows.len() - 1) as f64;
    let squares = rows.iter().flat_map(|row| controls.iter().map(|&i| row[i]));
    let squares = squares.filter_map(|cell| cell.parse::<f64>().ok()).map(|u| u * u);
    let effort = step_s * squares.sum::<f64>();
    assert!((number(&fast["effort_rad2_s3"]) / effort - 1.0).abs() < 1e-9);

    let text = compare(&folder, &["out", "slow"]).stdout;
    for part in
        ["out", "slow", "duration [s]", "peak joint torque [N m]", "margin of joint rate [deg/s]"]
    {
        assert!(text.contains(part), "no {part} in {text}");
    }
    // Nothing is written where nothing was asked for.
    assert!(!files_in(folder.path()).iter().any(|name| name.ends_with(".html")));
}

#[test]
fn the_nearest_limit_of_each_kind_is_told_with_its_place() {
    let folder = two_plans();
    let found = compare(&folder, &["out", "slow", "--json"]).json();
    let text = std::fs::read_to_string(folder.path().join("out/solution.json")).expect("a plan");
    let solution: Value = serde_json::from_str(&text).expect("JSON");
    let rates =
        solution["limits"].as_array().expect("limits").iter().filter(|limit| {
            limit["name"].as_str().is_some_and(|name| name.starts_with("joint rate"))
        });
    let margin = |limit: &Value| number(&limit["bound"]) - number(&limit["value"]);
    let least = rates.map(margin).fold(f64::INFINITY, f64::min);
    let margins = found["plans"][0]["smallest_margins"].as_array().expect("margins");
    let told: Vec<&Value> = margins
        .iter()
        .filter(|limit| limit["name"].as_str().is_some_and(|name| name.starts_with("joint rate")))
        .collect();
    assert_eq!(told.len(), 1);
    assert!((number(&told[0]["margin"]) - least).abs() < 1e-12);
    assert!(told[0]["subject"].is_string() && told[0]["time_s"].is_number());
}

#[test]
fn what_is_no_plan_is_refused_and_one_that_fails_is_compared() {
    let folder = two_plans();
    compare(&folder, &["out", "nowhere"]).assert_refused("nowhere/solution.json: cannot be read");
    assert_eq!(compare(&folder, &["out"]).code, 2);
    tamper(folder.path(), 20, add("q2_rad", 0.01));
    let run = compare(&folder, &["out", "slow", "--json"]);
    assert_eq!(run.code, 4, "{}", run.stderr);
    let found = run.json();
    assert_eq!([&found["plans"][0]["verified"], &found["plans"][1]["verified"]], [false, true]);
}

#[cfg(unix)]
#[test]
fn the_page_shows_the_plans_on_one_clock_and_turns_them_together() {
    use crate::browser::Browser;
    let folder = two_plans();
    let run = compare(&folder, &["out", "slow", "--out", "side"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.ends_with("\nside/compare.html\n"), "{}", run.stdout);
    let page = folder.path().join("side/compare.html");
    for size in [[1400, 900], [390, 844], [844, 390]] {
        let mut page = Browser::open(&page, size);
        assert_eq!(page.value("document.title"), "out, slow");
        assert_eq!(page.value("document.documentElement.scrollWidth <= innerWidth"), true);
        assert_eq!(page.value("compare.state().duration_s"), 40.0);
        let attitudes = |page: &mut Browser, time_s: f64| {
            page.value(&format!("compare.seek({time_s})"));
            let plans = page.value("compare.state().plans.map(plan => plan.attitude_wxyz)");
            [plans[0].clone(), plans[1].clone()]
        };
        // In 30 s one has ended and stays, the other one goes on.
        let [ended, on_its_way] = attitudes(&mut page, 30.0);
        let [still, arrived] = attitudes(&mut page, 40.0);
        assert_eq!(ended, still);
        assert_ne!(on_its_way, arrived);
        let curves =
            page.value("document.querySelectorAll('#plots figure:first-child .chip').length");
        assert_eq!(curves, 2);
        // Both look from the same side, also when one is turned.
        let cameras =
            "compare.state().plans.map(plan => plan.camera.map(x => x.toFixed(4)).join())";
        page.click("#view-x", 0.5);
        let from_x = page.value(cameras);
        assert_eq!(from_x[0], from_x[1]);
        if size[0] < 500 {
            page.swipe(".scene-view", 80.0);
            let turned = page.value(cameras);
            assert_eq!(turned[0], turned[1]);
            assert_ne!(turned[0], from_x[0]);
        }
        assert_eq!(page.complaints(), [] as [String; 0]);
    }
}
