//! The verifier's own model of base and arm: Newton's and Euler's laws, body by body, in inertial
//! axes, on plain numbers.
//!
//! It is built from the system as it stands in a file and shares nothing with the planner's model,
//! so that a wrong term of one shows against the other. The planner eliminates masses (barycentric
//! moments), works in link axes from the tip inward and drops what is zero; here every body is
//! followed by itself and every law stands as it is taught. With x, v, a the position, velocity and
//! acceleration of a body's center of mass, Ω and α its angular rate and acceleration, J = C I Cᵀ its
//! inertia, and c the system's center of mass,
//!
//! ```text
//! P = Σ m v                               linear momentum
//! H = Σ [ (x − c) × m v + J Ω ]           angular momentum about c
//! 0 = Σ m a                               no force from outside
//! 0 = Σ [ (x − c) × m a + J α + Ω × J Ω ] no moment from outside, or the one that acts
//! τ = e · Σ [ (x − p) × m a + J α + Ω × J Ω ]   over the bodies beyond a joint with axis e through p
//! f = e · Σ m a                                  over the bodies beyond a joint that slides along e
//! ```
//!
//! Accelerations are linear in those of the base, r̈ and Ω̇: the bodies are moved once with the base
//! unaccelerated, which gives the force F⁰ and the moment N⁰ about c that would be missing, and then
//!
//! ```text
//! (Σ [ J + m (d² 1 − d dᵀ) ]) Ω̇ = −N⁰        d = x − c
//! r̈ = −F⁰/M − Ω̇ × (c − r)
//! ```
//!
//! Attitudes are nalgebra's quaternions.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_scenario::Scenario;
//! use righting_verifier::model::{BaseAcceleration, Model, Motion, Outside, State};
//!
//! // A base that turns at 20 deg/s keeps its momentum when the arm moves.
//! let scenario = Scenario::read(Path::new("../../scenarios/detumble_4dof.json"))?;
//! let model = Model::new(scenario.resolved_system());
//! let mut motion = Motion::new(&model);
//! let mut x = scenario.initial().state().to_vec();
//! let u = [0.1, -0.2, 0.1, 0.3];
//! let mut momentum = |x: &[f64]| {
//!     motion.set(&model, &State::from_slice(x), &BaseAcceleration::default(), &u);
//!     motion.angular_momentum()
//! };
//! let before = momentum(&x);
//! let (mut rate, mut room) = (vec![0.0; x.len()], Motion::new(&model));
//! for _ in 0..1000 {
//!     model.state_derivative(&x, &u, &Outside::default(), &mut room, &mut rate);
//!     x.iter_mut().zip(&rate).for_each(|(x, rate)| *x += 1e-4 * rate);
//! }
//! assert!((momentum(&x) - before).norm() < 1e-4 * before.norm());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod body;
mod cuboid;
mod dynamics;
mod motion;
mod outside;
mod pose;
mod row;
mod segment;
mod state;
mod step;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_scenario::file;

use body::Body;
use row::{Convention, Row};
use step::Step;

use crate::lineage::Lineage;

pub use cuboid::Cuboid;
pub use dynamics::{BaseAcceleration, MountLoad};
pub use motion::{BodyMotion, FrameMotion, Motion};
pub use outside::{Outside, Surroundings};
pub use pose::Pose;
pub use segment::Segment;
pub use state::State;

/// A free-floating base with its arms.
///
/// Frame 0 moves with the base. Of an arm in rows it is the mount; frame i follows from frame i−1 by row i of
/// the Denavit–Hartenberg table and moves with joint i. Of bodies it is the body frame; frame i is that of
/// body i and follows from the frame of the body that carries it.
#[derive(Clone, Debug)]
pub struct Model {
    /// Frame 0 in body axes, from the origin of the body frame, m.
    first: Pose,
    /// To every other frame, after the one to the frame that carries it.
    steps: Vec<Step>,
    joint_count: usize,
    /// Every body with mass, the base first.
    bodies: Vec<Body>,
    total_mass: f64,
}

impl Model {
    /// The model of a system that was checked when its scenario was read.
    pub fn new(system: &file::System) -> Self {
        let mut bodies = vec![Body::base(&system.base)];
        let (first, steps) = match &system.bodies {
            Some(listed) => {
                bodies.extend(listed.iter().enumerate().map(|(k, body)| Body::listed(body, k + 1)));
                (Pose::identity(), steps_of_bodies(system, listed))
            }
            None => {
                let convention = match system.dh_convention.unwrap_or_default() {
                    file::DhConvention::Standard => Convention::Distal,
                    file::DhConvention::Modified => Convention::Proximal,
                };
                let rows: Vec<Row> = system.links.iter().map(Row::new).collect();
                for (index, (link, row)) in system.links.iter().zip(&rows).enumerate() {
                    bodies.push(Body::link(link, row, convention, index));
                }
                if let Some(payload) = &system.payload {
                    bodies.push(Body::payload(payload, rows.len()));
                }
                let steps = rows.into_iter().enumerate();
                let steps = steps.map(|(index, row)| Step::of_row(row, convention, index));
                (system.mount.as_ref().map_or_else(Pose::identity, mount), steps.collect())
            }
        };
        bodies.retain(|body| body.mass > 0.0);
        Self {
            first,
            joint_count: steps.iter().filter(|step| step.joint.is_some()).count(),
            steps,
            total_mass: bodies.iter().map(|body| body.mass).sum(),
            bodies,
        }
    }

    /// Number of joints j.
    pub fn joint_count(&self) -> usize {
        self.joint_count
    }

    /// Number of frames.
    pub fn frame_count(&self) -> usize {
        self.steps.len() + 1
    }

    /// Mass of the whole system, kg.
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// Writes where all frames are at joint coordinates `q` (j, rad or m), in body axes from the origin of the body
    /// frame (m), into `frames`. Link i is the straight segment from origin i−1 to origin i.
    ///
    /// # Panics
    /// A slice has another length.
    pub fn frames(&self, q: &[f64], frames: &mut [Pose]) {
        assert_eq!((q.len(), frames.len()), (self.joint_count(), self.frame_count()));
        frames[0] = self.first;
        for step in &self.steps {
            let before = frames[step.parent];
            let angle = step.joint.map_or(0.0, |joint| q[joint]);
            let (rotation, arm) = step.follow(&before.rotation, angle);
            frames[step.frame] = Pose { rotation, origin: before.origin + arm };
        }
    }
}

fn mount(mount: &file::Mount) -> Pose {
    let [w, x, y, z] = mount.rotation.unwrap_or([1.0, 0.0, 0.0, 0.0]);
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    Pose {
        rotation: rotation.to_rotation_matrix().into_inner(),
        origin: Vector3::from(mount.position_m),
    }
}

fn steps_of_bodies(system: &file::System, bodies: &[file::Body]) -> Vec<Step> {
    let lineage = Lineage::new(system);
    let step = |body: usize| {
        let parent = lineage.parent(body).map_or(0, |parent| parent + 1);
        Step::of_body(&bodies[body].joint, body + 1, parent, lineage.joint(body))
    };
    lineage.outward().into_iter().map(step).collect()
}
