use std::num::NonZeroUsize;

use righting_symbolic::{Expr, Function};

use crate::error::OcpError;
use crate::expr_matrix::ExprMatrix;
use crate::matrix_output::{MatrixOutput, varying};
use crate::node_function::NodeFunction;
use crate::rk4::STAGES;
use crate::step_derivatives::StepDerivatives;

/// The derivatives of one integration step F(x, u), a few Runge–Kutta steps, from those of ẋ at its stage
/// points. All three functions take the ports `h`, the length of a Runge–Kutta step, then the varying entries
/// of J_1, J_2, … of every stage.
#[derive(Debug, Clone)]
pub(crate) struct StepFunctions {
    /// Runge–Kutta steps in one integration step.
    pub(crate) substeps: NonZeroUsize,
    /// `→ −∂F/∂(x, u)`, the sign it has in the defect x⁺ − F.
    pub(crate) first: Function,
    pub(crate) jacobian: MatrixOutput,
    /// `…, λ → μ_1, μ_2, …`.
    pub(crate) multipliers: Function,
    /// `…, H_1, H_2, … → ∇²(λᵀF)`, lower triangle.
    pub(crate) second: Function,
    pub(crate) hessian: MatrixOutput,
}

impl StepFunctions {
    pub(crate) fn compile(
        states: usize,
        controls: usize,
        ode: &NodeFunction,
        substeps: NonZeroUsize,
    ) -> Result<Self, OcpError> {
        let size = states + controls;
        let stages = substeps.get() * STAGES;
        let names = |of: &str| -> Vec<String> {
            (1..=stages).map(|stage| format!("{of}_{stage}")).collect()
        };
        let (jacobian_ports, hessian_ports) = (names("jacobian"), names("hessian"));
        let h = Expr::symbol("h");
        let symbols = |ports: &[String], count: usize| -> Vec<Vec<Expr>> {
            ports.iter().map(|name| Expr::symbols(name, count)).collect()
        };
        let jacobian_values = symbols(&jacobian_ports, ode.jacobian.varying());
        let jacobians = jacobian_values
            .iter()
            .map(|values| ExprMatrix::from_output(&ode.jacobian, values, states, size))
            .collect();
        let derivatives = StepDerivatives::new(h, states, controls, jacobians);
        let port = |name: &str| {
            let builder = Function::builder(name).input("h", &[h]);
            jacobian_ports
                .iter()
                .zip(&jacobian_values)
                .fold(builder, |builder, (name, values)| builder.input(name, values))
        };

        let step_jacobian = derivatives.step_jacobian().negated().to_sparse();
        let first = port("step_first").output("jacobian", &varying(&step_jacobian)).build()?;

        let lambda = Expr::symbols("lambda", states);
        let multipliers = names("mu")
            .iter()
            .zip(derivatives.stage_multipliers(&lambda))
            .fold(port("step_multipliers").input("lambda", &lambda), |builder, (name, values)| {
                builder.output(name, &values)
            })
            .build()?;

        let hessian_values = symbols(&hessian_ports, ode.hessian.varying());
        let hessians: Vec<ExprMatrix> = hessian_values
            .iter()
            .map(|values| ExprMatrix::from_output(&ode.hessian, values, size, size).mirrored())
            .collect();
        let step_hessian = derivatives.step_hessian(&hessians).to_sparse();
        let second = hessian_ports
            .iter()
            .zip(&hessian_values)
            .fold(port("step_second"), |builder, (name, values)| builder.input(name, values))
            .output("hessian", &varying(&step_hessian))
            .build()?;
        Ok(Self {
            substeps,
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
