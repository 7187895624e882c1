//! What the command line accepts, and what it says otherwise.

use std::path::Path;

use crate::program::righting;

fn run(arguments: &[&str]) -> crate::program::Run {
    righting(Path::new("."), arguments)
}

#[test]
fn help_and_version_are_results() {
    for arguments in [&["--help"][..], &["--version"], &["help", "solve"], &["solve", "--help"]] {
        let run = run(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
        assert!(!run.stdout.is_empty());
    }
    assert!(run(&["--version"]).stdout.starts_with("righting 0."));
    assert!(run(&["--help"]).stdout.contains("130  interrupted"));
}

#[test]
fn wrong_usage_exits_with_2_and_says_what_is_right() {
    for (arguments, part) in [
        (&[][..], "Usage"),
        (&["sovle"], "'solve'"),
        (&["solve"], "--out <DIR>"),
        (&["solve", "a.json"], "--out <DIR>"),
        (&["solve", "a.json", "--out"], "value is required"),
        (&["solve", "a.json", "--out", ""], "value is required"),
        (&["solve", "a.json", "--out", "b", "--jsno"], "--json"),
        (&["verify"], "<DIR>"),
        (&["verify", "a", "b"], "unexpected argument 'b'"),
        (&["schema", "sytem"], "system"),
        // What would be ignored is refused.
        (&["reach", "a.json", "--png"], "--out <DIR>"),
        (&["explain", "a.json", "--png"], "--out <DIR>"),
        (&["solve", "a.json", "--out", "b", "--figures", "none", "--png"], "no figure to write"),
        (&["export", "a", "--format", "npz", "--frame", "ICRF"], "holds the plan alone"),
        (&["export", "a", "--format", "aem", "--naif-id", "-5"], "no NAIF ID"),
        (&["export", "a", "--format", "stk", "--object-name", "A"], "and no names"),
        (&["export", "a", "--format", "ck", "--originator", "A"], "no originator"),
    ] {
        let run = run(arguments);
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
        assert_eq!(run.stdout, "", "{arguments:?}");
    }
}
