//! A model written once, run on numbers and on dual numbers: Coulomb friction, which branches.
//!
//! `cargo run -p righting-scalar --example friction`

use num_dual::Dual64;
use righting_scalar::Scalar;

/// Friction force on a body that slides at this speed: proportional to it up to 0.1 m/s, then 2 N.
fn friction<T: Scalar>(speed_m_s: T) -> T {
    -(speed_m_s * 20.0).clamped(T::from(-2.0), T::from(2.0))
}

fn main() {
    for speed in [-1.0, -0.05, 0.0, 0.05, 1.0] {
        let force = friction(Dual64::new(speed, 1.0));
        assert_eq!(force.re, friction(speed));
        println!("{speed:5.2} m/s: {:5.2} N, {:6.2} N s/m", force.re + 0.0, force.eps + 0.0);
    }
}
