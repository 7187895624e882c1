//! Shell completions: as a shell uses them.

use std::process::{Command, Stdio};

use crate::program::{folder_with, righting};

fn script(shell: &str) -> String {
    let folder = folder_with(&serde_json::json!({}));
    let run = righting(folder.path(), &["completions", shell]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{shell}");
    run.stdout
}

/// What bash offers once it has sourced the script and the last of `words` is to be completed.
#[cfg(unix)]
fn offered(words: &[&str]) -> Vec<String> {
    let folder = folder_with(&serde_json::json!({}));
    std::fs::write(folder.path().join("righting.bash"), script("bash")).expect("writable");
    let bash = "set -eu; source ./righting.bash; complete -p righting >/dev/null; \
                COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); \
                _righting righting \"${COMP_WORDS[COMP_CWORD]}\" \"${COMP_WORDS[COMP_CWORD - 1]}\"; \
                printf '%s\\n' \"${COMPREPLY[@]}\"";
    let output = Command::new("bash")
        .args(["--norc", "-c", bash, "bash"])
        .args(words)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .expect("bash is there");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let offered = String::from_utf8(output.stdout).expect("UTF-8");
    offered.lines().map(str::to_owned).collect()
}

#[test]
#[cfg(unix)]
fn bash_completes_commands_options_and_values() {
    assert_eq!(offered(&["righting", "so"]), ["solve"]);
    // The command of the workers is not for people.
    assert_eq!(offered(&["righting", "sw"]), ["sweep"]);
    assert_eq!(offered(&["righting", "sweep", "sl"]), ["slurm"]);
    assert_eq!(offered(&["righting", "solve", "--wa"]), ["--warm-start"]);
    assert_eq!(offered(&["righting", "solve", "--figures", "us"]), ["usual"]);
    assert_eq!(offered(&["righting", "schema", "sy"]), ["system"]);
    assert_eq!(offered(&["righting", "completions", "z"]), ["zsh"]);
}

#[test]
fn every_shell_has_a_script_that_names_every_command() {
    let folder = folder_with(&serde_json::json!({}));
    let help = righting(folder.path(), &["--help"]).stdout;
    let (_, listed) = help.split_once("Commands:\n").expect("a list");
    let (listed, _) = listed.split_once("\n\n").expect("an end");
    let commands: Vec<&str> =
        listed.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(commands.contains(&"completions") && commands.contains(&"solve"), "{commands:?}");
    for (shell, mark) in [
        ("bash", "complete -F _righting"),
        ("zsh", "#compdef righting"),
        ("fish", "complete -c righting"),
        ("elvish", "edit:completion:arg-completer[righting]"),
        ("powershell", "Register-ArgumentCompleter"),
    ] {
        let script = script(shell);
        assert!(script.contains(mark), "{shell}");
        assert!(!script.contains("sweep-worker"), "{shell}");
        for command in &commands {
            assert!(script.contains(command), "{shell}: {command}");
        }
    }
}

/// Shells that are here read their script without a complaint.
#[test]
#[cfg(unix)]
fn shells_take_their_scripts() {
    for (shell, check) in [("bash", "-n"), ("zsh", "-n"), ("fish", "--no-execute")] {
        let folder = folder_with(&serde_json::json!({}));
        let file = folder.path().join("script");
        std::fs::write(&file, script(shell)).expect("writable");
        if let Ok(output) = Command::new(shell).arg(check).arg(&file).output() {
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && said.is_empty(), "{shell}: {said}");
        }
    }
}
