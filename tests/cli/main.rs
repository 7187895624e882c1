//! The `righting` program as its users run it: exit codes, messages, files.

mod bad_input;
mod bad_limits;
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
mod fly;
#[cfg(target_os = "linux")]
mod folder_faults;
mod full_disk;
mod import;
#[cfg(unix)]
mod interrupted;
mod kinds;
mod library;
mod long_life;
mod machine;
mod manpages;
#[cfg(unix)]
mod page;
#[cfg(target_os = "linux")]
mod paths;
mod power;
mod program;
mod reach;
mod scenarios;
mod solve;
mod standard_input;
mod streams;
mod supply;
mod sweep;
mod sweep_faults;
mod unsafe_blocks;
mod usage;
mod verify;
mod warm_start;
mod wheel_page;
mod witnesses;
