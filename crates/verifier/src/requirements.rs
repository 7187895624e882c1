//! What a scenario asks of a plan, from the resolved file alone.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_scenario::file::{self, JointKind};
use righting_scenario::scenario::{Horizon, Scenario};

use crate::clearances::Clearances;
use crate::goal::{Goal, stopped_rate};
use crate::lineage::Lineage;
use crate::loads::LoadLimits;
use crate::model::{BaseAcceleration, Model, Motion, State, Surroundings};
use crate::motion_bound::Reach;
use crate::pointing::Cone;
use crate::posture::EndPosture;
use crate::tolerances::{Measures, Tolerances};
use crate::waypoints::{Waypoint, waypoints};
use crate::wheels::Wheels;

/// Everything that a plan is measured by.
#[derive(Debug)]
pub(super) struct Requirements {
    pub model: Model,
    pub surroundings: Surroundings,
    pub wheels: Wheels,
    /// Whether a slew may end with the drift that angular momentum leaves.
    pub may_drift: bool,
    pub horizon: Horizon,
    /// State vector at the start: the body frame's origin at the inertial one, the system's at rest.
    pub start: Vec<f64>,
    pub goal: Goal,
    pub waypoints: Vec<Waypoint>,
    pub end_posture: EndPosture,
    /// One a joint.
    pub joint_limits: Vec<JointLimits>,
    /// Which joints slide.
    pub slides: Vec<bool>,
    pub size_m: f64,
    pub load_limits: LoadLimits,
    pub clearances: Clearances,
    pub cones: Vec<Cone>,
    pub reach: Reach,
    pub tolerances: Tolerances,
    pub measures: Measures,
    /// Whether the end is met as well as numbers allow.
    pub is_end_hard: bool,
}

/// What a joint may do: rad and its rates, or m and its of one that slides.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointLimits {
    pub angle_min_rad: Option<f64>,
    pub angle_max_rad: Option<f64>,
    /// In magnitude.
    pub rate_max_rad_s: f64,
    /// In magnitude.
    pub acceleration_max_rad_s2: f64,
    /// In magnitude.
    pub jerk_max_rad_s3: Option<f64>,
}

impl Requirements {
    pub fn new(scenario: &Scenario) -> Self {
        let file = scenario.resolved();
        let system = scenario.resolved_system();
        let model = Model::new(system);
        let kinds = system.joint_kinds();
        let start = start(&model, &kinds, &file.initial);
        let wheels = Wheels::new(file);
        let clearance_m = file.collision.clearance_m.unwrap_or(0.0);
        let clearances = Clearances::new(system, &model, clearance_m);
        let duration_s = scenario.horizon().duration_s;
        Self {
            tolerances: Tolerances::new(
                size_m(system),
                clearance_m,
                duration_s,
                State::from_slice(&start).angular_rate.norm(),
            ),
            measures: Measures::new(size_m(system), model.total_mass(), duration_s),
            is_end_hard: file.end.as_ref().and_then(|end| end.hard).unwrap_or(false),
            goal: Goal::new(&file.maneuver, &model, &State::from_slice(&start)),
            waypoints: {
                let attitude = State::from_slice(&start).attitude;
                let attitude = UnitQuaternion::from_quaternion(attitude);
                waypoints(&file.maneuver, &attitude, scenario.horizon())
            },
            end_posture: EndPosture::new(file.end.as_ref(), &kinds),
            horizon: scenario.horizon(),
            surroundings: Surroundings::new(file.environment.as_ref()),
            may_drift: file.environment.is_some() && !(wheels.work() && wheels.may_hold(file)),
            wheels,
            joint_limits: system.joints().iter().map(JointLimits::new).collect(),
            slides: kinds.iter().map(|kind| *kind == JointKind::Prismatic).collect(),
            size_m: size_m(system),
            load_limits: LoadLimits::new(system),
            cones: file.pointing.iter().map(Cone::new).collect(),
            reach: Reach::new(system, &clearances.solids),
            clearances,
            model,
            start,
        }
    }
}

impl Requirements {
    /// The base's rate that no fault of the plan leaves in a state at rest, deg/s: the one that momentum from
    /// outside leaves once the joints have stopped.
    pub fn drift_deg_s(&self, state: &State<'_>) -> f64 {
        match self.may_drift {
            true => stopped_rate(&self.model, state).norm().to_degrees(),
            false => 0.0,
        }
    }
}

/// The length of the arm stretched out, from the origin of the body frame, m; of bodies, to the joint or
/// center of mass that can be farthest. Not less than to the base's center of mass: places have its rounding.
fn size_m(system: &file::System) -> f64 {
    let size_m = match &system.bodies {
        None => {
            let links: f64 = system.links.iter().map(|link| link.a_m.hypot(link.d_m)).sum();
            let mount =
                system.mount.as_ref().map_or(Vector3::zeros(), |mount| mount.position_m.into());
            mount.norm() + links
        }
        Some(bodies) => {
            let length_m = |v: Option<[f64; 3]>| Vector3::from(v.unwrap_or_default()).norm();
            let lineage = Lineage::new(system);
            let reach_m = |body: usize| -> f64 {
                let way = lineage.way_from_base(body).into_iter();
                way.map(|body| length_m(bodies[body].joint.position_m)).sum::<f64>()
                    + length_m(bodies[body].center_of_mass_m)
            };
            (0..bodies.len()).map(reach_m).fold(0.0, f64::max)
        }
    };
    let to_base_m = Vector3::from(system.base.center_of_mass_m.unwrap_or_default()).norm();
    let size_m = f64::max(size_m, to_base_m);
    if size_m > 0.0 { size_m } else { 1.0 }
}

impl JointLimits {
    fn new(joint: &file::JointRow) -> Self {
        let words = joint.words();
        let si = |limit: Option<f64>| limit.map(|limit| words.to_si(limit));
        Self {
            angle_min_rad: si(joint.min),
            angle_max_rad: si(joint.max),
            rate_max_rad_s: si(joint.rate_max).unwrap_or(f64::INFINITY),
            acceleration_max_rad_s2: si(joint.acceleration_max).unwrap_or(f64::INFINITY),
            jerk_max_rad_s3: si(joint.jerk_max),
        }
    }
}

fn start(model: &Model, kinds: &[JointKind], initial: &file::Initial) -> Vec<f64> {
    let joint_angles = initial.joint_coordinates(kinds);
    let joint_rates = initial.joint_rates(kinds);
    let [w, x, y, z] = initial.attitude.unwrap_or([1.0, 0.0, 0.0, 0.0]);
    let held = State {
        position: Vector3::zeros(),
        attitude: UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).into_inner(),
        velocity: Vector3::zeros(),
        angular_rate: Vector3::from(initial.angular_rate_deg_s.unwrap_or_default())
            .map(f64::to_radians),
        joint_angles: &joint_angles,
        joint_rates: &joint_rates,
    };
    let mut motion = Motion::new(model);
    let coasting = vec![0.0; joint_angles.len()];
    motion.set(model, &held, &BaseAcceleration::default(), &coasting);
    // Carried along at this velocity, the system's center of mass is at rest.
    let velocity = -motion.linear_momentum() / model.total_mass();
    State { velocity, ..held }.to_vec()
}
