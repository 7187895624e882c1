//! Hostile and random inputs for every reader, and for whole solves.
//!
//! An input is a string of bytes. [`arbitrary`] makes a file of it that has the structure of a real one: JSON after
//! the project's own schemas, robots, tables, records. So a fuzzer that changes bytes changes fields, and a fixed
//! seed gives the same inputs on every machine. [`Target::check`] runs one and says which property it breaks:
//!
//! - nothing panics, and nothing hangs or takes more memory than the program `righting-fuzz` allows;
//! - the same input is refused twice in the same words: one line, which begins with the file and says where in it;
//! - what is accepted is accepted again as it is written down, and means the same;
//! - a plan that says it is verified is verified by its files alone.
//!
//! ```
//! use righting_fuzz::{Outcome, Target, Workspace};
//!
//! let workspace = Workspace::new()?;
//! let outcome = Target::Scenario.check(&[7; 400], &workspace);
//! assert!(matches!(outcome, Ok(Outcome::Accepted | Outcome::Refused)), "{outcome:?}");
//! # Ok::<(), std::io::Error>(())
//! ```
#![forbid(unsafe_code)]

mod from_schema;
mod hostile;
mod journal;
mod json;
mod plan_files;
mod random_maneuver;
mod refusal;
mod robot;
mod solve;
mod target;
mod workspace;

pub use target::{Outcome, Target};
pub use workspace::Workspace;
