//! A true maneuver without a planner: controls made by hand, the motion integrated finely, and the
//! slew that it happens to be asked for afterwards.

#![forbid(unsafe_code)]

pub mod arms;
pub mod bodies;
pub mod by_hand;
pub mod json_schema;
pub mod thin_links;
pub mod trees;
pub mod units;

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use righting_multibody::{State, System};
use righting_results::solution::SCHEMA;
use righting_results::{
    AttemptRecord, ControlInterval, Node, Solution, Status, Terminal, Timing, Trajectory, Versions,
    WaypointRecord, objective,
};
use righting_scenario::{Scenario, file};
use righting_verifier::verify;

/// The folder of the shipped scenarios.
pub fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

/// A shipped scenario, by its name.
pub fn shipped(name: &str) -> Scenario {
    Scenario::read(&scenarios().join(format!("{name}.json"))).unwrap()
}

/// A checked variant of a scenario.
pub fn varied(scenario: &Scenario, change: impl FnOnce(&mut file::Scenario)) -> Scenario {
    scenario.varied(change).unwrap()
}

/// `/system/links/3/a_m` as `system.links[3].a_m`.
pub fn path_of(pointer: &str) -> String {
    let mut path = String::new();
    for step in pointer.split('/').skip(1) {
        match step.parse::<usize>() {
            Ok(index) => path.push_str(&format!("[{index}]")),
            Err(_) if path.is_empty() => path.push_str(step),
            Err(_) => path.push_str(&format!(".{step}")),
        }
    }
    path
}

/// Grid, outcome and iterations of every attempt, in order.
pub fn solves(attempts: &[AttemptRecord]) -> Vec<(usize, Option<Status>, usize)> {
    let attempts = attempts.iter();
    attempts.map(|attempt| (attempt.steps, attempt.status, attempt.iterations)).collect()
}

/// Joint accelerations of joints that sway out and back, from rest to rest, in one to three whole
/// periods, at about a sixth of their largest rate. Every other joint sways to both sides, so that
/// the arm goes around loops, which is what turns the base: on its own way back it would not.
pub fn swing(scenario: &Scenario) -> Vec<Vec<f64>> {
    let steps = scenario.horizon().steps;
    let duration_s = scenario.horizon().duration_s;
    let limits = &scenario.system().joint_limits;
    (0..steps)
        .map(|k| {
            let joints = limits.iter().enumerate();
            joints
                .map(|(joint, limits)| {
                    let periods = (joint % 3 + 1) as f64;
                    let amplitude = limits.rate_max_rad_s / 6.0 * TAU * periods / duration_s;
                    let phase = TAU * periods * (k as f64 + 0.5) / steps as f64;
                    match joint % 2 {
                        0 => amplitude * phase.cos(),
                        _ => amplitude * ((2.0 * phase).sin() - 0.5 * phase.sin()),
                    }
                })
                .collect()
        })
        .collect()
}

/// What moves a system of base and arm, right or wrong.
pub trait Equations {
    /// ẋ of the full form.
    fn state_derivative(&self, x: &[f64], u: &[f64]) -> Vec<f64>;

    /// The joints' torques, N m.
    fn joint_torques(&self, state: &State<f64>, u: &[f64]) -> Vec<f64>;
}

/// The planner's model.
impl Equations for System {
    fn state_derivative(&self, x: &[f64], u: &[f64]) -> Vec<f64> {
        self.state_derivative(x, u, None)
    }

    fn joint_torques(&self, state: &State<f64>, u: &[f64]) -> Vec<f64> {
        self.joint_torques(&state.angular_rate, &state.joint_angles, &state.joint_rates, u, None)
    }
}

/// The motion that follows from the scenario's start and `controls` by the planner's model.
pub fn motion(scenario: &Scenario, controls: &[Vec<f64>]) -> Trajectory {
    motion_by(&scenario.system().model, scenario, controls)
}

/// The motion that follows from the scenario's start and `controls`, integrated by another group's
/// method of order 8: no integrator of this project has a part in it.
pub fn motion_by(
    equations: &impl Equations,
    scenario: &Scenario,
    controls: &[Vec<f64>],
) -> Trajectory {
    let held = |step: usize, _| controls[step].clone();
    let states = states_by(equations, scenario, controls.len(), held);
    trajectory_of(equations, scenario, controls, &states)
}

/// The motion that follows from the scenario's start, with joint accelerations of zero there, and `jerks`
/// held over the steps, by the planner's model.
pub fn motion_of_jerks(scenario: &Scenario, jerks: &[Vec<f64>]) -> Trajectory {
    let step_s = scenario.horizon().step_s();
    let after = |u: &[f64], jerk: &[f64], after_s: f64| -> Vec<f64> {
        u.iter().zip(jerk).map(|(u, jerk)| u + after_s * jerk).collect()
    };
    let mut accelerations = vec![vec![0.0; scenario.system().joint_count()]];
    for jerk in jerks {
        accelerations.push(after(&accelerations[accelerations.len() - 1], jerk, step_s));
    }
    let equations = &scenario.system().model;
    let linear = |step: usize, after_s| after(&accelerations[step], &jerks[step], after_s);
    let states = states_by(equations, scenario, jerks.len(), linear);
    let held = trajectory_of(equations, scenario, &accelerations, &states);
    tampered(&held, |_, intervals| {
        for (interval, jerk) in intervals.iter_mut().zip(jerks) {
            interval.joint_jerks_rad_s3.clone_from(jerk);
        }
    })
}

