//! Reaction wheels on the page of a plan, in a browser.

use righting_verifier::verify_directory;
use serde_json::{Value, json};

use crate::browser::Browser;
use crate::program::{folder_with, small_slew, solve};

/// The small slew with two wheels about its axis, of which the second has failed with momentum in store.
fn small_slew_with_wheels() -> Value {
    let mut scenario = small_slew();
    scenario["wheels"] = json!([
        { "axis": [1.0, 0.0, 0.0], "momentum_max_n_m_s": 2.0, "torque_max_n_m": 0.2 },
        { "axis": [1.0, 0.0, 0.0], "momentum_max_n_m_s": 2.0, "torque_max_n_m": 0.2,
          "initial_momentum_n_m_s": 0.5, "failed": true }
    ]);
    scenario
}

/// The readout of a plot, by its title: one number a curve.
fn readout(page: &mut Browser, title: &str) -> Vec<f64> {
    let shown = page.value(&format!(
        "[...[...document.querySelectorAll('#plots figure')]\
         .find(figure => figure.textContent.includes('{title}')).querySelectorAll('.chip b')]\
         .map(chip => Number(chip.textContent.replace('\\u2212', '-')))"
    ));
    let shown = shown.as_array().expect("a list").iter();
    shown.map(|number| number.as_f64().expect("a number")).collect()
}

#[test]
fn wheels_are_plotted_drawn_and_count_in_the_momentum() {
    let folder = folder_with(&small_slew_with_wheels());
    let run = solve(folder.path());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let out = folder.path().join("out");
    let plan = verify_directory(&out).expect("a plan");
    let nodes = plan.trajectory.nodes();
    let middle = &nodes[nodes.len() / 2];
    for size in [[1400, 900], [390, 844], [844, 390]] {
        let mut page = Browser::open(&out.join("report.html"), size);
        assert_eq!(page.value("document.documentElement.scrollWidth <= innerWidth"), true);
        page.value(&format!("righting.seek({})", middle.time_s));

        // One curve of each: a wheel that has failed is not plotted.
        let close = |shown: f64, value: f64| (shown - value).abs() <= 0.01 * value.abs() + 1e-3;
        let [momentum] = readout(&mut page, "Momenta of the wheels")[..] else {
            panic!("not one curve")
        };
        assert!(close(momentum, middle.wheel_momenta_n_m_s[0]), "{momentum}");
        let [torque] = readout(&mut page, "Torques of the wheels")[..] else {
            panic!("not one curve")
        };
        let given = plan.trajectory.wheel_torques_at(nodes.len() / 2)[0];
        assert!(close(torque, given), "{torque} {given}");

        // What is in store counts; the total is what was there at the start.
        let text = |page: &mut Browser, name: &str| -> f64 {
            let text =
                page.value(&format!("document.querySelector('#momentum-{name}').textContent"));
            text.as_str().and_then(|text| text.parse().ok()).expect("a number")
        };
        let stored = (middle.wheel_momenta_n_m_s[0] + middle.wheel_momenta_n_m_s[1]).abs();
        assert!(close(text(&mut page, "wheels"), stored));
        assert!(close(text(&mut page, "total"), 0.5));

        page.value("document.querySelector('#legend').setAttribute('open', '')");
        assert_eq!(page.value("document.querySelector('#wheels').hidden"), false);
        page.value("document.querySelector('#show-wheels').click()");
        assert_eq!(page.value("document.querySelector('#show-wheels').checked"), false);
        assert!(page.complaints().is_empty(), "{:?}", page.complaints());
    }
}

#[test]
fn a_page_without_wheels_does_not_mention_them() {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let mut page = Browser::open(&folder.path().join("out/report.html"), [1400, 900]);
    assert_eq!(page.value("document.querySelector('#wheels').hidden"), true);
    assert_eq!(page.value("document.querySelector('#wheels-row').hidden"), true);
    // Rounding is no momentum.
    assert_eq!(page.value("document.querySelector('#total-row').hidden"), true);
    assert_eq!(
        page.value("document.querySelector('#plots').textContent.includes('wheels')"),
        false
    );
}
