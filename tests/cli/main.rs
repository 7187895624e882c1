//! The `righting` program as its users run it: exit codes, messages, files.

mod bad_input;
mod documents;
mod envelope;
mod machine;
mod power;
mod program;
mod scenarios;
mod solve;
mod streams;
mod usage;
mod verify;
