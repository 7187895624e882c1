use std::time::Instant;

use righting_nlp::{
    Declarations, EvaluationTiming, Multipliers, NlpScaling, Options, Problem, Start,
};

use crate::{GivesUp, are_finite, largest};

/// Beyond this a bound is none, as in Ipopt.
const NO_BOUND: f64 = 1e19;

/// One bound of one variable or slack: `sign · (w − value) ≥ 0`. Every iteration reads them a dozen
/// times, so they are small.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bound {
    pub(crate) value: f64,
    index: u32,
    is_upper: bool,
    /// Whether there is no bound on the other side. (Wächter & Biegler 2006, section 3.7.)
    pub(crate) is_only: bool,
}

impl Bound {
    /// Of the variable or slack.
    pub(crate) fn index(&self) -> usize {
        self.index as usize
    }

    /// One for a lower bound, minus one for an upper one.
    pub(crate) fn sign(&self) -> f64 {
        if self.is_upper { -1.0 } else { 1.0 }
    }
}

/// What a constraint demands of g.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Row {
    /// g = this.
    Equality(f64),
    /// g − w\[this\] = 0.
    Slack(usize),
}

/// A problem as the method sees it: scaled, w = (x, s) with a slack for each inequality, and
///
/// ```text
/// min f(x)   s.t.   c(w) = 0,   bounds of w
/// ```
pub(crate) struct Program<'p, P: ?Sized> {
    problem: &'p mut P,
    pub(crate) declared: Declarations,
    pub(crate) rows: Vec<Row>,
    /// The row of each slack.
    pub(crate) slack_rows: Vec<usize>,
    pub(crate) bounds: Vec<Bound>,
    /// Factor of the objective.
    pub(crate) objective_scale: f64,
    /// Factors of the constraints, if any is not one.
    row_scales: Option<Vec<f64>>,
    pub(crate) timing: EvaluationTiming,
    /// Multipliers of the functions before they are scaled.
    unscaled: Vec<f64>,
}

impl<'p, P: Problem + ?Sized> Program<'p, P> {
    /// Scales the functions as Ipopt does by their gradients at the start, and relaxes the bounds.
    pub(crate) fn new(
        problem: &'p mut P,
        options: &Options,
        start: &Start,
    ) -> Result<Self, GivesUp> {
        let declared = Declarations::of(problem)?;
        declared.check_start(start)?;
        let mut program = Self {
            rows: Vec::with_capacity(declared.constraints),
            slack_rows: Vec::new(),
            bounds: Vec::new(),
            problem,
            declared,
            objective_scale: 1.0,
            row_scales: None,
            timing: EvaluationTiming::default(),
            unscaled: Vec::new(),
        };
        if options.nlp_scaling == NlpScaling::GradientBased {
            program.scale_by_gradients(options, &start.x)?;
        }
        program.classify_rows();
        program.bounds = program.relaxed_bounds(options)?;
        if program.rows.len() - program.slack_rows.len() >= program.variables() {
            return Err(GivesUp::Unsupported("as many equations as variables"));
        }
        Ok(program)
    }

    pub(crate) fn variables(&self) -> usize {
        self.declared.variables
    }

    /// Variables and slacks.
    pub(crate) fn primals(&self) -> usize {
        self.variables() + self.slack_rows.len()
    }

