//! What the program is built from: licences and sources, by cargo's own account and deny.toml.

use std::collections::BTreeSet;
use std::process::Command;

use serde_json::Value;

use crate::program::root;

fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        .current_dir(root())
        .output()
        .expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    metadata["packages"].as_array().expect("packages").clone()
}

/// The licences that deny.toml allows, one a line.
fn allowed() -> BTreeSet<String> {
    let text = std::fs::read_to_string(root().join("deny.toml")).expect("deny.toml");
    let lines = text.lines().skip_while(|line| *line != "allow = [").skip(1);
    let names = lines.take_while(|line| *line != "]");
    names.map(|line| line.trim().trim_matches([',', '"']).to_owned()).collect()
}

/// Whether an SPDX expression (or an older one, with a stroke for OR) can be met with these licences. AND binds
/// tighter than OR; what is in brackets is met first.
fn can_be_met(expression: &str, allowed: &BTreeSet<String>) -> bool {
    let mut expression = expression.replace('/', " OR ");
    while let Some(close) = expression.find(')') {
        let open = expression[..close].rfind('(').expect("brackets in pairs");
        let inner = can_be_met(&expression[open + 1..close], allowed);
        expression.replace_range(open..=close, if inner { "MIT" } else { "none" });
    }
    expression.split(" OR ").any(|all| all.split(" AND ").all(|one| allowed.contains(one.trim())))
}

#[test]
fn every_licence_is_one_that_is_allowed() {
    let allowed = allowed();
    assert!(allowed.contains("Apache-2.0") && allowed.contains("MIT"), "{allowed:?}");
    assert!(can_be_met("(MIT OR GPL-3.0-only) AND Unicode-3.0", &allowed));
    assert!(can_be_met("LGPL-2.1-or-later OR Zlib/MIT", &allowed));
    assert!(!can_be_met("MIT AND GPL-3.0-only", &allowed));
    let packages = packages();
    assert!(packages.len() > 100, "{}", packages.len());
    for package in packages {
        let licence = package["license"].as_str().unwrap_or_default();
        assert!(can_be_met(licence, &allowed), "{}: \"{licence}\"", package["name"]);
    }
}

#[test]
fn everything_comes_from_here_or_from_one_registry_and_is_locked() {
    let sources: BTreeSet<String> = packages()
        .iter()
        .filter_map(|package| package["source"].as_str().map(str::to_owned))
        .collect();
    assert!(
        sources.len() == 1 && sources.iter().all(|s| s.starts_with("registry+")),
        "{sources:?}"
    );
    // Each with a checksum: a changed archive is not built.
    let lock = std::fs::read_to_string(root().join("Cargo.lock")).expect("Cargo.lock");
    let count = |start: &str| lock.lines().filter(|line| line.starts_with(start)).count();
    assert!(count("source = ") > 100);
    assert_eq!(count("source = "), count("checksum = "));
}
