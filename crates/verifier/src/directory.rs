//! The check of a folder that a solve has written.

use std::path::{Path, PathBuf};

use righting_results::solution::{SCHEMA, Solution};
use righting_results::trajectory::Trajectory;
use righting_results::{SOLUTION_FILE, TRAJECTORY_FILE, objective};
use righting_scenario::error::Error;
use righting_scenario::json::Location;
use righting_scenario::scenario::{FreeDuration, Scenario};

use crate::ledger::{Ledger, Worst};
use crate::model::State;
use crate::requirements::Requirements;
use crate::verify::verify;

/// How far numbers in `solution.json` may be from what the trajectory says, relative.
const REPORTED: f64 = 1e-6;
/// How far past its bounds a duration may be, as a share of the longest: what the optimizer relaxes them by.
const DURATION_ROUNDING: f64 = 1e-7;

/// A result folder, read and checked.
#[derive(Clone, Debug)]
pub struct Verified {
    /// The contents of `solution.json`, with the outcome of the check made now.
    pub solution: Solution,
    /// The scenario in it.
    pub scenario: Scenario,
    /// The contents of `trajectory.csv`.
    pub trajectory: Trajectory,
}

/// Reads `solution.json` and `trajectory.csv` in `folder` and checks both: the trajectory as
/// [`verify`] does, the scenario against its hash, and what the solution claims against the
/// trajectory.
///
/// # Errors
/// Those of reading the two files. A plan that is wrong is no error: see
/// [`Verification::passed`](righting_results::Verification::passed).
pub fn verify_directory(folder: &Path) -> Result<Verified, Error> {
    let solution_file: PathBuf = folder.join(SOLUTION_FILE);
    let solution = Solution::read_json(&solution_file)?;
    let place = Location::root(&solution_file);
    if solution.schema != SCHEMA {
        let found = format!("\"{}\"", solution.schema);
        return Err(place.key("schema").refuse(found, format!("\"{SCHEMA}\"")));
    }
    let asked =
        Scenario::from_file_at(solution.scenario.clone(), &solution_file, &place.key("scenario"))?;
    let scenario = with_chosen_duration(asked, solution.duration_s, &place.key("duration_s"))?;
    let trajectory = Trajectory::read_csv(&folder.join(TRAJECTORY_FILE))?;
    let report = verify(&scenario, &trajectory);
    let mut ledger = Ledger::new(scenario.resolved_system(), report);
    check_claims(&solution, &scenario, &trajectory, &mut ledger);
    let verification = ledger.finish();
    let solution = Solution { limits: verification.limits(), verification, ..solution };
    Ok(Verified { solution, scenario, trajectory })
}

/// The scenario with the duration that the plan chose where it was free to: one within the scenario's bounds.
fn with_chosen_duration(
    scenario: Scenario,
    chosen_s: Option<f64>,
    place: &Location,
) -> Result<Scenario, Error> {
    let Some(FreeDuration { shortest_s }) = scenario.free_duration() else { return Ok(scenario) };
    let longest_s = scenario.horizon().duration_s;
    let allowed = format!("the chosen duration, from {shortest_s} to {longest_s}");
    let Some(chosen_s) = chosen_s else { return Err(place.missing(allowed)) };
    let rounding = DURATION_ROUNDING * longest_s;
    match (shortest_s - rounding..=longest_s + rounding).contains(&chosen_s) {
        true => Ok(scenario.with_duration(chosen_s)),
        false => Err(place.refuse(chosen_s, allowed)),
    }
}

/// What `solution.json` says is what the trajectory shows.
fn check_claims(
    solution: &Solution,
    scenario: &Scenario,
    trajectory: &Trajectory,
    ledger: &mut Ledger,
) {
    let is_changed = solution.scenario.sha256() != solution.scenario_sha256;
    let mut hash = Worst::new("scenario changed since it was solved", "", 0.0);
    hash.at_most(f64::from(u8::from(is_changed)), 0.0, None, None);
    ledger.add(hash);

    let mut cost = Worst::new("objective mismatch", "", 0.0);
    let found = objective(scenario, trajectory);
    cost.at_most((found - solution.objective).abs(), REPORTED * found.abs().max(1e-9), None, None);
    ledger.add(cost);

    let end = State::of_node(trajectory.end());
    let asked = Requirements::new(scenario);
    let found = asked.goal.reached(&end, &asked.slides);
    let claimed = &solution.terminal;
    let pairs = [
        (found.attitude_error, claimed.attitude_error),
        (found.attitude_error_deg, claimed.attitude_error_deg),
        (found.angular_rate_deg_s, claimed.angular_rate_deg_s),
        (found.joint_rate_deg_s, claimed.joint_rate_deg_s),
        (found.joint_speed_m_s.unwrap_or(0.0), claimed.joint_speed_m_s.unwrap_or(0.0)),
    ];
    let mut terminal = Worst::new("terminal mismatch", "", 0.0);
    for (found, claimed) in pairs {
        terminal.at_most((found - claimed).abs(), REPORTED * found.abs().max(1.0), None, None);
    }
    ledger.add(terminal);
}
