//! How large an arm must be to do what an array of wheels does, and the reverse.

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use righting_multibody::System;
use righting_scenario::system_description::SystemDescription;
use serde::Serialize;

use super::arm::{Arm, Quantity};
use super::extent::{Reach, climb};
use crate::zonotope::Zonotope;

/// Directions in which the two are compared, axes and diagonals among them.
const DIRECTIONS: usize = 66;
/// Brackets of the factor, from one either way: most arms are of the right order.
const BRACKETS: [f64; 4] = [2.0, 10.0, 1e2, 1e6];
/// A longer or heavier arm than this many times is no advice.
const LARGEST: f64 = 1e2;
/// The logarithm of the factor is found to this.
const PRECISION: f64 = 5e-4;

/// Factors at which one side reaches as far as the other in every direction; none where no factor up
/// to 100 does, 0 where a millionth still does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sizing {
    /// On the length of every link, masses held.
    pub arm_length_factor: Option<f64>,
    /// On the mass of every link, lengths held.
    pub arm_mass_factor: Option<f64>,
    /// On the limit of every wheel.
    pub wheel_limit_factor: Option<f64>,
}

/// What about the links is changed.
#[derive(Clone, Copy)]
enum Change {
    Length,
    Mass,
}

/// The factors for one quantity, from the arm's reach as it is.
pub(super) fn sizing(
    description: &SystemDescription,
    of: Quantity,
    reaches: &[Reach],
    wheels: &Zonotope,
) -> Sizing {
    let reaches = &reaches[..DIRECTIONS.min(reaches.len())];
    let factor = |change| {
        smallest_factor(|factor| {
            let Some(model) = scaled(&description.model, change, factor) else { return false };
            let arm = Arm { model: &model, limits: &description.joint_limits };
            let reached = reaches
                .par_iter()
                .map(|reach| {
                    let start = arm.most_at(reach.motion.angles.clone(), &reach.direction, of);
                    climb(arm, of, reach.direction, start)
                })
                .collect::<Vec<_>>();
            reached.iter().all(|reach| reach.extent() >= wheels.extent(&reach.direction))
        })
    };
    let wheel_limit_factor = reaches
        .iter()
        .map(|reach| reach.extent() / wheels.extent(&reach.direction))
        .fold(0.0, f64::max);
    Sizing {
        arm_length_factor: factor(Change::Length),
        arm_mass_factor: factor(Change::Mass),
        wheel_limit_factor: wheel_limit_factor.is_finite().then_some(wheel_limit_factor),
    }
}

/// The smallest factor that suffices, as far as more is better.
fn smallest_factor(suffices: impl Fn(f64) -> bool) -> Option<f64> {
    let (mut low, mut high) = if suffices(1.0) {
        let Some(i) = BRACKETS.iter().position(|&width| !suffices(1.0 / width)) else {
            return Some(0.0);
        };
        (-BRACKETS[i].ln(), if i == 0 { 0.0 } else { -BRACKETS[i - 1].ln() })
    } else {
        let mut wider = BRACKETS.iter().take_while(|&&width| width <= LARGEST);
        let i = wider.position(|&width| suffices(width))?;
        (if i == 0 { 0.0 } else { BRACKETS[i - 1].ln() }, BRACKETS[i].ln())
    };
    while high - low > PRECISION {
        let middle = 0.5 * (low + high);
        *(if suffices(middle.exp()) { &mut high } else { &mut low }) = middle;
    }
    Some(high.exp())
}

/// The system with every link's length or mass multiplied; none where that is not a system.
fn scaled(model: &System, change: Change, factor: f64) -> Option<System> {
    let (length, mass) = match change {
        Change::Length => (factor, 1.0),
        Change::Mass => (1.0, factor),
    };
    model.with_links_scaled(length, mass).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_factor_is_found_across_the_range() {
        for needed in [3e-6, 0.013, 0.4, 0.99, 1.0, 1.7, 6.0, 80.0] {
            let found = smallest_factor(|factor| factor >= needed).expect("in range");
            assert!((found / needed - 1.0).abs() < 2e-3, "{found} for {needed}");
        }
        assert_eq!(smallest_factor(|_| false), None);
        assert_eq!(smallest_factor(|factor| factor >= 150.0), None);
        assert_eq!(smallest_factor(|_| true), Some(0.0));
    }
}
