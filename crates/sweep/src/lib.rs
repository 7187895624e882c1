//! Many maneuvers from one file.
//!
//! A *sweep file* names a base scenario and what varies in it. Its dimensions are crossed, each a list
//! of settings of one or more fields, so that case i of n₁ × n₂ × … × n_d takes from dimension k the
//! setting of digit k of i, the last dimension fastest. A case is known by a hash of what it sets, not
//! by its number: a sweep that grows keeps the results it has.
//!
//! Cases are planned and verified by a [`Pool`] of worker processes, each for many cases. Every
//! finished one becomes a checksummed line of an append-only [`Journal`] at once; whatever dies, at
//! most the cases in flight are lost. [`Shard`]s split the work between machines that share nothing
//! but a folder, and a [`Table`] joins what is there, in the order of the plan.
//!
//! What a case reaches depends on the case alone: no worker carries anything from one to the next. So
//! the same sweep gives the same table whatever the number of workers and shards and however often it
//! was interrupted, but for the columns that say how long it took.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_sweep::Sweep;
//!
//! let text = r#"{
//!     "name": "two angles about three axes",
//!     "scenario": "../../scenarios/slew_2dof.json",
//!     "vary": [ { "field": "maneuver.axis", "fibonacci": 3 },
//!               { "field": "maneuver.angle_deg", "values": [10, 20] } ] }"#;
//! let sweep = Sweep::parse(text, Path::new("angles.json"))?;
//! assert_eq!(sweep.len(), 6);
//! let case = sweep.case(5);
//! assert_eq!(case.values[1], 20);
//! assert_eq!(sweep.scenario(&case)["maneuver"]["angle_deg"], 20);
//! # Ok::<(), righting_scenario::Error>(())
//! ```
#![forbid(unsafe_code)]

mod base;
mod case;
mod cells;
mod dimension;
mod draw;
pub mod error;
mod evaluation;
mod field_path;
pub mod file;
mod folder;
mod journal;
mod outcome;
#[cfg(feature = "parquet")]
mod parquet_file;
mod pool;
mod process;
mod record;
mod setting;
mod shard;
mod shard_run;
mod slews;
mod summary;
mod sweep;
mod system_values;
mod table;
mod table_columns;
pub mod worker;

pub use case::{Case, CaseId};
pub use dimension::Column;
pub use error::SweepError;
pub use folder::SweepFolder;
pub use journal::{Journal, JournalContents, read_journal};
pub use outcome::{CaseStatus, Flown, Outcome, Trouble};
pub use pool::Pool;
pub use record::{Record, RunFacts};
pub use setting::Kind;
pub use shard::Shard;
pub use shard_run::{ShardRun, Workers};
pub use slews::{SlewLimit, SlewPoint, Slews};
pub use summary::{Failures, Spread, Summary};
pub use sweep::{Sweep, sweep_schema};
pub use table::{Row, Table};
pub use table_columns::{ColumnCells, TableColumn};
