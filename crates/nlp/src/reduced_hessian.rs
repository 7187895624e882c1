/// How the Lagrangian curves at a point, along the constraints and with the bounds in force held:
/// the definiteness of Zᵀ(W + Σ)Z, with Z a basis of the null space of the constraint Jacobian.
///
/// It is told by the inertia of the [`AugmentedSystem`](crate::AugmentedSystem) (Gould,
/// *Mathematical Programming* 32, 1985).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReducedHessian {
    /// Upwards in every direction. With the first-order conditions this is sufficient for a strict
    /// local minimum (Nocedal & Wright, *Numerical Optimization*, 2nd ed., theorem 12.6).
    PositiveDefinite,
    /// Not upwards in some direction, or the constraints are linearly dependent.
    NotPositiveDefinite,
}
