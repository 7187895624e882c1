//! Power against the change of kinetic energy, against a joint by hand, and against a finer grid.

use std::path::Path;

use righting_analysis::PowerProfile;
use righting_analysis::power::{Accounting, PAPER_EFFICIENCY};
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_test_support::{motion, shipped, varied};

/// Controls that speed every joint up, each in its own way, and leave it moving.
fn start_moving(scenario: &Scenario) -> Vec<Vec<f64>> {
    let limits = scenario.system().joint_limits.iter().enumerate();
    let controls: Vec<f64> = limits
        .map(|(joint, limits)| {
            let sign = if joint % 2 == 0 { 1.0 } else { -1.0 };
            sign * limits.rate_max_rad_s / scenario.horizon().duration_s / (joint + 2) as f64
        })
        .collect();
    vec![controls; scenario.horizon().steps]
}

fn moved(name: &str, duration_s: f64, steps: u32) -> (Scenario, Trajectory) {
    let scenario = varied(&shipped(name), |file| {
        file.horizon.duration_s = righting_scenario::file::Duration::Given(duration_s);
        file.horizon.steps = f64::from(steps);
    });
    let trajectory = motion(&scenario, &start_moving(&scenario));
    (scenario, trajectory)
}

#[test]
fn the_work_of_the_joints_is_the_change_of_kinetic_energy() {
    for name in ["slew_2dof", "slew_4dof", "slew_canadarm2", "detumble_4dof", "detumble_canadarm2"]
    {
        let (scenario, trajectory) = moved(name, 6.0, 30);
        let profile = PowerProfile::new(&scenario, &trajectory).unwrap();
        let model = &scenario.system().model;
        let energy_j =
            [trajectory.end(), trajectory.start()].map(|node| model.kinetic_energy(&node.state()));
        let change_j = energy_j[0] - energy_j[1];
        assert_eq!(profile.kinetic_energy_change_j(), change_j);
        assert!(change_j.abs() > 1e-3, "{name}: {change_j} shows nothing");
        let work_j = profile.work_j();
        let error = (work_j - change_j).abs() / energy_j[0].max(energy_j[1]);
        assert!(error < 1e-9, "{name}: {work_j} J of work, {change_j} J of energy, {error:.1e}");
    }
}

#[test]
fn torques_at_the_nodes_are_the_trajectory_s() {
    let (scenario, trajectory) = moved("slew_4dof", 6.0, 30);
    let profile = PowerProfile::new(&scenario, &trajectory).unwrap();
    let per_interval = profile.instants().len() / trajectory.steps();
    for (k, interval) in trajectory.intervals().iter().enumerate() {
        let instant = &profile.instants()[per_interval * k];
        assert_eq!(instant.time_s, trajectory.nodes()[k].time_s);
        assert_eq!(instant.joint_torques_n_m, interval.joint_torques_n_m);
        let power_w: f64 = instant.joint_powers_w.iter().sum();
        assert!((power_w - trajectory.nodes()[k].power_w).abs() < 1e-15);
    }
}

