//! `righting fly`: a plan flown with spacecraft that are not as planned.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, ValueEnum};
use righting_flight::{Campaign, Control, Flight, Sensors, Settings, Spreads, Summary};
use righting_planner::{Planned, Planner};
use righting_report::{FlightsFigure, flights_svg, flights_table};
use righting_results::{IterationRecord, SOLUTION_FILE, Trajectory};
use righting_scenario::Scenario;
use righting_verifier::Verified;
use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde_json::Value;

use crate::failure::Failure;
use crate::figures::Formats;
use crate::interrupt::Interrupt;
use crate::output_folder::OutputFolder;
use crate::progress::Progress;
use crate::{build, optimizer, output, plan_folder, scenario_input};

const JSON_FILE: &str = "fly.json";
const TABLE_FILE: &str = "flights.csv";
const FIGURE_FILE: &str = "flights.svg";

/// Fly a plan many times with spacecraft that are not as planned: open loop, and with the rest of the maneuver
/// planned anew on the way.
///
/// Each flight draws its own masses, inertias and centers of mass. The joints follow the accelerations that they
/// are told, the base turns as the spacecraft's own momentum has it. The spacecraft is the verifier's model, not
/// the planner's. A replan starts from the attitude and the joints that are measured then.
#[derive(Args)]
pub struct Arguments {
    /// The scenario, a JSON file (- for standard input), or the folder of its plan.
    #[arg(value_name = "SCENARIO_OR_DIR")]
    input: PathBuf,
    /// The folder for fly.json, flights.csv and flights.svg.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// How many flights.
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    flights: u32,
    /// Seed of all random draws: the same seed, the same flights.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// What is done about it.
    #[arg(long, value_enum, default_value_t = Mode::Replan)]
    mode: Mode,
    /// Time from one replan to the next, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = period)]
    period: f64,
    /// A replan that takes longer is missed: the flight goes on with the last plan, ms.
    #[arg(long, value_name = "MS", value_parser = deadline)]
    deadline_ms: Option<Duration>,
    /// Every mass is off by up to so much either way, %.
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, value_parser = share)]
    mass_percent: f64,
    /// Every inertia that is given is off by up to so much either way, %.
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, value_parser = share)]
    inertia_percent: f64,
    /// Every center of mass that is given is off by up to so much along each axis, m.
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = not_negative)]
    center_m: f64,
    /// The mount is off by up to so much along each axis, m.
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = not_negative)]
    mount_m: f64,
    /// Standard deviation of the measured attitude about each axis, deg.
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = not_negative)]
    attitude_noise_deg: f64,
    /// Standard deviation of every measured joint angle, deg.
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = not_negative)]
    joint_noise_deg: f64,
    /// Standard deviation of every measured joint rate, deg/s.
    #[arg(long, value_name = "DEG_S", default_value_t = 0.0, value_parser = not_negative)]
    joint_rate_noise_deg_s: f64,
    #[command(flatten)]
    formats: Formats,
    /// Print the contents of fly.json.
    #[arg(long)]
    pub json: bool,
}

/// What is done about a spacecraft that is not as planned.
#[derive(Clone, Copy, Serialize, JsonSchema, ValueEnum)]
#[serde(rename_all = "kebab-case")]
enum Mode {
    /// Nothing: the plan is flown as it is.
    OpenLoop,
    /// The plan's own gains correct every step, for slews.
    Feedback,
    /// The rest of the maneuver is planned anew, time and again.
    Replan,
}

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
    let (scenario, plan, interrupt) = scenario_and_plan(&arguments.input)?;
    let folder = OutputFolder::open(&arguments.out)?;
    let settings = settings(arguments);
    let count = arguments.flights as usize;
    let progress = Progress::start();
    progress.name(format!("{count} flights: "));
    let campaign = Campaign::new(&scenario, &plan, settings)?;
    let flights = campaign.fly(count, &|| interrupt.is_asked());
    drop(progress);
    if interrupt.is_asked() {
        return Err(Failure::Interrupted { has_plan: false });
    }

    let summary = Summary::of(&flights);
    let printed = Printed {
        schema: "righting.fly/1",
        scenario: scenario.name(),
        scenario_sha256: scenario.resolved().sha256(),
        seed: arguments.seed,
        mode: arguments.mode,
        period_s: arguments.period,
        summary: &summary,
    };
    let json = output::to_json(&printed)?;
    let mut files = vec![folder.write(TABLE_FILE, csv(&flights).as_bytes())?];
    files.push(folder.write(JSON_FILE, json.as_bytes())?);
    let figure = FlightsFigure {
        scenario: scenario.resolved(),
        flights: &flights,
        control: settings.control,
    };
    if let Some(figure) = flights_svg(figure) {
        files.extend(writer.write(folder.path(), FIGURE_FILE, &figure)?);
    }
    match arguments.json {
        true => output::print(&json),
        false => {
            output::print(&flights_table(scenario.resolved(), settings.control, &summary, &files))
        }
    }
}

