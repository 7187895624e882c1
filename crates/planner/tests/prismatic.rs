//! Plans of arms with joints that slide.

use nalgebra::Vector3;
use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::file::{self, Formulation};
use righting_scenario::{Scenario, SystemDescription};
use righting_test_support::units::Units;
use righting_test_support::{scenarios, varied};

fn planned(scenario: &Scenario) -> Planned {
    let planned = Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap();
    let failures: Vec<_> = planned.solution.verification.failures().collect();
    assert!(planned.solution.verification.passed, "{failures:?}");
    planned
}

/// A slew of the Stanford arm on a coarse grid.
fn slew() -> Scenario {
    let scenario = Scenario::read(&scenarios().join("real/slew_stanford.json")).unwrap();
    varied(&scenario, |file| {
        file.horizon.steps = 120.0;
        file.weights = file::Weights::default();
        file.end = None;
    })
}

#[test]
fn a_slide_takes_part_and_both_formulations_agree() {
    let reduced = planned(&slew());
    let travels: Vec<f64> =
        reduced.trajectory.nodes().iter().map(|node| node.joint_angles_rad[2]).collect();
    let [least, most] = [f64::min, f64::max].map(|of| travels.iter().copied().reduce(of).unwrap());
    assert!(most - least > 0.05, "the boom slides from {least} to {most} m only");
    assert!(reduced.solution.terminal.joint_speed_m_s.unwrap() < 1e-4);
    let full = planned(&varied(&slew(), |file| file.solver.formulation = Some(Formulation::Full)));
    let (a, b) = (reduced.solution.objective, full.solution.objective);
    assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
}

#[test]
fn lengths_in_any_unit_give_the_same_plan() {
    let scenario = slew();
    let plan = planned(&scenario);
    for (mass, length, time) in [(1.0, 1000.0, 1.0), (1000.0, 0.01, 60.0)] {
        let units = Units { mass, length, time };
        let file = units.of(scenario.resolved());
        let other = Scenario::from_file(file, std::path::Path::new("other.json")).unwrap();
        let other = planned(&other);
        let nodes = plan.trajectory.nodes().iter().zip(other.trajectory.nodes());
        for (a, b) in nodes {
            let listed = a.joint_angles_rad.iter().zip(&b.joint_angles_rad).enumerate();
            for (joint, (a, b)) in listed {
                let b = if joint == 2 { b / length } else { *b };
                assert!((a - b).abs() < 1e-5, "joint {joint}: {a} {b} where a metre is {length}");
            }
        }
    }
}

/// A mass that slides past the base at a distance turns it as angular momentum says: with m* = m M/(m + M) the
/// reduced mass and x the distance of the rail, tan of the angle (r − r₀) / x scaled by √(m* x² + I)... in closed
/// form from (I + m*(x² + q²)) ω = m* x q̇.
#[test]
fn a_mass_on_a_rail_turns_the_base_by_the_closed_form() {
    let text = r#"{
        "name": "rail",
        "base": { "mass_kg": 40, "inertia_kg_m2": [[5, 0, 0], [0, 5, 0], [0, 0, 4]], "keep_out_radius_m": 0 },
        "bodies": [{
            "name": "mass", "parent": "base", "mass_kg": 10,
            "joint": { "type": "prismatic", "position_m": [1.5, 0, 0], "axis": [0, 1, 0], "travel_min_m": -2,
                       "travel_max_m": 2, "speed_max_m_s": 1, "acceleration_max_m_s2": 1 }
        }]
    }"#;
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rail.json");
    std::fs::write(&file, text).unwrap();
    let system = SystemDescription::read(&file).unwrap();
    let (inertia, reduced_mass, x) = (4.0, 8.0, 1.5);
    // ∫ −m* x q̇ / (I + m* (x² + q²)) dt, from q = −1 to 1.
    let across = f64::sqrt(inertia / reduced_mass + x * x);
    let angle = -2.0 * x / across * (1.0 / across).atan();
    let steps = 2000;
    let turned: f64 = (0..steps)
        .map(|k| {
            let q = -1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(steps);
            let rate = system.model.reduced_angular_rate(&[q], &[1.0], &Vector3::zeros());
            assert!(rate.xy().norm() < 1e-15);
            rate.z * 2.0 / f64::from(steps)
        })
        .sum();
    assert!((turned - angle).abs() < 1e-6, "{turned} {angle}");

    // Planned, that slew is reached with the mass going from one place to the other.
    let scenario = serde_json::json!({
        "name": "along_the_rail",
        "system": "rail.json",
        "initial": { "joint_angles_deg": [], "joint_travels_m": [-1] },
        "maneuver": { "type": "slew", "axis": [0, 0, 1], "angle_deg": angle.to_degrees() },
        "horizon": { "duration_s": 20, "steps": 80 }
    });
    let scenario = Scenario::parse(&scenario.to_string(), &folder.path().join("s.json")).unwrap();
    let end = planned(&scenario).trajectory.end().joint_angles_rad[0];
    assert!((end - 1.0).abs() < 1e-4, "{end}");
}
