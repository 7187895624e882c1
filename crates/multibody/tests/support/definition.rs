//! The equations as the paper writes them, on homogeneous transforms and sums over bodies.
//!
//! Slow and plain: shares with the crate only the parameters of the system.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;
use righting_multibody::{
    BodyJoint, DhConvention, InertialFrame, JointedBody, Link, Placement, Rows, System,
};
use righting_scalar::Scalar;

/// A rigid body seen from the body frame.
pub struct Body<T> {
    pub mass: f64,
    pub center: Vector3<T>,
    pub rotation: Matrix3<T>,
    /// About the centre of mass, own axes.
    pub inertia: Matrix3<f64>,
}

#[derive(Clone)]
struct Pose<T> {
    rotation: Matrix3<T>,
    position: Vector3<T>,
}

impl<T: Scalar> Pose<T> {
    fn then(&self, rotation: Matrix3<T>, position: Vector3<T>) -> Self {
        Self {
            rotation: self.rotation * rotation,
            position: self.position + self.rotation * position,
        }
    }

    fn about_z(&self, angle: T) -> Self {
        let (s, c) = angle.sin_cos();
        let (o, l) = (T::from(0.0), T::from(1.0));
        self.then(Matrix3::new(c, -s, o, s, c, o, o, o, l), Vector3::zeros())
    }

    fn about_x(&self, angle: f64) -> Self {
        let (s, c) = (T::from(angle.sin()), T::from(angle.cos()));
        let (o, l) = (T::from(0.0), T::from(1.0));
        self.then(Matrix3::new(l, o, o, o, c, -s, o, s, c), Vector3::zeros())
    }

    /// Rodrigues' formula: 1 + sin a [e]× + (1 − cos a) [e]×².
    fn about(&self, axis: &Vector3<f64>, angle: T) -> Self {
        let across = skew(&axis.normalize()).map(T::from);
        let (sin, cos) = angle.sin_cos();
        let rotation = Matrix3::identity() + across * sin + across * across * (T::from(1.0) - cos);
        self.then(rotation, Vector3::zeros())
    }

    fn moved(&self, x: f64, z: f64) -> Self {
        let position = Vector3::new(T::from(x), T::from(0.0), T::from(z));
        self.then(Matrix3::identity(), position)
    }

    fn point(&self, local: &Vector3<T>) -> Vector3<T> {
        self.position + self.rotation * local
    }

    fn seen(&self, point: &Vector3<T>) -> Vector3<T> {
        self.rotation.transpose() * (point - self.position)
    }
}

fn step<T: Scalar>(frame: &Pose<T>, link: &Link, angle: T, convention: DhConvention) -> Pose<T> {
    let angle = angle + link.theta_rad;
    match convention {
        DhConvention::Standard => {
            frame.about_z(angle).moved(link.a_m, link.d_m).about_x(link.alpha_rad)
        }
        DhConvention::Modified => {
            frame.about_x(link.alpha_rad).moved(link.a_m, 0.0).about_z(angle).moved(0.0, link.d_m)
        }
    }
}

fn rod(mass: f64, s: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * s.norm_squared() - s * s.transpose()) * (mass / 12.0)
}

/// Rotations and origins of the Denavit-Hartenberg frames 0…j, or of the body frame and all bodies'.
pub fn frames<T: Scalar>(system: &System, q: &[T]) -> Vec<(Matrix3<T>, Vector3<T>)> {
    poses(system, q).into_iter().map(|pose| (pose.rotation, pose.position)).collect()
}

fn poses<T: Scalar>(system: &System, q: &[T]) -> Vec<Pose<T>> {
    match (system.rows(), system.bodies()) {
        (Some(rows), _) => poses_of_rows(rows, q),
        (None, bodies) => poses_of_bodies(bodies.unwrap(), q),
    }
}

fn poses_of_rows<T: Scalar>(rows: &Rows, q: &[T]) -> Vec<Pose<T>> {
    let mut poses = vec![Pose {
        rotation: rows.mount.rotation.matrix().map(T::from),
        position: rows.mount.position_m.map(T::from),
    }];
    for (link, angle) in rows.links.iter().zip(q) {
        let next = step(&poses[poses.len() - 1], link, *angle, rows.convention);
        poses.push(next);
    }
    poses
}

