//! Scenarios that grow: arms of more joints, grids of more steps.

use std::path::{Path, PathBuf};

use righting_scenario::file::{Formulation, Guess, NamedGuess, SystemReference};
use righting_scenario::{Error, Scenario};

/// Arms that are compared.
pub const JOINTS: [usize; 6] = [2, 4, 7, 10, 14, 20];

/// The file of a scenario that is shipped.
pub fn shipped(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    folder.join(format!("{name}.json"))
}

/// The 20° slew of the 4-DOF arm with an arm of the same mass and reach but so many joints: a column
/// on the base, then links of one length that bend about one axis, each from the third joint on about
/// the axis at a right angle to the one before.
pub fn chain(joints: usize) -> Result<Scenario, Error> {
    let file = shipped("slew_4dof");
    let mut scenario = Scenario::read(&file)?.resolved().clone();
    scenario.name = format!("chain_{joints}");
    scenario.initial.joint_angles_deg = vec![0.0; joints];
    scenario.initial.joint_rates_deg_s = None;
    if let SystemReference::Inline(system) = &mut scenario.system {
        system.name.clone_from(&scenario.name);
        let reach_m: f64 = system.links.iter().map(|link| link.a_m).sum();
        let mass_kg: f64 = system.links.iter().map(|link| link.mass_kg).sum();
        let mut column = system.links.swap_remove(0);
        column.mass_kg = mass_kg / joints as f64;
        system.links = vec![column; joints];
        for (index, link) in system.links.iter_mut().enumerate().skip(1) {
            let bends_both_ways = (2..joints - 1).contains(&index);
            let is_first = index == 1;
            link.a_m = reach_m / (joints - 1) as f64;
            link.d_m = 0.0;
            link.alpha_deg = match bends_both_ways {
                true if index % 2 == 0 => 90.0,
                true => -90.0,
                false => 0.0,
            };
            link.theta_deg = if is_first { 90.0 } else { 0.0 };
            let range_deg = if is_first { 90.0 } else { 50.0 };
            (link.angle_min_deg, link.angle_max_deg) = (Some(-range_deg), Some(range_deg));
            link.body_exempt = false;
        }
    }
    Scenario::from_file(scenario, &file)
}

/// The same maneuver on another grid. The sum over the controls carries no Δt: its weight does.
pub fn on_grid(scenario: &Scenario, steps: usize) -> Result<Scenario, Error> {
    let mut file = scenario.resolved().clone();
    let ratio = file.horizon.steps / steps as f64;
    file.weights.control = file.weights.control.map(|weight| weight * ratio);
    file.horizon.steps = steps as f64;
    Scenario::from_file(file, &shipped("slew_4dof"))
}

/// The same maneuver from the paper's guess, in the reduced form.
pub fn from_constant_guess(scenario: &Scenario) -> Result<Scenario, Error> {
    let mut file = scenario.resolved().clone();
    file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
    file.solver.formulation = Some(Formulation::Reduced);
    Scenario::from_file(file, &shipped("slew_4dof"))
}
