//! The torques of a plan as functions of time.
//!
//! Joint accelerations are constant or linear over a step; torques are not, nor are they told well enough by
//! interpolation between nodes: an open-loop flight may amplify an error of its torques by 1e10. The
//! motion is therefore integrated once more, from the first node and the accelerations alone, and torques are taken from it at Chebyshev's points of every step.
//! At nodes they differ from the plan's by the plan's own integration error.

use nalgebra::{SMatrix, SVector};
use righting_multibody::State;
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_verifier::DormandPrince;

use crate::ExportError;

/// Coefficients of a polynomial.
pub(super) const COEFFICIENTS: usize = 7;

type Points = SVector<f64, COEFFICIENTS>;

/// Polynomials of degree six, one a joint and step.
pub(super) struct StepTorques {
    /// One after the other step: of every joint, coefficients of the powers of z, N m; z goes from −1 to
    /// 1 over the step.
    pub coefficients: Vec<Vec<[f64; COEFFICIENTS]>>,
}

impl StepTorques {
    /// Of a motion of the scenario's system.
    ///
    /// # Errors
    /// [`ExportError::Motion`] for a motion that cannot be followed.
    pub fn new(scenario: &Scenario, trajectory: &Trajectory) -> Result<Self, ExportError> {
        let model = &scenario.system().model;
        let joints = model.joint_count();
        let mut x = trajectory.start().state().to_vec();
        let mut integrator = DormandPrince::new(x.len());
        let places = Points::from_fn(|i, _| {
            -(std::f64::consts::PI * i as f64 / (COEFFICIENTS - 1) as f64).cos()
        });
        let powers = SMatrix::<f64, COEFFICIENTS, COEFFICIENTS>::from_fn(|i, power| {
            places[i].powi(power as i32)
        });
        let of_powers = powers.lu();
        let mut coefficients = Vec::with_capacity(trajectory.steps());
        let intervals = trajectory.nodes().windows(2).zip(trajectory.intervals());
        for (k, (nodes, interval)) in intervals.enumerate() {
            let half_s = (nodes[1].time_s - nodes[0].time_s) / 2.0;
            let control = |after_s| interval.joint_accelerations_after(after_s);
            let mut of_joints = vec![Points::zeros(); joints];
            for (i, place) in places.iter().enumerate() {
                if let Some(before) = i.checked_sub(1) {
                    let duration_s = (place - places[before]) * half_s;
                    let before_s = (places[before] + 1.0) * half_s;
                    let followed = integrator.advance(&mut x, duration_s, |after_s, x, rate| {
                        let after_s = before_s + after_s;
                        let external = trajectory.external(scenario, (k, after_s), x);
                        let control = control(after_s);
                        let derivative = model.state_derivative(x, &control, external.as_ref());
                        rate.copy_from_slice(&derivative);
                    });
                    if !followed {
                        return Err(ExportError::Motion { time_s: nodes[0].time_s });
                    }
                }
                let after_s = (place + 1.0) * half_s;
                let state =
                    State::from_slice(&x).ok_or(ExportError::Motion { time_s: nodes[0].time_s })?;
                let torques = model.joint_torques(
                    &state.angular_rate,
                    &state.joint_angles,
                    &state.joint_rates,
                    &control(after_s),
                    trajectory.external(scenario, (k, after_s), &x).as_ref(),
                );
                of_joints
                    .iter_mut()
                    .zip(torques)
                    .for_each(|(of_joint, torque)| of_joint[i] = torque);
            }
            let solved = of_joints.iter().map(|of_joint| of_powers.solve(of_joint));
            let solved: Option<Vec<Points>> = solved.collect();
            let solved = solved.ok_or(ExportError::Motion { time_s: nodes[0].time_s })?;
            coefficients.push(solved.into_iter().map(|of_joint| of_joint.data.0[0]).collect());
        }
        Ok(Self { coefficients })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use righting_scenario::file::Duration;
    use righting_test_support::{motion, shipped, swing, varied};

    /// Half way through a step too the polynomial is the torque of the motion, which another group's
    /// integrator finds on a grid twice as fine.
    #[test]
    fn torques_between_nodes_are_those_of_the_motion() {
        for name in ["detumble_4dof", "detumble_canadarm2_table"] {
            let on_grid = |steps: usize| {
                varied(&shipped(name), |file| {
                    file.horizon.duration_s = Duration::Given(3.0);
                    file.horizon.steps = steps as f64;
                })
            };
            let (coarse, fine) = (on_grid(30), on_grid(60));
            let controls = swing(&coarse);
            let twice: Vec<Vec<f64>> =
                controls.iter().flat_map(|control| [control.clone(), control.clone()]).collect();
            let [trajectory, finer] = [motion(&coarse, &controls), motion(&fine, &twice)];
            let torques = StepTorques::new(&coarse, &trajectory).unwrap();
            let largest = finer.intervals().iter().flat_map(|i| &i.joint_torques_n_m);
            let largest = largest.fold(0.0_f64, |largest, torque| largest.max(torque.abs()));
            for (k, of_joints) in torques.coefficients.iter().enumerate() {
                for (joint, coefficients) in of_joints.iter().enumerate() {
                    for (place, z) in [(0, -1.0_f64), (1, 0.0)] {
                        let powers = (0..).map(|power| z.powi(power));
                        let found: f64 = coefficients.iter().zip(powers).map(|(c, z)| c * z).sum();
                        let expected = finer.intervals()[2 * k + place].joint_torques_n_m[joint];
                        let error = (found - expected).abs() / largest;
                        assert!(error < 1e-9, "{name}, step {k}, {z}: {error:.1e}");
                    }
                }
            }
        }
    }
}
