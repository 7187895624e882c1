//! Targets on the way, as the optimizer is told them: weights of their errors at the nodes from arrival to
//! departure, so large that they are met to far below their tolerances, as the end is.
//!
//! On a grid whose nodes are elsewhere, a waypoint is asked of the nearest ones. The base's rate needs a weight only
//! where wheels turn it: otherwise the base rests where the joints do.

use righting_multibody::Quaternion;
use righting_ocp::{Expr, StepTime};
use righting_scalar::Scalar;
use righting_scenario::scenario::Scenario;
use righting_scenario::wheels::any_works;

use super::{Coordinates, counted, sum_of_squares};
use crate::scaling::WaypointWeights;

/// By how much of a step nodes are taken as earlier, so that one of two that are as near is the nearest.
const TIE: f64 = 1e-6;

/// The waypoints of a slew.
#[derive(Clone, Debug)]
pub(super) struct Waypoints {
    stops: Vec<Stop>,
    weights: WaypointWeights,
    /// Whether the base may turn while the joints rest.
    has_wheels: bool,
    /// What a unit of each joint's coordinate counts, rad.
    counts: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Stop {
    target: Quaternion<f64>,
    arrival: f64,
    departure: f64,
    is_at_rest: bool,
}

impl Waypoints {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let duration = scenario.horizon().duration_s;
        let stops = scenario.waypoints().iter().map(|waypoint| Stop {
            target: waypoint.target,
            arrival: waypoint.arrival * duration,
            departure: waypoint.departure * duration,
            is_at_rest: waypoint.is_at_rest,
        });
        Self {
            stops: stops.collect(),
            weights: WaypointWeights::of(scenario),
            has_wheels: any_works(scenario.wheels()),
            counts: scenario.system().radians_a_unit(),
        }
    }

    /// What the errors at the beginning of a step cost.
    pub(super) fn cost(&self, coordinates: &Coordinates, x: &[Expr], step: StepTime) -> Expr {
        let zero = Expr::constant(0.0);
        let (begins, half) = (step.start - step.length * TIE, step.length * 0.5);
        let attitude = coordinates.attitude_of(x);
        self.stops.iter().fold(zero, |sum, stop| {
            let target = Quaternion::from_array(stop.target.to_array().map(Expr::from));
            let error = attitude.error_vector(&target);
            let mut cost = sum_of_squares(error.as_slice()) * self.weights.attitude;
            if stop.is_at_rest {
                let of_joints = |values: &[Expr]| sum_of_squares(&counted(values, &self.counts));
                let rates = of_joints(coordinates.joint_rates(x));
                let accelerations = of_joints(coordinates.acceleration_states(x));
                cost += (rates + accelerations) * self.weights.rate;
                if self.has_wheels {
                    let rate = coordinates.free_floating_state(x).angular_rate;
                    cost += sum_of_squares(rate.as_slice()) * self.weights.rate;
                }
            }
            let is_after_arrival = begins + half - stop.arrival;
            let is_before_departure = half + stop.departure - begins;
            let within = Expr::select_positive(is_before_departure, cost, zero);
            sum + Expr::select_positive(is_after_arrival, within, zero)
        })
    }
}
