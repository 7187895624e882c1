//! The whole system as MJCF, MuJoCo's own format: the base on a free joint, no gravity.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use righting_multibody::{JointKind, Placement, RigidBody};
use righting_results::{Node, Trajectory};
use righting_scenario::{JointLimits, SystemDescription};

use crate::arm::{Arm, BASE, Hinge, TIP};
use crate::xml::Element;

/// What stands for an angle without a limit where the joint has another.
const UNLIMITED: f64 = 1e9;
/// The least mass (kg) and principal moment (kg m²) of a body on a joint; MuJoCo refuses less than
/// 1e-15.
const LEAST: f64 = 1e-14;

/// The system as an MJCF model, with the plan's first and last node as its key frames `start` and
/// `end`.
///
/// The body `base` is on a free joint; no gravity, armature, damping or friction. Body `link_i` is
/// what `joint_i` moves, in the frame whose z axis is the joint's axis where all coordinates are zero; bodies
/// and joints with names of their own keep them. Joints stand depth first. A payload is part of the last
/// body. Joint coordinates are the plan's. Every joint has a motor of the same
/// name, whose control is its torque or force, within the joint's limit; locked joints are none, their bodies
/// are fixed. Rate and acceleration limits stand in `custom`, since MJCF has none: those of the joints that turn
/// and those of the joints that slide, in the order of the joints. The site `tip` is the last frame of an arm in
/// rows.
///
/// MuJoCo refuses bodies without mass on a joint. A massless link is therefore no body: its joint
/// turns the next body with mass, which is the same motion. Where none or several follow, and for principal
/// moments of zero such as a rod's about itself, 1e-14 kg and kg m² stand for zero.
pub fn mjcf(system: &SystemDescription, trajectory: &Trajectory) -> String {
    model(system, &Arm::new(system), trajectory).to_string()
}

/// The model of an arm with the key frames of a trajectory.
pub(crate) fn model(system: &SystemDescription, arm: &Arm, trajectory: &Trajectory) -> Element {
    let moving = || arm.hinges.iter().filter(|hinge| hinge.held_at.is_none());
    let joint = Element::new("joint")
        .with_number("armature", 0.0)
        .with_number("damping", 0.0)
        .with_number("frictionloss", 0.0);
    let mut custom = Element::new("custom");
    let mut actuator = Element::new("actuator");
    for hinge in moving() {
        actuator.push(motor(hinge));
    }
    let names_of_kinds = [
        (JointKind::Revolute, ["rate_max_rad_s", "acceleration_max_rad_s2", "jerk_max_rad_s3"]),
        (JointKind::Prismatic, ["speed_max_m_s", "acceleration_max_m_s2", "jerk_max_m_s3"]),
    ];
    for (kind, [rate, acceleration, jerk]) in names_of_kinds {
        let limits: Vec<&JointLimits> =
            moving().filter(|hinge| hinge.kind == kind).map(|hinge| &hinge.limits).collect();
        if limits.is_empty() {
            continue;
        }
        let mut push = |name, of: fn(&JointLimits) -> f64| {
            let values = limits.iter().map(|limits| of(limits));
            custom.push(Element::new("numeric").with("name", name).with_numbers("data", values));
        };
        push(rate, |limits| limits.rate_max_rad_s);
        push(acceleration, |limits| limits.acceleration_max_rad_s2);
        if limits.iter().any(|limits| limits.jerk_max_rad_s3.is_finite()) {
            push(jerk, |limits| limits.jerk_max_rad_s3.min(UNLIMITED));
        }
    }
    let keys = Element::new("keyframe")
        .holding(key("start", arm, trajectory.start()))
        .holding(key("end", arm, trajectory.end()));
    Element::new("mujoco")
        .with("model", &system.name)
        .noting("SI units and radians; motors take torques in N m, where joints slide forces in N")
        .holding(Element::new("compiler").with("angle", "radian"))
        .holding(Element::new("option").with_numbers("gravity", [0.0; 3]).with("integrator", "RK4"))
        .holding(Element::new("default").holding(joint))
        .holding(custom)
        .holding(Element::new("worldbody").holding(bodies(arm)))
        .holding(actuator)
        .holding(keys)
}

fn motor(hinge: &Hinge) -> Element {
    let motor = Element::new("motor").with("name", &hinge.joint).with("joint", &hinge.joint);
    let largest_n_m = hinge.limits.torque_max_n_m;
    match largest_n_m.is_finite() {
        true => {
            motor.with("ctrllimited", "true").with_numbers("ctrlrange", [-largest_n_m, largest_n_m])
        }
        false => motor,
    }
}

/// What lies between a body of the model and the next one farther out that is in the model.
#[derive(Clone)]
struct Between<'a> {
    placement: Placement,
    joints: Vec<Joint<'a>>,
}

/// A joint in the frame of the body that it turns.
#[derive(Clone)]
struct Joint<'a> {
    hinge: &'a Hinge,
    axis: Vector3<f64>,
    position_m: Vector3<f64>,
}

impl<'a> Between<'a> {
    fn nothing() -> Self {
        Self { placement: Placement::identity(), joints: Vec::new() }
    }

    /// And one hinge more.
    fn past(mut self, hinge: &'a Hinge) -> Self {
        let step = hinge.placed();
        self.placement = self.placement.then(&step);
        for joint in &mut self.joints {
            *joint = joint.seen_from(&step);
        }
        if hinge.held_at.is_none() {
            self.joints.push(Joint { hinge, axis: Vector3::z(), position_m: Vector3::zeros() });
        }
        self
    }

