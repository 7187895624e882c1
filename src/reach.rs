//! `righting reach`: how short, or how far, a maneuver can be.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use righting_planner::reach;
use righting_planner::reach::{Quantity, Reach, ReachSettings, Reached, StartedFrom, Try};
use righting_report::{FigureWriter, reach_summary, reach_svg};
use righting_scenario::scenario::MAX_STARTS;
use righting_scenario::{Maneuver, Scenario};
use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde_json::Value;

use crate::failure::Failure;
use crate::figures::{FigureSet, Formats};
use crate::interrupt::Interrupt;
use crate::output_folder::OutputFolder;
use crate::progress::Progress;
use crate::solve::{Shown, write};
use crate::{build, optimizer, output, scenario_input};

const JSON_FILE: &str = "reach.json";
const FIGURE_FILE: &str = "reach.svg";
/// Folder of the plan at the edge of what is possible.
const PLAN_FOLDER: &str = "plan";

/// Find the shortest duration in which a maneuver succeeds, or the largest angle of a slew.
///
/// A slew succeeds when its plan is verified, attitude error included; a detumble when in addition
/// the rate it leaves is within some percent of the least that momentum allows with the arm at rest.
///
/// From the scenario's own value the search goes to easier ones until one succeeds (durations up
/// to 16 times as long), from there a quarter harder at a time until one fails (durations down to a
/// hundredth, angles up to 180 degrees: beyond, the other way around is shorter), and halves what
/// lies between. Steps and weights stay those of the scenario. A value counts as failed once it
/// has failed from the nearest success and from the scenario's own guess.
///
/// The shortest duration of a slew that ends in its target whatever that takes is planned first, by one plan that
/// chooses it, and then tried from both sides.
///
/// A shorter duration or larger angle that was not tried may still succeed.
#[derive(Args)]
#[command(mut_arg("png", |png| png.requires("out")))]
pub struct Arguments {
    /// The scenario, a JSON file; - for standard input.
    scenario: PathBuf,
    /// What to vary.
    #[arg(long, value_enum, default_value_t = What::Duration)]
    what: What,
    /// How close to find the edge: durations in percent, 1 by default; angles in degrees, 0.5.
    #[arg(long, value_name = "R", value_parser = resolution)]
    resolution: Option<f64>,
    /// Detumble: how many percent above the bound the rate left may be; 2 if not given.
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    within: Option<f64>,
    /// Try so many more initial guesses (a Halton sequence) too before a value counts as failed.
    #[arg(long, value_name = "N", default_value_t = 0,
          value_parser = clap::value_parser!(u64).range(0..=MAX_STARTS))]
    starts: u64,
    /// Do not plan the shortest duration first: search for it step by step.
    #[arg(long)]
    step_by_step: bool,
    /// Another weights.control than the scenario's. Where effort is what costs too much, a small one
    /// finds what the arm's limits allow.
    #[arg(long, value_name = "W", allow_negative_numbers = true)]
    control_weight: Option<f64>,
    /// The folder for reach.json, reach.svg and, in plan, the plan found at the edge.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    formats: Formats,
    /// Print the contents of reach.json.
    #[arg(long)]
    pub json: bool,
}

/// What to vary.
#[derive(Clone, Copy, ValueEnum)]
enum What {
    /// The duration.
    Duration,
    /// The angle of a slew about its axis.
    Angle,
}

fn resolution(text: &str) -> Result<f64, String> {
    within(text, 0.01, 50.0)
}

fn percent(text: &str) -> Result<f64, String> {
    within(text, 0.0, 1000.0)
}

fn within(text: &str, low: f64, high: f64) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|value| (low..=high).contains(value));
    value.ok_or_else(|| format!("expected a number from {low} to {high}"))
}

