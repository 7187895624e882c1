//! The distances that the joint angles decide, as the optimizer is told them.

use std::sync::Arc;

use nalgebra::Vector3;
use righting_multibody::System;
use righting_ocp::ComponentBounds;
use righting_scalar::Scalar;
use righting_scenario::bodies::KeepOut;
use righting_scenario::collision::{Between, CollisionModel, Other, Pair};
use righting_scenario::scenario::Scenario;
use righting_symbolic::{Expr, trace};

/// The optimizers relax bounds of one or less by 1e-8 and leave residuals up to that. Where a distance may be
/// less than this share of the system's size, that shows, …
const SMALL: f64 = 0.025;
/// … so this much more is asked of its square, …
const RELAXED: f64 = 2e-8;
/// … measured by the size times so many times the distance, if that is less than the size's square. Measured
/// by the distance's own square the solves take 2.6 times the iterations.
const RELATIVE_TO: f64 = 200.0;

/// The distances that the joint angles decide, with their smallest values: squared between the cores of
/// capsules, signed from boxes.
#[derive(Clone)]
pub(crate) struct Clearances {
    pub(crate) system: Arc<System>,
    collision: CollisionModel,
    /// Which of all distances depend on the joint angles.
    varying: Vec<usize>,
    /// Whether each is stated relative to the least that is allowed: the optimizer's tolerances are
    /// absolute, and a clearance may be a small part of the system. The paper's are not.
    is_relative: bool,
}

impl Clearances {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let mut clearances = Self {
            system: Arc::new(scenario.system().model.clone()),
            collision: scenario.collision().clone(),
            varying: Vec::new(),
            is_relative: !scenario.solver().is_paper(),
        };
        clearances.varying = trace(|| {
            let q = Expr::symbols("q", clearances.system.joint_count());
            let pairs = clearances.collision.pairs.iter();
            let distances: Vec<Expr> = pairs.map(|pair| clearances.measured(&q, pair)).collect();
            (0..distances.len()).filter(|&i| distances[i].as_constant().is_none()).collect()
        });
        clearances
    }

    /// The distances as they are stated.
    pub(super) fn distances<T: Scalar>(&self, q: &[T]) -> Vec<T> {
        (0..self.len()).map(|place| self.distance(q, place)).collect()
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.varying.len()
    }

    /// What the one at `place` is between.
    pub(crate) fn pair(&self, place: usize) -> &Pair {
        &self.collision.pairs[self.varying[place]]
    }

    /// The names of that.
    pub(crate) fn between(&self, place: usize) -> Between {
        self.pair(place).between
    }

    /// How far the arm keeps from the base and from itself.
    pub(crate) fn clearance_m(&self) -> f64 {
        self.collision.clearance_m
    }

    /// The one at `place`, as it is stated.
    pub(super) fn distance<T: Scalar>(&self, q: &[T], place: usize) -> T {
        self.measured(q, self.pair(place)) * self.measure(place).0.recip()
    }

    fn measured<T: Scalar>(&self, q: &[T], pair: &Pair) -> T {
        let (system, core) = (&self.system, &pair.solid.core);
        match &pair.other {
            Other::Center => system.squared_distance_to_point(q, core, &Vector3::zeros()),
            Other::KeepOut(KeepOut::Capsule { ends_m, .. }) if ends_m[0] == ends_m[1] => {
                system.squared_distance_to_point(q, core, &ends_m[0])
            }
            Other::KeepOut(KeepOut::Capsule { ends_m, .. }) => {
                system.squared_distance_to_segment(q, core, ends_m)
            }
            Other::KeepOut(KeepOut::Cuboid(cuboid)) => {
                cuboid.signed_distance(&system.kinematics(q).core(core))
            }
            Other::Solid(inboard) => system.squared_distance_between(q, &inboard.core, core),
        }
    }

    fn is_squared(&self, place: usize) -> bool {
        !matches!(self.pair(place).other, Other::KeepOut(KeepOut::Cuboid(_)))
    }

    /// What the distance at `place` is measured by, and how much more is asked of it.
    fn measure(&self, place: usize) -> (f64, f64) {
        let size = self.system.size_m();
        let least = self.pair(place).least_of_cores_m();
        let is_small = least > 0.0 && least < SMALL * size;
        match self.is_relative && is_small && self.is_squared(place) {
            true => (size * size.min(RELATIVE_TO * least), RELAXED),
            false => (1.0, 0.0),
        }
    }

    /// The least that the one at `place` may be, as it is stated.
    pub(super) fn least(&self, place: usize) -> f64 {
        let (measure, more) = self.measure(place);
        let least = self.pair(place).least_of_cores_m();
        let least = if self.is_squared(place) { least.powi(2) } else { least };
        least / measure + more
    }

    pub(super) fn bounds(&self) -> ComponentBounds {
        let lower: Vec<f64> = (0..self.len()).map(|place| self.least(place)).collect();
        let upper = vec![f64::INFINITY; lower.len()];
        ComponentBounds::new(lower, upper)
    }
}
