//! The classical Runge–Kutta method (Kutta 1901; Hairer, Nørsett & Wanner, *Solving Ordinary
//! Differential Equations I*, section II.1)
//!
//! ```text
//! y_1 = x,  y_i = x + c_i h k_{i−1},  k_i = ẋ(y_i),  c = (·, ½, ½, 1)
//! F = x + h Σ b_i k_i,  b = (1, 2, 2, 1)/6
//! ```

/// Number of stages.
pub(crate) const STAGES: usize = 4;
/// c, y_i = x + NODE\[i\] · h · k_{i−1}.
pub(crate) const NODE: [f64; STAGES] = [0.0, 0.5, 0.5, 1.0];
/// b, F = x + h Σ WEIGHT\[i\] k_i.
pub(crate) const WEIGHT: [f64; STAGES] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Takes steps of the classical Runge–Kutta method. It allocates only when it is made.
///
/// ```
/// use righting_ocp::RungeKutta4;
///
/// // ẋ = −x from 1 over one second.
/// let (mut method, mut x) = (RungeKutta4::new(1), vec![1.0]);
/// for _ in 0..10 {
///     let next = method.step(0.1, &x, |stage| {
///         let mut point = [0.0];
///         stage.write_point(&mut point);
///         stage.set_rates(&[-point[0]]);
///     });
///     x = next.to_vec();
/// }
/// assert!((x[0] - (-1.0_f64).exp()).abs() < 1e-6);
/// ```
#[derive(Debug, Clone)]
pub struct RungeKutta4 {
    rates: Vec<f64>,
    next: Vec<f64>,
}

/// One stage of a step: where to evaluate ẋ, and where its value goes.
#[derive(Debug)]
pub struct StagePoint<'a> {
    index: usize,
    state: &'a [f64],
    /// c_i h.
    offset: f64,
    /// k_{i−1}, then k_i.
    rates: &'a mut [f64],
}

impl RungeKutta4 {
    /// For so many states.
    pub fn new(states: usize) -> Self {
        Self { rates: vec![0.0; states], next: vec![0.0; states] }
    }

    /// One step of length `h` from `state`; `evaluate` sets the rates of each of the four stages.
    pub fn step(
        &mut self,
        h: f64,
        state: &[f64],
        mut evaluate: impl FnMut(&mut StagePoint<'_>),
    ) -> &[f64] {
        let mut next = std::mem::take(&mut self.next);
        next.copy_from_slice(state);
        self.stages(h, state, |stage| {
            evaluate(stage);
            add_scaled(&mut next, WEIGHT[stage.index] * h, stage.rates);
        });
        self.next = next;
        &self.next
    }

    /// The stages of such a step alone.
    fn stages(&mut self, h: f64, state: &[f64], mut evaluate: impl FnMut(&mut StagePoint<'_>)) {
        for (index, node) in NODE.into_iter().enumerate() {
            let rates = &mut self.rates;
            evaluate(&mut StagePoint { index, state, offset: node * h, rates });
        }
    }
}

impl StagePoint<'_> {
    /// Number of the stage, from zero.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Writes y_i.
    pub fn write_point(&self, point: &mut [f64]) {
        point.copy_from_slice(self.state);
        if self.offset != 0.0 {
            add_scaled(point, self.offset, self.rates);
        }
    }

    /// Takes k_i = ẋ(y_i).
    pub fn set_rates(&mut self, rates: &[f64]) {
        self.rates.copy_from_slice(rates);
    }
}

fn add_scaled(sum: &mut [f64], scale: f64, terms: &[f64]) {
    for (sum, &term) in sum.iter_mut().zip(terms) {
        *sum += scale * term;
    }
}
