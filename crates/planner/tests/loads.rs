//! Limits of torque, of loads at the mount and of the base's rate are kept, and cost what they cost.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::{self, SystemReference};
use righting_test_support::{shipped, varied};
use righting_verifier::model::{Model, Motion, Outside, State};

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

fn system(file: &mut file::Scenario) -> &mut file::System {
    match &mut file.system {
        SystemReference::Inline(system) => system,
        SystemReference::File(_) => unreachable!("a checked scenario has its system inline"),
    }
}

/// The largest loads at the nodes of a plan: joint torques, force and moment at the mount, rate of the base.
struct Peaks {
    torques_n_m: Vec<f64>,
    force_n: f64,
    moment_n_m: f64,
    rate_deg_s: f64,
}

impl Peaks {
    /// Limits each joint's torque to a share of its peak; one that carries nothing, to next to nothing.
    fn limit_torques(&self, system: &mut file::System, share: f64) {
        let largest = self.torques_n_m.iter().fold(0.0_f64, |largest, peak| largest.max(*peak));
        for (link, peak) in system.links.iter_mut().zip(&self.torques_n_m) {
            link.torque_max_n_m = Some(share * peak.max(1e-3 * largest));
        }
    }
}

fn peaks(scenario: &Scenario, planned: &Planned) -> Peaks {
    let model = Model::new(scenario.resolved_system());
    let joints = model.joint_count();
    let mut motion = Motion::new(&model);
    let mut torques = vec![0.0; joints];
    let mut peaks =
        Peaks { torques_n_m: vec![0.0; joints], force_n: 0.0, moment_n_m: 0.0, rate_deg_s: 0.0 };
    for (node, interval) in planned.trajectory.nodes().iter().zip(planned.trajectory.intervals()) {
        let x = node.state().to_vec();
        let state = State::from_slice(&x);
        let control = &interval.joint_accelerations_rad_s2;
        let mount =
            model.joint_torques(&state, control, &Outside::default(), &mut motion, &mut torques);
        for (peak, torque) in peaks.torques_n_m.iter_mut().zip(&torques) {
            *peak = peak.max(torque.abs());
        }
        peaks.force_n = peaks.force_n.max(mount.force.norm());
        peaks.moment_n_m = peaks.moment_n_m.max(mount.moment.norm());
        peaks.rate_deg_s = peaks.rate_deg_s.max(state.angular_rate.norm().to_degrees());
    }
    peaks
}

fn assert_verified(what: &str, planned: &Planned) {
    let failures: Vec<String> =
        planned.solution.verification.failures().map(ToString::to_string).collect();
    let passed = planned.solution.verification.passed;
    assert!(
        passed,
        "{what}: {:?} {failures:?} {:?}",
        planned.solution.status, planned.solution.notes
    );
}

/// What is changed in a system.
type Change<'a> = Box<dyn Fn(&mut file::System) + 'a>;

