//! A Python script that flies a plan in MuJoCo.

use righting_results::{Solution, Trajectory};
use righting_scenario::Scenario;

use super::Flight;
use super::python::Constants;
use crate::{ExportError, mjcf};

/// A Python script that builds the system in MuJoCo and flies the plan by its torques alone, nothing
/// correcting them; it prints how far the end is from the plan's, and how far the largest torques are
/// from those that MuJoCo finds for the plan's accelerations. Everything it needs is in it: the model
/// as MJCF, the plan as encoded doubles. `maneuver` says in words what is flown.
///
/// A joint that turns no inertia holds its angle at the start, and of two joints on one axis without
/// inertia between them the second makes the motion of both: torques tell no more.
///
/// # Errors
/// [`ExportError::Motion`] for a motion that cannot be followed.
pub fn mujoco(
    scenario: &Scenario,
    solution: &Solution,
    trajectory: &Trajectory,
    maneuver: &str,
) -> Result<Vec<u8>, ExportError> {
    let flight = Flight::new(scenario, trajectory)?;
    let mut constants = Constants::new(&flight, solution, trajectory, maneuver);
    let model = mjcf::model(scenario.system(), &flight.arm, trajectory);
    constants.lines("MODEL", &model.to_string());
    Ok(constants.into_script(include_str!("mujoco.py")))
}
