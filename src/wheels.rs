//! `--wheels`, of every command that compares an arm with reaction wheels.

use std::path::PathBuf;

use clap::Args;
use righting_scenario::WheelArray;
use righting_scenario::json::FileKind;

use crate::failure::Failure;

/// The wheels to compare with.
#[derive(Args)]
pub struct Wheels {
    /// The wheels to compare with, a JSON file; if not given, those of the scenario, and where it has none a
    /// pyramid of four of 1 N m s, 0.1 N m and 5 W each.
    #[arg(long, value_name = "FILE")]
    wheels: Option<PathBuf>,
}

impl Wheels {
    /// Reads those of the file; none where no file is named.
    pub fn read(&self) -> Result<Option<WheelArray>, Failure> {
        let read = self.wheels.as_deref().map(WheelArray::read).transpose();
        read.map_err(|error| Failure::InputOf { kind: FileKind::Wheels, error })
    }
}
