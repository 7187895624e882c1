//! The largest value of a quadratic form on a box.

use nalgebra::DMatrix;

/// Sweeps over the coordinates; a handful suffices for as many joints as an arm has.
const MOST_SWEEPS: usize = 20;

/// Where xᵀ G x is largest on |x_i| ≤ `bound_i`, `form` being the symmetric G.
///
/// Exact ascent in one coordinate after another, from every single coordinate at its bound and from
/// zero: the problem is not concave, so what is found is a lower bound of the maximum, the best of
/// j + 1 starts.
pub(super) fn largest_in_box(form: &DMatrix<f64>, bound: &[f64]) -> Vec<f64> {
    let joints = bound.len();
    let mut best = (0.0, vec![0.0; joints]);
    for first in 0..joints {
        let mut x = vec![0.0; joints];
        x[first] = bound[first];
        let mut value = f64::NEG_INFINITY;
        for _ in 0..MOST_SWEEPS {
            // The start's own coordinate comes last, when the others have answered it.
            for i in (1..=joints).map(|step| (first + step) % joints) {
                let others: f64 =
                    (0..joints).filter(|&k| k != i).map(|k| form[(i, k)] * x[k]).sum();
                x[i] = match form[(i, i)] {
                    own if own < 0.0 => (-others / own).clamp(-bound[i], bound[i]),
                    _ if others == 0.0 => bound[i].copysign(x[i]),
                    _ => bound[i].copysign(others),
                };
            }
            let now = quadratic(form, &x);
            if now <= value * (1.0 + 1e-12) {
                break;
            }
            value = now;
        }
        let value = quadratic(form, &x);
        if value > best.0 {
            best = (value, x);
        }
    }
    best.1
}

fn quadratic(form: &DMatrix<f64>, x: &[f64]) -> f64 {
    let row = |i: usize| (0..x.len()).map(|k| form[(i, k)] * x[k]).sum::<f64>();
    (0..x.len()).map(|i| x[i] * row(i)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use righting_scenario::halton::Halton;

    #[test]
    fn no_point_of_a_fine_grid_is_better() {
        let bound = [1.0, 0.5, 2.0];
        for entries in Halton::new(6).take(60) {
            let [a, b, c, d, e, f] = std::array::from_fn(|i| 2.0 * entries[i] - 1.0);
            let form = DMatrix::from_row_slice(3, 3, &[a, b, c, b, d, e, c, e, f]);
            let found = quadratic(&form, &largest_in_box(&form, &bound));
            let ticks = || (-20..=20).map(|i| f64::from(i) / 20.0);
            for x in ticks() {
                for (y, z) in ticks().flat_map(|y| ticks().map(move |z| (y, z))) {
                    let point = [x * bound[0], y * bound[1], z * bound[2]];
                    assert!(quadratic(&form, &point) <= found + 1e-12, "{form}");
                }
            }
        }
    }
}
