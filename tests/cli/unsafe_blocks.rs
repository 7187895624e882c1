//! Where code is unsafe: counted here and in docs/reliability.md, argued where it stands.

use std::collections::BTreeMap;
use std::path::Path;

use crate::program::root;

/// Rust files beneath a folder.
fn rust_files(folder: &Path, files: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let name = entry.file_name();
        if path.is_dir() && name != "target" && name != "node_modules" {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// The crate that a file belongs to, by its folder.
fn package_of(file: &Path) -> String {
    let relative = file.strip_prefix(root()).expect("in the repository");
    let mut parts = relative.iter().map(|part| part.to_string_lossy().into_owned());
    match parts.next().as_deref() {
        Some("crates") => format!("crates/{}", parts.next().unwrap_or_default()),
        Some(folder) => folder.to_owned(),
        None => String::new(),
    }
}

#[test]
fn every_unsafe_block_is_argued_and_counted() {
    let mut files = Vec::new();
    for folder in ["src", "crates", "ipopt-sys"] {
        rust_files(&root().join(folder), &mut files);
    }
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for file in files {
        let text = std::fs::read_to_string(&file).expect("readable");
        let lines: Vec<&str> = text.lines().collect();
        for (number, line) in lines.iter().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            if !(code.contains("unsafe {") || code.contains("unsafe impl")) {
                continue;
            }
            *counts.entry(package_of(&file)).or_default() += 1;
            // The argument stands in the lines of the comment above the statement.
            let before = lines[number.saturating_sub(8)..=number].iter();
            let is_argued = before.clone().any(|line| line.contains("SAFETY:"));
            assert!(is_argued, "{}:{}: no SAFETY comment", file.display(), number + 1);
        }
    }
    let page = std::fs::read_to_string(root().join("docs/reliability.md")).expect("readable");
    for (package, count) in &counts {
        let row = format!("| `{package}` | {count} |");
        assert!(page.contains(&row), "docs/reliability.md does not say {row}");
    }
    let packages: Vec<&str> = counts.keys().map(String::as_str).collect();
    assert_eq!(packages, ["crates/ipopt", "crates/symbolic", "ipopt-sys"]);
}
