//! Which motion of a search is delivered, and how it fares.

use righting_results::{ControlInterval, Node, Terminal, Trajectory, Verification, objective};
use righting_scenario::error::ShapeError;
use righting_scenario::{Maneuver, Scenario};
use righting_verifier::verify;

use crate::formulation::Coordinates;
use crate::scaling::Scaling;
use crate::search::{Found, Motion};

/// A detumble that did not converge must take out more than this of what stopping the arm leaves, or there is no
/// point in delivering it, %.
const LEAST_REDUCTION_PERCENT: f64 = 1.0;

/// A motion on the scenario's grid with its verification.
pub(crate) struct Delivered {
    /// The scenario with the duration that was chosen.
    pub(crate) scenario: Scenario,
    /// That, s, where it was free.
    pub(crate) duration_s: Option<f64>,
    pub(crate) trajectory: Trajectory,
    /// Without checks where there is no plan.
    pub(crate) verification: Verification,
}

impl Delivered {
    /// Where the last solve converged, verified.
    pub(crate) fn converged(
        asked: &Scenario,
        scaling: &Scaling,
        found: &Found,
    ) -> Result<Self, ShapeError> {
        let last = Self::unverified(asked, scaling, found, &Motion::of(&found.solution))?;
        let verification = verify(&last.scenario, &last.trajectory);
        Ok(Self { verification, ..last })
    }

    /// The cheapest motion of a search without a plan that passes its verification all the same; where none
    /// does, that at which the last solve ended, unverified.
    pub(crate) fn best_of_unconverged(
        asked: &Scenario,
        scaling: &Scaling,
        found: &Found,
    ) -> Result<Self, ShapeError> {
        let mut best: Option<(f64, Self)> = None;
        for motion in &found.incumbents {
            let candidate = Self::unverified(asked, scaling, found, motion)?;
            let cost = objective(&candidate.scenario, &candidate.trajectory);
            // One that costs more need not be looked at.
            let is_cheaper = best.as_ref().is_none_or(|(least, _)| cost < *least);
            if !(is_cheaper && candidate.is_worthwhile()) {
                continue;
            }
            let verification = verify(&candidate.scenario, &candidate.trajectory);
            if verification.passed {
                best = Some((cost, Self { verification, ..candidate }));
            }
        }
        match best {
            Some((_, best)) => Ok(best),
            None => Self::unverified(asked, scaling, found, &Motion::of(&found.solution)),
        }
    }

    fn unverified(
        asked: &Scenario,
        scaling: &Scaling,
        found: &Found,
        motion: &Motion,
    ) -> Result<Self, ShapeError> {
        let share = found.duration_share(motion);
        let duration_s = share.map(|share| share * asked.horizon().duration_s);
        let scenario = match duration_s {
            Some(duration_s) => asked.clone().with_duration(duration_s),
            None => asked.clone(),
        };
        let trajectory = trajectory(&scenario, scaling, &found.coordinates, motion)?;
        Ok(Self { scenario, duration_s, trajectory, verification: Verification::default() })
    }

    /// Whether it does something: to do nothing is a detumble that breaks no law.
    fn is_worthwhile(&self) -> bool {
        let reached = Terminal::reached(&self.scenario, &self.trajectory);
        *self.scenario.maneuver() != Maneuver::Detumble
            || reached.reduction_percent(&self.scenario) > LEAST_REDUCTION_PERCENT
    }
}

/// The whole motion, with the torques that it takes and their power.
fn trajectory(
    scenario: &Scenario,
    scaling: &Scaling,
    coordinates: &Coordinates,
    motion: &Motion,
) -> Result<Trajectory, ShapeError> {
    let system = &scenario.system().model;
    let steps = scenario.horizon().steps;
    let mut nodes = Vec::with_capacity(steps + 1);
    let mut intervals = Vec::with_capacity(steps);
    // The motion of joints and wheels, exactly as the controls have it: the optimizer's defects would add up.
    let step_s = scaling.duration(scenario.horizon().step_s());
    let wheels = coordinates.wheel_set();
    let mut driven = motion.states.row(0).to_vec();
    for k in 0..=steps {
        let mut row = motion.states.row(k).to_vec();
        coordinates.copy_driven(&driven, &mut row);
        let state = scaling.state(coordinates.free_floating_state(&row));
        let mut controls = motion.controls.row(k.min(steps - 1)).to_vec();
        if k < steps {
            let rates = &mut controls[coordinates.first_wheel()..];
            wheels.keep_within(&driven[coordinates.wheels()], rates, step_s);
        }
        let controls = &controls;
        let accelerations = coordinates.accelerations(&driven, controls);
        let wheel_momenta_n_m_s =
            scaling.wheel_momenta(&wheels.momenta(&driven[coordinates.wheels()]));
        let wheel_torques_n_m =
            scaling.wheel_torques(&wheels.torques(coordinates.wheel_rates(controls)));
        if k < steps {
            coordinates.move_driven(&mut driven, controls, step_s);
        }
        let accelerations = scaling.accelerations(&accelerations);
        let time_s = scenario.horizon().time_s(k);
        let external = scenario.external(
            &state.attitude,
            &state.angular_rate,
            time_s,
            (&wheel_momenta_n_m_s, &wheel_torques_n_m),
        );
        let torques = system.joint_torques(
            &state.angular_rate,
            &state.joint_angles,
            &state.joint_rates,
            &accelerations,
            external.as_ref(),
        );
        nodes.push(Node {
            time_s,
            position_m: state.position.into(),
            attitude: state.attitude.to_array(),
            velocity_m_s: state.velocity.into(),
            angular_rate_rad_s: state.angular_rate.into(),
            power_w: torques
                .iter()
                .zip(&state.joint_rates)
                .map(|(torque, rate)| torque * rate)
                .sum(),
            joint_angles_rad: state.joint_angles,
            joint_rates_rad_s: state.joint_rates,
            wheel_momenta_n_m_s,
        });
        if k < steps {
            intervals.push(ControlInterval {
                joint_accelerations_rad_s2: accelerations,
                joint_jerks_rad_s3: match coordinates.has_jerk() {
                    true => scaling.jerks(&coordinates.jerks(controls)),
                    false => Vec::new(),
                },
                joint_torques_n_m: torques,
                wheel_torques_n_m,
            });
        }
    }
    Trajectory::new(nodes, intervals)
}
