//! What a plan starts from besides its own guesses: an earlier plan, or the nearest of a library.

use std::io::ErrorKind;
use std::path::Path;

use righting_planner::Library;
use righting_planner::library::is_same_arm;
use righting_results::{SOLUTION_FILE, Solution, TRAJECTORY_FILE, Trajectory};
use righting_scenario::{Error, Scenario};

use crate::failure::Failure;
use crate::output::{self, Label};
use crate::plan_folder::refuse_file;

/// So many subfolders of a library that are of no use are named.
const MOST_WARNINGS: usize = 10;

/// An earlier motion, if there is one, and what a reader of the plan should know about it.
#[derive(Debug, Default)]
pub struct WarmStart {
    /// The motion.
    pub trajectory: Option<Trajectory>,
    /// Such as where it is from.
    pub note: Option<String>,
}

impl WarmStart {
    /// The plan in a folder: of an arm with as many joints as the scenario's.
    pub fn of_plan(folder: &Path, scenario: &Scenario) -> Result<Self, Failure> {
        refuse_file(folder, "the folder of a plan")?;
        let trajectory = Trajectory::read_csv(&folder.join(TRAJECTORY_FILE))?;
        let (found, expected) = (trajectory.joints(), scenario.system().joint_count());
        if found != expected {
            return Err(Failure::OtherArm { folder: folder.to_owned(), found, expected });
        }
        let shown = folder.display();
        let note = match Solution::read_json(&folder.join(SOLUTION_FILE)) {
            Ok(earlier) if is_same_arm(scenario.resolved(), &earlier.scenario) => None,
            Ok(_) => Some(format!(
                "the warm start {shown} is of another arm: its Denavit-Hartenberg rows or its \
                 mount differ"
            )),
            // A motion alone does.
            Err(Error::Read { source, .. }) if source.kind() == ErrorKind::NotFound => None,
            Err(error) => {
                output::say(
                    Label::Warning,
                    &format!("the arm of the warm start is unknown: {error}"),
                );
                None
            }
        };
        Ok(Self { trajectory: Some(trajectory), note })
    }

    /// The nearest plan of a library of plans, which is made if it is missing.
    pub fn of_library(folder: &Path, scenario: &Scenario) -> Result<Self, Failure> {
        refuse_file(folder, "the folder of a library")?;
        std::fs::create_dir_all(folder)
            .map_err(|source| Error::Write { file: folder.to_owned(), source })?;
        let mut library = Library::read(folder)?;
        let nearest = library.nearest(scenario);
        let shown = folder.display();
        let warn = |text: &str| {
            output::say(Label::Warning, &format!("{shown}: skipped {text}"));
        };
        for skipped in library.skipped().iter().take(MOST_WARNINGS) {
            warn(&skipped.to_string());
        }
        let more = library.skipped().len().saturating_sub(MOST_WARNINGS);
        if more > 0 {
            warn(&format!("{more} more"));
        }
        let note = match &nearest {
            Some(near) => {
                let (name, distance) = (&near.name, near.distance);
                format!("library maneuver {name} was a start too (distance {distance:.3})")
            }
            None if library.is_empty() => {
                format!("library {shown} is empty: a plan joins it by --out {shown}/NAME")
            }
            None => format!("library {shown} holds no maneuver of this type by this arm"),
        };
        Ok(Self { trajectory: nearest.map(|near| near.trajectory), note: Some(note) })
    }
}
