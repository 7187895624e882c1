//! The `righting` program as its users run it: exit codes, messages, files.

mod bad_input;
#[cfg(unix)]
mod book;
#[cfg(unix)]
mod browser;
#[cfg(target_os = "linux")]
mod color;
mod compare;
mod completions;
mod crates;
mod documents;
mod envelope;
mod explain;
mod export;
mod figures;
mod full_disk;
mod import;
#[cfg(unix)]
mod interrupted;
mod kinds;
mod library;
mod machine;
mod manpages;
#[cfg(unix)]
mod page;
mod power;
mod program;
mod reach;
mod scenarios;
mod solve;
mod standard_input;
mod streams;
mod sweep;
mod sweep_faults;
mod usage;
mod verify;
mod warm_start;
