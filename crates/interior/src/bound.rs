use righting_nlp::{Declarations, Options};

/// Beyond this a bound is none (options `nlp_lower_bound_inf` and `nlp_upper_bound_inf`).
const NO_BOUND: f64 = 1e19;

/// One bound of one variable or slack: `sign · (w − value) ≥ 0`. Every iteration reads them a dozen
/// times, so they are small.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bound {
    pub(crate) value: f64,
    index: u32,
    is_upper: bool,
    /// Whether there is no bound on the other side.
    pub(crate) is_only: bool,
}

impl Bound {
    /// The bounds of variables and slacks, in their order, the lower one of each first; each is
    /// relaxed by `bound_relax_factor` (W&B eq. 35) and those of slacks are scaled with their rows.
    pub(crate) fn relaxed(
        declared: &Declarations,
        options: &Options,
        row_scale: impl Fn(usize) -> f64,
    ) -> Vec<Self> {
        let Declarations { x_lower, x_upper, g_lower, g_upper, .. } = declared;
        let of_variables = x_lower.iter().zip(x_upper).map(|(&lower, &upper)| (lower, upper, 1.0));
        let of_slacks =
            declared.inequalities().map(|row| (g_lower[row], g_upper[row], row_scale(row)));
        let outwards = |bound: f64| options.bound_relax_factor * bound.abs().max(1.0);
        let mut bounds = Vec::new();
        for ((lower, upper, scale), index) in of_variables.chain(of_slacks).zip(0..) {
            let (has_lower, has_upper) = (lower > -NO_BOUND, upper < NO_BOUND);
            let is_only = has_lower != has_upper;
            if has_lower {
                let value = scale * (lower - outwards(lower));
                bounds.push(Self { value, index, is_upper: false, is_only });
            }
            if has_upper {
                let value = scale * (upper + outwards(upper));
                bounds.push(Self { value, index, is_upper: true, is_only });
            }
        }
        bounds
    }

    /// Of the variable or slack.
    pub(crate) fn index(&self) -> usize {
        self.index as usize
    }

    /// One for a lower bound, minus one for an upper one.
    pub(crate) fn sign(&self) -> f64 {
        if self.is_upper { -1.0 } else { 1.0 }
    }

    /// How far inside w is.
    pub(crate) fn distance(&self, w: &[f64]) -> f64 {
        self.sign() * (w[self.index()] - self.value)
    }
}