fn poses_of_bodies<T: Scalar>(bodies: &[JointedBody], q: &[T]) -> Vec<Pose<T>> {
    let base = Pose { rotation: Matrix3::identity(), position: Vector3::zeros() };
    let mut angles = q.iter();
    let angles: Vec<Option<&T>> =
        bodies.iter().map(|body| body.is_movable().then(|| angles.next().unwrap())).collect();
    let mut poses: Vec<Option<Pose<T>>> = vec![None; bodies.len()];
    // As often as it takes: a body may stand before the one that carries it.
    while poses.iter().any(Option::is_none) {
        for (index, body) in bodies.iter().enumerate() {
            let parent = match body.parent {
                Some(parent) => poses[parent].clone(),
                None => Some(base.clone()),
            };
            let Some(parent) = parent else { continue };
            let Placement { position_m, rotation } = &body.placement;
            let joint = parent.then(rotation.map(T::from), position_m.map(T::from));
            poses[index] = Some(match (&body.joint, angles[index]) {
                (BodyJoint::Revolute(axis), Some(angle)) => joint.about(axis, *angle),
                (BodyJoint::Prismatic(axis), Some(travel)) => {
                    let along = axis.normalize().map(|entry| *travel * entry);
                    joint.then(Matrix3::identity(), along)
                }
                _ => joint,
            });
        }
    }
    std::iter::once(base).chain(poses.into_iter().flatten()).collect()
}

/// Base, links and payload, or base and bodies.
pub fn bodies<T: Scalar>(system: &System, q: &[T]) -> Vec<Body<T>> {
    let poses = poses(system, q);
    let base = Body {
        mass: system.base().mass_kg,
        center: system.base().center_of_mass_m.map(T::from),
        rotation: Matrix3::identity(),
        inertia: system.base().inertia_kg_m2,
    };
    let others = match (system.rows(), system.bodies()) {
        (Some(rows), _) => links(rows, &poses),
        (None, bodies) => {
            let bodies = bodies.unwrap().iter().zip(&poses[1..]);
            let placed = bodies.map(|(body, pose)| Body {
                mass: body.body.mass_kg,
                center: pose.point(&body.body.center_of_mass_m.map(T::from)),
                rotation: pose.rotation,
                inertia: body.body.inertia_kg_m2,
            });
            placed.collect()
        }
    };
    std::iter::once(base).chain(others).collect()
}

fn links<T: Scalar>(rows: &Rows, poses: &[Pose<T>]) -> Vec<Body<T>> {
    let mut bodies = Vec::new();
    for (i, link) in rows.links.iter().enumerate() {
        let own = match (rows.convention, link.inertial_frame) {
            (_, Some(InertialFrame::Own)) | (DhConvention::Standard, None) => &poses[i + 1],
            (_, Some(InertialFrame::Previous)) | (DhConvention::Modified, None) => &poses[i],
        };
        let (inboard, outboard) = (poses[i].position, poses[i + 1].position);
        let segment = own.seen(&outboard) - own.seen(&inboard);
        let center = match &link.center_of_mass_m {
            Some(center) => own.point(&center.map(T::from)),
            None => (inboard + outboard) * T::from(0.5),
        };
        // The segment is fixed in the link's own frame, whatever the scalar's other parts are.
        let inertia = link.inertia_kg_m2.unwrap_or_else(|| rod(link.mass_kg, &segment.map(real)));
        bodies.push(Body { mass: link.mass_kg, center, rotation: own.rotation, inertia });
    }
    if let Some(payload) = &rows.payload {
        let last = &poses[poses.len() - 1];
        bodies.push(Body {
            mass: payload.mass_kg,
            center: last.position,
            rotation: last.rotation,
            inertia: payload.inertia_kg_m2.unwrap_or_else(Matrix3::zeros),
        });
    }
    bodies
}

fn real<T: Scalar>(x: T) -> f64 {
    x.re()
}

/// r_CM from the body-frame origin.
pub fn center<T: Scalar>(system: &System, q: &[T]) -> Vector3<T> {
    let bodies = bodies(system, q);
    let total = bodies.iter().map(|body| body.mass).sum::<f64>();
    bodies.iter().fold(Vector3::zeros(), |sum, body| sum + body.center * T::from(body.mass / total))
}

