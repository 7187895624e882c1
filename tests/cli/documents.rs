//! What the documents say is so.

use serde_json::Value;

use crate::program::{folder_with, righting, root};

/// The fenced blocks of the README in a language.
fn blocks(language: &str) -> Vec<String> {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("a README");
    let fence = format!("```{language}\n");
    let blocks = readme.split(&fence).skip(1);
    blocks.filter_map(|rest| rest.split("```").next()).map(str::to_owned).collect()
}

#[test]
fn the_examples_of_the_readme_are_accepted() {
    let examples: Vec<Value> =
        blocks("json").iter().map(|text| serde_json::from_str(text).expect("JSON")).collect();
    let [scenario, system] = examples.as_slice() else { panic!("a scenario and a system") };

    let place = root().join("scenarios/readme.json");
    righting_maneuver::Scenario::parse(&scenario.to_string(), &place).expect("accepted");

    let mut with_system = scenario.clone();
    with_system["system"] = system.clone();
    with_system["initial"]["joint_angles_deg"] = serde_json::json!([0, 0]);
    righting_maneuver::Scenario::parse(&with_system.to_string(), &place).expect("accepted");
}

#[test]
fn every_file_that_a_document_links_to_is_there() {
    for document in ["README.md", "ARCHITECTURE.md", "CHANGELOG.md"] {
        let text = std::fs::read_to_string(root().join(document)).expect("a document");
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if !target.contains("://") {
                assert!(root().join(target).exists(), "{document} links to {target}");
            }
        }
    }
}

#[test]
fn every_command_of_the_readme_exists() {
    let folder = folder_with(&serde_json::json!({}));
    let help = righting(folder.path(), &["--help"]).stdout;
    let readme = std::fs::read_to_string(root().join("README.md")).expect("a README");
    let rows = readme.lines().filter_map(|line| line.strip_prefix("| `righting "));
    let commands: Vec<&str> = rows.filter_map(|row| row.split([' ', '`']).next()).collect();
    assert!(!commands.is_empty());
    for command in commands {
        assert!(help.contains(&format!("  {command} ")), "{command}");
    }
}
