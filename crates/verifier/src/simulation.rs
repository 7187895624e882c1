//! The second integration: from a start and the controls alone.

use righting_results::trajectory::ControlInterval;
use righting_scenario::scenario::Horizon;

use crate::dormand_prince::DormandPrince;
use crate::joints::Accelerations;
use crate::model::{Model, Motion, State};

/// What follows the motion within the intervals of a trajectory.
pub(super) struct Follower<'a> {
    model: &'a Model,
    pub motion: Motion,
    /// The joint accelerations (j, rad/s²) that were looked at last.
    pub control: Vec<f64>,
    integrator: DormandPrince,
}

impl<'a> Follower<'a> {
    pub fn new(model: &'a Model) -> Self {
        let joints = model.joint_count();
        Self {
            model,
            motion: Motion::new(model),
            control: vec![0.0; joints],
            integrator: DormandPrince::new(State::dimension(joints)),
        }
    }

    /// Carries a state vector from `before_s` after the beginning of an interval on by `duration_s`; one that
    /// cannot be followed is NaN from there on.
    pub fn advance(
        &mut self,
        x: &mut [f64],
        accelerations: Accelerations<'_>,
        before_s: f64,
        duration_s: f64,
    ) {
        let Self { model, motion, control, integrator } = self;
        let followed = integrator.advance(x, duration_s, |after_s, x, rate| {
            accelerations.write(before_s + after_s, control);
            model.state_derivative(x, control, motion, rate);
        });
        if !followed {
            x.fill(f64::NAN);
        }
    }
}

/// The motion that controls lead to, at every node.
#[derive(Debug)]
pub(super) struct Simulation {
    /// Of one node after the other.
    states: Vec<f64>,
    dimension: usize,
}

impl Simulation {
    /// Integrates the full equations of motion from the state vector `start`. After a state that
    /// cannot be followed, all later ones are NaN.
    pub fn new(
        model: &Model,
        horizon: Horizon,
        start: &[f64],
        intervals: &[ControlInterval],
    ) -> Self {
        let mut follower = Follower::new(model);
        let mut x = start.to_vec();
        let mut states = Vec::with_capacity(start.len() * (intervals.len() + 1));
        states.extend(&x);
        for (k, interval) in intervals.iter().enumerate() {
            let duration_s = horizon.time_s(k + 1) - horizon.time_s(k);
            follower.advance(&mut x, Accelerations::of(interval), 0.0, duration_s);
            states.extend(&x);
        }
        Self { states, dimension: start.len() }
    }

    /// The states at the N + 1 nodes.
    pub fn nodes(&self) -> impl ExactSizeIterator<Item = State<'_>> {
        self.states.chunks_exact(self.dimension).map(State::from_slice)
    }

    /// The state at the first node.
    pub fn start(&self) -> State<'_> {
        State::from_slice(&self.states[..self.dimension])
    }

    /// The state at the last node.
    pub fn end(&self) -> State<'_> {
        State::from_slice(&self.states[self.states.len() - self.dimension..])
    }
}