/// The states at the nodes for joint accelerations that are a function of the step and of the time within.
fn states_by(
    equations: &impl Equations,
    scenario: &Scenario,
    steps: usize,
    accelerations: impl Fn(usize, f64) -> Vec<f64>,
) -> Vec<State<f64>> {
    let step_s = scenario.horizon().step_s();
    let mut states = vec![scenario.initial().state()];
    for step in 0..steps {
        let x = states[step].to_vec();
        let rate = |after_s: f64, x: &Vec<f64>, rate: &mut Vec<f64>| {
            rate.copy_from_slice(&equations.state_derivative(x, &accelerations(step, after_s)));
        };
        let solution = IVP::ode_from_fn(rate, 0.0, step_s, x)
            .method(ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-13))
            .solve()
            .unwrap();
        states.push(State::from_slice(&solution.y[solution.y.len() - 1]).unwrap());
    }
    states
}

/// The states at the nodes with the torques and the power that `equations` say, for the controls of every step,
/// and the accelerations of the last node if there is one more.
pub fn trajectory_of(
    equations: &impl Equations,
    scenario: &Scenario,
    controls: &[Vec<f64>],
    states: &[State<f64>],
) -> Trajectory {
    let torques = |k: usize, state: &State<f64>| {
        equations.joint_torques(state, &controls[k.min(controls.len() - 1)])
    };
    let nodes = states.iter().enumerate().map(|(k, state)| Node {
        time_s: scenario.horizon().time_s(k),
        position_m: state.position.into(),
        attitude: state.attitude.to_array(),
        velocity_m_s: state.velocity.into(),
        angular_rate_rad_s: state.angular_rate.into(),
        joint_angles_rad: state.joint_angles.clone(),
        joint_rates_rad_s: state.joint_rates.clone(),
        power_w: torques(k, state).iter().zip(&state.joint_rates).map(|(t, rate)| t * rate).sum(),
        wheel_momenta_n_m_s: Vec::new(),
    });
    let steps = controls.iter().zip(states).take(states.len() - 1);
    let intervals = steps.enumerate().map(|(k, (control, state))| ControlInterval {
        joint_accelerations_rad_s2: control.clone(),
        joint_jerks_rad_s3: Vec::new(),
        joint_torques_n_m: torques(k, state),
        wheel_torques_n_m: Vec::new(),
    });
    Trajectory::new(nodes.collect(), intervals.collect()).unwrap()
}

/// A slew that the hand-made swing of the arm performs.
pub fn true_slew(scenario: &Scenario) -> (Scenario, Trajectory) {
    let trajectory = motion(scenario, &swing(scenario));
    let reached = trajectory.end().state().attitude.normalized();
    let (axis, angle_rad) = reached.to_axis_angle();
    let scenario = varied(scenario, |file| {
        file.maneuver.axis = Some(axis.into());
        file.maneuver.angle_deg = Some(angle_rad.to_degrees());
    });
    (scenario, trajectory)
}

/// What a solve that came to this trajectory would report.
pub fn solution_of(scenario: &Scenario, trajectory: &Trajectory) -> Solution {
    let verification = verify(scenario, trajectory);
    Solution {
        schema: SCHEMA.to_owned(),
        scenario: scenario.resolved().clone(),
        scenario_sha256: scenario.resolved().sha256(),
        versions: Versions::default(),
        status: Status::Solved,
        objective: objective(scenario, trajectory),
        iterations: 7,
        constraint_violation: f64::NAN,
        optimality: None,
        duration_s: None,
        terminal: Terminal::reached(scenario, trajectory),
        waypoints: WaypointRecord::reached(scenario, trajectory),
        timing_s: Timing::default(),
        limits: verification.limits(),
        verification,
        bound_deg_s: None,
        stopped_deg_s: None,
        reduction_percent: None,
        robustness: None,
        notes: Vec::new(),
        attempts: Vec::new(),
        history: Vec::new(),
    }
}

/// The same trajectory with nodes or intervals changed.
pub fn tampered(
    trajectory: &Trajectory,
    change: impl FnOnce(&mut Vec<Node>, &mut Vec<ControlInterval>),
) -> Trajectory {
    let mut nodes = trajectory.nodes().to_vec();
    let mut intervals = trajectory.intervals().to_vec();
    change(&mut nodes, &mut intervals);
    Trajectory::new(nodes, intervals).unwrap()
}