/// Ĩ = Σ I_i − Σ m_i [r_i − r_CM]× [r_i]×.
pub fn locked_inertia<T: Scalar>(system: &System, q: &[T]) -> Matrix3<T> {
    let center = center(system, q);
    bodies(system, q).iter().fold(Matrix3::zeros(), |sum, body| {
        let own = body.rotation * body.inertia.map(T::from) * body.rotation.transpose();
        let shifted = skew(&(body.center - center)) * skew(&body.center) * T::from(body.mass);
        sum + own - shifted
    })
}

/// H̃ = Σ I_i ω_{i/B} + Σ m_i (r_i − r_CM) × r'_i.
pub fn h_tilde<T: Scalar>(system: &System, q: &[T], qdot: &[T]) -> Vector3<T> {
    let moving: Vec<Dual<T>> = q.iter().zip(qdot).map(|(q, v)| Dual::new(*q, *v)).collect();
    let center = center(system, q);
    bodies(system, &moving).iter().fold(Vector3::zeros(), |sum, body| {
        let rotation = body.rotation.map(|entry| entry.re);
        let spin = body.rotation.map(|entry| entry.eps) * rotation.transpose();
        let omega = Vector3::new(spin.m32, spin.m13, spin.m21);
        let own = rotation * body.inertia.map(T::from) * rotation.transpose() * omega;
        let (r, r_dot) = (body.center.map(|x| x.re), body.center.map(|x| x.eps));
        sum + own + skew(&(r - center)) * r_dot * T::from(body.mass)
    })
}

/// ω̇ from dH/dt + ω × H = 0, and r̈₀ in body axes from the unaccelerated centre of mass.
pub fn base_acceleration(
    system: &System,
    omega: &Vector3<f64>,
    q: &[f64],
    qdot: &[f64],
    qddot: &[f64],
) -> (Vector3<f64>, Vector3<f64>) {
    let along = |x: &[f64], v: &[f64]| -> Vec<Dual<f64>> {
        x.iter().zip(v).map(|(x, v)| Dual::new(*x, *v)).collect()
    };
    let (moving, accelerating) = (along(q, qdot), along(qdot, qddot));
    let inertia = locked_inertia(system, &moving);
    let relative = h_tilde(system, &moving, &accelerating);
    let held = inertia.map(|x| x.re);
    let momentum = held * omega + relative.map(|x| x.re);
    let change = inertia.map(|x| x.eps) * omega + relative.map(|x| x.eps);
    let angular = held.try_inverse().unwrap() * -(change + omega.cross(&momentum));

    let twice: Vec<Dual<Dual<f64>>> =
        moving.iter().zip(&accelerating).map(|(q, v)| Dual::new(*q, *v)).collect();
    let center = center(system, &twice);
    let (c, c1, c2) =
        (center.map(|x| x.re.re), center.map(|x| x.eps.re), center.map(|x| x.eps.eps));
    let linear = -(angular.cross(&c) + omega.cross(&omega.cross(&c)) + omega.cross(&c1) * 2.0 + c2);
    (angular, linear)
}

/// Kinetic energy of base velocity `v` (body axes) and rate ω.
pub fn kinetic_energy(
    system: &System,
    v: &Vector3<f64>,
    omega: &Vector3<f64>,
    q: &[f64],
    qdot: &[f64],
) -> f64 {
    let moving: Vec<Dual<f64>> = q.iter().zip(qdot).map(|(q, v)| Dual::new(*q, *v)).collect();
    bodies(system, &moving)
        .iter()
        .map(|body| {
            let rotation = body.rotation.map(|entry| entry.re);
            let spin = body.rotation.map(|entry| entry.eps) * rotation.transpose();
            let rate = omega + Vector3::new(spin.m32, spin.m13, spin.m21);
            let (r, r_dot) = (body.center.map(|x| x.re), body.center.map(|x| x.eps));
            let velocity = v + omega.cross(&r) + r_dot;
            let own = rotation * body.inertia * rotation.transpose();
            0.5 * body.mass * velocity.norm_squared() + 0.5 * rate.dot(&(own * rate))
        })
        .sum()
}

fn skew<T: Scalar>(v: &Vector3<T>) -> Matrix3<T> {
    let o = T::from(0.0);
    Matrix3::new(o, -v.z, v.y, v.z, o, -v.x, -v.y, v.x, o)
}
