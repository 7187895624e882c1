//! A Python script that flies a plan in MuJoCo.

use righting_results::{Solution, Trajectory};
use righting_scenario::wheels::stored;
use righting_scenario::{Environment, Scenario};

use super::Flight;
use super::python::{Constants, row};
use crate::xml::number;
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
    surroundings(&mut constants, scenario, trajectory);
    Ok(constants.into_script(include_str!("mujoco.py")))
}

/// What acts from outside, and what the wheels store at the beginning of every step and give in it, body axes.
fn surroundings(constants: &mut Constants, scenario: &Scenario, trajectory: &Trajectory) {
    let wheels = scenario.wheels();
    let sums = |values: &[f64]| -> [f64; 3] { stored(wheels, values).into() };
    let steps = trajectory.steps();
    let momenta = trajectory.nodes().iter().take(steps);
    let momenta = momenta.flat_map(|node| sums(&node.wheel_momenta_n_m_s));
    constants.array("WHEEL_MOMENTA", &[steps, 3], momenta);
    let torques = trajectory.intervals().iter();
    let torques = torques.flat_map(|interval| sums(&interval.wheel_torques_n_m));
    constants.array("WHEEL_TORQUES", &[steps, 3], torques);
    let Environment { torque_body_n_m, torque_inertial_n_m, orbit } =
        scenario.environment().cloned().unwrap_or_default();
    constants.value("TORQUE_BODY", &row(torque_body_n_m.iter().copied()));
    constants.value("TORQUE_INERTIAL", &row(torque_inertial_n_m.iter().copied()));
    let (rate, nadir, ahead) =
        orbit.map_or_else(Default::default, |orbit| (orbit.rate_rad_s, orbit.nadir, orbit.ahead));
    constants.value("ORBIT_RATE", &number(rate));
    constants.value("NADIR", &row(nadir.iter().copied()));
    constants.value("AHEAD", &row(ahead.iter().copied()));
}
