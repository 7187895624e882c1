use righting_symbolic::{Expr, Function, hessian_lower, jacobian};

use crate::error::OcpError;
use crate::matrix_output::{MatrixOutput, varying};

/// A function of one node (or step) with its gradient or Jacobian, and the Hessian of its weighted
/// sum.
#[derive(Debug, Clone)]
pub(crate) struct NodeFunction {
    /// Values and first derivatives: ports `value`, `jacobian`.
    pub(crate) first: Function,
    /// Values alone: port `value`.
    pub(crate) value: Function,
    /// Hessian of Σ weight · value: port `hessian`; the weights are the last input.
    pub(crate) second: Function,
    pub(crate) jacobian: MatrixOutput,
    pub(crate) hessian: MatrixOutput,
}

impl NodeFunction {
    pub(crate) fn compile(
        name: &str,
        inputs: &[(&str, &[Expr])],
        values: &[Expr],
    ) -> Result<Self, OcpError> {
        Self::with_parameters(name, inputs, &[], values)
    }

    /// With `parameters`, input ports after those of the variables: no derivatives are taken by them.
    pub(crate) fn with_parameters(
        name: &str,
        inputs: &[(&str, &[Expr])],
        parameters: &[(&str, &[Expr])],
        values: &[Expr],
    ) -> Result<Self, OcpError> {
        let variables: Vec<Expr> =
            inputs.iter().flat_map(|(_, port)| port.iter().copied()).collect();
        let weights = Expr::symbols("weight", values.len());
        let weighted = values
            .iter()
            .zip(&weights)
            .fold(Expr::constant(0.0), |sum, (&value, &weight)| sum + weight * value);
        let first = jacobian(values, &variables);
        let second = hessian_lower(weighted, &variables);
        let port = |suffix: &str| {
            let builder = Function::builder(&format!("{name}_{suffix}"));
            let ports = inputs.iter().chain(parameters);
            ports.fold(builder, |builder, (name, port)| builder.input(name, port))
        };
        Ok(Self {
            value: port("value").output("value", values).build()?,
            first: port("first")
                .output("value", values)
                .output("jacobian", &varying(&first))
                .build()?,
            second: port("second")
                .input("weight", &weights)
                .output("hessian", &varying(&second))
                .build()?,
            jacobian: MatrixOutput::of(&first),
            hessian: MatrixOutput::of(&second),
        })
    }

    pub(crate) fn functions_mut(&mut self) -> [&mut Function; 3] {
        [&mut self.first, &mut self.value, &mut self.second]
    }
}
