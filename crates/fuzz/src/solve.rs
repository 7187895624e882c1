//! Whole solves of random maneuvers on tiny grids.

use std::num::NonZeroUsize;
use std::time::Duration;

use arbitrary::Unstructured;
use righting_ocp::Control;
use righting_planner::{PlanError, Planned, Planner};
use righting_results::{SOLUTION_FILE, TRAJECTORY_FILE};
use righting_scenario::Scenario;
use righting_verifier::{verify, verify_directory};

use crate::random_maneuver::{keep_small, scenario};
use crate::refusal::well_said;
use crate::target::Outcome;
use crate::workspace::{Workspace, scenarios};

/// Far more than a tiny grid takes: a solve that is stopped by it is reported by how it ended.
const TIME_LIMIT: Duration = Duration::from_secs(5);

/// Plans a random maneuver. A plan that says it is verified is so by its files alone.
pub(crate) fn check(u: &mut Unstructured<'_>, workspace: &Workspace) -> Result<Outcome, String> {
    let mut value = scenario(u).map_err(|error| error.to_string())?;
    keep_small(&mut value);
    let file = scenarios().join("fuzzed_scenario.json");
    let scenario = match Scenario::parse(&value.to_string(), &file) {
        Ok(scenario) => scenario,
        Err(error) => {
            well_said(&error.to_string(), scenarios().display())?;
            return Ok(Outcome::Refused);
        }
    };
    let planner = Planner::new().threads(NonZeroUsize::MIN).without_remedies();
    let planned = planner.time_limit(TIME_LIMIT).plan(&scenario, &mut |_| Control::Continue);
    let Planned { solution, trajectory } = match planned {
        Ok(planned) => planned,
        Err(PlanError::Impossible(_)) => return Ok(Outcome::Impossible),
        Err(error) => return Err(format!("no plan at all: {error}: {value}")),
    };
    if !solution.has_plan() {
        return Ok(Outcome::NoPlan);
    }
    let wrong = |what: &str| Err(format!("{what}: {value}"));
    let kinds = scenario.system().model.joint_kinds();
    let again = match solution.duration_s {
        Some(duration_s) => verify(&scenario.with_duration(duration_s), &trajectory),
        None => verify(&scenario, &trajectory),
    };
    if again.passed != solution.verification.passed {
        return wrong("another verdict on the same plan");
    }
    let failed = |error: righting_scenario::Error| format!("{error}: {value}");
    solution.write_json(&workspace.file(SOLUTION_FILE)).map_err(failed)?;
    trajectory.write_csv(&kinds, &workspace.file(TRAJECTORY_FILE)).map_err(failed)?;
    let read = verify_directory(workspace.path()).map_err(failed)?.solution;
    match (solution.verification.passed, read.verification.passed) {
        (true, true) => Ok(Outcome::Verified),
        (false, false) => Ok(Outcome::NotVerified),
        _ => {
            let check = read.verification.failures().next().map(ToString::to_string);
            wrong(&format!("another verdict on the files of a plan: {check:?}"))
        }
    }
}
