//! `righting schema`: the formats of the files.

use clap::{Args, ValueEnum};
use righting_results::solution::solution_schema;
use righting_scenario::schema::{scenario_schema, system_schema, wheels_schema};
use righting_sweep::sweep_schema;

use crate::failure::Failure;
use crate::{explain, fly, output, reach};

/// Print the JSON Schema of a file, input or result.
#[derive(Args)]
pub struct Arguments {
    /// Which file.
    #[arg(value_enum, default_value = "scenario")]
    file: File,
}

#[derive(Clone, Copy, ValueEnum)]
enum File {
    /// A maneuver to plan.
    Scenario,
    /// A spacecraft and its arm.
    System,
    /// Reaction wheels to compare an arm with.
    Wheels,
    /// Many maneuvers.
    Sweep,
    /// The outcome of a solve, solution.json.
    Solution,
    /// The outcome of a search for what is possible, reach.json.
    Reach,
    /// What an arm can do, explain.json.
    Explain,
    /// How a plan flies, fly.json.
    Fly,
}

/// Prints the schema.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    output::print_json(&match arguments.file {
        File::Scenario => scenario_schema(),
        File::System => system_schema(),
        File::Wheels => wheels_schema(),
        File::Sweep => sweep_schema(),
        File::Solution => solution_schema(),
        File::Reach => reach::schema(),
        File::Explain => explain::schema(),
        File::Fly => fly::schema(),
    })
}
