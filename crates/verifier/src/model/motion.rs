//! How every frame and every body moves, in inertial axes, and the momentum that makes.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::body::Carrier;
use super::step::Step;
use super::{BaseAcceleration, Model, State};

/// A frame in motion, in inertial axes.
#[derive(Clone, Copy, Debug)]
pub struct FrameMotion {
    /// The frame's axes, as columns.
    pub rotation: Matrix3<f64>,
    /// Origin, m.
    pub origin: Vector3<f64>,
    /// Angular rate Ω, rad/s.
    pub angular_rate: Vector3<f64>,
    /// Velocity of the origin, m/s.
    pub velocity: Vector3<f64>,
    /// Angular acceleration Ω̇, rad/s².
    pub angular_acceleration: Vector3<f64>,
    /// Acceleration of the origin, m/s².
    pub acceleration: Vector3<f64>,
}

/// A body in motion, in inertial axes.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion {
    /// kg.
    pub mass: f64,
    /// Center of mass x, m.
    pub center: Vector3<f64>,
    /// Velocity v of the center of mass, m/s.
    pub velocity: Vector3<f64>,
    /// Inertia J about the center of mass, kg m².
    pub inertia: Matrix3<f64>,
    /// Angular momentum J Ω about the center of mass, N m s.
    pub spin: Vector3<f64>,
    /// Force m a that moves the center of mass so, N.
    pub force: Vector3<f64>,
    /// Moment J Ω̇ + Ω × J Ω about the center of mass that turns the body so, N m.
    pub moment: Vector3<f64>,
}

/// The whole system in motion, and room for the next motion.
#[derive(Clone, Debug)]
pub struct Motion {
    base: FrameMotion,
    frames: Vec<FrameMotion>,
    bodies: Vec<BodyMotion>,
    /// Room for force and moment on all that each frame carries.
    pub(super) carried: Vec<[Vector3<f64>; 2]>,
    total_mass: f64,
}

impl FrameMotion {
    const STILL: Self = Self {
        rotation: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        origin: Vector3::new(0.0, 0.0, 0.0),
        angular_rate: Vector3::new(0.0, 0.0, 0.0),
        velocity: Vector3::new(0.0, 0.0, 0.0),
        angular_acceleration: Vector3::new(0.0, 0.0, 0.0),
        acceleration: Vector3::new(0.0, 0.0, 0.0),
    };

    /// Velocity and acceleration of a point fixed in this frame, `arm` away from its origin
    /// (inertial axes).
    fn point(&self, arm: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let swing = self.angular_rate.cross(arm);
        (
            self.velocity + swing,
            self.acceleration
                + self.angular_acceleration.cross(arm)
                + self.angular_rate.cross(&swing),
        )
    }
}

impl Motion {
    /// Room for the motions of `model`.
    pub fn new(model: &Model) -> Self {
        let still = BodyMotion {
            mass: 0.0,
            center: Vector3::zeros(),
            velocity: Vector3::zeros(),
            inertia: Matrix3::zeros(),
            spin: Vector3::zeros(),
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
        };
        Self {
            base: FrameMotion::STILL,
            frames: vec![FrameMotion::STILL; model.frame_count()],
            carried: vec![[Vector3::zeros(); 2]; model.frame_count()],
            bodies: vec![still; model.bodies.len()],
            total_mass: model.total_mass,
        }
    }

