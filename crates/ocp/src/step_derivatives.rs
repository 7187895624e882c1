//! The exact derivatives of one classical Runge–Kutta step, composed from the derivatives of ẋ at
//! the four stage points y_1…y_4 (not from one graph of the whole step: the joint states of a
//! mechanical system then cost next to nothing, and ẋ is differentiated once instead of four times).
//!
//! With z = (x, u), K_i = d k_i/dz and Y_i = d(y_i, u)/dz,
//!
//! ```text
//! Y_i = [[I 0] + c_i h K_{i−1}; [0 I]]      K_i = J_i Y_i
//! ∂F/∂z = [I 0] + h Σ b_i K_i
//! μ_4 = h/6 λ,  μ_i = b_i h λ + c_{i+1} h J_{i+1,x}ᵀ μ_{i+1}     ∇²(λᵀF) = Σ Y_iᵀ ∇²(μ_iᵀ f)(y_i, u) Y_i
//! ```

use righting_symbolic::Expr;

use crate::expr_matrix::ExprMatrix;
use crate::rk4::{NODE, STAGES, WEIGHT};

/// The derivatives of ẋ at the four stage points, as expressions.
pub(crate) struct StepDerivatives {
    step: Expr,
    states: usize,
    /// ∂f/∂(x, u) at each stage point.
    jacobians: Vec<ExprMatrix>,
    /// Y_i at each stage point.
    sensitivities: Vec<ExprMatrix>,
    /// K_i at each stage point.
    slopes: Vec<ExprMatrix>,
}

impl StepDerivatives {
    /// Composes from `jacobians`, ∂f/∂(x, u) at y_1…y_4, each `states × (states + controls)`.
    pub(crate) fn new(
        step: Expr,
        states: usize,
        controls: usize,
        jacobians: Vec<ExprMatrix>,
    ) -> Self {
        let columns = states + controls;
        let identity = ExprMatrix::identity(states, columns);
        let mut control_rows = ExprMatrix::zeros(controls, columns);
        for i in 0..controls {
            *control_rows.at_mut(i, states + i) = Expr::constant(1.0);
        }
        let mut sensitivities: Vec<ExprMatrix> = Vec::with_capacity(STAGES);
        let mut slopes: Vec<ExprMatrix> = Vec::with_capacity(STAGES);
        for (stage, jacobian) in jacobians.iter().enumerate() {
            let state_rows = match slopes.last() {
                None => identity.clone(),
                Some(slope) => identity.plus_scaled(step * NODE[stage], slope),
            };
            let sensitivity = state_rows.stacked(&control_rows);
            slopes.push(jacobian.times(&sensitivity));
            sensitivities.push(sensitivity);
        }
        Self { step, states, jacobians, sensitivities, slopes }
    }

    /// ∂F/∂(x, u).
    pub(crate) fn step_jacobian(&self) -> ExprMatrix {
        let [first, second, third, fourth] = [0, 1, 2, 3].map(|stage| &self.slopes[stage]);
        // The inner pair first: k_2 and k_3 carry the same weight.
        let one = Expr::constant(1.0);
        let outer = first.plus_scaled(one, fourth);
        let inner = second.plus_scaled(one, third);
        let columns = ExprMatrix::identity(self.states, self.sensitivities[0].columns());
        let sum = outer.plus_scaled(Expr::constant(2.0), &inner);
        columns.plus_scaled(self.step * WEIGHT[0], &sum)
    }

    /// μ_1…μ_4 for the multipliers λ of F.
    pub(crate) fn stage_multipliers(&self, multipliers: &[Expr]) -> Vec<Vec<Expr>> {
        let mut stages = vec![Vec::new(); STAGES];
        for stage in (0..STAGES).rev() {
            let direct = multipliers.iter().map(|&l| self.step * WEIGHT[stage] * l);
            stages[stage] = match stages.get(stage + 1) {
                None => direct.collect(),
                Some(next) => {
                    let scale = self.step * NODE[stage + 1];
                    let pulled = self.jacobians[stage + 1]
                        .leading_columns(self.states)
                        .transposed_times(next);
                    direct.zip(pulled).map(|(d, p)| d + scale * p).collect()
                }
            };
        }
        stages
    }

    /// The lower triangle of ∇²(λᵀF) from `hessians`, ∇²(μ_iᵀ f) at the stage points.
    pub(crate) fn step_hessian(&self, hessians: &[ExprMatrix]) -> ExprMatrix {
        let size = self.sensitivities[0].columns();
        let mut sum = ExprMatrix::zeros(size, size);
        for (sensitivity, hessian) in self.sensitivities.iter().zip(hessians) {
            sensitivity.add_congruence_lower(hessian, &mut sum);
        }
        sum
    }
}