    fn scale_by_gradients(&mut self, options: &Options, x: &[f64]) -> Result<(), GivesUp> {
        let (most, least) = (options.nlp_scaling_max_gradient, options.nlp_scaling_min_value);
        let mut gradient = vec![0.0; self.variables()];
        let mut jacobian = vec![0.0; self.declared.jacobian.len()];
        self.gradient(x, &mut gradient)?;
        self.jacobian(x, &mut jacobian)?;
        let steepest = largest(&gradient);
        if steepest > most {
            self.objective_scale = (most / steepest).max(least);
        }
        let mut rows = vec![f64::MIN_POSITIVE; self.declared.constraints];
        for (&row, value) in self.declared.jacobian.rows.iter().zip(&jacobian) {
            let row = &mut rows[row as usize];
            *row = row.max(value.abs());
        }
        // Ipopt scales equalities and inequalities apart.
        let mut is_scaled = false;
        for equalities in [true, false] {
            let in_kind: Vec<usize> = (0..rows.len())
                .filter(|&row| self.declared.is_equality(row) == equalities)
                .collect();
            let scales = in_kind.iter().any(|&row| rows[row] > most);
            is_scaled |= scales;
            for row in in_kind {
                rows[row] = if scales { (most / rows[row]).min(1.0).max(least) } else { 1.0 };
            }
        }
        self.row_scales = is_scaled.then_some(rows);
        Ok(())
    }

    fn classify_rows(&mut self) {
        for row in 0..self.declared.constraints {
            self.rows.push(if self.declared.is_equality(row) {
                Row::Equality(self.row_scale(row) * self.declared.g_lower[row])
            } else {
                self.slack_rows.push(row);
                Row::Slack(self.primals() - 1)
            });
        }
    }

    /// The bounds of variables and slacks, in their order, the lower one of each first.
    fn relaxed_bounds(&self, options: &Options) -> Result<Vec<Bound>, GivesUp> {
        let outwards = |bound: f64| options.bound_relax_factor * bound.abs().max(1.0);
        let mut bounds = Vec::new();
        let mut add = |index: usize, lower: f64, upper: f64, scale: f64| {
            let (has_lower, has_upper) = (lower > -NO_BOUND, upper < NO_BOUND);
            let is_only = has_lower != has_upper;
            let index = index as u32;
            if has_lower {
                let value = scale * (lower - outwards(lower));
                bounds.push(Bound { value, index, is_upper: false, is_only });
            }
            if has_upper {
                let value = scale * (upper + outwards(upper));
                bounds.push(Bound { value, index, is_upper: true, is_only });
            }
        };
        let Declarations { variables, x_lower, x_upper, g_lower, g_upper, .. } = &self.declared;
        for (index, (&lower, &upper)) in x_lower.iter().zip(x_upper).enumerate() {
            if lower == upper {
                return Err(GivesUp::FixedVariable { index });
            }
            add(index, lower, upper, 1.0);
        }
        for (slack, &row) in self.slack_rows.iter().enumerate() {
            add(variables + slack, g_lower[row], g_upper[row], self.row_scale(row));
        }
        Ok(bounds)
    }

    /// f at these variables.
    pub(crate) fn objective(&mut self, x: &[f64]) -> Result<f64, GivesUp> {
        let started = Instant::now();
        let value = self.problem.objective(x, true);
        self.timing.objective.add_since(started);
        match value {
            Ok(value) if value.is_finite() => Ok(self.objective_scale * value),
            _ => Err(GivesUp::Undefined),
        }
    }

    /// c at these variables and slacks.
    pub(crate) fn residuals(&mut self, w: &[f64], c: &mut [f64]) -> Result<(), GivesUp> {
        let x = &w[..self.variables()];
        let started = Instant::now();
        let defined = self.problem.constraints(x, true, c).is_ok();
        self.timing.constraints.add_since(started);
        if let Some(scales) = &self.row_scales {
            c.iter_mut().zip(scales).for_each(|(c, scale)| *c *= scale);
        }
        for (c, row) in c.iter_mut().zip(&self.rows) {
            *c -= match *row {
                Row::Equality(value) => value,
                Row::Slack(index) => w[index],
            };
        }
        finite(defined, c)
    }

