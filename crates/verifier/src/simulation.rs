//! The second integration: from a start and the controls alone.

use righting_results::trajectory::ControlInterval;
use righting_scenario::scenario::Horizon;

use crate::dormand_prince::DormandPrince;
use crate::joints::Accelerations;
use crate::model::{Model, Motion, Outside, State, Surroundings};
use crate::requirements::Requirements;
use crate::wheels::{Store, Wheels};

/// An interval of a trajectory: when it begins, and what joints and wheels do then.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span<'i> {
    pub start_s: f64,
    pub accelerations: Accelerations<'i>,
    pub store: Store,
}

impl Span<'_> {
    /// What acts on the bodies in a state, a time after the beginning.
    pub fn outside(&self, surroundings: &Surroundings, state: &State<'_>, after_s: f64) -> Outside {
        let store = self.store.after(after_s);
        surroundings.at(&state.attitude, self.start_s + after_s).with_wheels(
            state,
            &store.momentum,
            &store.torque,
        )
    }
}

/// What follows the motion within the intervals of a trajectory.
pub(super) struct Follower<'a> {
    model: &'a Model,
    surroundings: &'a Surroundings,
    pub motion: Motion,
    /// The joint accelerations (j, rad/s²) that were looked at last.
    pub control: Vec<f64>,
    integrator: DormandPrince,
}

impl<'a> Follower<'a> {
    pub fn new(model: &'a Model, surroundings: &'a Surroundings) -> Self {
        let joints = model.joint_count();
        Self {
            model,
            surroundings,
            motion: Motion::new(model),
            control: vec![0.0; joints],
            integrator: DormandPrince::new(State::dimension(joints)),
        }
    }

    /// Carries a state vector from `before_s` after the beginning of an interval on by `duration_s`; one that
    /// cannot be followed is NaN from there on.
    pub fn advance(&mut self, x: &mut [f64], span: Span<'_>, before_s: f64, duration_s: f64) {
        let Self { model, surroundings, motion, control, integrator } = self;
        let followed = integrator.advance(x, duration_s, |after_s, x, rate| {
            let after_s = before_s + after_s;
            span.accelerations.write(after_s, control);
            let outside = span.outside(surroundings, &State::from_slice(x), after_s);
            model.state_derivative(x, control, &outside, motion, rate);
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
    /// What the wheels store at the beginning of every interval, and give in it.
    stores: Vec<Store>,
}

impl Simulation {
    /// Integrates the full equations of motion from the state vector `start`. After a state that
    /// cannot be followed, all later ones are NaN.
    pub fn new(
        (model, surroundings, wheels): (&Model, &Surroundings, &Wheels),
        horizon: Horizon,
        start: &[f64],
        intervals: &[ControlInterval],
    ) -> Self {
        let mut follower = Follower::new(model, surroundings);
        let step_s = |k| horizon.time_s(k + 1) - horizon.time_s(k);
        let stores: Vec<Store> = wheels.stores(intervals, step_s).collect();
        let mut x = start.to_vec();
        let mut states = Vec::with_capacity(start.len() * (intervals.len() + 1));
        states.extend(&x);
        for (k, interval) in intervals.iter().enumerate() {
            let (start_s, store) = (horizon.time_s(k), stores[k]);
            let span = Span { start_s, accelerations: Accelerations::of(interval), store };
            follower.advance(&mut x, span, 0.0, step_s(k));
            states.extend(&x);
        }
        Self { states, dimension: start.len(), stores }
    }

    /// Interval `k` of the trajectory, which is `interval`.
    pub fn span<'i>(
        &self,
        asked: &Requirements,
        k: usize,
        interval: &'i ControlInterval,
    ) -> Span<'i> {
        Span {
            start_s: asked.horizon.time_s(k),
            accelerations: Accelerations::of(interval),
            store: self.stores[k],
        }
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
