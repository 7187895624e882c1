use crate::nlp::MultipleShooting;
use crate::point::Point;
use crate::rk4::{NODE, STAGES, WEIGHT};
use crate::samples::Samples;

impl MultipleShooting<'_> {
    /// All states at the nodes 0…N and the controls of the steps 0…N−1 of a point on this grid. The
    /// passive states are integrated along the trajectory with the same steps.
    pub fn trajectory(&self, point: &Point) -> (Samples, Samples) {
        let z = &point.z;
        let (functions, layout, steps) = (self.functions(), self.layout(), self.grid().steps());
        let mut states = Samples::new(functions.all_states);
        let mut controls = Samples::new(functions.controls);
        let mut state = self.full_initial_state().to_vec();
        states.push(&state);
        let mut integrator = functions.full_ode.as_ref().map(FullStep::new);
        for step in 0..steps {
            let control = &z[layout.control(step)];
            if let Some(integrator) = &mut integrator {
                integrator.advance(&mut state, control, self.grid().step_s());
            }
            for (&target, &value) in functions.active.iter().zip(&z[layout.state(step + 1)]) {
                state[target] = value;
            }
            states.push(&state);
            controls.push(control);
        }
        (states, controls)
    }
}

/// One integration step of all states.
struct FullStep<'f> {
    ode: &'f righting_symbolic::Function,
    workspace: righting_symbolic::Workspace,
    point: Vec<f64>,
    rates: Vec<f64>,
    next: Vec<f64>,
}

impl<'f> FullStep<'f> {
    fn new(ode: &'f righting_symbolic::Function) -> Self {
        let states = ode.input_ports()[0].len();
        let zeros = vec![0.0; states];
        Self {
            ode,
            workspace: ode.workspace(),
            point: zeros.clone(),
            rates: zeros.clone(),
            next: zeros,
        }
    }

    fn advance(&mut self, state: &mut [f64], control: &[f64], h: f64) {
        self.next.copy_from_slice(state);
        for stage in 0..STAGES {
            for ((point, &start), &rate) in self.point.iter_mut().zip(&*state).zip(&self.rates) {
                *point = if stage == 0 { start } else { start + NODE[stage] * h * rate };
            }
            let inputs = [self.point.as_slice(), control];
            self.ode.evaluate(&mut self.workspace, &inputs, &mut [&mut self.rates]);
            for (next, &rate) in self.next.iter_mut().zip(&self.rates) {
                *next += WEIGHT[stage] * h * rate;
            }
        }
        state.copy_from_slice(&self.next);
    }
}
