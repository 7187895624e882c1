use thiserror::Error;

use crate::{Bounds, Scaling, TripletStructure};

/// A nonlinear program with sparse derivatives.
///
/// With n variables and m constraints: `x` has n entries, `g` and the constraint multipliers m.
/// `new_x` is false when `x` is the point of the previous call, so that intermediate results may be
/// kept; the same for `new_multipliers`. Values are written in the order of the structure that was
/// declared; entries given twice are summed.
///
/// An [`EvaluationError`], a NaN or an infinity all say "not defined here". For the objective and
/// the constraints at a trial point the optimizer then shortens the step. At the start, and for a
/// derivative at a point already accepted, it has nothing to shorten and ends with
/// [`Status::InvalidNumber`](crate::Status::InvalidNumber).
pub trait Problem {
    /// How many variables and constraints there are.
    fn dimensions(&self) -> Dimensions;

    /// Writes the bounds. They come filled with −∞ and +∞: no bound. Equal bounds fix a variable or
    /// make an equality constraint. Anything beyond ±1e19 is read as no bound.
    ///
    /// Without this method nothing is bounded.
    fn bounds(&self, _bounds: &mut Bounds) {}

    /// Where ∂g/∂x may be nonzero: m rows, n columns.
    ///
    /// Without this method nowhere, as fits a problem without constraints.
    fn jacobian_structure(&self) -> TripletStructure {
        TripletStructure::default()
    }

    /// Where the lower triangle of the Lagrangian's Hessian may be nonzero: n rows, n columns,
    /// row ≥ column.
    fn hessian_structure(&self) -> TripletStructure;

    /// f(x).
    fn objective(&mut self, x: &[f64], new_x: bool) -> Result<f64, EvaluationError>;

    /// ∇f(x), all n entries.
    fn gradient(
        &mut self,
        x: &[f64],
        new_x: bool,
        gradient: &mut [f64],
    ) -> Result<(), EvaluationError>;

    /// g(x).
    ///
    /// A problem without constraints needs no such method; one with constraints is defined nowhere
    /// without it.
    fn constraints(
        &mut self,
        _x: &[f64],
        _new_x: bool,
        g: &mut [f64],
    ) -> Result<(), EvaluationError> {
        if g.is_empty() { Ok(()) } else { Err(EvaluationError) }
    }

    /// ∂g/∂x.
    ///
    /// A problem without constraints needs no such method; one whose constraints have derivatives
    /// is defined nowhere without it.
    fn jacobian(
        &mut self,
        _x: &[f64],
        _new_x: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        if values.is_empty() { Ok(()) } else { Err(EvaluationError) }
    }

    /// `objective_factor` ∇²f(x) + Σ `multipliers[i]` ∇²gᵢ(x).
    #[allow(clippy::too_many_arguments)]
    fn hessian(
        &mut self,
        x: &[f64],
        new_x: bool,
        objective_factor: f64,
        multipliers: &[f64],
        new_multipliers: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError>;

    /// Scaling that the problem knows better than the optimizer can find out. Where given, it takes the
    /// place of [`Options::nlp_scaling`](crate::Options::nlp_scaling).
    fn scaling(&self) -> Option<Scaling> {
        None
    }
}

/// A function is not defined at the point where it was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("the function cannot be evaluated at this point")]
pub struct EvaluationError;

/// The size of a [`Problem`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dimensions {
    /// n, at least one.
    pub variables: usize,
    /// m, possibly none.
    pub constraints: usize,
}
