//! How far a detumble can go.

use righting_multibody::System;

use crate::halton::Halton;
use crate::scenario::Scenario;
use crate::system_description::SystemDescription;

/// Arm postures looked at to begin with.
const SAMPLES: usize = 1024;
/// The best of them from which to climb.
const CLIMBS: usize = 4;
/// The climb ends when its step is below this part of a joint's range.
const FINEST: f64 = 1e-7;

/// The least angular rate that a base can have when its arm stands still, rad/s.
///
/// Momentum h₀ is conserved, and with the joints at rest h = Ĩ(q) ω, so
///
/// ```text
/// ‖ω‖ ≥ ‖h₀‖ / max_q λ_max(Ĩ(q)),
/// ```
///
/// the maximum over the joints' ranges. It is found from evenly spread postures by climbing from the
/// best of them, the same way every time. Collisions do not count, so a bound may be out of reach.
pub fn rate_bound_rad_s(scenario: &Scenario) -> f64 {
    let momentum = scenario.initial().angular_momentum_n_m_s.norm();
    momentum / largest_inertia(scenario.system())
}

/// max_q λ_max(Ĩ(q)), kg m².
fn largest_inertia(system: &SystemDescription) -> f64 {
    let joints = system.joint_count();
    let height = |unit: &[f64]| principal_inertia(&system.model, &system.joint_angles_at(unit));
    let mut starts: Vec<(f64, Vec<f64>)> =
        Halton::new(joints).take(SAMPLES).map(|unit| (height(&unit), unit)).collect();
    starts.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    starts.truncate(CLIMBS);
    starts.into_iter().map(|(start, unit)| climb(start, unit, height)).fold(0.0, f64::max)
}

/// Compass search within the unit cube: steps along each axis while they go up, then shorter ones.
fn climb(start: f64, mut unit: Vec<f64>, height: impl Fn(&[f64]) -> f64) -> f64 {
    let mut highest = start;
    let mut step = 0.1;
    while step > FINEST {
        let before = highest;
        for axis in 0..unit.len() {
            for direction in [step, -step] {
                let here = unit[axis];
                unit[axis] = (here + direction).clamp(0.0, 1.0);
                let found = height(&unit);
                if found > highest {
                    highest = found;
                    break;
                }
                unit[axis] = here;
            }
        }
        if highest <= before {
            step *= 0.5;
        }
    }
    highest
}

fn principal_inertia(model: &System, joint_angles_rad: &[f64]) -> f64 {
    model.locked_inertia(joint_angles_rad).symmetric_eigenvalues().max()
}
