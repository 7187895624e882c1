//! The equations of a system as compiled functions.

use nalgebra::Vector3;
use pyo3::exceptions::PyRuntimeError;
use righting_multibody::{Quaternion, System};
use righting_symbolic::{
    Expr, FunctionError, SparseMatrix, Sparsity, hessian_lower, jacobian, trace,
};

use crate::failure::{Failure, Outcome};
use crate::function::Function;

/// Name of the Hessians: their lower triangles.
const HESSIAN: &str = "hessian";

/// ẋ of the full form: x = [r, q_BN, ṙ, ω, q, q̇], u = q̈.
pub fn full_dynamics(model: &System, order: usize) -> Outcome<Function> {
    let joints = model.joint_count();
    traced(|| {
        let (x, u) = (Expr::symbols("x", 13 + 2 * joints), Expr::symbols("u", joints));
        let rates = model.state_derivative(&x, &u, None);
        Equations { name: "full_dynamics", variables: &[("x", &x), ("u", &u)], parameters: &[] }
            .compiled("rates", &rates, order)
    })
}

/// ẋ of the reduced form: x = [q_BN, q, q̇], u = q̈, with the angular momentum in inertial axes as a parameter.
pub fn reduced_dynamics(model: &System, order: usize) -> Outcome<Function> {
    let joints = model.joint_count();
    traced(|| {
        let (x, u) = (Expr::symbols("x", 4 + 2 * joints), Expr::symbols("u", joints));
        let momentum = Expr::symbols("momentum", 3);
        let attitude = Quaternion::new(x[0], x[1], x[2], x[3]);
        let (angles, joint_rates) = x[4..].split_at(joints);
        let in_body = attitude.to_body(&vector(&momentum));
        let omega = model.reduced_angular_rate(angles, joint_rates, &in_body);
        let turning = attitude.rate(&omega).to_array().into_iter();
        let rates: Vec<Expr> =
            turning.chain(joint_rates.iter().copied()).chain(u.iter().copied()).collect();
        Equations {
            name: "reduced_dynamics",
            variables: &[("x", &x), ("u", &u)],
            parameters: &[("momentum", &momentum)],
        }
        .compiled("rates", &rates, order)
    })
}

/// Torques of the joints of the free-floating system: of ω, q, q̇ and q̈.
pub fn joint_torques(model: &System, order: usize) -> Outcome<Function> {
    let joints = model.joint_count();
    traced(|| {
        let omega = Expr::symbols("angular_rate", 3);
        let angles = Expr::symbols("joint_angles", joints);
        let rates = Expr::symbols("joint_rates", joints);
        let accelerations = Expr::symbols("joint_accelerations", joints);
        let torques = model.joint_torques(&vector(&omega), &angles, &rates, &accelerations, None);
        let variables: [(&str, &[Expr]); 4] = [
            ("angular_rate", &omega),
            ("joint_angles", &angles),
            ("joint_rates", &rates),
            ("joint_accelerations", &accelerations),
        ];
        Equations { name: "joint_torques", variables: &variables, parameters: &[] }
            .compiled("torques", &torques, order)
    })
}

/// Ĩ(q) and B(q) of the angular momentum Ĩ ω + B q̇ about the system's center of mass.
pub fn momentum_map(model: &System) -> Outcome<Function> {
    traced(|| {
        let angles = Expr::symbols("joint_angles", model.joint_count());
        let map = model.momentum_map(&angles);
        let inertia = map.inertia.transpose().iter().copied().collect();
        let columns = map.joint_columns.transpose().iter().copied().collect();
        let function = righting_symbolic::Function::builder("momentum_map")
            .input("joint_angles", &angles)
            .output_sparse("inertia", &dense(3, inertia))
            .output_sparse("joint_columns", &dense(model.joint_count(), columns))
            .build()?;
        Ok(Function::new(function, HESSIAN))
    })
}

/// What values depend on.
struct Equations<'a> {
    name: &'static str,
    /// What derivatives are taken by, in this order.
    variables: &'a [(&'static str, &'a [Expr])],
    /// What they are not taken by.
    parameters: &'a [(&'static str, &'a [Expr])],
}

impl Equations<'_> {
    /// Values, from order 1 on their Jacobian, and from order 2 on the Hessian of their sum by weights.
    fn compiled(
        &self,
        output: &str,
        values: &[Expr],
        order: usize,
    ) -> Result<Function, FunctionError> {
        let all: Vec<Expr> =
            self.variables.iter().flat_map(|(_, symbols)| symbols.iter().copied()).collect();
        let ports = self.variables.iter().chain(self.parameters);
        let builder = righting_symbolic::Function::builder(self.name);
        let mut builder =
            ports.fold(builder, |builder, (name, symbols)| builder.input(name, symbols));
        builder = builder.output(output, values);
        if order >= 1 {
            builder = builder.output_sparse("jacobian", &jacobian(values, &all));
        }
        if order >= 2 {
            let weights = Expr::symbols("weights", values.len());
            let terms = values.iter().zip(&weights).map(|(&value, &weight)| weight * value);
            let sum = terms.fold(Expr::constant(0.0), |sum, term| sum + term);
            builder = builder
                .input("weights", &weights)
                .output_sparse(HESSIAN, &hessian_lower(sum, &all));
        }
        Ok(Function::new(builder.build()?, HESSIAN))
    }
}

fn traced(build: impl FnOnce() -> Result<Function, FunctionError>) -> Outcome<Function> {
    let built = trace(build);
    built.map_err(|error| Failure::Python(PyRuntimeError::new_err(error.to_string())))
}

fn vector(symbols: &[Expr]) -> Vector3<Expr> {
    Vector3::new(symbols[0], symbols[1], symbols[2])
}

/// A matrix of three rows, from its entries row by row.
fn dense(columns: usize, entries: Vec<Expr>) -> SparseMatrix {
    SparseMatrix::new(Sparsity::dense(3, columns), entries)
        .expect("a map of momentum has three rows and a column an entry")
}
