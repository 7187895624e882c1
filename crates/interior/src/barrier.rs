//! The barrier function φ_μ = f − μ Σ ln δ_i and what keeps its iterates inside of the bounds (W&B
//! section 2.1; section 3.4 for bounds on both sides).

use crate::bound::Bound;

/// κ_d, the weight of the linear term that keeps variables with a single bound from drifting off
/// (W&B section 3.7; option `kappa_d`).
const DAMPING: f64 = 1e-5;
/// κ_Σ: a multiplier stays within this factor of μ over its distance (W&B eq. 16; option
/// `kappa_sigma`).
const KAPPA_SIGMA: f64 = 1e10;
/// So many distances are multiplied before their logarithm is taken: their product neither over-
/// nor underflows while each is within ten to the power ±32.
const IN_A_PRODUCT: usize = 8;

/// Distances δ to the bounds at w. Returns whether one that is zero but for rounding was set off
/// from its bound, which has to move with it.
///
/// As in W&B section 3.5, a distance below ε μ counts as zero, and the bound moves by `slack_move`,
/// ε^¾ max(1, |bound|), at most. Within that the distance is set to μ/z, where δ z = μ holds as on
/// the central path (W&B eq. 4c): a larger move would leave the path.
pub(crate) fn distances(
    bounds: &[Bound],
    w: &[f64],
    z: &[f64],
    mu: f64,
    distances: &mut [f64],
) -> bool {
    let least = f64::EPSILON * mu.min(1.0);
    let mut moved = false;
    for ((distance, bound), z) in distances.iter_mut().zip(bounds).zip(z) {
        *distance = bound.distance(w);
        if *distance < least {
            moved = true;
            let most = distance.max(0.0) + f64::EPSILON.powf(0.75) * bound.value.abs().max(1.0);
            *distance = (mu / z).max(least).min(most);
        }
    }
    moved
}

/// −Σ ln δ + damping, to be multiplied by μ.
pub(crate) fn barrier_term(bounds: &[Bound], distances: &[f64]) -> f64 {
    let logarithms: f64 =
        distances.chunks(IN_A_PRODUCT).map(|some| some.iter().product::<f64>().ln()).sum();
    let damped: f64 =
        bounds.iter().zip(distances).filter(|(bound, _)| bound.is_only).map(|(_, d)| d).sum();
    DAMPING * damped - logarithms
}

/// The derivative of μ (−ln δ) + damping with respect to w of one bound.
pub(crate) fn slope(bound: &Bound, distance: f64, mu: f64) -> f64 {
    bound.sign() * mu * (if bound.is_only { DAMPING } else { 0.0 } - 1.0 / distance)
}

/// The fraction-to-the-boundary rule of the primal step: the longest one, up to one, that leaves
/// 1 − τ of every distance (W&B eq. 15a).
pub(crate) fn longest_primal_step(
    bounds: &[Bound],
    distances: &[f64],
    dw: &[f64],
    tau: f64,
) -> f64 {
    bounds.iter().zip(distances).fold(1.0, |step: f64, (bound, distance)| {
        let towards = -bound.sign() * dw[bound.index()];
        if towards > 0.0 { step.min(tau * distance / towards) } else { step }
    })
}

/// The same of the multipliers (W&B eq. 15b).
pub(crate) fn longest_dual_step(z: &[f64], dz: &[f64], tau: f64) -> f64 {
    z.iter().zip(dz).fold(
        1.0,
        |step: f64, (z, dz)| {
            if *dz < 0.0 { step.min(-tau * z / dz) } else { step }
        },
    )
}

/// Keeps the multipliers near μ over their distances (W&B eq. 16).
pub(crate) fn reset_multipliers(z: &mut [f64], distances: &[f64], mu: f64) {
    for (z, distance) in z.iter_mut().zip(distances) {
        let central = mu / distance;
        *z = z.min(KAPPA_SIGMA * central).max(central / KAPPA_SIGMA);
    }
}
