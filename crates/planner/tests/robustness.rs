//! Plans that depend on masses less.

use righting_multibody::Quaternion;
use righting_ocp::Control;
use righting_planner::Planner;
use righting_results::Trajectory;
use righting_scenario::file::{End, Robustness, SystemReference};
use righting_scenario::{Maneuver, Scenario};
use righting_test_support::{shipped, varied};
use righting_verifier::simulate;

/// Root of the sum of squares of the angles by which the verifier's model ends elsewhere with one mass off: those of the
/// base, of its inertia and of the links.
fn deviation_deg(scenario: &Scenario, plan: &Trajectory, share: f64) -> f64 {
    let Maneuver::Slew(slew) = scenario.maneuver() else { unreachable!() };
    let links = scenario.system().joint_count();
    let ends = (0..links + 2).map(|which| {
        let other = varied(scenario, |file| {
            let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
            let base = &mut system.base;
            if let Some(side_m) = base.cube_side_m.take() {
                let moment = base.mass_kg * side_m.powi(2) / 6.0;
                base.inertia_kg_m2 =
                    Some([[moment, 0.0, 0.0], [0.0, moment, 0.0], [0.0, 0.0, moment]]);
                base.keep_out_radius_m = Some(side_m * 0.75_f64.sqrt());
            }
            match which {
                0 => base.mass_kg *= 1.0 + share,
                1 => {
                    let inertia = base.inertia_kg_m2.iter_mut().flatten().flatten();
                    inertia.for_each(|entry| *entry *= 1.0 + share);
                }
                link => system.links[link - 2].mass_kg *= 1.0 + share,
            }
        });
        let (terminal, _) = simulate(&other, plan);
        terminal.attitude_error_deg
    });
    let planned = Quaternion::from_array(plan.end().attitude).angle_to(&slew.target);
    assert!(planned < 1e-4, "the plan itself ends in its target");
    ends.map(|end| end * end).sum::<f64>().sqrt()
}

#[test]
fn a_robust_plan_depends_less_on_masses_and_says_by_how_much() {
    let plain = varied(&shipped("slew_4dof"), |file| {
        file.end = Some(End { hard: Some(true), ..End::default() });
    });
    let robust = varied(&plain, |file| {
        file.robustness = Some(Robustness { mass_percent: 3.0, weight: Some(10.0) });
    });
    let [plain, robust] = [plain, robust].map(|scenario| {
        let planned = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
        assert!(planned.solution.verification.passed);
        (scenario, planned)
    });
    assert_eq!(plain.1.solution.robustness, None);
    let record = robust.1.solution.robustness.unwrap();
    let share = 0.03 / 3f64.sqrt();
    let [without, with] = [&plain, &robust]
        .map(|(scenario, planned)| deviation_deg(scenario, &planned.trajectory, share));
    assert!((record.without_deg / without - 1.0).abs() < 0.01, "{} {without}", record.without_deg);
    assert!((record.deviation_deg / with - 1.0).abs() < 0.01, "{} {with}", record.deviation_deg);
    assert!(with < 0.98 * without, "{with} {without}");
    let costs = robust.1.solution.objective / plain.1.solution.objective;
    assert!((record.cost_ratio / costs - 1.0).abs() < 0.02, "{} {costs}", record.cost_ratio);
}
