//! The structure of the nonlinear program of a scenario.

use righting_ocp::{Grid, KktSparsity, MultipleShooting, OcpError, StageFunctions};
use righting_scenario::scenario::Scenario;

use crate::formulation::FormulatedManeuver;

/// Where the KKT matrix of the program on the scenario's first `steps` intervals can be nonzero.
///
/// # Errors
/// As compiling the stage functions.
pub fn kkt_sparsity(scenario: &Scenario, steps: usize) -> Result<KktSparsity, OcpError> {
    let formulated = FormulatedManeuver::new(scenario);
    let functions = StageFunctions::compile(&formulated.problem)?;
    let horizon = scenario.horizon();
    let steps = steps.clamp(1, horizon.steps);
    let grid = Grid::new(horizon.step_s() * steps as f64, steps)?;
    Ok(MultipleShooting::new(&functions, grid, &formulated.initial)?.kkt_sparsity())
}
