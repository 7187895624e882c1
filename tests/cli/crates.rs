//! What each crate may reach, by cargo's own account of the workspace.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

/// Normal dependencies, from crate to crate, of the whole resolved graph.
fn dependencies() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let list = |value: &Value| value.as_array().unwrap().clone();
    let name_of: BTreeMap<String, String> = list(&metadata["packages"])
        .iter()
        .map(|package| [&package["id"], &package["name"]].map(|v| v.as_str().unwrap().to_owned()))
        .map(|[id, name]| (id, name))
        .collect();
    let is_normal = |dependency: &Value| {
        list(&dependency["dep_kinds"]).iter().any(|kind| kind["kind"].is_null())
    };
    list(&metadata["resolve"]["nodes"])
        .iter()
        .map(|node| {
            let needs = list(&node["deps"])
                .iter()
                .filter(|dependency| is_normal(dependency))
                .map(|dependency| name_of[dependency["pkg"].as_str().unwrap()].clone())
                .collect();
            (name_of[node["id"].as_str().unwrap()].clone(), needs)
        })
        .collect()
}

/// Everything that a crate is built from.
fn reached<'a>(
    from: &'a str,
    dependencies: &'a BTreeMap<String, BTreeSet<String>>,
) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(name) = open.pop() {
        for needed in &dependencies[name] {
            if reached.insert(needed.as_str()) {
                open.push(needed);
            }
        }
    }
    reached
}

#[test]
fn no_crate_reaches_what_it_shall_know_nothing_of() {
    let dependencies = dependencies();
    let solvers = [
        "righting-ocp",
        "righting-nlp",
        "righting-interior",
        "righting-ipopt",
        "righting-ipopt-sys",
    ];
    let physics = ["righting-multibody", "righting-scenario", "righting-planner"];
    let symbols = ["righting-symbolic"];
    let planner = ["righting-planner"];
    let rules: [(&str, &[&[&str]]); 14] = [
        ("righting-scenario", &[&solvers, &symbols, &planner]),
        ("righting-results", &[&solvers, &symbols, &planner]),
        ("righting-verifier", &[&solvers, &symbols, &planner]),
        ("righting-analysis", &[&solvers, &symbols, &planner]),
        ("righting-export", &[&solvers, &symbols, &planner, &["righting-report"]]),
        ("righting-import", &[&solvers, &symbols, &["righting-scenario"]]),
        ("righting-multibody", &[&solvers, &symbols]),
        ("righting-symbolic", &[&solvers, &physics]),
        ("righting-nlp", &[&["righting-ipopt-sys"], &physics, &symbols]),
        ("righting-ipopt", &[&physics, &symbols]),
        ("righting-interior", &[&["righting-ipopt-sys", "righting-ipopt"], &physics, &symbols]),
        ("righting-ocp", &[&physics]),
        ("righting-planner", &[&["righting-report", "righting-sweep"]]),
        ("righting-sweep", &[&["righting-report"]]),
    ];
    for (name, forbidden) in rules {
        let reached = reached(name, &dependencies);
        for other in forbidden.concat() {
            assert!(dependencies.contains_key(other), "{other} is no crate");
            assert!(!reached.contains(other), "{name} reaches {other}");
        }
    }
    // The verifier reads the planner's types of systems and states, and calls no equation of theirs.
    assert!(!dependencies["righting-verifier"].contains("righting-multibody"));
    // The check itself sees what is there.
    assert!(reached("righting-planner", &dependencies).contains("righting-ipopt-sys"));
}
