//! JSON files that people read and change: what fits in a line stands in one.

use serde::Serialize;

use crate::failure::Failure;
use crate::output::to_json;

/// Characters of a line.
const WIDTH: usize = 110;

/// A value as JSON with its fields in their order, ending with a line.
pub fn readable_json(value: &impl Serialize) -> Result<String, Failure> {
    let mut written = String::new();
    write(&one_line(&to_json(value)?), 0, &mut written);
    written.push('\n');
    Ok(written)
}

/// JSON on one line, with a space after every comma and colon.
fn one_line(pretty: &str) -> String {
    let mut line = String::new();
    for part in pretty.lines().map(str::trim) {
        let is_spaced = line.ends_with(',') || line.ends_with('{') || part.starts_with('}');
        if is_spaced && !line.is_empty() {
            line.push(' ');
        }
        line.push_str(part);
    }
    line
}

/// Writes JSON of one line, over more where it is too long or the whole file.
fn write(json: &str, indent: usize, written: &mut String) {
    let is_container = json.starts_with(['{', '[']);
    let fits = json.len() + 2 * indent <= WIDTH && indent > 0;
    if fits || !is_container {
        written.push_str(json);
        return;
    }
    let (open, close) = (&json[..1], &json[json.len() - 1..]);
    written.push_str(open);
    let members = members(json[1..json.len() - 1].trim());
    for (index, member) in members.iter().enumerate() {
        written.push_str(if index == 0 { "\n" } else { ",\n" });
        written.push_str(&"  ".repeat(indent + 1));
        let key_end = if open == "{" { end_of_key(member) } else { 0 };
        written.push_str(&member[..key_end]);
        write(&member[key_end..], indent + 1, written);
    }
    written.push('\n');
    written.push_str(&"  ".repeat(indent));
    written.push_str(close);
}

/// The members of an object or an array between its brackets.
fn members(inside: &str) -> Vec<&str> {
    let (mut members, mut start) = (Vec::new(), 0);
    let mut depth = 0_usize;
    for (at, byte) in outside_strings(inside) {
        match byte {
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth -= 1,
            b',' if depth == 0 => {
                members.push(inside[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    if !inside[start..].trim().is_empty() {
        members.push(inside[start..].trim());
    }
    members
}

/// Where the value of an object's member begins.
fn end_of_key(member: &str) -> usize {
    let colon = outside_strings(member).find(|(_, byte)| *byte == b':');
    colon.map_or(0, |(at, _)| at + 2)
}

/// The bytes that are part of no string, with their places.
fn outside_strings(json: &str) -> impl Iterator<Item = (usize, u8)> + '_ {
    let (mut is_inside, mut is_escaped) = (false, false);
    json.bytes().enumerate().filter(move |(_, byte)| {
        let was_inside = is_inside;
        match byte {
            b'"' if !is_escaped => is_inside = !is_inside,
            b'\\' if is_inside && !is_escaped => {
                is_escaped = true;
                return false;
            }
            _ => {}
        }
        is_escaped = false;
        !was_inside && *byte != b'"'
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn what_fits_stands_in_a_line_and_all_is_the_same() {
        let value = json!({
            "name": "a \"b\", {c]: d\\",
            "bodies": [
                { "mass_kg": 1.0, "inertia_kg_m2": [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]] },
                { "name": "x".repeat(80), "shapes": [{ "sphere": { "radius_m": 1e-3 } }], "empty": [] },
            ],
        });
        let text = readable_json(&value).unwrap();
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
        assert!(
            text.contains("\"inertia_kg_m2\": [[1.0,0.0,0.0]") || text.contains("[[1.0, 0.0, 0.0]")
        );
        assert!(text.lines().all(|line| line.len() <= WIDTH), "{text}");
        assert!(text.lines().count() < 14, "{text}");
    }
}
