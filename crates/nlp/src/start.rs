/// Where a solve begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// The variables (n). The optimizer moves them into the interior of their bounds, see
    /// [`Options::bound_push`](crate::Options::bound_push).
    pub x: Vec<f64>,
    /// Multipliers make it a warm start: they are used as they are, the `warm_start_…` options
    /// take the place of their namesakes, and [`Options::mu_init`](crate::Options::mu_init) should
    /// match the accuracy of the point.
    pub multipliers: Option<Multipliers>,
}

impl Start {
    /// A cold start at `x`.
    pub fn at(x: Vec<f64>) -> Self {
        Self { x, multipliers: None }
    }
}

/// Lagrange multipliers, for the Lagrangian f + λᵀg − z_Lᵀ(x − x_L) − z_Uᵀ(x_U − x).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Multipliers {
    /// λ of the constraints (m).
    pub constraints: Vec<f64>,
    /// z_L ≥ 0 of the lower bounds (n).
    pub lower: Vec<f64>,
    /// z_U ≥ 0 of the upper bounds (n).
    pub upper: Vec<f64>,
}
