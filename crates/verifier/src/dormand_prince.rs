//! Dormand and Prince's embedded Runge–Kutta pair of orders 5 and 4 with step-size control.
//!
//! Coefficients: Dormand and Prince, *J. Comp. Appl. Math.* 6 (1980); error norm and controller:
//! Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, II.4.

/// Largest local error of a step, relative to the larger of the state's size and one.
const TOLERANCE: f64 = 1e-11;

/// The most steps that one call may take before the motion counts as wild.
const MAX_STEPS: usize = 10_000;

const STAGES: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Fifth-order minus fourth-order weights.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// An integrator of one autonomous system, with the step size that fitted last.
pub struct DormandPrince {
    step: f64,
}

impl DormandPrince {
    /// One that has made no step yet.
    #[allow(clippy::new_without_default, reason = "a default step size means nothing")]
    pub fn new() -> Self {
        Self { step: f64::INFINITY }
    }

    /// Carries `x` over `duration` by ẋ = `rate(x)`. Returns none if the motion is too wild to
    /// follow or not finite.
    pub fn advance(
        &mut self,
        x: &[f64],
        duration: f64,
        rate: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Option<Vec<f64>> {
        let mut x = x.to_vec();
        let mut rates = vec![rate(&x)];
        let mut left = duration;
        for _ in 0..MAX_STEPS {
            let last = self.step >= left;
            let step = if last { left } else { self.step };
            for coefficients in STAGES {
                rates.push(rate(&moved(&x, step, coefficients, &rates)));
            }
            // The last stage is evaluated at the fifth-order result, which starts the next step.
            let next = moved(&x, step, STAGES[5], &rates);
            let error = error_norm(&x, &next, step, &rates);
            if !error.is_finite() {
                return None;
            }
            let factor = (0.9 * error.powf(-0.2)).clamp(0.2, 5.0);
            if error <= 1.0 {
                x = next;
                if last {
                    // The remainder of an interval says little about the next one's step.
                    self.step = self.step.max(step * factor);
                    return Some(x);
                }
                left -= step;
                rates.swap(0, 6);
            }
            self.step = step * factor;
            rates.truncate(1);
        }
        None
    }
}

/// x + h Σ cᵢ kᵢ
fn moved(x: &[f64], step: f64, coefficients: &[f64], rates: &[Vec<f64>]) -> Vec<f64> {
    let mut moved = x.to_vec();
    for (coefficient, rates) in coefficients.iter().zip(rates) {
        if *coefficient != 0.0 {
            let scale = step * coefficient;
            moved.iter_mut().zip(rates).for_each(|(x, rate)| *x += scale * rate);
        }
    }
    moved
}

/// Largest error of any state relative to what is allowed.
fn error_norm(x: &[f64], next: &[f64], step: f64, rates: &[Vec<f64>]) -> f64 {
    let mut largest = 0.0_f64;
    for i in 0..x.len() {
        let error: f64 = ERROR.iter().zip(rates).map(|(weight, rates)| weight * rates[i]).sum();
        let scale = TOLERANCE * x[i].abs().max(next[i].abs()).max(1.0);
        let relative = (step * error).abs() / scale;
        if relative.is_nan() {
            return f64::NAN;
        }
        largest = largest.max(relative);
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_an_oscillator_and_an_orbit_to_the_tolerance() {
        let oscillator = |x: &[f64]| vec![x[1], -25.0 * x[0]];
        let mut integrator = DormandPrince::new();
        let mut x = vec![1.0, 0.0];
        for k in 1..=200 {
            x = integrator.advance(&x, 0.05, oscillator).unwrap();
            let t = 0.05 * f64::from(k);
            assert!((x[0] - (5.0 * t).cos()).abs() < 2e-8, "{t}: {}", x[0]);
        }

        // Kepler's problem, eccentricity 0.5, one revolution.
        let orbit = |x: &[f64]| {
            let cubed = (x[0] * x[0] + x[1] * x[1]).powf(1.5);
            vec![x[2], x[3], -x[0] / cubed, -x[1] / cubed]
        };
        let start = [0.5, 0.0, 0.0, 3.0_f64.sqrt()];
        let period = 2.0 * std::f64::consts::PI;
        let end = DormandPrince::new().advance(&start, period, orbit).unwrap();
        for (end, start) in end.iter().zip(&start) {
            assert!((end - start).abs() < 1e-8);
        }
    }

    #[test]
    fn wild_motion_is_given_up() {
        let explosion = |x: &[f64]| vec![x[0] * x[0]];
        assert!(DormandPrince::new().advance(&[1.0], 2.0, explosion).is_none());
        assert!(DormandPrince::new().advance(&[f64::NAN], 1.0, explosion).is_none());
    }
}
