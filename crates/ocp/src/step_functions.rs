use righting_symbolic::{Expr, Function};

use crate::error::OcpError;
use crate::expr_matrix::ExprMatrix;
use crate::matrix_output::{MatrixOutput, varying};
use crate::node_function::NodeFunction;
use crate::rk4::STAGES;
use crate::step_derivatives::StepDerivatives;

/// Names of the ports that hold the derivatives at the four stage points.
const JACOBIAN_PORTS: [&str; STAGES] = ["jacobian_1", "jacobian_2", "jacobian_3", "jacobian_4"];
const HESSIAN_PORTS: [&str; STAGES] = ["hessian_1", "hessian_2", "hessian_3", "hessian_4"];
const MULTIPLIER_PORTS: [&str; STAGES] = ["mu_1", "mu_2", "mu_3", "mu_4"];

/// The derivatives of one integration step F(x, u) from those of ẋ at its stage points. All three
/// functions take the ports `h`, then the varying entries of J_1…J_4.
#[derive(Debug, Clone)]
pub(crate) struct StepFunctions {
    /// `→ −∂F/∂(x, u)`, the sign it has in the defect x⁺ − F.
    pub(crate) first: Function,
    pub(crate) jacobian: MatrixOutput,
    /// `…, λ → μ_1…μ_4`.
    pub(crate) multipliers: Function,
    /// `…, H_1…H_4 → ∇²(λᵀF)`, lower triangle.
    pub(crate) second: Function,
    pub(crate) hessian: MatrixOutput,
}

impl StepFunctions {
    pub(crate) fn compile(
        states: usize,
        controls: usize,
        ode: &NodeFunction,
    ) -> Result<Self, OcpError> {
        let size = states + controls;
        let h = Expr::symbol("h");
        let jacobian_values =
            JACOBIAN_PORTS.map(|name| Expr::symbols(name, ode.jacobian.varying()));
        let jacobians = jacobian_values
            .iter()
            .map(|values| ExprMatrix::from_output(&ode.jacobian, values, states, size))
            .collect();
        let derivatives = StepDerivatives::new(h, states, controls, jacobians);
        let port = |name: &str| {
            let builder = Function::builder(name).input("h", &[h]);
            JACOBIAN_PORTS
                .iter()
                .zip(&jacobian_values)
                .fold(builder, |builder, (name, values)| builder.input(name, values))
        };

        let step_jacobian = derivatives.step_jacobian().negated().to_sparse();
        let first = port("step_first").output("jacobian", &varying(&step_jacobian)).build()?;

        let lambda = Expr::symbols("lambda", states);
        let multipliers = MULTIPLIER_PORTS
            .iter()
            .zip(derivatives.stage_multipliers(&lambda))
            .fold(port("step_multipliers").input("lambda", &lambda), |builder, (name, values)| {
                builder.output(name, &values)
            })
            .build()?;

        let hessian_values = HESSIAN_PORTS.map(|name| Expr::symbols(name, ode.hessian.varying()));
        let hessians: Vec<ExprMatrix> = hessian_values
            .iter()
            .map(|values| ExprMatrix::from_output(&ode.hessian, values, size, size).mirrored())
            .collect();
        let step_hessian = derivatives.step_hessian(&hessians).to_sparse();
        let second = HESSIAN_PORTS
            .iter()
            .zip(&hessian_values)
            .fold(port("step_second"), |builder, (name, values)| builder.input(name, values))
            .output("hessian", &varying(&step_hessian))
            .build()?;
        Ok(Self {
            first,
            jacobian: MatrixOutput::of(&step_jacobian),
            multipliers,
            second,
            hessian: MatrixOutput::of(&step_hessian),
        })
    }

    pub(crate) fn functions_mut(&mut self) -> [&mut Function; 3] {
        [&mut self.first, &mut self.multipliers, &mut self.second]
    }
}
