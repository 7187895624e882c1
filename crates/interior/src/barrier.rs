//! Distances to the bounds and what follows from them.

use crate::program::Bound;

/// Weight of the linear term that keeps variables with a single bound from drifting off.
pub(crate) const DAMPING: f64 = 1e-5;
/// A multiplier stays within this factor of μ over its distance.
const KAPPA_SIGMA: f64 = 1e10;
/// So many distances are multiplied before their logarithm is taken: their product neither over-
/// nor underflows while each is within ten to the power ±32.
const IN_A_PRODUCT: usize = 8;

/// Distances to the bounds at w. One that is zero but for rounding is set off from its bound, which
/// moves with it, as Ipopt does.
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
        *distance = bound.sign() * (w[bound.index()] - bound.value);
        if *distance < least {
            moved = true;
            let most = distance.max(0.0) + f64::EPSILON.powf(0.75) * bound.value.abs().max(1.0);
            *distance = (mu / z).max(least).min(most);
        }
    }
    moved
}

/// −Σ ln d + damping, to be multiplied by μ.
pub(crate) fn barrier(bounds: &[Bound], distances: &[f64]) -> f64 {
    let logarithms: f64 =
        distances.chunks(IN_A_PRODUCT).map(|some| some.iter().product::<f64>().ln()).sum();
    let damped: f64 =
        bounds.iter().zip(distances).filter(|(bound, _)| bound.is_only).map(|(_, d)| d).sum();
    DAMPING * damped - logarithms
}

/// The derivative of μ (−ln d) + damping with respect to w of one bound.
pub(crate) fn slope(bound: &Bound, distance: f64, mu: f64) -> f64 {
    bound.sign() * mu * (if bound.is_only { DAMPING } else { 0.0 } - 1.0 / distance)
}

/// The longest step, up to one, that leaves 1 − τ of every distance.
pub(crate) fn primal_step(bounds: &[Bound], distances: &[f64], dw: &[f64], tau: f64) -> f64 {
    bounds.iter().zip(distances).fold(1.0, |step: f64, (bound, distance)| {
        let towards = -bound.sign() * dw[bound.index()];
        if towards > 0.0 { step.min(tau * distance / towards) } else { step }
    })
}

/// The longest step, up to one, that leaves 1 − τ of every multiplier.
pub(crate) fn dual_step(z: &[f64], dz: &[f64], tau: f64) -> f64 {
    z.iter().zip(dz).fold(
        1.0,
        |step: f64, (z, dz)| {
            if *dz < 0.0 { step.min(-tau * z / dz) } else { step }
        },
    )
}

/// Keeps the multipliers near μ over their distances.
pub(crate) fn keep_near_path(z: &mut [f64], distances: &[f64], mu: f64) {
    for (z, distance) in z.iter_mut().zip(distances) {
        let central = mu / distance;
        *z = z.min(KAPPA_SIGMA * central).max(central / KAPPA_SIGMA);
    }
}
