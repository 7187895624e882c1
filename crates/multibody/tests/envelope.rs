//! The momentum and torque that the paper prints for its 4-DOF arm, about 2.7 N m s and 2.2 N m.

mod support;

use num_dual::Dual64;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use support::table_one;

#[test]
fn largest_of_two_thousand_samples() {
    let arm = table_one::xlink_4dof();
    let limits = [180.0, 90.0, 50.0, 35.0].map(f64::to_radians);
    let (rate, acceleration) = (17.2_f64.to_radians(), 11.5_f64.to_radians());
    let runs = 30;
    let (mut momenta, mut torques) = (0.0, 0.0);
    for seed in 0..runs {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut within = |limit: f64| random.random_range(-limit..limit);
        let (mut momentum, mut torque) = (0.0_f64, 0.0_f64);
        for _ in 0..2000 {
            let qdot = [0; 4].map(|_| within(rate));
            let q: Vec<Dual64> = (0..4).map(|i| Dual64::new(within(limits[i]), qdot[i])).collect();
            let qdot: Vec<Dual64> =
                qdot.iter().map(|v| Dual64::new(*v, within(acceleration))).collect();
            let h_tilde = arm.h_tilde(&q, &qdot);
            momentum = momentum.max(h_tilde.map(|x| x.re).norm());
            torque = torque.max(h_tilde.map(|x| x.eps).norm());
        }
        momenta += momentum / runs as f64;
        torques += torque / runs as f64;
    }
    // Between runs the largest sample scatters by 0.08 and 0.14; their mean by a fifth of that.
    assert!((momenta - 2.71).abs() < 0.05, "{momenta} N m s");
    assert!((torques - 2.21).abs() < 0.08, "{torques} N m");
}
