//! Figures and page of a spacecraft with shapes.

mod common;

use std::path::Path;

use righting_analysis::Histories;
use righting_report::{clearances_svg, report_html};
use righting_results::{Solution, Trajectory};
use righting_scenario::Scenario;
use righting_scenario::file::{System, SystemReference};
use serde_json::{Value, json};

/// The made-up result of four joints with shapes on links, payload and base.
fn with_shapes() -> (Scenario, Solution, Trajectory) {
    let (mut solution, trajectory) = common::result("slew", 4, 100);
    let SystemReference::Inline(system) = &mut solution.scenario.system else { panic!("inline") };
    let mut value = serde_json::to_value(&*system).unwrap();
    value["base"]["keep_out"] = json!([
        { "box": { "center_m": [0, 0, -1], "size_m": [0.5, 0.5, 0.4] } },
        { "capsule": { "from_m": [0, 0, -2], "to_m": [1, 0, -2], "radius_m": 0.1 } },
        { "sphere": { "center_m": [0, -2, 0], "radius_m": 0.2 } },
    ]);
    value["links"][1]["radius_m"] = json!(0.03);
    value["links"][2]["shapes"] =
        json!([{ "capsule": { "from_m": [-0.2, 0, 0], "to_m": [0, 0, 0], "radius_m": 0.02 } }]);
    value["payload"] = json!({ "mass_kg": 1, "radius_m": 0.05 });
    let changed: System = serde_json::from_value(value).unwrap();
    **system = changed;
    solution.scenario.initial.angular_rate_deg_s = None;
    let scenario =
        Scenario::from_file(solution.scenario.clone(), Path::new("shapes.json")).unwrap();
    (scenario, solution, trajectory)
}

#[test]
fn clearances_from_shapes_have_a_panel_of_their_own() {
    let (scenario, solution, trajectory) = with_shapes();
    let histories = Histories::new(&scenario, &trajectory).unwrap();
    let svg = clearances_svg(&solution, &trajectory, &histories).unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<&str> = document
        .descendants()
        .filter_map(|node| node.text())
        .filter(|text| text.len() > 1)
        .collect();
    assert!(texts.iter().any(|text| text.starts_with("Links from base shapes")), "{texts:?}");
    assert!(!texts.contains(&"Links from the base's center"), "{texts:?}");
    // A link along its segment and a shape of the base, another link, a shape of a link, the payload.
    for name in ["4–3", "2–4", "1–3.1", "2–P"] {
        assert!(texts.contains(&name), "{name}: {texts:?}");
    }
}

#[test]
fn the_page_holds_every_shape() {
    let (scenario, solution, trajectory) = with_shapes();
    let page = report_html(&scenario, &solution, &trajectory);
    let start =
        page.find("id=\"data\"").and_then(|at| page[at..].find('>').map(|end| at + end + 1));
    let data = &page[start.unwrap()..];
    let data: Value = serde_json::from_str(&data[..data.find("</script>").unwrap()]).unwrap();
    let spacecraft = &data["spacecraft"];
    assert_eq!(spacecraft["keep_out_radius_m"], Value::Null);
    assert_eq!(
        spacecraft["keep_out"],
        json!([
            { "box": { "center_m": [0.0, 0.0, -1.0], "size_m": [0.5, 0.5, 0.4] } },
            { "capsule": { "from_m": [0.0, 0.0, -2.0], "to_m": [1.0, 0.0, -2.0], "radius_m": 0.1 } },
            { "capsule": { "from_m": [0.0, -2.0, 0.0], "to_m": [0.0, -2.0, 0.0], "radius_m": 0.2 } },
        ])
    );
    // Links 1 and 4 are thin lines.
    assert_eq!(spacecraft["capsule_radii_m"], json!([0.03, 0.02, 0.05]));
    // Six numbers a capsule and node, four bytes each, in base64.
    let column = data["columns"]["capsules_m"].as_str().unwrap();
    assert_eq!(column.len(), (101 * 3 * 6 * 4_usize).div_ceil(3) * 4);
}
