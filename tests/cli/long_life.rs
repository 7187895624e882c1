//! Folders that earlier versions wrote: they open, and what was verified stays verified.

use std::path::PathBuf;

use crate::program::{files_in, righting, root};

/// Folders of `righting.solution/1`, each named by when it was written; none is ever changed.
fn folders() -> Vec<PathBuf> {
    let fixtures = root().join("tests/fixtures/solution-1");
    files_in(&fixtures).into_iter().map(|name| fixtures.join(name)).collect()
}

#[test]
fn plans_of_earlier_versions_stay_verified() {
    assert!(folders().len() >= 3);
    for folder in folders() {
        let run = righting(&root(), &["verify".as_ref(), folder.as_os_str(), "--json".as_ref()]);
        assert_eq!(run.code, 0, "{folder:?}: {}", run.stderr);
        assert_eq!(run.json()["verification"]["passed"], true, "{folder:?}");
    }
}

#[test]
fn every_command_that_takes_a_plan_takes_an_earlier_one() {
    for folder in folders() {
        let out = tempfile::tempdir().expect("a temporary folder");
        for name in files_in(&folder) {
            std::fs::copy(folder.join(&name), out.path().join(name)).expect("writable");
        }
        for command in ["report", "figures", "power", "explain"] {
            let run = righting(out.path(), &[command, "."]);
            assert_eq!(run.code, 0, "{command} {folder:?}: {}", run.stderr);
        }
        let run = righting(out.path(), &["export", ".", "--format", "npz"]);
        assert_eq!(run.code, 0, "{folder:?}: {}", run.stderr);
    }
}
