//! How far momentum or torque reaches in every direction.

use nalgebra::Vector3;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use righting_scenario::halton::Halton;

use super::arm::{Arm, Motion, Quantity};
use super::directions::octahedral;
use crate::hull::{Mesh, convex_hull};

/// Arm positions that the search of the coarse directions starts from.
const POOL: usize = 2048;
/// How many of them each coarse direction climbs from.
const STARTS: usize = 4;
/// Refinements of the coarse directions: 66 of them.
const COARSE: usize = 2;
/// Refinements of all directions: 1026 of them, 7° apart.
const FINE: usize = 4;
/// Rounds in which directions take over what others found.
const MOST_EXCHANGES: usize = 6;
/// Steps of a climb; it mostly ends after a dozen.
const MOST_STEPS: usize = 100;
/// A climb ends when this many steps in a row gained less than [`GAIN`].
const PATIENCE: usize = 3;
const GAIN: f64 = 1e-7;
/// Joint angle that a climb's first step turns by at most, rad.
const FIRST_STEP_RAD: f64 = 0.2;

/// The farthest that is reached along one direction.
#[derive(Clone, Debug)]
pub(super) struct Reach {
    pub direction: Vector3<f64>,
    pub motion: Motion,
}

impl Reach {
    /// The support function: the largest component along the direction.
    pub fn extent(&self) -> f64 {
        self.direction.dot(&self.motion.vector)
    }
}

/// The reach along 1026 directions, the six axes first.
///
/// At given joint angles the best rates and accelerations are known; over the angles, several climbs
/// a direction look for the best. Every point found bounds the extent in all directions from below:
/// where another direction's beats a direction's own, that direction climbs on from there.
pub(super) fn reach(arm: Arm<'_>, of: Quantity) -> Vec<Reach> {
    let directions = octahedral(FINE);
    let coarse = octahedral(COARSE).len();
    let pool: Vec<Vec<f64>> =
        Halton::new(arm.joints()).take(POOL).map(|at| arm.angles_at(&spread(at, arm))).collect();
    let mut found = directions[..coarse]
        .par_iter()
        .map(|direction| {
            let mut starts: Vec<Motion> =
                pool.iter().map(|angles| arm.most_at(angles.clone(), direction, of)).collect();
            let along = |motion: &Motion| direction.dot(&motion.vector);
            starts.sort_by(|a, b| along(b).total_cmp(&along(a)));
            best_climb(arm, of, *direction, starts.into_iter().take(STARTS))
        })
        .collect::<Vec<_>>();
    let fine = directions[coarse..]
        .par_iter()
        .map(|direction| {
            let mut nearest: Vec<&Reach> = found.iter().collect();
            let along = |reach: &Reach| direction.dot(&reach.motion.vector);
            nearest.sort_by(|a, b| along(b).total_cmp(&along(a)));
            let starts = nearest.into_iter().take(2).map(|reach| reach.motion.clone());
            best_climb(arm, of, *direction, starts)
        })
        .collect::<Vec<_>>();
    found.extend(fine);
    for _ in 0..MOST_EXCHANGES {
        let improved = found
            .par_iter()
            .map(|own| {
                let along = |reach: &&Reach| own.direction.dot(&reach.motion.vector);
                let better = found.iter().max_by(|a, b| along(a).total_cmp(&along(b)))?;
                let beats = along(&better) > own.extent() + GAIN * own.extent().abs();
                beats.then(|| climb(arm, of, own.direction, better.motion.clone()))
            })
            .collect::<Vec<_>>();
        if improved.iter().all(Option::is_none) {
            break;
        }
        for (own, better) in found.iter_mut().zip(improved) {
            if let Some(better) = better {
                *own = better;
            }
        }
    }
    found
}

/// Halton's points have dimensions for as many joints as are allowed.
fn spread(mut at: Vec<f64>, arm: Arm<'_>) -> Vec<f64> {
    at.resize(arm.joints(), 0.5);
    at
}

