//! The grid on which initial guesses are ranked, and the meshes between it and the asked one.

use righting_ocp::{Grid, OcpError};
use righting_scenario::scenario::Scenario;

/// Steps of the grid on which guesses are ranked: coarse enough that five of them cost less than
/// the asked grid, fine enough to tell the optima apart.
const COARSE_STEPS: usize = 20;
/// A long maneuver takes more of them: so far may the fastest joint turn in one, rad. Beyond that the
/// steps integrate so poorly that the order of the optima changes.
const COARSE_TURN_RAD: f64 = 0.46;
/// But no more than these.
const MOST_COARSE_STEPS: usize = 120;
/// How much finer than the mesh before it a mesh may be.
const REFINEMENT: usize = 6;

/// The grid on which guesses are ranked.
pub(super) fn coarse(scenario: &Scenario, asked: &Grid) -> Result<Grid, OcpError> {
    let rates = scenario.system().joint_limits.iter().map(|limits| limits.rate_max_rad_s);
    let turn_rad = asked.duration_s() * rates.fold(0.0, f64::max);
    let steps = (turn_rad / COARSE_TURN_RAD).ceil() as usize;
    let steps = steps.clamp(COARSE_STEPS, MOST_COARSE_STEPS);
    asked.with_steps(asked.steps().min(steps))
}

/// The numbers of steps between those of a coarse grid and those of a fine one.
pub(super) fn between(coarse: usize, fine: usize) -> Vec<usize> {
    let mut meshes: Vec<usize> =
        std::iter::successors(Some(fine), |&steps| Some(steps.div_ceil(REFINEMENT)))
            .skip(1)
            .take_while(|&steps| steps > coarse)
            .collect();
    meshes.reverse();
    meshes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_mesh_is_much_finer_than_the_one_before() {
        assert_eq!(between(20, 600), [100]);
        assert_eq!(between(20, 9600), [45, 267, 1600]);
        assert!(between(20, 120).is_empty());
        assert!(between(7, 7).is_empty());
    }
}