/// A share of what a plan without a limit takes is the limit: the plan with it keeps it, and costs more.
#[test]
fn each_limit_alone_and_all_together_are_kept_by_every_arm() {
    for name in ["slew_2dof", "slew_4dof", "slew_canadarm2_table", "detumble_4dof"] {
        let free_scenario = shipped(name);
        let free = plan(&free_scenario);
        let peaks = peaks(&free_scenario, &free);
        // The base of a detumble turns fastest where it starts.
        let rate_share = if name.starts_with("slew") { 0.9 } else { 1.001 };
        let limits: [(&str, Change<'_>); 5] = [
            (
                "torques",
                Box::new(|system| {
                    peaks.limit_torques(system, 0.85);
                }),
            ),
            (
                "force",
                Box::new(|system| {
                    system.mount.as_mut().unwrap().force_max_n = Some(0.85 * peaks.force_n)
                }),
            ),
            (
                "moment",
                Box::new(|system| {
                    system.mount.as_mut().unwrap().moment_max_n_m = Some(0.85 * peaks.moment_n_m)
                }),
            ),
            (
                "rate",
                Box::new(|system| {
                    system.base.angular_rate_max_deg_s = Some(rate_share * peaks.rate_deg_s);
                }),
            ),
            (
                "all",
                Box::new(|system| {
                    peaks.limit_torques(system, 0.95);
                    system.mount.as_mut().unwrap().force_max_n = Some(0.95 * peaks.force_n);
                    system.mount.as_mut().unwrap().moment_max_n_m = Some(0.95 * peaks.moment_n_m);
                    system.base.angular_rate_max_deg_s = Some(rate_share * peaks.rate_deg_s);
                }),
            ),
        ];
        for (what, limit) in &limits {
            let scenario = varied(&free_scenario, |file| limit(system(file)));
            let planned = plan(&scenario);
            let what = format!("{name}, {what}");
            assert_verified(&what, &planned);
            let ratio = planned.solution.objective / free.solution.objective;
            println!("{what}: {ratio:.4} times the effort");
            // Another optimum may be cheaper, but not by much: the search without limits is wide.
            assert!(ratio > 0.99, "{what}: {ratio}");
        }
    }
}

/// Steps in which torques change more than a little.
#[test]
fn a_torque_is_kept_within_long_steps_too() {
    let coarse = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 24.0);
    let peaks = peaks(&coarse, &plan(&coarse));
    let scenario = varied(&coarse, |file| {
        peaks.limit_torques(system(file), 0.7);
    });
    assert_verified("24 steps", &plan(&scenario));
}

#[test]
fn a_limit_that_is_not_reached_changes_no_plan() {
    let free = plan(&shipped("slew_2dof"));
    let scenario = varied(&shipped("slew_2dof"), |file| {
        system(file).links[0].torque_max_n_m = Some(1e3);
        system(file).mount.as_mut().unwrap().moment_max_n_m = Some(1e3);
        system(file).base.angular_rate_max_deg_s = Some(100.0);
    });
    let planned = plan(&scenario);
    assert_verified("wide limits", &planned);
    let ratio = planned.solution.objective / free.solution.objective;
    assert!((ratio - 1.0).abs() < 1e-4, "{ratio}");
}

/// Friction and the rotor's inertia count in the torque that is limited, and in nothing else.
#[test]
fn a_drive_s_own_torque_counts() {
    let drive = file::Drive {
        viscous_friction_n_m_s: Some(0.5),
        rotor_inertia_kg_m2: Some(1e-4),
        gear_ratio: Some(100.0),
        ..file::Drive::default()
    };
    let with_drives = varied(&shipped("slew_4dof"), |file| {
        system(file).links.iter_mut().for_each(|link| link.drive = Some(drive.clone()));
    });
    let free = plan(&with_drives);
    assert_eq!(free.trajectory, plan(&shipped("slew_4dof")).trajectory);
    let torque_n_m = |planned: &Planned, joint: usize| {
        let (nodes, intervals) = (planned.trajectory.nodes(), planned.trajectory.intervals());
        let torques = nodes.iter().zip(intervals).map(|(node, interval)| {
            let (rate, acceleration) =
                (node.joint_rates_rad_s[joint], interval.joint_accelerations_rad_s2[joint]);
            (interval.joint_torques_n_m[joint] + 0.5 * rate + acceleration).abs()
        });
        torques.fold(0.0, f64::max)
    };
    let limits: Vec<f64> = (0..4).map(|joint| 0.9 * torque_n_m(&free, joint).max(0.01)).collect();
    let scenario = varied(&with_drives, |file| {
        for (link, limit) in system(file).links.iter_mut().zip(&limits) {
            link.torque_max_n_m = Some(*limit);
        }
    });
    let planned = plan(&scenario);
    assert_verified("drives", &planned);
    for (joint, limit) in limits.iter().enumerate() {
        let torque_n_m = torque_n_m(&planned, joint);
        assert!(torque_n_m < 1.01 * limit, "joint {}: {torque_n_m} of {limit} N m", joint + 1);
    }
    assert!(planned.solution.objective > free.solution.objective);
}