    fn body(&self, hinge: &Hinge) -> Element {
        let mut body = placed(Element::new("body").with("name", &hinge.link), &self.placement);
        for joint in &self.joints {
            body.push(joint.element());
        }
        let least = if self.joints.is_empty() { 0.0 } else { LEAST };
        body.holding(inertial(&hinge.body, least))
    }
}

/// Puts a body and all that it carries into the one that carries it.
fn hang<'a>(arm: &'a Arm, index: usize, between: Between<'a>, carrier: &mut Element) {
    let hinge = &arm.hinges[index];
    let between = between.past(hinge);
    let carried: Vec<usize> = arm.carried_by(Some(index)).collect();
    let tip = arm.tip.filter(|_| index + 1 == arm.hinges.len());
    let site = |placement: &Placement| placed(Element::new("site").with("name", TIP), placement);
    if hinge.body.mass_kg > 0.0 || carried.len() != 1 && !between.joints.is_empty() {
        let mut body = between.body(hinge);
        for next in carried {
            hang(arm, next, Between::nothing(), &mut body);
        }
        if let Some(tip) = &tip {
            body.push(site(tip));
        }
        carrier.push(body);
    } else {
        for next in carried {
            hang(arm, next, between.clone(), carrier);
        }
        if let Some(tip) = &tip {
            carrier.push(site(&between.placement.then(tip)));
        }
    }
}

impl Joint<'_> {
    /// The same joint in a frame that sits at `placement` in this one.
    fn seen_from(&self, placement: &Placement) -> Self {
        let back = placement.rotation.transpose();
        Self {
            axis: back * self.axis,
            position_m: back * (self.position_m - placement.position_m),
            ..self.clone()
        }
    }

    fn element(&self) -> Element {
        let JointLimits { angle_min_rad, angle_max_rad, .. } = self.hinge.limits;
        let is_limited = angle_min_rad.is_finite() || angle_max_rad.is_finite();
        let joint = Element::new("joint")
            .with("name", &self.hinge.joint)
            .with(
                "type",
                match self.hinge.kind {
                    JointKind::Revolute => "hinge",
                    JointKind::Prismatic => "slide",
                },
            )
            .with_numbers("pos", self.position_m.iter().copied())
            .with_numbers("axis", self.axis.iter().copied())
            .with("limited", if is_limited { "true" } else { "false" });
        match is_limited {
            true => joint.with_numbers(
                "range",
                [angle_min_rad.max(-UNLIMITED), angle_max_rad.min(UNLIMITED)],
            ),
            false => joint,
        }
    }
}

fn bodies(arm: &Arm) -> Element {
    let mut base = Element::new("body")
        .with("name", BASE)
        .holding(Element::new("freejoint").with("name", BASE))
        .holding(inertial(&arm.base, LEAST));
    for index in arm.carried_by(None) {
        hang(arm, index, Between::nothing(), &mut base);
    }
    base
}

fn placed(element: Element, placement: &Placement) -> Element {
    let rotation = Rotation3::from_matrix_unchecked(placement.rotation);
    element
        .with_numbers("pos", placement.position_m.iter().copied())
        .with_numbers("quat", wxyz(&UnitQuaternion::from_rotation_matrix(&rotation)))
}

fn wxyz(quaternion: &UnitQuaternion<f64>) -> [f64; 4] {
    [quaternion.w, quaternion.i, quaternion.j, quaternion.k]
}

/// Principal moments and axes, so that MuJoCo has none to find: it does so to 1e-12 only.
fn inertial(body: &RigidBody, least: f64) -> Element {
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(body.inertia_kg_m2);
    let moments = physical(eigenvalues, least);
    let is_right_handed = eigenvectors.determinant() > 0.0;
    let axes = if is_right_handed { eigenvectors } else { -eigenvectors };
    let axes = Rotation3::from_matrix_unchecked(Matrix3::from(axes));
    Element::new("inertial")
        .with_numbers("pos", body.center_of_mass_m.iter().copied())
        .with_numbers("quat", wxyz(&UnitQuaternion::from_rotation_matrix(&axes)))
        .with_number("mass", body.mass_kg.max(least))
        .with_numbers("diaginertia", moments.iter().copied())
}

/// Principal moments that are at least `least`, none of them larger than the two others together:
/// rounding may leave a rod's so.
fn physical(moments: Vector3<f64>, least: f64) -> Vector3<f64> {
    let moments = moments.map(|moment| moment.max(least));
    let total = moments.sum();
    moments.map(|moment| moment.min(total - moment))
}

fn key(name: &str, arm: &Arm, node: &Node) -> Element {
    let turning = |values: &[f64]| -> Vec<f64> {
        let turning = arm.hinges.iter().filter(|hinge| hinge.held_at.is_none());
        turning.map(|hinge| values[hinge.coordinate]).collect()
    };
    let place = node.position_m.into_iter().chain(node.attitude);
    let motion = node.velocity_m_s.into_iter().chain(node.angular_rate_rad_s);
    Element::new("key")
        .with("name", name)
        .with_numbers("qpos", place.chain(turning(&node.joint_angles_rad)))
        .with_numbers("qvel", motion.chain(turning(&node.joint_rates_rad_s)))
}
