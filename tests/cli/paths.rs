//! Paths that are hard to open or to print: not UTF-8, very long, links, links that go in circles.

use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::symlink;
use std::path::Path;

use serde_json::json;

use crate::program::{Run, files_in, folder_with, righting, small_slew};

const QUICK: [&str; 3] = ["--no-report", "--figures", "none"];

fn solve(folder: &Path, scenario: impl AsRef<OsStr>, out: impl AsRef<OsStr>, more: &[&str]) -> Run {
    let mut arguments: Vec<OsString> = ["solve".into(), scenario.as_ref().into()].to_vec();
    arguments.extend(["--out".into(), out.as_ref().into()]);
    arguments.extend(QUICK.iter().chain(more).map(OsString::from));
    righting(folder, &arguments)
}

#[test]
fn paths_need_not_be_utf_8() {
    let folder = folder_with(&small_slew());
    let (scenario, out) = (OsStr::from_bytes(b"sc\xff.json"), OsStr::from_bytes(b"o\xfeut"));
    std::fs::rename(folder.path().join("scenario.json"), folder.path().join(scenario))
        .expect("a file system that takes any name");
    let run = solve(folder.path(), scenario, out, &[]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(files_in(&folder.path().join(out)), ["solution.json", "trajectory.csv"]);
    assert_eq!(righting(folder.path(), &[OsStr::new("verify"), out]).code, 0);
    // JSON has no such texts: the paths in it are nearly right, and everything else is.
    for (command, out) in [("solve", out), ("verify", out)] {
        let run = match command {
            "solve" => solve(folder.path(), scenario, out, &["--json"]),
            _ => righting(folder.path(), &[OsStr::new("verify"), out, OsStr::new("--json")]),
        };
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{command}");
        assert!(run.json().is_object(), "{command}");
    }
    // Whoever writes such a name into an error writes one line.
    let missing = solve(folder.path(), OsStr::from_bytes(b"no\xff\n.json"), "other", &[]);
    missing.assert_refused("cannot be read: no such file");
}

#[test]
fn names_that_are_too_long_are_refused_at_once() {
    let folder = folder_with(&small_slew());
    let name = "n".repeat(300);
    let deep = "d/".repeat(3000);
    for long in [&name, &deep] {
        solve(folder.path(), long, "out", &[]).assert_refused("cannot be read: file name too long");
        solve(folder.path(), "scenario.json", long, &[]).assert_refused("cannot hold results");
        righting(folder.path(), &["verify", long]).assert_refused("file name too long");
    }
    let mut elsewhere = small_slew();
    elsewhere["system"] = json!(name);
    std::fs::write(folder.path().join("scenario.json"), elsewhere.to_string()).expect("writable");
    solve(folder.path(), "scenario.json", "out", &[]).assert_refused("file name too long");
}

#[test]
fn links_are_followed_and_circles_are_not() {
    let folder = folder_with(&small_slew());
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("real")).expect("writable");
    symlink("real", path("link")).expect("links");
    symlink("scenario.json", path("linked.json")).expect("links");
    symlink("circle", path("circle")).expect("links");
    symlink("nowhere", path("dangling")).expect("links");
    assert_eq!(solve(folder.path(), "linked.json", "link", &[]).code, 0);
    assert_eq!(files_in(&path("real")), ["solution.json", "trajectory.csv"]);
    // A result that is a link is replaced, and what it led to stays.
    std::fs::write(path("mine"), "mine").expect("writable");
    std::fs::remove_file(path("real/trajectory.csv")).expect("there");
    symlink("../mine", path("real/trajectory.csv")).expect("links");
    assert_eq!(solve(folder.path(), "linked.json", "link", &[]).code, 0);
    assert_eq!(std::fs::read_to_string(path("mine")).expect("there"), "mine");
    assert_eq!(righting(folder.path(), &["verify", "real"]).code, 0);

    let circle = solve(folder.path(), "circle", "out", &[]);
    circle.assert_refused("circle: cannot be read: too many levels of symbolic links");
    for out in ["circle", "circle/out", "dangling"] {
        solve(folder.path(), "scenario.json", out, &[]).assert_refused("cannot hold results: ");
    }
    let mut elsewhere = small_slew();
    elsewhere["system"] = json!("circle");
    std::fs::write(path("scenario.json"), elsewhere.to_string()).expect("writable");
    solve(folder.path(), "scenario.json", "out", &[]).assert_refused("symbolic links");
}
