//! The cones that instruments keep out of, or stay in.
//!
//! With b the boresight in body axes, d the cone's axis in inertial axes, α its half-angle and (w, v) the
//! attitude,
//!
//! ```text
//! dᵀ C b = ((w² − vᵀv) dᵀb + 2 (dᵀv) (vᵀb) + 2 w vᵀ(b × d)) / (w² + vᵀv)  ≤ cos α   outside,  ≥ cos α   inside,
//! ```
//!
//! both sides over sin α, or over a small angle's where that is less: near the cone a radian of turn is then
//! about one of the constraint. The quotient does not change with the quaternion's length, which drifts.

use nalgebra::Vector3;
use righting_multibody::Quaternion;
use righting_ocp::ComponentBounds;
use righting_scalar::Scalar;
use righting_scenario::scenario::Scenario;
use righting_scenario::{ConeSide, Direction, Pointing};

use super::Coordinates;

/// A half-angle below this, or so near to half a turn, is measured as if it were this, rad.
const SMALL_RAD: f64 = 0.02;

/// The cones of a scenario.
#[derive(Clone, Debug)]
pub(crate) struct Cones {
    cones: Vec<Pointing>,
}

impl Cones {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        Self { cones: scenario.pointing().to_vec() }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.cones.len()
    }

    /// The one at `place`.
    pub(crate) fn get(&self, place: usize) -> &Pointing {
        &self.cones[place]
    }

    /// Whether an axis moves.
    pub(crate) fn has_moving(scenario: &Scenario) -> bool {
        scenario.pointing().iter().any(|cone| !cone.direction.is_fixed())
    }

    /// The cosine of the angle from the axis of the one at `place` in a state, as it is stated.
    pub(super) fn cosine<T: Scalar>(&self, coordinates: &Coordinates, x: &[T], place: usize) -> T {
        let Pointing { boresight, direction, .. } = &self.cones[place];
        let boresight = boresight.map(T::from);
        let direction = axis(direction, coordinates.time_of(x));
        let Quaternion { w, vector: v } = coordinates.attitude_of(x);
        let squared = dot(&v, &v);
        let across = Vector3::new(
            boresight.y * direction.z - boresight.z * direction.y,
            boresight.z * direction.x - boresight.x * direction.z,
            boresight.x * direction.y - boresight.y * direction.x,
        );
        let cosine = (w * w - squared) * dot(&direction, &boresight)
            + dot(&v, &direction) * dot(&v, &boresight) * 2.0
            + w * dot(&v, &across) * 2.0;
        cosine * ((w * w + squared) * self.measure(place)).recip()
    }

    /// All of them.
    pub(super) fn cosines<T: Scalar>(&self, coordinates: &Coordinates, x: &[T]) -> Vec<T> {
        (0..self.len()).map(|place| self.cosine(coordinates, x, place)).collect()
    }

    /// The least and the most that the one at `place` may be, as it is stated.
    pub(super) fn bounds_of(&self, place: usize) -> (f64, f64) {
        let cosine = self.cones[place].half_angle_rad.cos() / self.measure(place);
        match self.cones[place].side {
            ConeSide::Outside => (f64::NEG_INFINITY, cosine),
            ConeSide::Inside => (cosine, f64::INFINITY),
        }
    }

    pub(super) fn bounds(&self) -> ComponentBounds {
        let (lower, upper) = (0..self.len()).map(|place| self.bounds_of(place)).unzip();
        ComponentBounds::new(lower, upper)
    }

    fn measure(&self, place: usize) -> f64 {
        self.cones[place].half_angle_rad.sin().max(SMALL_RAD.sin())
    }
}

/// The direction at a time, of unit length. Of a table, v₀ + m₀ (t − t₀) + Σ (mᵢ − mᵢ₋₁) max(0, t − tᵢ) with the
/// vectors v and their slopes m, normalised.
fn axis<T: Scalar>(direction: &Direction, time: T) -> Vector3<T> {
    let Direction { times_s, vectors } = direction;
    let mut sum = vectors[0].map(T::from);
    if direction.is_fixed() {
        return sum;
    }
    let slopes = times_s.windows(2).zip(vectors.windows(2));
    let slopes = slopes.map(|(times, vectors)| (vectors[1] - vectors[0]) / (times[1] - times[0]));
    let mut before = Vector3::zeros();
    for (slope, &from_s) in slopes.zip(times_s) {
        let since = time - from_s;
        // What is at or before the start is always past.
        let since = if from_s > 0.0 { since.maximum(T::from(0.0)) } else { since };
        let change = slope - before;
        sum = Vector3::from_fn(|i, _| sum[i] + since * change[i]);
        before = slope;
    }
    let length = dot(&sum, &sum).sqrt().recip();
    sum.map(|entry| entry * length)
}

fn dot<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> T {
    a.x * b.x + a.y * b.y + a.z * b.z
}
