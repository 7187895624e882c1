//! `report.html`, the maneuver to look at, `compare.html`, several of them, and `slews.html`, a sweep: files that
//! need nothing else.

mod columns;
mod compare;
mod cones;
mod data;
mod slews;
mod wheels;

use righting_results::{Solution, Trajectory};
use righting_scenario::Scenario;
use serde::Serialize;

pub use compare::compare_html;
use data::PageData;
pub use slews::slews_html;

const TEMPLATE: &str = include_str!("../../page/report.html");
const SCRIPT: &str = include_str!("../../page/dist/report.js");
const STYLE: &str = include_str!("../../page/dist/report.css");

/// The page of a plan, as an HTML document that opens from disk and loads nothing: spacecraft and
/// arm moving in three dimensions, plots on the same time line, the verdict and the numbers.
///
/// `scenario` is that of the solution. Of a plan with more than a thousand intervals, evenly chosen
/// nodes are shown.
pub fn report_html(scenario: &Scenario, solution: &Solution, trajectory: &Trajectory) -> String {
    let data = in_script(&PageData::new(scenario, solution, trajectory));
    let title = escaped(scenario.name());
    fill(TEMPLATE, &[("title", &title), ("style", STYLE), ("data", &data), ("script", SCRIPT)])
}

/// JSON that may stand in a script element, where only the character that could end it matters.
fn in_script(data: &impl Serialize) -> String {
    let data = serde_json::to_string(data).expect("plain structs of text and numbers become JSON");
    data.replace('<', "\\u003c")
}

/// Puts each part where the template has its name in double braces.
fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let length: usize = parts.iter().map(|(_, text)| text.len()).sum();
    let mut page = String::with_capacity(template.len() + length);
    let mut pieces = template.split("{{");
    page.extend(pieces.next());
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").expect("the template closes its braces");
        let part = parts.iter().find(|(part, _)| *part == name);
        page.push_str(part.expect("the template names parts that there are").1);
        page.push_str(rest);
    }
    page
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use sha2::{Digest, Sha256};

    use super::*;

    #[test]
    fn parts_are_put_in_once() {
        assert_eq!(fill("a{{x}}b{{y}}", &[("y", "2"), ("x", "{{y}}")]), "a{{y}}b2");
    }

    #[test]
    fn nothing_in_the_bundle_ends_its_element() {
        for script in [SCRIPT, compare::SCRIPT, slews::SCRIPT] {
            for forbidden in ["</script", "<!--"] {
                assert!(!script.to_lowercase().contains(forbidden), "{forbidden}");
            }
        }
        for style in [STYLE, compare::STYLE, slews::STYLE] {
            assert!(!style.to_lowercase().contains("</style"));
        }
    }

    #[test]
    fn the_bundle_keeps_the_licences_of_what_is_in_it() {
        for part in ["three.js authors", "Leon Sorokin", "Permission is hereby granted"] {
            for script in [SCRIPT, compare::SCRIPT, slews::SCRIPT] {
                assert!(script.contains(part), "{part}");
            }
        }
    }

    /// As `page/build.mjs` computes it.
    #[test]
    fn the_bundle_was_made_from_the_sources_beside_it() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("page");
        let sources = std::fs::read_dir(folder.join("src")).expect("the page has sources");
        let mut sources: Vec<PathBuf> = sources
            .map(|entry| Path::new("src").join(entry.expect("readable").file_name()))
            .collect();
        sources.sort();
        let settings = ["build.mjs", "package-lock.json", "package.json", "tsconfig.json"];
        let files = settings.into_iter().map(PathBuf::from).chain(sources);
        let mut digest = Sha256::new();
        for file in files {
            digest.update(format!("{}\n", file.display()));
            digest.update(std::fs::read(folder.join(&file)).expect("readable"));
        }
        let digest: String = digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        let scripts = [SCRIPT, compare::SCRIPT, slews::SCRIPT];
        for bundle in scripts.into_iter().chain([STYLE, compare::STYLE, slews::STYLE]) {
            let made_from = bundle.lines().next().unwrap_or_default();
            assert!(made_from.contains(&digest), "the bundle is stale: run `make page`");
        }
    }
}
