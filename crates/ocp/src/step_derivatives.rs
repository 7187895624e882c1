//! The exact derivatives of one integration step, a few classical Runge–Kutta steps of length h with the same
//! control, composed from the derivatives of ẋ at their stage points y_1…y_4 (not from one graph of the
//! whole step: the joint states of a mechanical system then cost next to nothing, and ẋ is differentiated
//! once instead of at every stage).
//!
//! With z = (x, u), S = dx/dz where a Runge–Kutta step begins ([I 0] in the first), K_i = d k_i/dz and
//! Y_i = d(y_i, u)/dz,
//!
//! ```text
//! Y_i = [S + c_i h K_{i−1}; [0 I]]      K_i = J_i Y_i      S⁺ = S + h Σ b_i K_i
//! ```
//!
//! and ∂F/∂z is S⁺ of the last. With λ the multipliers of where a Runge–Kutta step ends,
//!
//! ```text
//! μ_4 = h/6 λ,  μ_i = b_i h λ + c_{i+1} h J_{i+1,x}ᵀ μ_{i+1}      λ⁻ = λ + Σ J_{i,x}ᵀ μ_i
//! ```
//!
//! are those of its stages and of where it begins, and ∇²(λᵀF) = Σ Y_iᵀ ∇²(μ_iᵀ f)(y_i, u) Y_i over all stages.

use righting_symbolic::Expr;

use crate::expr_matrix::ExprMatrix;
use crate::rk4::{NODE, STAGES, WEIGHT};

/// The derivatives of ẋ at the stage points, as expressions.
pub(crate) struct StepDerivatives {
    step: Expr,
    states: usize,
    /// ∂f/∂(x, u) at each stage point.
    jacobians: Vec<ExprMatrix>,
    /// Y_i at each stage point.
    sensitivities: Vec<ExprMatrix>,
    /// ∂F/∂(x, u).
    step_jacobian: ExprMatrix,
}

impl StepDerivatives {
    /// Composes from `jacobians`, ∂f/∂(x, u) at the stage points of Runge–Kutta steps of length `step` one
    /// after the other, each `states × (states + controls)`.
    pub(crate) fn new(
        step: Expr,
        states: usize,
        controls: usize,
        jacobians: Vec<ExprMatrix>,
    ) -> Self {
        let columns = states + controls;
        let mut control_rows = ExprMatrix::zeros(controls, columns);
        for i in 0..controls {
            *control_rows.at_mut(i, states + i) = Expr::constant(1.0);
        }
        let mut begins = ExprMatrix::identity(states, columns);
        let mut sensitivities: Vec<ExprMatrix> = Vec::with_capacity(jacobians.len());
        for jacobians in jacobians.chunks(STAGES) {
            let mut slopes: Vec<ExprMatrix> = Vec::with_capacity(STAGES);
            for (stage, jacobian) in jacobians.iter().enumerate() {
                let state_rows = match slopes.last() {
                    None => begins.clone(),
                    Some(slope) => begins.plus_scaled(step * NODE[stage], slope),
                };
                let sensitivity = state_rows.stacked(&control_rows);
                slopes.push(jacobian.times(&sensitivity));
                sensitivities.push(sensitivity);
            }
            begins = after(step, &begins, &slopes);
        }
        Self { step, states, jacobians, sensitivities, step_jacobian: begins }
    }

    /// ∂F/∂(x, u).
    pub(crate) fn step_jacobian(&self) -> ExprMatrix {
        self.step_jacobian.clone()
    }

    /// μ_i at every stage point for the multipliers λ of F.
    pub(crate) fn stage_multipliers(&self, multipliers: &[Expr]) -> Vec<Vec<Expr>> {
        let mut ends = multipliers.to_vec();
        let mut stages = vec![Vec::new(); self.jacobians.len()];
        for first in (0..self.jacobians.len()).step_by(STAGES).rev() {
            let mut begins = ends.clone();
            let mut pulled: Option<Vec<Expr>> = None;
            for stage in (0..STAGES).rev() {
                let direct = ends.iter().map(|&l| self.step * WEIGHT[stage] * l);
                let own: Vec<Expr> = match &pulled {
                    None => direct.collect(),
                    Some(pulled) => {
                        let scale = self.step * NODE[stage + 1];
                        direct.zip(pulled).map(|(d, &p)| d + scale * p).collect()
                    }
                };
                // Of the first stage of all nothing is needed further back.
                if first + stage > 0 {
                    let states = self.jacobians[first + stage].leading_columns(self.states);
                    let back = states.transposed_times(&own);
                    begins.iter_mut().zip(&back).for_each(|(sum, &term)| *sum += term);
                    pulled = Some(back);
                }
                stages[first + stage] = own;
            }
            ends = begins;
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

/// S + h Σ b_i K_i.
fn after(step: Expr, begins: &ExprMatrix, slopes: &[ExprMatrix]) -> ExprMatrix {
    let [first, second, third, fourth] = [0, 1, 2, 3].map(|stage| &slopes[stage]);
    // The inner pair first: k_2 and k_3 carry the same weight.
    let one = Expr::constant(1.0);
    let outer = first.plus_scaled(one, fourth);
    let inner = second.plus_scaled(one, third);
    let sum = outer.plus_scaled(Expr::constant(2.0), &inner);
    begins.plus_scaled(step * WEIGHT[0], &sum)
}
