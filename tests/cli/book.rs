//! The book: what it tells to run runs, and what it links to is there.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::documents::anchor;
use crate::program::root;

/// Commands of documents that need files of other projects.
const NOT_OURS: [&str; 2] =
    ["righting import panda_collision.urdf ", "righting import ur5_robot.urdf "];

/// What documents call `robot.urdf`, with the links and joints that they name.
const ROBOT: &str = r#"<robot name="robot">
  <link name="base_link"><inertial><mass value="100"/>
    <inertia ixx="10" iyy="10" izz="10" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="upper"><inertial><origin xyz="0 0 0.2"/><mass value="3"/>
    <inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tool0"><inertial><origin xyz="0 0 0.2"/><mass value="2"/>
    <inertia ixx="0.03" iyy="0.03" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="gripper"/>
  <joint name="shoulder" type="revolute"><parent link="base_link"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" velocity="0.5" effort="20"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="tool0"/><origin xyz="0 0 0.4"/>
    <axis xyz="1 0 0"/><limit lower="-2" upper="2" velocity="0.5" effort="20"/></joint>
  <joint name="grip" type="fixed"><parent link="tool0"/><child link="gripper"/></joint>
</robot>"#;
const BUS: &str = r#"{ "mass_kg": 150, "cube_side_m": 1.0 }"#;

/// A folder with the shipped scenarios and what documents take for granted.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::os::unix::fs::symlink(root().join("scenarios"), folder.path().join("scenarios"))
        .expect("a link");
    for (name, text) in [("robot.urdf", ROBOT), ("bus.json", BUS)] {
        std::fs::write(folder.path().join(name), text).expect("writable");
    }
    folder
}

/// Runs shell commands as a reader types them, in the folder of the project.
fn run(commands: &str, folder: &Path, page: &Path) {
    let program = Path::new(env!("CARGO_BIN_EXE_righting"));
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(program.parent().expect("a folder").to_owned())
        .chain(std::env::split_paths(&path));
    let output = Command::new("bash")
        .args(["-euo", "pipefail", "-c", commands])
        .current_dir(folder)
        .env("PATH", std::env::join_paths(folders).expect("a path"))
        .output()
        .expect("bash starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}:\n{commands}\n{stderr}", page.display());
}

/// The fenced blocks of a document: their language and their text.
fn blocks(text: &str) -> Vec<(&str, &str)> {
    let fenced = text.split("\n```").skip(1).step_by(2);
    fenced.filter_map(|block| block.split_once('\n')).collect()
}

fn without_comment(line: &str) -> &str {
    line.split(" #").next().unwrap_or(line).trim_end()
}

fn read(page: &Path) -> String {
    std::fs::read_to_string(page).unwrap_or_else(|error| panic!("{}: {error}", page.display()))
}

/// The pages that SUMMARY.md names, by their paths in the book.
fn summary() -> Vec<String> {
    let text = read(&root().join("book/src/SUMMARY.md"));
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.map(str::to_owned).collect()
}

/// Where a page of the book stands in the project; none of one that the program's own account makes.
fn source(page: &str) -> Option<PathBuf> {
    let own = root().join("book/src").join(page);
    match (own.exists(), page.starts_with("reference/")) {
        (true, _) => Some(own),
        (false, true) => None,
        (false, false) => Some(root().join(page)),
    }
}

fn is_own(page: &Path) -> bool {
    page.starts_with(root().join("book"))
}

#[test]
fn every_command_of_the_book_s_own_pages_runs_in_its_order() {
    let mut ran = 0;
    for page in summary().iter().filter_map(|page| source(page)).filter(|page| is_own(page)) {
        let folder = folder();
        for (language, block) in blocks(&read(&page)) {
            if language == "sh" {
                run(block, folder.path(), &page);
                ran += 1;
            }
        }
    }
    assert!(ran > 20, "only {ran} blocks");
}

#[test]
fn every_command_of_the_documents_in_the_book_runs() {
    let folder = folder();
    let mut known = HashSet::new();
    for page in summary().iter().filter_map(|page| source(page)).filter(|page| !is_own(page)) {
        for (language, block) in blocks(&read(&page)) {
            if language != "sh" {
                continue;
            }
            let whole_lines = block.replace("\\\n", " ");
            for line in whole_lines.lines().filter(|line| line.starts_with("righting ")) {
                let is_ours = !NOT_OURS.iter().any(|other| line.starts_with(other));
                if is_ours && known.insert(without_comment(line).to_owned()) {
                    run(line, folder.path(), &page);
                }
            }
        }
    }
    assert!(known.len() > 8, "only {known:?}");
}

#[test]
fn no_command_hides_in_a_block_that_is_not_run() {
    for page in summary().iter().filter_map(|page| source(page)) {
        for (language, block) in blocks(&read(&page)) {
            let command = block.lines().find(|line| line.starts_with("righting "));
            assert!(language == "sh" || command.is_none(), "{}: {command:?}", page.display());
        }
    }
}

#[test]
fn every_page_of_the_book_is_in_its_summary_and_links_to_what_is_there() {
    let summary = summary();
    let own = std::fs::read_dir(root().join("book/src")).expect("the book");
    for file in own.map(|entry| entry.expect("a page").file_name()) {
        let name = file.to_string_lossy().into_owned();
        assert!(name == "SUMMARY.md" || summary.contains(&name), "{name} is in no summary");
    }
    for page in &summary {
        let Some(file) = source(page) else { continue };
        let text = read(&file);
        if !is_own(&file) {
            continue;
        }
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let (linked, heading) = target.split_once('#').unwrap_or((target, ""));
            assert!(summary.iter().any(|page| page == linked), "{page} links to {target}");
            if let Some(linked) = source(linked).filter(|_| !heading.is_empty()) {
                let is_there =
                    read(&linked).lines().any(|line| anchor(line).as_deref() == Some(heading));
                assert!(is_there, "{page} links to {target}");
            }
        }
    }
}
