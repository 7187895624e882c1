//! `righting fly`: a plan flown with spacecraft that are not as planned.

use std::io;
use std::path::Path;

use righting_flight::{
    Campaign, Faults, Flight, Guidance, JointDrives, Settings, Summary, fly_with,
};
use righting_planner::{Planned, Planner};
use righting_report::{FlightsFigure, flights_svg, flights_table};
use righting_results::{IterationRecord, SOLUTION_FILE};
use righting_verifier::Verified;
use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde_json::Value;

mod arguments;
mod first_flight;
mod table;

pub use arguments::Arguments;
use arguments::{Mode, Spacecraft};

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output_folder::OutputFolder;
use crate::progress::Progress;
use crate::{build, optimizer, output, plan_folder, scenario_input};

const JSON_FILE: &str = "fly.json";
const TABLE_FILE: &str = "flights.csv";
const FIGURE_FILE: &str = "flights.svg";
const DEFAULT_FLIGHTS: u32 = 100;

/// What fly.json holds and `--json` prints.
#[derive(Serialize, JsonSchema)]
#[schemars(title = "Righting flights")]
struct Printed<'a> {
    /// "righting.fly/1".
    schema: &'static str,
    /// Name of the scenario.
    scenario: &'a str,
    /// SHA-256 of the resolved scenario's compact JSON, hexadecimal.
    scenario_sha256: String,
    /// Seed of all draws.
    seed: u64,
    /// What was done about it.
    mode: Mode,
    /// Time from one replan to the next, s.
    period_s: f64,
    #[serde(flatten)]
    summary: &'a Summary,
}

/// The JSON Schema (draft 2020-12) of fly.json.
pub fn schema() -> Value {
    schema_for!(Printed<'_>).to_value()
}

/// Plans if need be, flies, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let writer = arguments.formats.writer()?;
    let (plan, interrupt) = plan_and_interrupt(&arguments.input)?;
    let settings = arguments.settings(&plan.scenario)?;
    let folder = OutputFolder::open(&arguments.out)?;
    let (flights, mut files) = match arguments.plant {
        Spacecraft::Stdio if arguments.flights.is_some() => {
            let why = "--plant stdio is one flight: leave out --flights";
            return Err(Failure::Usage(why));
        }
        Spacecraft::Stdio => (vec![fly_over_pipes(&plan, &settings)?], Vec::new()),
        Spacecraft::Model => {
            let count = arguments.flights.unwrap_or(DEFAULT_FLIGHTS) as usize;
            let progress = Progress::start();
            progress.name(format!("{count} flights: "));
            let campaign = Campaign::new(&plan.scenario, &plan.trajectory, settings)?;
            let flights = campaign.fly(count, &|| interrupt.is_asked());
            drop(progress);
            let files = match flights.is_empty() {
                true => Vec::new(),
                false => first_flight::write(&plan, &campaign, &folder, &writer)?,
            };
            (flights, files)
        }
    };

    let summary = Summary::of(&flights);
    let printed = Printed {
        schema: "righting.fly/1",
        scenario: plan.scenario.name(),
        scenario_sha256: plan.scenario.resolved().sha256(),
        seed: arguments.seed,
        mode: arguments.guidance.mode,
        period_s: arguments.guidance.period,
        summary: &summary,
    };
    let json = output::to_json(&printed)?;
    files.push(folder.write(TABLE_FILE, table::csv(&flights).as_bytes())?);
    files.push(folder.write(JSON_FILE, json.as_bytes())?);
    let resolved = plan.scenario.resolved();
    let figure = FlightsFigure { scenario: resolved, flights: &flights, control: settings.control };
    if let Some(figure) = flights_svg(figure) {
        files.extend(writer.write(folder.path(), FIGURE_FILE, &figure)?);
    }
    let text = match arguments.json {
        true => json,
        false => flights_table(resolved, settings.control, &summary, &files),
    };
    match arguments.plant {
        // Standard output is the plant's.
        Spacecraft::Stdio => eprint!("{text}"),
        Spacecraft::Model => output::print(&text)?,
    }
    match interrupt.is_asked() {
        true => Err(Failure::FlightsInterrupted { flown: flights.len() }),
        false => Ok(()),
    }
}

/// One flight of a spacecraft that answers on standard input.
fn fly_over_pipes(plan: &Verified, settings: &Settings) -> Result<Flight, Failure> {
    if settings.faults != Faults::default() || settings.drives != JointDrives::default() {
        return Err(Failure::Usage(
            "--plant stdio: what its joints do and what fails is up to that spacecraft; leave out --joint-lag-s, \
             --joint-noise-percent, --lost-percent, --missed-percent and --stick",
        ));
    }
    let guidance = Guidance::new(&plan.scenario, &plan.trajectory, settings)?;
    let pipes = (&mut io::stdin().lock(), &mut io::stdout().lock());
    Ok(fly_with(&plan.scenario, &plan.trajectory, guidance, pipes)?)
}

/// The plan in a folder, or that of a scenario, and what watches for an interrupt.
fn plan_and_interrupt(input: &Path) -> Result<(Verified, Interrupt), Failure> {
    if input.join(SOLUTION_FILE).exists() {
        let plan = plan_folder::read(input)?;
        Failure::of_verification(&plan.solution).map_or(Ok(()), Err)?;
        // Replans are solved too.
        optimizer::load()?;
        return Ok((plan, Interrupt::watch()));
    }
    let scenario = scenario_input::read(input)?;
    let interrupt = Interrupt::watch();
    optimizer::load()?;
    let progress = Progress::start();
    let mut on_iteration = |record: &IterationRecord| {
        progress.show(record);
        interrupt.control()
    };
    let mut planner = Planner::new().program(build::VERSION);
    let Planned { solution, trajectory } = planner.plan(&scenario, &mut on_iteration)?;
    crate::solve::conclude(&solution)?;
    Ok((Verified { solution, scenario, trajectory }, interrupt))
}
