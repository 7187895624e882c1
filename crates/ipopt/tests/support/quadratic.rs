//! The projection of a point onto a polyhedron: small, convex, and free in every declaration.

use righting_ipopt::*;

/// min Σ (xᵢ − targetᵢ)²  s.t.  lower ≤ A x ≤ upper,  within bounds.
#[derive(Clone)]
pub struct Projection {
    pub target: Vec<f64>,
    pub x_bounds: Vec<(f64, f64)>,
    /// The triplets of A.
    pub a: Vec<(i32, i32, f64)>,
    pub g_bounds: Vec<(f64, f64)>,
    pub hessian: TripletStructure,
    pub jacobian: TripletStructure,
    pub scaling: Option<Scaling>,
}

impl Projection {
    /// Without bounds and constraints.
    pub fn of(target: &[f64]) -> Self {
        let diagonal: Vec<i32> = (0..target.len() as i32).collect();
        Self {
            target: target.to_vec(),
            x_bounds: vec![(f64::NEG_INFINITY, f64::INFINITY); target.len()],
            a: Vec::new(),
            g_bounds: Vec::new(),
            hessian: TripletStructure { rows: diagonal.clone(), columns: diagonal },
            jacobian: TripletStructure::default(),
            scaling: None,
        }
    }

    /// With bounds of the variables.
    pub fn within(mut self, x_bounds: &[(f64, f64)]) -> Self {
        self.x_bounds = x_bounds.to_vec();
        self
    }

    /// With one more constraint, given by its nonzero columns.
    pub fn subject_to(mut self, row: &[(i32, f64)], bounds: (f64, f64)) -> Self {
        let i = self.g_bounds.len() as i32;
        for &(j, value) in row {
            self.a.push((i, j, value));
            self.jacobian.rows.push(i);
            self.jacobian.columns.push(j);
        }
        self.g_bounds.push(bounds);
        self
    }
}

impl Problem for Projection {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: self.target.len(), constraints: self.g_bounds.len() }
    }

    fn bounds(&self, bounds: &mut Bounds) {
        for (i, (lower, upper)) in self.x_bounds.iter().enumerate() {
            (bounds.x_lower[i], bounds.x_upper[i]) = (*lower, *upper);
        }
        for (i, (lower, upper)) in self.g_bounds.iter().enumerate() {
            (bounds.g_lower[i], bounds.g_upper[i]) = (*lower, *upper);
        }
    }

    fn jacobian_structure(&self) -> TripletStructure {
        self.jacobian.clone()
    }

    fn hessian_structure(&self) -> TripletStructure {
        self.hessian.clone()
    }

    fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Ok(x.iter().zip(&self.target).map(|(x, t)| (x - t).powi(2)).sum())
    }

    fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        for ((out, x), target) in out.iter_mut().zip(x).zip(&self.target) {
            *out = 2.0 * (x - target);
        }
        Ok(())
    }

    fn constraints(&mut self, x: &[f64], _: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
        g.fill(0.0);
        for &(i, j, value) in &self.a {
            g[i as usize] += value * x[j as usize];
        }
        Ok(())
    }

    fn jacobian(&mut self, _: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        assert_eq!(out.len(), self.a.len());
        for (out, (_, _, value)) in out.iter_mut().zip(&self.a) {
            *out = *value;
        }
        Ok(())
    }

    fn hessian(
        &mut self,
        _: &[f64],
        _: bool,
        objective_factor: f64,
        multipliers: &[f64],
        _: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        assert_eq!(multipliers.len(), self.g_bounds.len());
        values.fill(2.0 * objective_factor);
        Ok(())
    }

    fn scaling(&self) -> Option<Scaling> {
        self.scaling.clone()
    }
}
