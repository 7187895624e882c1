//! What a plan starts from besides its own guesses: an earlier plan, or the nearest of a library.

use std::io::ErrorKind;
use std::path::Path;

use righting_planner::PlanLibrary;
use righting_planner::library::is_same_arm;
use righting_results::{SOLUTION_FILE, Solution, TRAJECTORY_FILE, Trajectory};
use righting_scenario::{Error, Scenario};

use crate::failure::Failure;
use crate::output::{self, Label};
use crate::plan_folder::refuse_file;

/// So many subfolders of a library that are of no use are named.
const MOST_WARNINGS: usize = 10;

/// What to start from besides the scenario's own guesses.
#[derive(Debug)]
pub enum WarmStart {
    /// Nothing.
    None,
    /// An earlier plan.
    Plan {
        /// Its motion.
        trajectory: Trajectory,
        /// What a reader of the plan should know about it.
        note: Option<String>,
    },
    /// The nearest plan of a library.
    Library(PlanLibrary),
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
        Ok(Self::Plan { trajectory, note })
    }

    /// A library of plans, which is made if it is missing.
    pub fn of_library(folder: &Path) -> Result<Self, Failure> {
        refuse_file(folder, "the folder of a library")?;
        std::fs::create_dir_all(folder)
            .map_err(|source| Error::Write { file: folder.to_owned(), source })?;
        Ok(Self::Library(PlanLibrary::read(folder)?))
    }

    /// Says what a reader of the plan should know: in its notes, and on stderr what of the library was
    /// of no use.
    pub fn report(self, solution: &mut Solution) {
        match self {
            Self::None => {}
            Self::Plan { note, .. } => solution.notes.splice(..0, note).for_each(drop),
            Self::Library(library) => warn_of_skipped(&library),
        }
    }
}

fn warn_of_skipped(library: &PlanLibrary) {
    let shown = library.folder().display();
    let warn = |text: &str| output::say(Label::Warning, &format!("{shown}: skipped {text}"));
    for skipped in library.skipped().iter().take(MOST_WARNINGS) {
        warn(&skipped.to_string());
    }
    let more = library.skipped().len().saturating_sub(MOST_WARNINGS);
    if more > 0 {
        warn(&format!("{more} more"));
    }
}
