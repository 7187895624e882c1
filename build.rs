//! Stamps into the binary what it was built from.
//!
//! Without a git checkout the stamp is empty, so that a release archive builds the same bytes
//! wherever it is unpacked.

use std::env;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let root = env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
    let git = Path::new(&root).join(".git");
    // A .git further up would describe some other repository.
    let revision = if git.exists() {
        // In a linked worktree they lie elsewhere.
        for name in ["HEAD", "index"] {
            let place = first_line("git", &["-C", &root, "rev-parse", "--git-path", name]);
            let watched = Path::new(&root).join(place);
            if watched.is_file() {
                println!("cargo::rerun-if-changed={}", watched.display());
            }
        }
        first_line("git", &["-C", &root, "describe", "--always", "--tags", "--dirty"])
    } else {
        String::new()
    };
    let rustc = env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let rustc = first_line(&rustc, &["--version"]);
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    let version = if revision.is_empty() { version } else { format!("{version} ({revision})") };
    println!("cargo::rustc-env=RIGHTING_VERSION={version}");
    println!("cargo::rustc-env=RIGHTING_RUSTC={}", rustc.trim_start_matches("rustc "));
    println!("cargo::rustc-env=RIGHTING_TARGET={}", env::var("TARGET").unwrap_or_default());
}

/// The first line that a command prints; empty if it cannot be run or fails.
fn first_line(command: &str, arguments: &[&str]) -> String {
    let output = Command::new(command).args(arguments).stderr(std::process::Stdio::null()).output();
    match output {
        Ok(output) if output.status.success() => {
            String::from_utf8_lossy(&output.stdout).lines().next().unwrap_or("").trim().to_owned()
        }
        _ => String::new(),
    }
}
