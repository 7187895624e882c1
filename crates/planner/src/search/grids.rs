//! The grid on which initial guesses are ranked, and the meshes between it and the asked one.

use std::num::NonZeroUsize;

use righting_ocp::{Grid, OcpError};
use righting_scenario::ConeSide;
use righting_scenario::scenario::{Horizon, Maneuver, Scenario};

use crate::spin::beginning_s;

/// Steps of the grid on which guesses are ranked: coarse enough that five of them cost less than
/// the asked grid, fine enough to tell the optima apart.
const COARSE_STEPS: usize = 20;
/// A long maneuver takes more of them: so far may the fastest joint turn in one, rad. Beyond that the
/// steps integrate so poorly that the order of the optima changes.
const COARSE_TURN_RAD: f64 = 0.46;
/// A cone that a boresight keeps out of is not stepped over: so many steps, at the least, go to a turn by its
/// half-angle, were the base to turn evenly to the target.
const STEPS_A_HALF_ANGLE: f64 = 4.0;
/// But no more than these.
const MOST_COARSE_STEPS: usize = 120;
/// So far may a base that turns by itself turn in a step, rad: the same of a motion that never rests.
const COARSE_SPIN_RAD: f64 = 0.35;
/// The beginning of a longer horizon has so many, integrated in several Runge–Kutta steps each, …
const BEGINNING_STEPS: usize = 120;
/// … this many at most.
const MOST_SUBSTEPS: usize = 16;
/// How much finer than the mesh before it a mesh may be.
const REFINEMENT: usize = 6;

/// What initial guesses are ranked on: the beginning of the asked horizon in fewer steps.
///
/// That is the whole horizon, but for a base that spins fast for long: nothing is lost when the arm
/// holds still in the rest of a long detumble, which no coarse grid could follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ranking {
    /// Steps of the asked grid in the beginning.
    pub(super) asked_steps: usize,
    /// Steps that the beginning is divided into.
    pub(super) steps: usize,
    /// Runge–Kutta steps in each of them.
    pub(super) substeps: NonZeroUsize,
}

impl Ranking {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let Horizon { duration_s, steps } = scenario.horizon();
        let rates = scenario.system().joint_limits.iter().map(|limits| limits.rate_max_rad_s);
        let turn_rad = duration_s * rates.fold(0.0, f64::max);
        let for_joints = ((turn_rad / COARSE_TURN_RAD).ceil() as usize)
            .max(steps_for_cones(scenario))
            .max(steps_for_legs(scenario))
            .clamp(COARSE_STEPS, MOST_COARSE_STEPS);
        let spin_rad = duration_s * scenario.initial().angular_rate_rad_s.norm();
        let for_spin = (spin_rad / COARSE_SPIN_RAD).ceil() as usize;
        if beginning_s(scenario) >= duration_s * (1.0 - 1e-9) {
            let steps_of_ranking = steps.min(for_joints.max(for_spin));
            return Self {
                asked_steps: steps,
                steps: steps_of_ranking,
                substeps: substeps(for_spin, steps_of_ranking),
            };
        }
        let share = beginning_s(scenario) / duration_s;
        let asked_steps = ((share * steps as f64).ceil() as usize).clamp(1, steps);
        let steps = asked_steps.min(BEGINNING_STEPS);
        let for_spin = (share * for_spin as f64).ceil() as usize;
        Self { asked_steps, steps, substeps: substeps(for_spin, steps) }
    }

    /// The grid, from the asked one.
    pub(super) fn grid(self, asked: &Grid) -> Result<Grid, OcpError> {
        asked.beginning(self.asked_steps, self.steps)
    }

    /// The beginning of the asked grid, its steps as they are.
    pub(super) fn asked_grid(self, asked: &Grid) -> Result<Grid, OcpError> {
        asked.beginning(self.asked_steps, self.asked_steps)
    }

    /// The scenario with the beginning of its horizon alone, on the grid of ranking.
    pub(super) fn scenario(self, scenario: &Scenario) -> Scenario {
        let duration_s = scenario.horizon().step_s() * self.asked_steps as f64;
        scenario.clone().with_horizon(Horizon { duration_s, steps: self.steps })
    }
}

/// How many steps the legs of a slew with waypoints ask for: as many for the shortest as for a whole slew.
fn steps_for_legs(scenario: &Scenario) -> usize {
    let legs = scenario.legs().into_iter().map(|leg| leg.end - leg.start);
    let shortest = legs.filter(|&share| share > 0.0).fold(1.0, f64::min);
    (COARSE_STEPS as f64 / shortest).round() as usize
}

/// How many steps the cones ask for.
fn steps_for_cones(scenario: &Scenario) -> usize {
    let Maneuver::Slew(slew) = scenario.maneuver() else { return 0 };
    let outside = scenario.pointing().iter().filter(|cone| cone.side == ConeSide::Outside);
    let half_angles = outside.map(|cone| cone.half_angle_rad);
    let narrowest_rad = half_angles.fold(f64::INFINITY, f64::min);
    (STEPS_A_HALF_ANGLE * slew.angle_rad.abs() / narrowest_rad).ceil() as usize
}

/// How many Runge–Kutta steps each of `steps` steps takes where so many are needed in all.
fn substeps(needed: usize, steps: usize) -> NonZeroUsize {
    NonZeroUsize::new(needed.div_ceil(steps).min(MOST_SUBSTEPS)).unwrap_or(NonZeroUsize::MIN)
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
