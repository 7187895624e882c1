//! A problem that misbehaves on command.

use righting_ipopt::*;

/// Which method is being called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    Objective,
    Gradient,
    Constraints,
    Jacobian,
    Hessian,
}

/// What it does instead of its work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mischief {
    None,
    Refuse,
    Nan,
    Infinite,
    Panic,
}

/// `inner`, except where `meddle` says otherwise of a method, its call (from zero) and the point.
pub struct Meddling<P, M> {
    pub inner: P,
    pub meddle: M,
    pub calls: [usize; 5],
}

impl<P, M: FnMut(Method, usize, &[f64]) -> Mischief> Meddling<P, M> {
    pub fn new(inner: P, meddle: M) -> Self {
        Self { inner, meddle, calls: [0; 5] }
    }

    fn around(
        &mut self,
        method: Method,
        x: &[f64],
        out: &mut [f64],
        work: impl FnOnce(&mut P, &mut [f64]) -> Result<(), EvaluationError>,
    ) -> Result<(), EvaluationError> {
        let call = self.calls[method as usize];
        self.calls[method as usize] += 1;
        let mischief = (self.meddle)(method, call, x);
        match mischief {
            Mischief::Refuse => return Err(EvaluationError),
            Mischief::Panic => std::panic::panic_any(method),
            _ => work(&mut self.inner, out)?,
        }
        if let Some(last) = out.last_mut() {
            match mischief {
                Mischief::Nan => *last = f64::NAN,
                Mischief::Infinite => *last = f64::INFINITY,
                _ => {}
            }
        }
        Ok(())
    }
}

impl<P: Problem, M: FnMut(Method, usize, &[f64]) -> Mischief> Problem for Meddling<P, M> {
    fn dimensions(&self) -> Dimensions {
        self.inner.dimensions()
    }

    fn bounds(&self, bounds: &mut Bounds) {
        self.inner.bounds(bounds);
    }

    fn jacobian_structure(&self) -> TripletStructure {
        self.inner.jacobian_structure()
    }

    fn hessian_structure(&self) -> TripletStructure {
        self.inner.hessian_structure()
    }

    fn objective(&mut self, x: &[f64], new_x: bool) -> Result<f64, EvaluationError> {
        let mut value = [0.0];
        self.around(Method::Objective, x, &mut value, |inner, value| {
            value[0] = inner.objective(x, new_x)?;
            Ok(())
        })?;
        Ok(value[0])
    }

    fn gradient(&mut self, x: &[f64], new: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        self.around(Method::Gradient, x, out, |inner, out| inner.gradient(x, new, out))
    }

    fn constraints(&mut self, x: &[f64], new: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
        self.around(Method::Constraints, x, g, |inner, g| inner.constraints(x, new, g))
    }

    fn jacobian(&mut self, x: &[f64], new: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        self.around(Method::Jacobian, x, out, |inner, out| inner.jacobian(x, new, out))
    }

    fn hessian(
        &mut self,
        x: &[f64],
        new_x: bool,
        factor: f64,
        multipliers: &[f64],
        new_multipliers: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        self.around(Method::Hessian, x, values, |inner, values| {
            inner.hessian(x, new_x, factor, multipliers, new_multipliers, values)
        })
    }
}