/// The plan in a folder, or that of a scenario, and what watches for an interrupt.
fn scenario_and_plan(input: &Path) -> Result<(Scenario, Trajectory, Interrupt), Failure> {
    if input.join(SOLUTION_FILE).exists() {
        let Verified { solution, scenario, trajectory } = plan_folder::read(input)?;
        Failure::of_verification(&solution).map_or(Ok(()), Err)?;
        // Replans are solved too.
        optimizer::load()?;
        return Ok((scenario, trajectory, Interrupt::watch()));
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
    Ok((scenario, trajectory, interrupt))
}

fn settings(arguments: &Arguments) -> Settings {
    Settings {
        spreads: Spreads {
            masses: arguments.mass_percent / 100.0,
            inertias: arguments.inertia_percent / 100.0,
            centers_m: arguments.center_m,
            mount_m: arguments.mount_m,
        },
        sensors: Sensors {
            attitude_rad: arguments.attitude_noise_deg.to_radians(),
            joint_angle_rad: arguments.joint_noise_deg.to_radians(),
            joint_rate_rad_s: arguments.joint_rate_noise_deg_s.to_radians(),
        },
        control: match arguments.mode {
            Mode::OpenLoop => Control::OpenLoop,
            Mode::Feedback => Control::Feedback,
            Mode::Replan => Control::Replan,
        },
        period_s: arguments.period,
        deadline: arguments.deadline_ms,
        seed: arguments.seed,
    }
}

/// One row a flight.
fn csv(flights: &[Flight]) -> String {
    let mut text = String::from(
        "flight,final_error_deg,final_rate_deg_s,final_joint_rate_deg_s,open_loop_error_deg,\
         open_loop_rate_deg_s,replans,missed_replans,slowest_replan_ms\n",
    );
    for flight in flights {
        let Flight { number, open_loop, flown, replans, missed } = flight;
        let slowest_ms = replans.iter().max().map_or(f64::NAN, |time| 1e3 * time.as_secs_f64());
        let cells = [
            flown.error_rad.to_degrees(),
            flown.rate_rad_s.to_degrees(),
            flown.joint_rate_rad_s.to_degrees(),
            open_loop.error_rad.to_degrees(),
            open_loop.rate_rad_s.to_degrees(),
        ];
        let cells =
            cells.map(|cell| if cell.is_finite() { cell.to_string() } else { String::new() });
        let slowest_ms =
            if slowest_ms.is_finite() { slowest_ms.to_string() } else { String::new() };
        let replans = replans.len();
        text += &format!("{number},{},{replans},{missed},{slowest_ms}\n", cells.join(","));
    }
    text
}

fn period(text: &str) -> Result<f64, String> {
    number(text, |value| value > 0.0)
        .ok_or_else(|| "expected a number of seconds above 0".to_owned())
}

fn deadline(text: &str) -> Result<Duration, String> {
    let ms = number(text, |value| value > 0.0);
    let duration = ms.and_then(|ms| Duration::try_from_secs_f64(ms / 1e3).ok());
    duration.ok_or_else(|| "expected a number of milliseconds above 0".to_owned())
}

fn share(text: &str) -> Result<f64, String> {
    number(text, |value| (0.0..100.0).contains(&value))
        .ok_or_else(|| "expected a number from 0, below 100".to_owned())
}

fn not_negative(text: &str) -> Result<f64, String> {
    number(text, |value| value >= 0.0).ok_or_else(|| "expected a number from 0".to_owned())
}

fn number(text: &str, is_allowed: impl Fn(f64) -> bool) -> Option<f64> {
    text.parse().ok().filter(|&value: &f64| value.is_finite() && is_allowed(value))
}
