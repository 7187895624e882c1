use crate::multiple_shooting::MultipleShooting;
use crate::primal_dual_point::PrimalDualPoint;
use crate::rk4::RungeKutta4;
use crate::samples::Samples;

impl MultipleShooting<'_> {
    /// All states at the nodes 0…N and the controls of the steps 0…N−1 of a point on this grid. The
    /// passive states are integrated along the trajectory with the same steps.
    pub fn trajectory(&self, point: &PrimalDualPoint) -> (Samples, Samples) {
        let z = &point.z;
        let (functions, layout, steps) = (self.functions(), self.layout(), self.grid().steps());
        let mut states = Samples::new(functions.all_states);
        let mut controls = Samples::new(functions.controls);
        let mut state = self.full_initial_state().to_vec();
        for (&place, &value) in functions.free.iter().zip(z) {
            state[functions.active[place]] = value;
        }
        states.push(&state);
        let mut integrator = functions.full_ode.as_ref().map(FullIntegrator::new);
        for step in 0..steps {
            let control = &z[layout.control(step)];
            if let Some(integrator) = &mut integrator {
                let substeps = functions.substeps().get();
                let h = self.grid().step_s() / substeps as f64;
                for _ in 0..substeps {
                    integrator.advance(&mut state, control, h);
                }
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

/// Integrates all states.
struct FullIntegrator<'f> {
    ode: &'f righting_symbolic::Function,
    workspace: righting_symbolic::Workspace,
    method: RungeKutta4,
    point: Vec<f64>,
    rates: Vec<f64>,
}

impl<'f> FullIntegrator<'f> {
    fn new(ode: &'f righting_symbolic::Function) -> Self {
        let states = ode.input_ports()[0].len();
        Self {
            ode,
            workspace: ode.workspace(),
            method: RungeKutta4::new(states),
            point: vec![0.0; states],
            rates: vec![0.0; states],
        }
    }

    fn advance(&mut self, state: &mut [f64], control: &[f64], h: f64) {
        let Self { ode, workspace, method, point, rates } = self;
        let next = method.step(h, state, |stage| {
            stage.write_point(point);
            ode.evaluate(workspace, &[point, control], &mut [rates]);
            stage.set_rates(rates);
        });
        state.copy_from_slice(next);
    }
}
