//! Steps of the asked grid that are too long for how the base turns: each is integrated in several.

use std::num::NonZeroUsize;

use righting_ocp::{Grid, OcpError, OcpSolution};
use righting_scenario::scenario::Scenario;

use super::{Search, settings, stoppable};

/// How far off a plan's last attitude may be for the steps of its integration, rad: a fifth of what its
/// verification tolerates.
const ACCURATE_RAD: f64 = 2e-5;
/// The most Runge–Kutta steps in a step of the grid.
const MOST_SUBSTEPS: usize = 32;
/// The error of one turn through `φ` in a step, as a share of φ⁴ a radian: measured where a tumbling base
/// nutates (0.068) and rounded up.
const SPIN_ERROR: f64 = 0.1;

/// The Runge–Kutta steps that each step of the asked grid needs for the base's first spin alone.
pub(crate) fn substeps_of_spin(scenario: &Scenario) -> NonZeroUsize {
    let one = NonZeroUsize::MIN;
    if scenario.solver().is_paper() {
        return one;
    }
    let horizon = scenario.horizon();
    let spin_rad = horizon.duration_s * scenario.initial().angular_rate_rad_s.norm();
    let step_rad = spin_rad / horizon.steps as f64;
    let error_rad = SPIN_ERROR * spin_rad * step_rad.powi(4);
    more_substeps(one, error_rad, ACCURATE_RAD).unwrap_or(one)
}

/// How many Runge–Kutta steps it takes instead of `substeps`, which are off by so much, to be off by no more than
/// allowed; none if they will do.
fn more_substeps(substeps: NonZeroUsize, error_rad: f64, allowed_rad: f64) -> Option<NonZeroUsize> {
    if error_rad <= allowed_rad || substeps.get() >= MOST_SUBSTEPS {
        return None;
    }
    let times = (error_rad / allowed_rad).powf(0.25);
    let needed = (substeps.get() as f64 * times).ceil() as usize;
    NonZeroUsize::new(needed.clamp(substeps.get() + 1, MOST_SUBSTEPS))
}

impl Search<'_> {
    /// The solution, or the one near it with the steps of the asked grid integrated in as many Runge–Kutta
    /// steps as the motion needs.
    pub(super) fn integrated_well(
        &mut self,
        mut solution: OcpSolution,
        grid: Grid,
    ) -> Result<OcpSolution, OcpError> {
        // After the beginning of a longer horizon what is off there drifts on.
        let allowed_rad = ACCURATE_RAD * grid.duration_s() / self.grid.duration_s();
        let is_paper = self.scenario.solver().is_paper();
        while solution.status.is_success() && !is_paper && !self.is_interrupted() {
            let error_rad = self.model.integration_error_rad(grid, &solution)?;
            let substeps = self.model.asked_functions().substeps();
            let Some(more) = more_substeps(substeps, error_rad, allowed_rad) else { break };
            self.model.take_substeps(more)?;
            self.keep(&solution);
            let settings = settings::delivered(self.scenario);
            let on_iteration = stoppable(self.on_iteration, &self.stop);
            let mut again = self.model.refine(grid, &[], solution, &settings, on_iteration)?;
            self.attempts.append(&mut again.attempts);
            solution = again;
        }
        Ok(solution)
    }
}
