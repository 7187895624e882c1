use std::time::Instant;

use righting_nlp::{
    Declarations, EvaluationTiming, Multipliers, NlpScaling, Options, Problem, Start,
};

use crate::bound::Bound;
use crate::error::FailureReason;
use crate::norm::are_finite;
use crate::scaling::GradientScaling;

/// What a constraint demands of g.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Row {
    /// g = this.
    Equality(f64),
    /// g − w\[this\] = 0.
    Slack(usize),
}

/// A problem as the method sees it: scaled, w = (x, s) with a slack for each inequality (W&B
/// section 3.4), and
///
/// ```text
/// min f(x)   s.t.   c(w) = 0,   bounds of w
/// ```
pub(crate) struct Program<'p, P: ?Sized> {
    problem: &'p mut P,
    pub(crate) declared: Declarations,
    pub(crate) rows: Vec<Row>,
    /// The row of each slack.
    slack_rows: Vec<usize>,
    pub(crate) bounds: Vec<Bound>,
    pub(crate) scaling: GradientScaling,
    pub(crate) timing: EvaluationTiming,
    /// Multipliers of the functions before they are scaled.
    unscaled: Vec<f64>,
}

impl<'p, P: Problem + ?Sized> Program<'p, P> {
    /// Scales the functions by their gradients at the start, and relaxes the bounds.
    pub(crate) fn new(
        problem: &'p mut P,
        options: &Options,
        start: &Start,
    ) -> Result<Self, FailureReason> {
        let declared = Declarations::of(problem)?;
        declared.check_start(start)?;
        if let Some(index) =
            (0..declared.variables).find(|&i| declared.x_lower[i] == declared.x_upper[i])
        {
            return Err(FailureReason::FixedVariable { index });
        }
        let slack_rows: Vec<usize> = declared.inequalities().collect();
        if declared.constraints - slack_rows.len() >= declared.variables {
            return Err(FailureReason::Unsupported("as many equations as variables"));
        }
        let mut program = Self {
            rows: Vec::with_capacity(declared.constraints),
            slack_rows,
            bounds: Vec::new(),
            problem,
            declared,
            scaling: GradientScaling::none(),
            timing: EvaluationTiming::default(),
            unscaled: Vec::new(),
        };
        if options.nlp_scaling == NlpScaling::GradientBased {
            program.scale_by_gradients(options, &start.x)?;
        }
        program.classify_rows();
        let Self { declared, scaling, .. } = &program;
        program.bounds = Bound::relaxed(declared, options, |row| scaling.of_row(row));
        Ok(program)
    }

    pub(crate) fn variables(&self) -> usize {
        self.declared.variables
    }

    /// Variables and slacks.
    pub(crate) fn primals(&self) -> usize {
        self.variables() + self.slack_rows.len()
    }

    /// The row whose slack a bound is of; `None` for that of a variable.
    pub(crate) fn row_of(&self, bound: &Bound) -> Option<usize> {
        bound.index().checked_sub(self.variables()).map(|slack| self.slack_rows[slack])
    }

    fn scale_by_gradients(&mut self, options: &Options, x: &[f64]) -> Result<(), FailureReason> {
        let mut gradient = vec![0.0; self.variables()];
        let mut jacobian = vec![0.0; self.declared.jacobian.len()];
        self.gradient(x, &mut gradient)?;
        self.jacobian(x, &mut jacobian)?;
        self.scaling = GradientScaling::of(&self.declared, options, &gradient, &jacobian);
        Ok(())
    }

    fn classify_rows(&mut self) {
        let mut slack = self.variables();
        for row in 0..self.declared.constraints {
            self.rows.push(if self.declared.is_equality(row) {
                Row::Equality(self.scaling.of_row(row) * self.declared.g_lower[row])
            } else {
                slack += 1;
                Row::Slack(slack - 1)
            });
        }
    }