/// A rod on a base that gives way by no more than 1e-7: τ = m l²/3 q̈, from rest to rest.
#[test]
fn one_joint_by_hand() {
    let (m, l, duration_s) = (6.0, 0.8, 10.0);
    let link = serde_json::json!({
        "mass_kg": m, "a_m": l, "alpha_deg": 0.0, "d_m": 0.0, "theta_deg": 0.0,
        "rate_max_deg_s": 30.0, "acceleration_max_deg_s2": 20.0, "body_exempt": true
    });
    let scenario = serde_json::json!({
        "name": "by_hand",
        "system": {
            "name": "rod", "base": {"mass_kg": 1e9, "cube_side_m": 0.5},
            "mount": {"position_m": [0.0, 0.0, 0.25]}, "links": [link]
        },
        "initial": {"joint_angles_deg": [0.0]},
        "maneuver": {"type": "slew", "axis": [0.0, 0.0, 1.0], "angle_deg": 1.0},
        "horizon": {"duration_s": duration_s, "steps": 20}
    });
    let scenario = Scenario::parse(&scenario.to_string(), Path::new("by_hand.json")).unwrap();
    let acceleration = 3f64.to_radians();
    let controls: Vec<Vec<f64>> =
        (0..20).map(|k| vec![if k < 10 { acceleration } else { -acceleration }]).collect();
    let profile = PowerProfile::new(&scenario, &motion(&scenario, &controls)).unwrap();

    let torque_n_m = m * l * l / 3.0 * acceleration;
    let rate_rad_s = acceleration * duration_s / 2.0;
    let stored_j = 0.5 * m * l * l / 3.0 * rate_rad_s * rate_rad_s;
    let close = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 1e-7 * stored_j, "{found} is not {expected}");
    };
    close(profile.peak_torques_n_m()[0], torque_n_m);
    close(profile.peak_joint_powers_w()[0], torque_n_m * rate_rad_s);
    let eta = PAPER_EFFICIENCY;
    let energies_j = [0.0, 2.0 * stored_j / eta, stored_j / eta, stored_j * (1.0 / eta - eta)];
    for (accounting, energy_j) in Accounting::ALL.into_iter().zip(energies_j) {
        let used = profile.consumption(accounting, eta);
        close(used.energy_j * eta, energy_j * eta);
        close(used.mean_w * duration_s * eta, energy_j * eta);
        close(used.peak_w * eta, torque_n_m * rate_rad_s);
        assert_eq!(used.peak_time_s, duration_s / 2.0, "{accounting:?}");
    }
}

/// The same motion on a grid ten times as fine draws the same.
#[test]
fn consumption_does_not_depend_on_the_grid() {
    let (scenario, _) = moved("slew_4dof", 24.0, 48);
    let controls = righting_test_support::swing(&scenario);
    let coarse = PowerProfile::new(&scenario, &motion(&scenario, &controls)).unwrap();
    let fine = varied(&scenario, |file| file.horizon.steps = 480.0);
    let repeated: Vec<Vec<f64>> =
        controls.iter().flat_map(|control| vec![control.clone(); 10]).collect();
    let fine = PowerProfile::new(&fine, &motion(&fine, &repeated)).unwrap();
    for accounting in Accounting::ALL {
        let [coarse, fine] = [&coarse, &fine].map(|p| p.consumption(accounting, 0.1));
        let scale = fine.peak_w;
        assert!((coarse.peak_w - fine.peak_w).abs() < 1e-9 * scale, "{accounting:?}");
        // Where a joint turns around within an interval the power drawn has a kink.
        assert!((coarse.mean_w - fine.mean_w).abs() < 1e-4 * scale, "{accounting:?}");
    }
}

#[test]
fn what_braking_gives_back_orders_the_variants() {
    let scenario = shipped("slew_4dof");
    let profile =
        PowerProfile::new(&scenario, &motion(&scenario, &righting_test_support::swing(&scenario)));
    let profile = profile.unwrap();
    let drawn = Accounting::ALL.map(|accounting| profile.drawn_w(accounting, 0.3));
    let [signed, absolute, without, with] = drawn;
    let mut differs = false;
    for i in 0..profile.instants().len() {
        assert!(signed[i] <= with[i] && with[i] <= without[i] && without[i] <= absolute[i]);
        differs |= signed[i] < with[i] && with[i] < without[i] && without[i] < absolute[i];
    }
    assert!(differs);
}

#[test]
fn a_trajectory_of_another_scenario_is_refused() {
    let (scenario, trajectory) = moved("slew_4dof", 6.0, 30);
    let other = PowerProfile::new(&shipped("slew_2dof"), &trajectory).unwrap_err();
    assert_eq!(other.to_string(), "joints: found 4, expected 2");
    let finer = varied(&scenario, |file| file.horizon.steps = 60.0);
    let other = PowerProfile::new(&finer, &trajectory).unwrap_err();
    assert_eq!(other.to_string(), "steps: found 30, expected 60");
}