/// What reach.json holds and `--json` prints.
#[derive(Serialize, JsonSchema)]
#[schemars(title = "Righting reach")]
struct Printed<'a> {
    /// "righting.reach/1".
    schema: &'static str,
    /// Name of the scenario.
    scenario: &'a str,
    /// SHA-256 of the resolved scenario's compact JSON, hexadecimal.
    scenario_sha256: String,
    /// What was varied.
    what: Quantity,
    /// How far apart the last failure and the last success may stay: of durations in percent, of
    /// angles in degrees.
    resolution: f64,
    /// The weights.control of every try.
    control_weight: f64,
    /// Detumble: by how much the rate left may exceed its bound, %.
    #[serde(skip_serializing_if = "Option::is_none")]
    within_percent: Option<f64>,
    /// Whether the search was stopped before its end.
    interrupted: bool,
    /// Present for durations; null if none succeeded.
    #[serde(skip_serializing_if = "Option::is_none")]
    smallest_duration_s: Option<Option<f64>>,
    /// Present for angles; null if none succeeded.
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_angle_deg: Option<Option<f64>>,
    /// The edge of what was found possible: durations, s, or angles, deg.
    bracket: Bracket,
    /// Detumble: no motion that stops the arm can leave less angular rate, deg/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    bound_deg_s: Option<f64>,
    /// Detumble: by how much the rate left by the best plan exceeds its bound, %.
    #[serde(skip_serializing_if = "Option::is_none")]
    closest_to_bound_percent: Option<f64>,
    /// What stands in the way of more, and how sure that is.
    notes: &'a [String],
    /// Everything tried, in order.
    tries: &'a [Try],
}

#[derive(Serialize, JsonSchema)]
struct Bracket {
    /// The failure next to the successes; null if nothing failed.
    last_failing: Option<f64>,
    /// The hardest of an unbroken row of successes; null if there is none.
    first_succeeding: Option<f64>,
}

/// The JSON Schema (draft 2020-12) of reach.json.
pub fn schema() -> Value {
    schema_for!(Printed<'_>).to_value()
}

/// Searches, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let started = Instant::now();
    let mut scenario = scenario_input::read(&arguments.scenario)?;
    // From here on: until then a signal may end the process while it waits for standard input.
    let interrupt = Interrupt::watch();
    if arguments.control_weight.is_some() {
        let mut file = scenario.resolved().clone();
        file.weights.control = arguments.control_weight;
        scenario = Scenario::from_file(file, scenario_input::name(&arguments.scenario))?;
    }
    if arguments.within.is_some() && *scenario.maneuver() != Maneuver::Detumble {
        return Err(Failure::Usage("--within: only a detumble leaves a rate, this is a slew"));
    }
    let load = started.elapsed();
    let quantity = match arguments.what {
        What::Duration => Quantity::Duration,
        What::Angle => Quantity::Angle,
    };
    let defaults = ReachSettings::new(quantity);
    let settings = ReachSettings {
        resolution: arguments.resolution.unwrap_or(defaults.resolution),
        within_percent: arguments.within.unwrap_or(defaults.within_percent),
        starts: arguments.starts,
        plans_fastest: !arguments.step_by_step,
        ..defaults
    };
    let writer = arguments.formats.writer()?;
    optimizer::load()?;
    let folder = match &arguments.out {
        Some(out) => Some(OutputFolder::open_alone(out)?),
        None => None,
    };
    let progress = Progress::start();
    let found = reach::reach(&scenario, settings, &mut |step| {
        show(&progress, quantity, step);
        interrupt.control()
    })?;
    drop(progress);

    let printed = printed(&scenario, settings, &found);
    let files = match &folder {
        Some(folder) => {
            keep(folder, &writer, &scenario, &printed, &found, Clock { started, load })?
        }
        None => Vec::new(),
    };
    if arguments.json {
        output::print_json(&printed)?;
    } else {
        output::print(&reach_summary(scenario.resolved(), &found, &files))?;
    }
    conclude(&found)
}