    /// f at these variables.
    pub(crate) fn objective(&mut self, x: &[f64]) -> Result<f64, FailureReason> {
        let started = Instant::now();
        let value = self.problem.objective(x, true);
        self.timing.objective.add_since(started);
        match value {
            Ok(value) if value.is_finite() => Ok(self.scaling.objective * value),
            _ => Err(FailureReason::Undefined),
        }
    }

    /// c at these variables and slacks.
    pub(crate) fn residuals(&mut self, w: &[f64], c: &mut [f64]) -> Result<(), FailureReason> {
        let x = &w[..self.variables()];
        let started = Instant::now();
        let defined = self.problem.constraints(x, true, c).is_ok();
        self.timing.constraints.add_since(started);
        if let Some(scales) = &self.scaling.constraints {
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
    pub(crate) fn gradient(
        &mut self,
        x: &[f64],
        gradient: &mut [f64],
    ) -> Result<(), FailureReason> {
        let started = Instant::now();
        let defined = self.problem.gradient(x, true, gradient).is_ok();
        self.timing.gradient.add_since(started);
        if self.scaling.objective != 1.0 {
            gradient.iter_mut().for_each(|g| *g *= self.scaling.objective);
        }
        finite(defined, gradient)
    }

    /// ∂g/∂x.
    pub(crate) fn jacobian(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), FailureReason> {
        let started = Instant::now();
        let defined = self.problem.jacobian(x, true, values).is_ok();
        self.timing.jacobian.add_since(started);
        if let Some(scales) = &self.scaling.constraints {
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
    ) -> Result<(), FailureReason> {
        let started = Instant::now();
        let multipliers = match &self.scaling.constraints {
            None => y,
            Some(scales) => {
                self.unscaled.clear();
                self.unscaled.extend(y.iter().zip(scales).map(|(y, scale)| y * scale));
                &self.unscaled
            }
        };
        let factor = self.scaling.objective;
        let defined = self.problem.hessian(x, true, factor, multipliers, true, values).is_ok();
        self.timing.hessian.add_since(started);
        finite(defined, values)
    }

    /// Multipliers of the caller's problem as those of the scaled one: y, and z of each bound of a
    /// variable. Those of a slack follow from y: the Lagrangian is stationary in the slack,
    /// −y − z_L + z_U = 0, and at a solution only one of the two is not zero.
    pub(crate) fn scaled_multipliers(&self, start: &Start) -> Option<(Vec<f64>, Vec<f64>)> {
        let Multipliers { constraints, lower, upper } = start.multipliers.as_ref()?;
        let y: Vec<f64> = (0..constraints.len())
            .map(|row| constraints[row] * self.multiplier_scale(row))
            .collect();
        let z = self.bounds.iter().map(|bound| match self.row_of(bound) {
            None if bound.sign() > 0.0 => lower[bound.index()] * self.scaling.objective,
            None => upper[bound.index()] * self.scaling.objective,
            Some(row) => -bound.sign() * y[row],
        });
        let z = z.collect();
        Some((y, z))
    }

    /// The multipliers of the caller's problem.
    pub(crate) fn unscaled_multipliers(&self, y: &[f64], z: &[f64]) -> Multipliers {
        let (mut lower, mut upper) = (vec![0.0; self.variables()], vec![0.0; self.variables()]);
        for (bound, z) in self.bounds.iter().zip(z) {
            if bound.index() < self.variables() {
                let side = if bound.sign() > 0.0 { &mut lower } else { &mut upper };
                side[bound.index()] = z / self.scaling.objective;
            }
        }
        let constraints =
            y.iter().enumerate().map(|(row, y)| y / self.multiplier_scale(row)).collect();
        Multipliers { constraints, lower, upper }
    }

    fn multiplier_scale(&self, row: usize) -> f64 {
        self.scaling.objective / self.scaling.of_row(row)
    }

    /// Puts a point back into the caller's bounds, which were relaxed (option
    /// `honor_original_bounds`).
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

fn finite(defined: bool, values: &[f64]) -> Result<(), FailureReason> {
    if defined && are_finite(values) { Ok(()) } else { Err(FailureReason::Undefined) }
}
