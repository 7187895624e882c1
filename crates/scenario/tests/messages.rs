//! What a file says comes back in messages, and must not spoil them: found by fuzzing.

use std::path::Path;

use righting_scenario::Scenario;
use serde_json::json;

fn message(text: &str) -> String {
    Scenario::parse(text, Path::new("plan.json")).expect_err("refused").to_string()
}

#[test]
fn a_long_key_is_shortened() {
    let key = "x".repeat(50_000);
    let message = message(&json!({ key: 1 }).to_string());
    assert!(message.starts_with("plan.json: xxxx") && message.contains('…'), "{message}");
    assert!(message.len() < 400, "{}", message.len());
}

#[test]
fn a_path_with_control_characters_stays_on_one_line() {
    let text = std::fs::read_to_string("../../scenarios/slew_2dof.json").expect("shipped");
    let mut scenario: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    for (path, shown) in [("a\nb", "a\\nb: cannot be read"), ("\u{1b}[2J", "\\u{1b}[2J: cannot")] {
        scenario["system"] = json!(path);
        let message = message(&scenario.to_string());
        assert!(message.starts_with("plan.json: system: ") && message.contains(shown), "{message}");
        assert!(!message.contains(char::is_control), "{message:?}");
    }
}

#[test]
fn values_show_no_control_characters() {
    // JSON escapes those below a space by itself, and not these.
    let message = message(r#"{ "name": ["\u009b2J\u007f"] }"#);
    assert!(message.contains("\\u{9b}2J\\u{7f}"), "{message:?}");
}
