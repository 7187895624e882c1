//! Feedback about a plan, between replans or instead of them.
//!
//! About a plan x*, u*, the motion in the reduced form is linear in what it is off,
//!
//! ```text
//! e_{k+1} = A_k e_k + B_k (u_k − u*_k),   e = [φ, q − q*, q̇ − q̇*],   q_BN = q*_BN ⊗ exp(φ/2)
//! ```
//!
//! and the plan's own cost of the end and of effort is least for u_k = u*_k − K_k e_k, with
//!
//! ```text
//! K_k = (R + B_kᵀ P_{k+1} B_k)⁻¹ B_kᵀ P_{k+1} A_k,   P_k = A_kᵀ P_{k+1} (A_k − B_k K_k)
//! ```
//!
//! from P_N, the end's weights (the finite-horizon linear-quadratic regulator; Anderson & Moore, *Optimal
//! Control: Linear Quadratic Methods*, section 2.4). Accelerations and the rates that they lead to are kept
//! within the joints' limits.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use righting_multibody::Quaternion;
use righting_results::Trajectory;
use righting_scenario::file::Formulation;
use righting_scenario::{Maneuver, Scenario};

use crate::formulation::Coordinates;
use crate::measured::{Measured, Measurement};
use crate::planner::PlanError;
use crate::scaling::Scaling;

/// Why there are no gains about accelerations that are states.
const JERKS: &str =
    "links[].jerk_max_deg_s3: there is no feedback for maneuvers with limited jerks";
/// By how much states are moved to see what follows (rad and rad in the unit of time): central differences are
/// then right to ten digits.
const DIFFERENCE: f64 = 1e-5;

/// Gains about the plan of a slew.
///
/// A clone shares the gains and may follow another plan.
#[derive(Clone)]
pub struct Feedback {
    scaling: Scaling,
    /// In units of its own.
    scenario: Scenario,
    coordinates: Coordinates,
    /// x* of the nodes and u* of the steps.
    states: Vec<Vec<f64>>,
    controls: Vec<Vec<f64>>,
    /// K of each step, j × (3 + 2j).
    gains: Arc<Vec<DMatrix<f64>>>,
}

impl Feedback {
    /// About a plan of a slew.
    ///
    /// # Errors
    /// [`PlanError::NoFeedback`] when the maneuver is no slew, its jerks are limited or it has wheels, [`PlanError::Shape`] when the plan is of other
    /// joints.
    pub fn new(scenario: &Scenario, plan: &Trajectory) -> Result<Self, PlanError> {
        if !matches!(scenario.maneuver(), Maneuver::Slew(_)) {
            return Err(PlanError::NoFeedback("feedback is for slews, this is a detumble"));
        }
        if scenario.system().limits_jerk() {
            return Err(PlanError::NoFeedback(JERKS));
        }
        if !scenario.wheels().is_empty() {
            return Err(PlanError::NoFeedback(
                "wheels: there is no feedback for plans with wheels",
            ));
        }
        crate::planner::require_same_joints(scenario, Some(plan))?;
        let (scenario, scaling) = Scaling::applied(scenario)?;
        let coordinates = Coordinates::new(&scenario, Formulation::Reduced);
        let plan = scaling.trajectory(plan);
        let states = plan.nodes().iter();
        let states: Vec<Vec<f64>> = states
            .map(|node| coordinates.of_free_floating_state(&node.state(), node.time_s))
            .collect();
        let controls: Vec<Vec<f64>> = plan
            .intervals()
            .iter()
            .map(|interval| interval.joint_accelerations_rad_s2.clone())
            .collect();
        let mut feedback =
            Self { scaling, scenario, coordinates, states, controls, gains: Arc::default() };
        feedback.gains = Arc::new(feedback.regulator());
        Ok(feedback)
    }

    /// Follows another plan from node `from` on: where it is at that node and the next ones, and how it accelerates the
    /// joints from each on (j, rad/s²). The gains stay those about the first plan.
    ///
    /// # Panics
    /// There are not so many steps, or not one joint value a joint.
    pub fn follow(&mut self, from: usize, nodes: &[Measurement], accelerations: &[Vec<f64>]) {
        for (step, (node, accelerations)) in nodes.iter().zip(accelerations).enumerate() {
            self.states[from + step] = self.measured(from + step, &node.as_measured());
            self.controls[from + step] = self.scaling.accelerations_measured(accelerations);
        }
    }

    /// K of each step in SI units, j × (3 + 2j): rad/s² (of a joint that slides m/s²) of each joint per rad that the base is
    /// turned from its planned attitude, about each of its axes, and per unit that the joints' coordinates and rates are
    /// off the plan's.
    pub fn gains(&self) -> Vec<DMatrix<f64>> {
        let (joints, time_s) = (&self.scaling.joints, self.scaling.units.time_s);
        let of_error = |entry: usize| match entry {
            0..3 => 1.0,
            _ if entry < 3 + joints.len() => 1.0 / joints[entry - 3],
            _ => time_s / joints[entry - 3 - joints.len()],
        };
        let in_si = |gain: &DMatrix<f64>| {
            DMatrix::from_fn(gain.nrows(), gain.ncols(), |joint, entry| {
                gain[(joint, entry)] * of_error(entry) * joints[joint] / time_s.powi(2)
            })
        };
        self.gains.iter().map(in_si).collect()
    }

