//! Manual pages: one a command, as `man` reads them.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{files_in, folder_with, righting};

const PAGES: [&str; 23] = [
    "righting-compare.1",
    "righting-completions.1",
    "righting-doctor.1",
    "righting-envelope.1",
    "righting-explain.1",
    "righting-export.1",
    "righting-figures.1",
    "righting-fly.1",
    "righting-import.1",
    "righting-manpages.1",
    "righting-power.1",
    "righting-reach.1",
    "righting-report.1",
    "righting-schema.1",
    "righting-solve.1",
    "righting-sweep-merge.1",
    "righting-sweep-plan.1",
    "righting-sweep-run.1",
    "righting-sweep-show.1",
    "righting-sweep-slurm.1",
    "righting-sweep.1",
    "righting-verify.1",
    "righting.1",
];

fn written() -> tempfile::TempDir {
    let folder = folder_with(&serde_json::json!({}));
    let run = righting(folder.path(), &["manpages", "man/man1"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let mut listed: Vec<&str> = run.stdout.lines().collect();
    listed.sort_unstable();
    let expected: Vec<String> = PAGES.iter().map(|page| format!("man/man1/{page}")).collect();
    assert_eq!(listed, expected);
    folder
}

fn read(folder: &Path, page: &str) -> String {
    std::fs::read_to_string(folder.join("man/man1").join(page)).expect("readable")
}

#[test]
fn every_command_has_its_page_and_nothing_else_is_left() {
    let folder = written();
    assert_eq!(files_in(&folder.path().join("man/man1")), PAGES);
    for page in PAGES {
        let text = read(folder.path(), page);
        let name = page.strip_suffix(".1").expect("section 1");
        assert!(text.contains(&format!(".TH {name} 1 ")), "{text}");
        for section in
            [".SH NAME", ".SH SYNOPSIS", ".SH DESCRIPTION", ".SH OPTIONS", ".SH \"EXIT STATUS\""]
        {
            assert!(text.contains(section), "{page}: {section}");
        }
    }
    let whole = read(folder.path(), "righting.1");
    assert!(whole.contains("righting\\-solve(1)") && !whole.contains("sweep\\-worker"), "{whole}");
    let solve = read(folder.path(), "righting-solve.1");
    assert!(solve.contains("\\-\\-warm\\-start"), "{solve}");
    // Again is as good.
    assert_eq!(righting(folder.path(), &["manpages", "man/man1"]).code, 0);
    assert_eq!(read(folder.path(), "righting.1"), whole);
}

#[test]
fn a_file_in_the_place_of_the_folder_is_said_to_be_there() {
    let folder = folder_with(&serde_json::json!({}));
    let run = righting(folder.path(), &["manpages", "scenario.json"]);
    let message = "error: scenario.json: cannot hold results: a file is in its place\n  hint: name \
                   another folder\n";
    assert_eq!((run.code, run.stderr.as_str()), (2, message));
}

/// Where groff is, it renders every page without a warning.
#[test]
#[cfg(unix)]
fn groff_renders_the_pages() {
    let folder = written();
    for page in PAGES {
        let file = folder.path().join("man/man1").join(page);
        let mut groff = Command::new("groff");
        groff.args(["-man", "-ww", "-Tascii", "-P-cbou"]).arg(file).stdin(Stdio::null());
        let Ok(output) = groff.output() else { return };
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.is_empty(), "{page}: {said}");
        let shown = String::from_utf8(output.stdout).expect("ASCII");
        assert!(shown.contains("\nNAME\n") && shown.contains("\nSYNOPSIS\n"), "{shown}");
        assert!(shown.contains("\n       130    interrupted\n"), "{shown}");
    }
}
