//! The second integration: from a start and the controls alone.

use righting_results::trajectory::ControlInterval;
use righting_scenario::scenario::Horizon;

use crate::dormand_prince::DormandPrince;
use crate::joints::Accelerations;
use crate::model::{Model, Motion, State};

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
        let mut motion = Motion::new(model);
        let mut integrator = DormandPrince::new(start.len());
        let mut control = vec![0.0; model.joint_count()];
        let mut x = start.to_vec();
        let mut states = Vec::with_capacity(start.len() * (intervals.len() + 1));
        states.extend(&x);
        for (k, interval) in intervals.iter().enumerate() {
            let duration_s = horizon.time_s(k + 1) - horizon.time_s(k);
            let accelerations = Accelerations::of(interval);
            let followed = integrator.advance(&mut x, duration_s, |after_s, x, rate| {
                accelerations.write(after_s, &mut control);
                model.state_derivative(x, &control, &mut motion, rate);
            });
            if !followed {
                x.fill(f64::NAN);
            }
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