/// One line a try, and what goes on until the next.
fn show(progress: &Progress, quantity: Quantity, step: reach::Progress<'_>) {
    let shown = |value: f64| match quantity {
        Quantity::Duration => format!("{value} s"),
        Quantity::Angle => format!("{value}\u{b0}"),
    };
    match step {
        reach::Progress::Trying { value, start } => {
            let start = match start {
                StartedFrom::Cold => "cold",
                StartedFrom::Neighbor => "from the nearest success",
                StartedFrom::Fastest => "with a duration that the plan chooses",
                StartedFrom::LowDiscrepancy => "from more initial guesses",
            };
            progress.name(format!("{}, {start}: ", shown(value)));
        }
        reach::Progress::Iteration(record) => progress.show(record),
        reach::Progress::Tried(tried) => {
            let value = shown(tried.value(quantity));
            progress.say(&match &tried.shortfall {
                Some(shortfall) => format!("{value} fails: {shortfall}"),
                None => format!("{value} succeeds"),
            });
        }
    }
}

fn printed<'a>(scenario: &'a Scenario, settings: ReachSettings, found: &'a Reach) -> Printed<'a> {
    let answer = |quantity| (quantity == found.quantity).then_some(found.first_succeeding);
    Printed {
        schema: "righting.reach/1",
        scenario: scenario.name(),
        scenario_sha256: scenario.resolved().sha256(),
        what: found.quantity,
        resolution: settings.resolution,
        control_weight: scenario.weights().control,
        within_percent: found.bound_deg_s.map(|_| settings.within_percent),
        interrupted: found.is_interrupted,
        smallest_duration_s: answer(Quantity::Duration),
        largest_angle_deg: answer(Quantity::Angle),
        bracket: Bracket {
            last_failing: found.last_failing,
            first_succeeding: found.first_succeeding,
        },
        bound_deg_s: found.bound_deg_s,
        closest_to_bound_percent: found.closest_to_bound_percent(),
        notes: &found.notes,
        tries: &found.tries,
    }
}

struct Clock {
    /// When the command began.
    started: Instant,
    /// How long the scenario took to read.
    load: Duration,
}

/// Writes the search and the plan at its edge, what only shows them last.
fn keep(
    folder: &OutputFolder,
    writer: &FigureWriter,
    scenario: &Scenario,
    printed: &Printed<'_>,
    found: &Reach,
    Clock { started, load }: Clock,
) -> Result<Vec<PathBuf>, Failure> {
    let mut files = vec![folder.write(JSON_FILE, output::to_json(printed)?.as_bytes())?];
    let plan_folder = folder.path().join(PLAN_FOLDER);
    if let Some(Reached { scenario, planned }) = &found.plan {
        let mut solution = planned.solution.clone();
        solution.timing_s.load = load.as_secs_f64();
        build::VERSION.clone_into(&mut solution.versions.righting);
        let plan_folder = OutputFolder::open(&plan_folder)?;
        let shown = Shown { figures: FigureSet::Usual, writer, page: true };
        let trajectory = &planned.trajectory;
        let written = write(&plan_folder, shown, scenario, &mut solution, trajectory, started)?;
        files.extend(written.paths());
    } else if plan_folder.is_dir() {
        OutputFolder::open(&plan_folder)?.remove_earlier_plan()?;
    }
    let figure = reach_svg(scenario.resolved(), found);
    files.extend(writer.write(folder.path(), FIGURE_FILE, &figure)?);
    Ok(files)
}

/// Whether there is an answer.
fn conclude(found: &Reach) -> Result<(), Failure> {
    match (found.is_interrupted, found.first_succeeding, found.last_failing) {
        (true, ..) => Err(Failure::Interrupted { has_plan: false }),
        (false, None, Some(value)) => Err(Failure::OutOfReach {
            easiest: match found.quantity {
                Quantity::Duration => format!("in {value} s"),
                Quantity::Angle => format!("by {value}\u{b0}"),
            },
        }),
        _ => Ok(()),
    }
}
