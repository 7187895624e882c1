//! `--wheels`, of every command that compares an arm with reaction wheels.

use std::path::PathBuf;

use clap::Args;
use righting_scenario::WheelArray;
use righting_scenario::json::FileKind;

use crate::failure::Failure;

/// The wheels to compare with.
#[derive(Args)]
pub struct Wheels {
    /// The wheels to compare with, a JSON file; a pyramid of four if not given, of 1 N m s, 0.1 N m
    /// and 5 W each.
    #[arg(long, value_name = "FILE")]
    wheels: Option<PathBuf>,
}

impl Wheels {
    /// Reads them.
    pub fn read(&self) -> Result<WheelArray, Failure> {
        WheelArray::read_or_pyramid(self.wheels.as_deref())
            .map_err(|error| Failure::InputOf { kind: FileKind::Wheels, error })
    }
}
