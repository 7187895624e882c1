//! Plans side by side, in numbers.

use righting_analysis::PowerProfile;
use righting_analysis::power::Accounting;
use righting_results::{LimitRecord, Solution, Trajectory};
use righting_scenario::Scenario;
use righting_scenario::file::ManeuverType;
use righting_verifier::Verified;

use crate::asked;
use crate::number::short;
use crate::summary::in_degrees;
use crate::table::aligned;

/// One of the plans that are compared.
#[derive(Clone, Copy, Debug)]
pub struct ComparedPlan<'a> {
    /// What it is called beside the others.
    pub name: &'a str,
    /// That of the solution.
    pub scenario: &'a Scenario,
    /// The outcome.
    pub solution: &'a Solution,
    /// The plan.
    pub trajectory: &'a Trajectory,
    /// What its motion takes.
    pub profile: &'a PowerProfile,
}

impl<'a> ComparedPlan<'a> {
    /// A plan of that name.
    pub fn new(name: &'a str, plan: &'a Verified, profile: &'a PowerProfile) -> Self {
        let Verified { solution, scenario, trajectory } = plan;
        Self { name, scenario, solution, trajectory, profile }
    }

    /// The largest torque of any joint in magnitude, N m, and which joint gives it, counted from zero.
    pub fn peak_torque_n_m(&self) -> (f64, usize) {
        let torques = self.profile.peak_torques_n_m();
        let joint = (0..torques.len()).max_by(|&a, &b| torques[a].total_cmp(&torques[b]));
        joint.map_or((0.0, 0), |joint| (torques[joint], joint))
    }

    /// The most mechanical power of all joints together, W.
    pub fn peak_power_w(&self) -> f64 {
        self.profile.consumption(Accounting::Signed, 1.0).peak_w
    }

    /// Mechanical energy ∫ Σ |τ q̇| dt, J: braking counts as driving.
    pub fn energy_j(&self) -> f64 {
        self.profile.consumption(Accounting::Absolute, 1.0).energy_j
    }

    /// Of each limited quantity the limit that the plan comes nearest to, or is furthest beyond.
    pub fn smallest_margins(&self) -> Vec<&'a LimitRecord> {
        let mut smallest: Vec<&LimitRecord> = Vec::new();
        for limit in &self.solution.limits {
            let known = smallest.iter_mut().find(|known| known.quantity() == limit.quantity());
            match known {
                Some(known) if limit.margin() < known.margin() => *known = limit,
                Some(_) => {}
                None => smallest.push(limit),
            }
        }
        smallest
    }
}

/// The plans side by side as text, one column a plan.
pub fn comparison_table(plans: &[ComparedPlan<'_>]) -> String {
    let asked = plans.iter().map(|plan| {
        [
            plan.name.to_owned(),
            plan.scenario.name().to_owned(),
            asked::planned_phrase(plan.solution),
        ]
    });
    let asked: Vec<[String; 3]> = asked.collect();
    let mut lines = aligned(&asked, &[false, false, false]);
    lines.push(String::new());
    let right_aligned: Vec<bool> = (0..=plans.len()).map(|column| column > 0).collect();
    lines.extend(aligned(&comparison_rows(plans), &right_aligned));
    lines.push(String::new());
    lines.join("\n")
}

/// The cells of the table, its head first: what is compared, then one cell a plan.
pub(crate) fn comparison_rows(plans: &[ComparedPlan<'_>]) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    let mut row = |name: &str, cell: &dyn Fn(&ComparedPlan<'_>) -> String| {
        let cells = plans.iter().map(cell);
        rows.push(std::iter::once(name.to_owned()).chain(cells).collect());
    };
    let is_slew =
        |plan: &ComparedPlan<'_>| plan.solution.scenario.maneuver.kind == ManeuverType::Slew;
    row("", &|plan| plan.name.to_owned());
    row("system", &|plan| plan.scenario.system().name.clone());
    row("joints", &|plan| plan.scenario.system().joint_count().to_string());
    row("verified", &|plan| {
        if plan.solution.verification.passed { "yes" } else { "NO" }.to_owned()
    });
    if plans.iter().any(is_slew) {
        row("attitude error [deg]", &|plan| match is_slew(plan) {
            true => short(plan.solution.terminal.attitude_error_deg),
            false => NOTHING.to_owned(),
        });
    }
    row("base at the end [deg/s]", &|plan| short(plan.solution.terminal.angular_rate_deg_s));
    row("duration [s]", &|plan| short(plan.profile.duration_s()));
    row("effort, integral of squared joint accelerations [rad\u{b2}/s\u{b3}]", &|plan| {
        short(plan.profile.effort_rad2_s3())
    });
    row("peak joint torque [N m]", &|plan| {
        let (torque_n_m, joint) = plan.peak_torque_n_m();
        format!("{} ({})", short(torque_n_m), plan.scenario.system().names.joint(joint))
    });
    row("peak power, mechanical [W]", &|plan| short(plan.peak_power_w()));
    row("energy, integral of |torque \u{d7} rate| [J]", &|plan| short(plan.energy_j()));
    for (quantity, unit) in quantities(plans) {
        let (unit, scale) = in_degrees(&unit);
        row(&format!("margin of {quantity} [{unit}]"), &|plan| {
            let margins = plan.smallest_margins();
            match margins.into_iter().find(|limit| limit.quantity() == quantity) {
                Some(limit) => short(scale * limit.margin()),
                None => NOTHING.to_owned(),
            }
        });
    }
    rows
}

/// What a plan has no number for.
const NOTHING: &str = "\u{2013}";

/// Everything that any plan has a limit of, with its unit.
fn quantities(plans: &[ComparedPlan<'_>]) -> Vec<(String, String)> {
    let mut quantities: Vec<(String, String)> = Vec::new();
    for limit in plans.iter().flat_map(ComparedPlan::smallest_margins) {
        let quantity = (limit.quantity().to_owned(), limit.unit.clone());
        if !quantities.contains(&quantity) {
            quantities.push(quantity);
        }
    }
    quantities
}
