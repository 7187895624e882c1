//! `righting explain`: what an arm can do at all.

mod sentences;

use std::path::{Path, PathBuf};

use clap::Args;
use righting_analysis::{Abilities, Explanation};
use righting_report::turn_rates_svg;
use righting_results::{SOLUTION_FILE, Solution};
use righting_scenario::json::FileKind;
use righting_scenario::{Maneuver, Scenario, SystemOrScenario};
use schemars::schema_for;
use serde_json::Value;

use crate::failure::Failure;
use crate::figures::Formats;
use crate::output;
use crate::output_folder::OutputFolder;
use sentences::describe;

const JSON_FILE: &str = "explain.json";
const FIGURE_FILE: &str = "explain.svg";

/// Say what an arm can do: about which axes it turns the base, how fast, and whether a maneuver is
/// possible.
///
/// Nothing is planned. Turn rates and durations are first estimates from some motions of the joints, timed at
/// their limits, clearances left out: of eight slews tried, the estimate was between 0.6 and 4.2 times the
/// shortest duration that `righting reach` found. What is called impossible is.
#[derive(Args)]
#[command(mut_arg("png", |png| png.requires("out")))]
pub struct Arguments {
    /// A system file, a scenario file, or the folder of a plan for its scenario.
    #[arg(value_name = "SYSTEM_OR_SCENARIO_OR_DIR")]
    path: PathBuf,
    /// The folder for explain.json and explain.svg.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    formats: Formats,
    /// Print the contents of explain.json.
    #[arg(long)]
    pub json: bool,
}

/// The JSON Schema (draft 2020-12) of explain.json.
pub fn schema() -> Value {
    schema_for!(Explanation<'_>).to_value()
}

/// Reads, looks, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let writer = arguments.formats.writer()?;
    let given = read(&arguments.path)?;
    let (system, scenario) = match &given {
        SystemOrScenario::System(system) => (&**system, None),
        SystemOrScenario::Scenario(scenario) => (scenario.system(), Some(&**scenario)),
    };
    let folder = arguments.out.as_ref().map(|out| OutputFolder::open(out)).transpose()?;
    let abilities = match scenario {
        Some(scenario) => Abilities::of_scenario(scenario),
        None => Abilities::of_system(system),
    };
    let explanation = Explanation::new(system, scenario, &abilities);
    let json = output::to_json(&explanation)?;
    let mut files = Vec::new();
    if let Some(folder) = &folder {
        files.push(folder.write(JSON_FILE, json.as_bytes())?);
        let asked = scenario.and_then(|scenario| match scenario.maneuver() {
            Maneuver::Slew(slew) => Some(&slew.axis),
            Maneuver::Detumble => None,
        });
        let name = scenario.map_or(&*system.name, Scenario::name);
        let figure = turn_rates_svg(name, &abilities.rates.semi_axes_deg_s(), asked);
        files.extend(writer.write(folder.path(), FIGURE_FILE, &figure)?);
    }
    if arguments.json {
        output::print(&json)
    } else {
        output::print(&describe(&explanation, &system.names, &abilities, &files))
    }
}

/// What a path stands for: of a plan's folder, the scenario that was solved.
fn read(path: &Path) -> Result<SystemOrScenario, Failure> {
    if !path.is_dir() {
        return SystemOrScenario::read(path)
            .map_err(|error| Failure::InputOf { kind: FileKind::SystemOrScenario, error });
    }
    let file = path.join(SOLUTION_FILE);
    let scenario = Solution::read_json(&file)
        .and_then(|solution| Scenario::from_file(solution.scenario, &file))
        .map_err(|error| Failure::InputOf { kind: FileKind::Solution, error })?;
    Ok(SystemOrScenario::Scenario(Box::new(scenario)))
}
