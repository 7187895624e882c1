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

/// When each of these stages is, as a share of the step.
const STAGE_TIMES: [f64; 6] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

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

/// An integrator of one system, with the step size that fitted last. Allocates nothing
/// while it integrates.
pub struct DormandPrince {
    step: f64,
    /// ẋ at each stage.
    rates: [Vec<f64>; 7],
    /// The state at a stage; of the last one, the result.
    next: Vec<f64>,
}

impl DormandPrince {
    /// For a system of `dimension` states.
    pub fn new(dimension: usize) -> Self {
        let zeros = || vec![0.0; dimension];
        Self { step: f64::INFINITY, rates: std::array::from_fn(|_| zeros()), next: zeros() }
    }

    /// Carries `x` over `duration` by ẋ = `rate(t, x)`, which is written into its third argument; t is zero
    /// where it begins. Returns whether it could: not if the motion is too wild to follow or not finite.
    pub fn advance(
        &mut self,
        x: &mut [f64],
        duration: f64,
        mut rate: impl FnMut(f64, &[f64], &mut [f64]),
    ) -> bool {
        rate(0.0, x, &mut self.rates[0]);
        let mut left = duration;
        for _ in 0..MAX_STEPS {
            let last = self.step >= left;
            let step = if last { left } else { self.step };
            // The last stage is evaluated at the fifth-order result, which starts the next step.
            let time = duration - left;
            for (stage, coefficients) in STAGES.iter().enumerate() {
                self.move_from(x, step, coefficients);
                let time = time + STAGE_TIMES[stage] * step;
                rate(time, &self.next, &mut self.rates[stage + 1]);
            }
            let error = self.error_norm(x, step);
            if !error.is_finite() {
                return false;
            }
            let factor = (0.9 * error.powf(-0.2)).clamp(0.2, 5.0);
            if error <= 1.0 {
                x.copy_from_slice(&self.next);
                if last {
                    // The remainder of an interval says little about the next one's step.
                    self.step = self.step.max(step * factor);
                    return true;
                }
                left -= step;
                self.rates.swap(0, 6);
            }
            self.step = step * factor;
        }
        false
    }

    /// x + h Σ cᵢ kᵢ, the state at the next stage.
    fn move_from(&mut self, x: &[f64], step: f64, coefficients: &[f64]) {
        self.next.copy_from_slice(x);
        for (coefficient, rates) in coefficients.iter().zip(&self.rates) {
            if *coefficient != 0.0 {
                let scale = step * coefficient;
                self.next.iter_mut().zip(rates).for_each(|(next, rate)| *next += scale * rate);
            }
        }
    }

    /// Largest error of any state relative to what is allowed.
    fn error_norm(&self, x: &[f64], step: f64) -> f64 {
        let mut largest = 0.0_f64;
        for i in 0..x.len() {
            let weighted = ERROR.iter().zip(&self.rates).map(|(weight, rates)| weight * rates[i]);
            let error: f64 = weighted.sum();
            let scale = TOLERANCE * x[i].abs().max(self.next[i].abs()).max(1.0);
            let relative = (step * error).abs() / scale;
            if relative.is_nan() {
                return f64::NAN;
            }
            largest = largest.max(relative);
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_an_oscillator_and_an_orbit_to_the_tolerance() {
        let oscillator = |_: f64, x: &[f64], rate: &mut [f64]| {
            rate.copy_from_slice(&[x[1], -25.0 * x[0]]);
        };
        let mut integrator = DormandPrince::new(2);
        let mut x = [1.0, 0.0];
        for k in 1..=200 {
            assert!(integrator.advance(&mut x, 0.05, oscillator));
            let t = 0.05 * f64::from(k);
            assert!((x[0] - (5.0 * t).cos()).abs() < 2e-8, "{t}: {}", x[0]);
        }

        // Kepler's problem, eccentricity 0.5, one revolution.
        let orbit = |_: f64, x: &[f64], rate: &mut [f64]| {
            let cubed = (x[0] * x[0] + x[1] * x[1]).powf(1.5);
            rate.copy_from_slice(&[x[2], x[3], -x[0] / cubed, -x[1] / cubed]);
        };
        let start = [0.5, 0.0, 0.0, 3.0_f64.sqrt()];
        let mut x = start;
        assert!(DormandPrince::new(4).advance(&mut x, 2.0 * std::f64::consts::PI, orbit));
        for (end, start) in x.iter().zip(&start) {
            assert!((end - start).abs() < 1e-8);
        }
    }

    /// ẋ = x + sin t from 1 is (3 eᵗ − sin t − cos t)/2.
    #[test]
    fn a_rate_may_depend_on_time() {
        let mut x = [1.0];
        let forced = |t: f64, x: &[f64], rate: &mut [f64]| rate[0] = x[0] + t.sin();
        assert!(DormandPrince::new(1).advance(&mut x, 2.0, forced));
        let expected = 0.5 * (3.0 * 2.0_f64.exp() - 2.0_f64.sin() - 2.0_f64.cos());
        assert!((x[0] - expected).abs() < 1e-9, "{} {expected}", x[0]);
    }

    #[test]
    fn wild_motion_is_given_up() {
        let explosion = |_: f64, x: &[f64], rate: &mut [f64]| rate[0] = x[0] * x[0];
        assert!(!DormandPrince::new(1).advance(&mut [1.0], 2.0, explosion));
        assert!(!DormandPrince::new(1).advance(&mut [f64::NAN], 1.0, explosion));
    }
}