    /// Moves the system as given: in the state `state`, with the base accelerating as `base` and the
    /// joints as `u` (j, rad/s² or m/s²).
    ///
    /// # Panics
    /// A slice does not have one value a joint, or `model` is not the one this was made for.
    pub fn set(&mut self, model: &Model, state: &State<'_>, base: &BaseAcceleration, u: &[f64]) {
        let joints = model.joint_count();
        let State { joint_angles, joint_rates, .. } = state;
        assert_eq!([joint_angles.len(), joint_rates.len(), u.len()], [joints; 3]);
        let counts = (self.frames.len(), self.bodies.len());
        assert_eq!(counts, (model.frame_count(), model.bodies.len()));
        let attitude = UnitQuaternion::from_quaternion(state.attitude).to_rotation_matrix();
        let rotation = attitude.into_inner();
        self.base = FrameMotion {
            rotation,
            origin: state.position,
            angular_rate: rotation * state.angular_rate,
            velocity: state.velocity,
            angular_acceleration: base.angular,
            acceleration: base.linear,
        };
        let arm = rotation * model.first.origin;
        let (velocity, acceleration) = self.base.point(&arm);
        self.frames[0] = FrameMotion {
            rotation: rotation * model.first.rotation,
            origin: self.base.origin + arm,
            velocity,
            acceleration,
            ..self.base
        };
        for step in &model.steps {
            let before = self.frames[step.parent];
            let [angle, rate, acceleration] = [*joint_angles, *joint_rates, u]
                .map(|of| step.joint.map_or(0.0, |joint| of[joint]));
            let (rotation, arm) = step.follow(&before.rotation, angle);
            let axis = step.axis(&before.rotation, &rotation);
            let relative = axis * rate;
            if step.slides() {
                let (velocity, swing) = before.point(&arm);
                self.frames[step.frame] = FrameMotion {
                    rotation,
                    origin: before.origin + arm,
                    velocity: velocity + relative,
                    acceleration: swing
                        + before.angular_rate.cross(&relative) * 2.0
                        + axis * acceleration,
                    ..before
                };
                continue;
            }
            let turned = FrameMotion {
                rotation,
                angular_rate: before.angular_rate + relative,
                angular_acceleration: before.angular_acceleration
                    + axis * acceleration
                    + before.angular_rate.cross(&relative),
                ..before
            };
            let carrier = if step.turns_with_joint() { &turned } else { &before };
            let (velocity, acceleration) = carrier.point(&arm);
            let origin = before.origin + arm;
            self.frames[step.frame] = FrameMotion { origin, velocity, acceleration, ..turned };
        }
        for (body, motion) in model.bodies.iter().zip(&mut self.bodies) {
            let frame = match body.carrier {
                Carrier::Base => &self.base,
                Carrier::Frame(frame) => &self.frames[frame],
            };
            let arm = frame.rotation * body.center;
            let (velocity, acceleration) = frame.point(&arm);
            let inertia = frame.rotation * body.inertia * frame.rotation.transpose();
            let spin = inertia * frame.angular_rate;
            *motion = BodyMotion {
                mass: body.mass,
                center: frame.origin + arm,
                velocity,
                inertia,
                spin,
                force: acceleration * body.mass,
                moment: inertia * frame.angular_acceleration + frame.angular_rate.cross(&spin),
            };
        }
    }

    /// The motion of the base's body frame.
    pub fn base(&self) -> &FrameMotion {
        &self.base
    }

    /// The motion of every frame.
    pub fn frames(&self) -> &[FrameMotion] {
        &self.frames
    }

    /// The motion of every body with mass, the base first, then outward.
    pub fn bodies(&self) -> &[BodyMotion] {
        &self.bodies
    }

    pub(super) fn bodies_mut(&mut self) -> &mut [BodyMotion] {
        &mut self.bodies
    }

    /// c, the system's center of mass, inertial, m.
    pub fn center_of_mass(&self) -> Vector3<f64> {
        self.bodies.iter().map(|body| body.center * body.mass).sum::<Vector3<f64>>()
            / self.total_mass
    }

    /// P, the linear momentum, inertial, N s.
    pub fn linear_momentum(&self) -> Vector3<f64> {
        self.bodies.iter().map(|body| body.velocity * body.mass).sum()
    }

    /// H, the angular momentum about the system's center of mass, inertial, N m s.
    pub fn angular_momentum(&self) -> Vector3<f64> {
        let center = self.center_of_mass();
        let about_center = |body: &BodyMotion| {
            (body.center - center).cross(&(body.velocity * body.mass)) + body.spin
        };
        self.bodies.iter().map(about_center).sum()
    }

    /// The axis of a step's joint: a point on it and its direction, inertial.
    pub(super) fn joint_axis(&self, step: &Step) -> (Vector3<f64>, Vector3<f64>) {
        let [before, after] = [&self.frames[step.parent], &self.frames[step.frame]];
        let point = if step.turns_with_joint() { before.origin } else { after.origin };
        (point, step.axis(&before.rotation, &after.rotation))
    }
}
