//! A base that turns because its arm moves: momenta of a two-joint arm on a 300 kg cube.
//!
//! With the system at rest as a whole, H = Ĩ ω + H̃ = 0 gives the base's rate ω = −Ĩ⁻¹ H̃ at every
//! instant. A closed loop of the joints leaves the base turned although no momentum was ever there.
//!
//! `cargo run -p righting-multibody --example momentum`

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;
use righting_multibody::{Base, DhConvention, Link, ModelError, Mount, Quaternion, System};

const STEPS: usize = 2000;
const DURATION_S: f64 = 60.0;
/// Both joints swing this far, a quarter of a period apart.
const AMPLITUDE_RAD: f64 = 1.0;

fn main() -> Result<(), ModelError> {
    let arm = System::new(
        Base::uniform_cube(300.0, 0.5)?,
        Mount::at(Vector3::new(0.0, 0.0, 0.25)),
        DhConvention::Standard,
        vec![Link::rod(0.0, 0.0, -FRAC_PI_2, 0.0, 0.0), Link::rod(25.0, 1.0, 0.0, 0.0, -FRAC_PI_2)],
        None,
    )?;
    let rate = TAU / DURATION_S;
    let joints = |t: f64| {
        let (sin, cos) = (rate * t).sin_cos();
        (
            [AMPLITUDE_RAD * sin, AMPLITUDE_RAD * cos],
            [rate * AMPLITUDE_RAD * cos, -rate * AMPLITUDE_RAD * sin],
        )
    };

    let step_s = DURATION_S / STEPS as f64;
    let mut attitude = Quaternion::identity();
    for step in 0..STEPS {
        let (q, qdot) = joints((step as f64 + 0.5) * step_s);
        let omega = arm.reduced_angular_rate(&q, &qdot, &Vector3::zeros());
        if step % (STEPS / 4) == 0 {
            let relative = arm.h_tilde(&q, &qdot);
            let momentum = arm.angular_momentum(&omega, &q, &qdot);
            println!(
                "{:4.1} s: arm {:.3} N m s, base {:.3} deg/s, together {:.0e} N m s",
                step as f64 * step_s,
                relative.norm(),
                omega.norm().to_degrees(),
                momentum.norm()
            );
        }
        // The rate held over the step, then back onto the unit sphere.
        let next = attitude
            .to_array()
            .iter()
            .zip(attitude.rate(&omega).to_array())
            .map(|(q, rate)| q + step_s * rate)
            .collect::<Vec<f64>>();
        let norm = next.iter().map(|q| q * q).sum::<f64>().sqrt();
        attitude = Quaternion::new(next[0] / norm, next[1] / norm, next[2] / norm, next[3] / norm);
    }
    let turned = 2.0 * attitude.vector.norm().atan2(attitude.w.abs());
    println!("after one loop of the joints the base has turned {:.2} deg", turned.to_degrees());
    Ok(())
}