    /// The state at a node, as far as it is measured; the rest is the plan's.
    fn measured(&self, node: usize, measured: &Measured<'_>) -> Vec<f64> {
        let here = measured.state(&self.scaling);
        let time = self.scenario.horizon().time_s(node);
        let mut here = self.coordinates.of_free_floating_state(&here, time);
        let momentum = self.coordinates.momentum();
        here[momentum.clone()].copy_from_slice(&self.states[node][momentum]);
        here
    }

    /// Joint accelerations (j, rad/s²) of a step that begins where it is measured.
    ///
    /// What is not finite corrects nothing.
    ///
    /// # Panics
    /// There is no such step, or not one joint value a joint.
    pub fn accelerations(&self, step: usize, measured: &Measured<'_>) -> Vec<f64> {
        let here = self.measured(step, measured);
        let correction = &self.gains[step] * self.off(&here, &self.states[step]);
        if !correction.iter().all(|value| value.is_finite()) {
            return self.scaling.accelerations(&self.controls[step]);
        }
        let limits = self.scenario.system().joint_limits.iter();
        let step_s = self.scenario.horizon().step_s();
        let rates = self.coordinates.joint_rates(&here);
        let commands: Vec<f64> = self.controls[step]
            .iter()
            .zip(&correction)
            .zip(limits.zip(rates))
            .map(|((planned, correction), (limits, rate))| {
                let most = limits.acceleration_max_rad_s2;
                let room = |bound: f64| ((bound - rate) / step_s).clamp(-most, most);
                (planned - correction)
                    .clamp(room(-limits.rate_max_rad_s), room(limits.rate_max_rad_s))
            })
            .collect();
        self.scaling.accelerations(&commands)
    }

    /// e: what a state is off.
    fn off(&self, state: &[f64], planned: &[f64]) -> DVector<f64> {
        let attitude = self.coordinates.attitude_of(state);
        let turned = attitude.error_vector(&self.coordinates.attitude_of(planned)) * 2.0;
        let joints = self.coordinates.driven_states();
        let joints = state[joints.clone()].iter().zip(&planned[joints]).map(|(x, there)| x - there);
        DVector::from_iterator(3 + 2 * self.controls[0].len(), turned.iter().copied().chain(joints))
    }

    /// The state that is off by so much in one of the entries of e.
    fn moved(&self, planned: &[f64], entry: usize, by: f64) -> Vec<f64> {
        let mut state = planned.to_vec();
        match entry {
            0..3 => {
                let mut turn = [1.0, 0.0, 0.0, 0.0];
                turn[1 + entry] = 0.5 * by;
                let attitude = self.coordinates.attitude_of(planned);
                let attitude = attitude.product(&Quaternion::from_array(turn)).normalized();
                state[self.coordinates.attitude()].copy_from_slice(&attitude.to_array());
            }
            _ => state[self.coordinates.driven_states()][entry - 3] += by,
        }
        state
    }

    /// A_k and B_k side by side.
    fn linearized(&self, step: usize) -> DMatrix<f64> {
        let joints = self.controls[0].len();
        let (errors, step_s) = (3 + 2 * joints, self.scenario.horizon().step_s());
        let (planned, control) = (&self.states[step], &self.controls[step]);
        let next = &self.states[step + 1];
        let column = |entry: usize| {
            let ends = [DIFFERENCE, -DIFFERENCE].map(|by| {
                let (mut state, mut control) = (planned.clone(), control.clone());
                match entry.checked_sub(errors) {
                    None => state = self.moved(planned, entry, by),
                    Some(joint) => control[joint] += by,
                }
                self.off(&self.coordinates.moved_on(&state, &control, step_s), next)
            });
            (&ends[0] - &ends[1]) / (2.0 * DIFFERENCE)
        };
        let columns: Vec<DVector<f64>> = (0..errors + joints).map(column).collect();
        DMatrix::from_columns(&columns)
    }

    /// K of every step.
    fn regulator(&self) -> Vec<DMatrix<f64>> {
        let joints = self.controls[0].len();
        let errors = 3 + 2 * joints;
        let weights = self.scenario.weights();
        // The cost of the attitude is that of half the angle.
        // A unit of a joint's coordinate counts so many radians.
        let counts: Vec<f64> =
            self.scenario.system().radians_a_unit().iter().map(|counts| counts.powi(2)).collect();
        let of_end = |entry: usize| match entry {
            0..3 => 0.25 * weights.attitude,
            _ if entry < 3 + joints => weights.joint_angle * counts[entry - 3],
            _ => weights.joint_rate * counts[entry - 3 - joints],
        };
        let mut cost = DMatrix::from_diagonal(&DVector::from_fn(errors, |entry, _| of_end(entry)));
        let effort = weights.control_per_step(self.scenario.horizon()).max(f64::MIN_POSITIVE);
        let mut gains = Vec::with_capacity(self.controls.len());
        for step in (0..self.controls.len()).rev() {
            let both = self.linearized(step);
            let (a, b) = (both.columns(0, errors), both.columns(errors, joints));
            let ahead = b.transpose() * &cost;
            let curvature = &ahead * b
                + DMatrix::from_diagonal(&(&DVector::from_column_slice(&counts) * effort));
            let gain = match curvature.cholesky() {
                Some(factor) => factor.solve(&(ahead * a)),
                None => DMatrix::zeros(joints, errors),
            };
            cost = a.transpose() * &cost * (a - b * &gain);
            cost = (&cost + cost.transpose()) * 0.5;
            gains.push(gain);
        }
        gains.reverse();
        gains
    }
}