    /// ∇f with respect to the variables.
    pub(crate) fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), GivesUp> {
        let started = Instant::now();
        let defined = self.problem.gradient(x, true, gradient).is_ok();
        self.timing.gradient.add_since(started);
        if self.objective_scale != 1.0 {
            gradient.iter_mut().for_each(|g| *g *= self.objective_scale);
        }
        finite(defined, gradient)
    }

    /// ∂g/∂x.
    pub(crate) fn jacobian(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), GivesUp> {
        let started = Instant::now();
        let defined = self.problem.jacobian(x, true, values).is_ok();
        self.timing.jacobian.add_since(started);
        if let Some(scales) = &self.row_scales {
            for (value, &row) in values.iter_mut().zip(&self.declared.jacobian.rows) {
                *value *= scales[row as usize];
            }
        }
        finite(defined, values)
    }

    /// The Lagrangian's second derivatives.
    pub(crate) fn hessian(
        &mut self,
        x: &[f64],
        y: &[f64],
        values: &mut [f64],
    ) -> Result<(), GivesUp> {
        let started = Instant::now();
        let multipliers = match &self.row_scales {
            None => y,
            Some(scales) => {
                self.unscaled.clear();
                self.unscaled.extend(y.iter().zip(scales).map(|(y, scale)| y * scale));
                &self.unscaled
            }
        };
        let factor = self.objective_scale;
        let defined = self.problem.hessian(x, true, factor, multipliers, true, values).is_ok();
        self.timing.hessian.add_since(started);
        finite(defined, values)
    }

    /// Multipliers of the caller's problem as those of the scaled one: y, and z of each bound of a
    /// variable; those of slacks follow from y.
    pub(crate) fn scaled_multipliers(&self, start: &Start) -> Option<(Vec<f64>, Vec<f64>)> {
        let Multipliers { constraints, lower, upper } = start.multipliers.as_ref()?;
        let y: Vec<f64> = (0..constraints.len())
            .map(|row| constraints[row] * self.multiplier_scale(row))
            .collect();
        let mut of_slack = vec![0.0; self.primals()];
        for (row, y) in self.rows.iter().zip(&y) {
            if let Row::Slack(index) = *row {
                of_slack[index] = *y;
            }
        }
        let z = self.bounds.iter().map(|bound| match bound.index() < self.variables() {
            true if bound.sign() > 0.0 => lower[bound.index()] * self.objective_scale,
            true => upper[bound.index()] * self.objective_scale,
            false => -bound.sign() * of_slack[bound.index()],
        });
        Some((y, z.collect()))
    }

    /// The multipliers of the caller's problem.
    pub(crate) fn unscaled_multipliers(&self, y: &[f64], z: &[f64]) -> Multipliers {
        let (mut lower, mut upper) = (vec![0.0; self.variables()], vec![0.0; self.variables()]);
        for (bound, z) in self.bounds.iter().zip(z) {
            if bound.index() < self.variables() {
                let side = if bound.sign() > 0.0 { &mut lower } else { &mut upper };
                side[bound.index()] = z / self.objective_scale;
            }
        }
        let constraints =
            y.iter().enumerate().map(|(row, y)| y / self.multiplier_scale(row)).collect();
        Multipliers { constraints, lower, upper }
    }

    fn multiplier_scale(&self, row: usize) -> f64 {
        self.objective_scale / self.row_scale(row)
    }

    pub(crate) fn row_scale(&self, row: usize) -> f64 {
        self.row_scales.as_ref().map_or(1.0, |scales| scales[row])
    }

    /// Puts a point back into the caller's bounds, which were relaxed.
    pub(crate) fn put_within_bounds(&self, x: &mut [f64]) {
        for ((x, lower), upper) in
            x.iter_mut().zip(&self.declared.x_lower).zip(&self.declared.x_upper)
        {
            *x = x.clamp(*lower, *upper);
        }
    }

    /// g of the caller's problem; not a number where it is not defined.
    pub(crate) fn unscaled_constraints(&mut self, x: &[f64]) -> Vec<f64> {
        let mut g = vec![0.0; self.rows.len()];
        if self.problem.constraints(x, true, &mut g).is_err() {
            g.fill(f64::NAN);
        }
        g
    }
}

fn finite(defined: bool, values: &[f64]) -> Result<(), GivesUp> {
    if defined && are_finite(values) { Ok(()) } else { Err(GivesUp::Undefined) }
}
