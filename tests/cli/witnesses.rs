//! Committed references and the scripts that made them: where one changes without the other, this says so.

use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::program::root;

#[test]
fn references_name_the_scripts_that_made_them_as_they_are_now() {
    let path = root().join("crates/multibody/tests/data/dynamics.json");
    let text = std::fs::read_to_string(path).expect("the reference");
    let reference: Value = serde_json::from_str(&text).expect("JSON");
    let made_by = reference["made_by"].as_object().expect("scripts by their hashes");
    assert!(made_by.len() == 2, "{made_by:?}");
    for (script, hash) in made_by {
        let source = std::fs::read(root().join(script)).expect(script);
        let digest = Sha256::digest(&source);
        let found: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(hash, &found, "{script} has changed: run `make references`");
    }
    assert!(reference["source"].as_str().is_some_and(|source| source.starts_with("Pinocchio ")));
}
