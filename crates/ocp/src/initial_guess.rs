use crate::error::OcpError;
use crate::multiple_shooting::MultipleShooting;
use crate::samples::Samples;

/// A trajectory to start from.
#[derive(Debug, Clone)]
pub struct InitialGuess {
    /// All states of the problem at the nodes 0…N; of the first row only what is free is used.
    pub states: Samples,
    /// The controls of the steps 0…N−1.
    pub controls: Samples,
}

impl InitialGuess {
    /// The state held at `state`, no control: the paper's initial guess.
    pub fn constant(state: &[f64], controls: usize, steps: usize) -> Self {
        Self {
            states: Samples::repeated(state, steps + 1),
            controls: Samples::repeated(&vec![0.0; controls], steps),
        }
    }
}

impl MultipleShooting<'_> {
    /// The decision vector of a guess.
    ///
    /// # Errors
    /// [`OcpError::Dimension`] or [`OcpError::NotFinite`] when it does not fit the problem.
    pub fn decision_vector(&self, guess: &InitialGuess) -> Result<Vec<f64>, OcpError> {
        let (functions, steps) = (self.functions(), self.grid().steps());
        for (what, samples, width, rows) in [
            ("guessed states", &guess.states, functions.all_states, steps + 1),
            ("guessed controls", &guess.controls, functions.controls, steps),
        ] {
            let found = samples.rows().map(<[f64]>::len).sum::<usize>();
            if samples.width() != width || found != width * rows {
                return Err(OcpError::Dimension { what, expected: width * rows, found });
            }
            if let Some((index, value)) = samples.first_not_finite() {
                return Err(OcpError::NotFinite { what, index, value });
            }
        }
        let layout = self.layout();
        let mut z = vec![0.0; layout.variables()];
        for (target, &place) in z.iter_mut().zip(&functions.free) {
            *target = guess.states.row(0)[functions.active[place]];
        }
        for step in 0..steps {
            if functions.controls > 0 {
                z[layout.control(step)].copy_from_slice(guess.controls.row(step));
            }
            let row = guess.states.row(step + 1);
            for (target, &source) in z[layout.state(step + 1)].iter_mut().zip(&functions.active) {
                *target = row[source];
            }
        }
        Ok(z)
    }
}