/// The farthest reach in any direction: the largest norm, with its motion.
pub(super) fn farthest(arm: Arm<'_>, of: Quantity, reaches: &[Reach]) -> Option<Reach> {
    let mut leading: Vec<&Reach> = reaches.iter().collect();
    leading.sort_by(|a, b| b.motion.vector.norm().total_cmp(&a.motion.vector.norm()));
    let refined = leading.into_iter().take(8).map(|start| {
        let mut best = start.clone();
        // The support along its own point's direction is at least that point's norm.
        for _ in 0..50 {
            let Some(direction) = best.motion.vector.try_normalize(f64::MIN_POSITIVE) else {
                break;
            };
            let norm = best.motion.vector.norm();
            best = climb(arm, of, direction, best.motion);
            if best.motion.vector.norm() <= norm * (1.0 + 1e-9) {
                break;
            }
        }
        best
    });
    refined.max_by(|a, b| a.motion.vector.norm().total_cmp(&b.motion.vector.norm()))
}

/// The convex hull of the points reached: inside the true envelope, touching it in each direction.
pub(super) fn inner_hull(reaches: &[Reach]) -> Mesh {
    convex_hull(&reaches.iter().map(|reach| reach.motion.vector).collect::<Vec<_>>())
}

/// The volume of the half spaces' intersection n·x ≤ s(n): outside the true envelope, by polarity.
/// None where the origin is not inside.
pub(super) fn outer_volume(reaches: &[Reach]) -> Option<f64> {
    let largest = reaches.iter().map(Reach::extent).fold(0.0, f64::max);
    if reaches.iter().any(|reach| reach.extent() <= 1e-9 * largest) {
        return None;
    }
    let polar: Vec<_> = reaches.iter().map(|reach| reach.direction / reach.extent()).collect();
    let polar = convex_hull(&polar);
    let corners: Vec<Vector3<f64>> = polar
        .triangles
        .iter()
        .filter_map(|triangle| {
            let [a, b, c] = triangle.map(|i| polar.vertices[i]);
            let normal = (b - a).cross(&(c - a));
            let offset = normal.dot(&a);
            (offset > 0.0).then(|| normal / offset)
        })
        .collect();
    Some(convex_hull(&corners).volume())
}

/// The best of climbs from several motions.
fn best_climb(
    arm: Arm<'_>,
    of: Quantity,
    direction: Vector3<f64>,
    starts: impl Iterator<Item = Motion>,
) -> Reach {
    let reaches = starts.map(|start| climb(arm, of, direction, start));
    let best = reaches.max_by(|a, b| a.extent().total_cmp(&b.extent()));
    best.unwrap_or_else(|| {
        let middle = arm.angles_at(&vec![0.5; arm.joints()]);
        climb(arm, of, direction, arm.most_at(middle, &direction, of))
    })
}

/// Projected gradient ascent over the joint angles with Barzilai and Borwein's steps (*IMA Journal of
/// Numerical Analysis* 8, 1988), shortened until they gain.
///
/// What is climbed is a maximum of smooth functions; the gradient of the one that leads is enough to
/// rise by (Danskin).
pub(super) fn climb(arm: Arm<'_>, of: Quantity, direction: Vector3<f64>, start: Motion) -> Reach {
    let mut at = arm.most_at(start.angles.clone(), &direction, of);
    let along = |motion: &Motion| direction.dot(&motion.vector);
    if along(&at) < along(&start) {
        at = start;
    }
    let mut slope = arm.slope(&at, &direction, of);
    let steepest = slope.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut step = FIRST_STEP_RAD / steepest.max(f64::MIN_POSITIVE);
    let mut idle = 0;
    for _ in 0..MOST_STEPS {
        let moved = at.angles.iter().zip(&slope).map(|(q, g)| q + (step * g).clamp(-0.5, 0.5));
        let trial = arm.most_at(arm.within_limits(moved.collect()), &direction, of);
        let turned: Vec<f64> = trial.angles.iter().zip(&at.angles).map(|(b, a)| b - a).collect();
        let length_squared: f64 = turned.iter().map(|x| x * x).sum();
        if length_squared < 1e-16 {
            break;
        }
        if along(&trial) <= along(&at) {
            step *= 0.25;
            continue;
        }
        let gain = along(&trial) - along(&at);
        idle = if gain < GAIN * along(&trial).abs() { idle + 1 } else { 0 };
        at = trial;
        if idle == PATIENCE {
            break;
        }
        let next = arm.slope(&at, &direction, of);
        let bend: f64 =
            turned.iter().zip(next.iter().zip(&slope)).map(|(s, (b, a))| s * (b - a)).sum();
        if bend < 0.0 {
            step = length_squared / -bend;
        } else {
            step *= 2.0;
        }
        slope = next;
    }
    Reach { direction, motion: at }
}
