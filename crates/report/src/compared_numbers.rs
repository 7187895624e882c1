//! One of the plans that are compared, in numbers.

use righting_results::LimitRecord;
use serde::Serialize;

use crate::comparison::ComparedPlan;

/// What a program reads of a plan beside others.
#[derive(Clone, Debug, Serialize)]
pub struct ComparedNumbers<'a> {
    /// Name of the scenario.
    pub scenario: &'a str,
    /// Name of the system.
    pub system: &'a str,
    /// Number of joints.
    pub joints: usize,
    /// Whether every check passed.
    pub verified: bool,
    /// Norm of the vector part of the attitude error quaternion at the end.
    pub attitude_error: f64,
    /// Its angle, deg.
    pub attitude_error_deg: f64,
    /// Norm of the base's angular rate at the end, deg/s.
    pub angular_rate_deg_s: f64,
    /// Norm of the joint rates at the end, all joints that turn together, deg/s.
    pub joint_rate_deg_s: f64,
    /// Duration, s.
    pub duration_s: f64,
    /// Integral of the squared joint accelerations, rad²/s³; of joints that slide as an objective counts them.
    pub effort_rad2_s3: f64,
    /// The largest torque of any joint, N m.
    pub peak_torque_n_m: f64,
    /// The joint that gives it.
    pub peak_torque_joint: String,
    /// The most mechanical power of all joints together, W.
    pub peak_power_w: f64,
    /// Mechanical energy, J: braking counts as driving.
    pub energy_j: f64,
    /// Of each limited quantity the limit that the plan comes nearest to.
    pub smallest_margins: Vec<ComparedMargin<'a>>,
}

/// How near a plan comes to a limit.
#[derive(Clone, Debug, Serialize)]
pub struct ComparedMargin<'a> {
    /// What is left; below zero beyond the limit.
    pub margin: f64,
    /// The limit.
    #[serde(flatten)]
    pub limit: &'a LimitRecord,
}

impl<'a> ComparedNumbers<'a> {
    /// Those of one plan.
    pub fn of(plan: &ComparedPlan<'a>) -> Self {
        let (peak_torque_n_m, joint) = plan.peak_torque_n_m();
        let system = plan.scenario.system();
        let terminal = &plan.solution.terminal;
        let margins = plan.smallest_margins().into_iter();
        Self {
            scenario: plan.scenario.name(),
            system: &system.name,
            joints: system.joint_count(),
            verified: plan.solution.verification.passed,
            attitude_error: terminal.attitude_error,
            attitude_error_deg: terminal.attitude_error_deg,
            angular_rate_deg_s: terminal.angular_rate_deg_s,
            joint_rate_deg_s: terminal.joint_rate_deg_s,
            duration_s: plan.profile.duration_s(),
            effort_rad2_s3: plan.profile.effort_rad2_s3(),
            peak_torque_n_m,
            peak_torque_joint: system.names.joint(joint),
            peak_power_w: plan.peak_power_w(),
            energy_j: plan.energy_j(),
            smallest_margins: margins
                .map(|limit| ComparedMargin { margin: limit.margin(), limit })
                .collect(),
        }
    }
}
