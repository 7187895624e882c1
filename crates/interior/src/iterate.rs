use righting_nlp::Problem;

use crate::error::FailureReason;
use crate::primal_point::PrimalPoint;
use crate::program::{Program, Row};

/// A primal–dual iterate (w, y, z) with functions and first derivatives there.
#[derive(Debug)]
pub(crate) struct Iterate {
    pub(crate) point: PrimalPoint,
    /// Multipliers of the constraints.
    pub(crate) y: Vec<f64>,
    /// Multipliers of the bounds.
    pub(crate) z: Vec<f64>,
    /// ∇f, zero for the slacks.
    pub(crate) gradient: Vec<f64>,
    /// ∇f + Jᵀ y − z of the bounds.
    pub(crate) lagrangian_gradient: Vec<f64>,
}

impl Iterate {
    /// An iterate whose derivatives are not evaluated yet.
    pub(crate) fn new(point: PrimalPoint, y: Vec<f64>, z: Vec<f64>) -> Self {
        let zeros = vec![0.0; point.w.len()];
        Self { point, y, z, gradient: zeros.clone(), lagrangian_gradient: zeros }
    }

    /// Evaluates the first derivatives, the Jacobian's to where they are needed.
    pub(crate) fn differentiate<P: Problem + ?Sized>(
        &mut self,
        program: &mut Program<'_, P>,
        jacobian: &mut [f64],
    ) -> Result<(), FailureReason> {
        let variables = program.variables();
        let x = &self.point.w[..variables];
        program.gradient(x, &mut self.gradient[..variables])?;
        program.jacobian(x, jacobian)?;
        self.differentiate_lagrangian(program, jacobian);
        Ok(())
    }

    /// The gradient of the Lagrangian from those of the functions.
    pub(crate) fn differentiate_lagrangian<P: Problem + ?Sized>(
        &mut self,
        program: &Program<'_, P>,
        jacobian: &[f64],
    ) {
        let Self { y, z, gradient, lagrangian_gradient, .. } = self;
        lagrangian_gradient.copy_from_slice(gradient);
        let structure = &program.declared.jacobian;
        let entries = structure.rows.iter().zip(&structure.columns);
        for ((&row, &column), value) in entries.zip(jacobian) {
            lagrangian_gradient[column as usize] += value * y[row as usize];
        }
        for (row, y) in program.rows.iter().zip(y) {
            if let Row::Slack(index) = *row {
                lagrangian_gradient[index] -= *y;
            }
        }
        for (bound, z) in program.bounds.iter().zip(z) {
            lagrangian_gradient[bound.index()] -= bound.sign() * *z;
        }
    }
}
