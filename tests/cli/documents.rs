//! What the documents say is so.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

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
    let [scenario, rows, bodies] = examples.as_slice() else {
        panic!("a scenario and two systems")
    };

    let place = root().join("scenarios/readme.json");
    righting_scenario::Scenario::parse(&scenario.to_string(), &place).expect("accepted");

    for (system, joint_angles_deg) in [(rows, vec![0, 0]), (bodies, vec![0])] {
        let mut with_system = scenario.clone();
        with_system["system"] = system.clone();
        with_system["initial"]["joint_angles_deg"] = serde_json::json!(joint_angles_deg);
        righting_scenario::Scenario::parse(&with_system.to_string(), &place).expect("accepted");
    }
}

#[test]
fn every_place_that_a_document_links_to_is_there() {
    // What the book's own pages link to is another thing: their place is in the book.
    let book = root().join("book/src");
    for document in documents().into_iter().filter(|document| !document.starts_with(&book)) {
        let text = std::fs::read_to_string(&document).expect("a document");
        let folder = document.parent().expect("a folder");
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if target.contains("://") {
                continue;
            }
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() { document.clone() } else { folder.join(file) };
            assert!(file.exists(), "{} links to {target}", document.display());
            if !heading.is_empty() {
                let linked = std::fs::read_to_string(&file).expect("a document");
                let is_there = linked.lines().any(|line| anchor(line).as_deref() == Some(heading));
                assert!(is_there, "{} links to {target}", document.display());
            }
        }
    }
}

#[test]
fn every_command_and_option_of_the_documents_exists() {
    let mut help = Help::new();
    let mut seen = 0;
    for document in documents() {
        let text = std::fs::read_to_string(&document).expect("a document");
        for code in code(&text) {
            for call in calls(code) {
                help.check(call, &format!("{}: {code}", document.display()));
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "only {seen} commands found");
}

#[test]
fn every_make_target_of_the_documents_exists() {
    let makefile = std::fs::read_to_string(root().join("Makefile")).expect("a Makefile");
    let mut seen = 0;
    for document in documents() {
        let text = std::fs::read_to_string(&document).expect("a document");
        for code in code(&text).iter().filter(|code| code.starts_with("make ")) {
            let target = code.split_whitespace().nth(1).expect("a target");
            let rule = format!("\n{target}:");
            assert!(makefile.contains(&rule), "{}: {code}", document.display());
            seen += 1;
        }
    }
    assert!(seen > 5, "only {seen} targets found");
}

#[test]
fn the_first_sixty_lines_of_the_readme_say_how_to_begin() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("a README");
    let beginning: Vec<&str> = readme.lines().take(60).collect();
    for step in ["git clone ", "make demo ", "make test ", "cargo install --path ."] {
        assert!(beginning.iter().any(|line| line.starts_with(step)), "{step}");
    }
    assert!(beginning.iter().any(|line| line.contains("out/demo/report.html")));
}

#[test]
fn versions_in_the_documents_are_those_of_the_sources() {
    let read = |file: &str| std::fs::read_to_string(root().join(file)).expect(file);
    let version = format!("\nversion: {}\n", env!("CARGO_PKG_VERSION"));
    assert!(read("CITATION.cff").contains(&version), "CITATION.cff: expected{version}");

    let version = format!("\nversion = \"{}\"\n", env!("CARGO_PKG_VERSION"));
    assert!(read("python/Cargo.toml").contains(&version), "python/Cargo.toml: expected{version}");

    let package: Value =
        serde_json::from_str(&read("crates/report/page/package.json")).expect("JSON");
    let notice = read("NOTICE");
    for (name, dependency) in [("three.js", "three"), ("uPlot", "uplot")] {
        let version = package["dependencies"][dependency].as_str().expect("a version");
        assert!(notice.contains(&format!("{name} {version}")), "NOTICE: expected {name} {version}");
    }
}

/// Every Markdown file of the project itself.
fn documents() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let crates = std::fs::read_dir(root().join("crates")).expect("crates");
    let crates = crates.map(|entry| entry.expect("a crate").path());
    let folders = [
        root(),
        root().join("docs"),
        root().join("book/src"),
        root().join("ipopt-sys"),
        root().join("python"),
    ];
    for folder in folders.into_iter().chain(crates) {
        let files = std::fs::read_dir(folder).expect("a folder");
        let files = files.map(|entry| entry.expect("a file").path());
        found.extend(files.filter(|file| file.extension() == Some("md".as_ref())));
    }
    assert!(found.len() > 8, "{found:?}");
    found
}

/// What a document shows as code: spans, and lines of fenced blocks without their comments.
fn code(text: &str) -> Vec<&str> {
    let mut is_fenced = false;
    let mut found = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            is_fenced = !is_fenced;
        } else if is_fenced {
            found.extend(line.split(" #").next());
        } else {
            found.extend(line.split('`').skip(1).step_by(2));
        }
    }
    found
}

/// What follows the program's name where it is called: first on a line, or quoted for another shell.
fn calls(code: &str) -> impl Iterator<Item = &str> {
    let called = |(at, name): (usize, &str)| {
        let before = code[..at].trim_start();
        (before.is_empty() || before.ends_with('\'')).then(|| &code[at + name.len()..])
    };
    code.match_indices("righting ").filter_map(called)
}

/// The anchor of a heading, as the usual hosts make it; `None` of any other line.
pub fn anchor(line: &str) -> Option<String> {
    let heading = line.strip_prefix('#')?.trim_start_matches('#').trim();
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    Some(kept.collect::<String>().to_lowercase().replace(' ', "-"))
}

/// What the program says about its commands, asked once each.
struct Help {
    folder: TempDir,
    texts: HashMap<String, String>,
}

impl Help {
    fn new() -> Self {
        Self { folder: folder_with(&serde_json::json!({})), texts: HashMap::new() }
    }

    fn of(&mut self, command: &str) -> &str {
        let folder: &Path = self.folder.path();
        self.texts.entry(command.to_owned()).or_insert_with(|| {
            let arguments: Vec<&str> = command.split_whitespace().chain(["--help"]).collect();
            righting(folder, &arguments).stdout
        })
    }

    fn has_command(&mut self, command: &str, name: &str) -> bool {
        let is_word = !name.is_empty() && name.chars().all(|c| c.is_ascii_lowercase() || c == '-');
        is_word && self.of(command).contains(&format!("\n  {name} "))
    }

    /// A call as written in a document, without the program's name: its command and its options.
    fn check(&mut self, call: &str, place: &str) {
        let words = call.split_whitespace().map(|word| {
            word.trim_matches(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '-' | '…'))
        });
        let mut command = String::new();
        for (index, word) in words.enumerate() {
            if let Some(option) = word.strip_prefix("--") {
                let option = option.split('=').next().expect("a name");
                assert!(self.of(&command).contains(&format!("--{option}")), "{place}: --{option}");
            } else if index < 2 && self.has_command(&command, word) {
                command = format!("{command} {word}").trim().to_owned();
            } else {
                assert!(index > 0, "{place}: no command `{word}`");
            }
        }
    }
}
