//! Maneuvers that follow from others: the same motion backwards, or seen in a mirror.

use nalgebra::{Matrix3, Vector3};
use righting_multibody::{Quaternion, System};
use righting_results::trajectory::{ControlInterval, Node, Trajectory};
use righting_scenario::halton::Halton;
use righting_scenario::system_description::SystemDescription;

/// How far inertia and momentum may differ from their mirror images, relative to the inertia, and the
/// center of mass from its own, m.
const TOLERANCE: f64 = 1e-9;
/// Combinations of joint signs looked at where a posture leaves them open.
const MOST_CANDIDATES: usize = 64;
/// Postures at which the two are compared.
const POSTURES: usize = 8;

/// A plane through the base's origin, normal to a body axis, in which the system is its own image
/// once some joints turn the other way.
///
/// With M the reflection and S the joints' signs,
///
/// ```text
/// Ĩ(Sq) = M Ĩ(q) M,      H̃(Sq, Sq̇) = −M H̃(q, q̇),      r_CM(Sq) = M r_CM(q)
/// ```
///
/// (angular momentum is an axial vector, a position a polar one), so that the mirror image of a
/// motion is one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mirror {
    normal: usize,
    signs: Vec<f64>,
}

impl Mirror {
    /// The mirrors of a system; none for most.
    pub(crate) fn all(system: &SystemDescription) -> Vec<Self> {
        (0..3).filter_map(|normal| Self::normal_to(normal, system)).collect()
    }

    fn normal_to(normal: usize, system: &SystemDescription) -> Option<Self> {
        let joints = system.joint_count();
        let posture = vec![0.0; joints];
        let mut candidates = vec![Vec::with_capacity(joints)];
        for joint in 0..joints {
            let moved = of_joint(&system.model, &posture, joint);
            let image = -reflected(normal, &moved);
            // A joint that moves no momentum in this posture may turn either way.
            let same = (image - moved).norm() <= TOLERANCE;
            let opposite = (image + moved).norm() <= TOLERANCE;
            let signs: &[f64] = match (same, opposite) {
                (true, true) if candidates.len() < MOST_CANDIDATES => &[1.0, -1.0],
                (true, _) => &[1.0],
                (false, true) => &[-1.0],
                (false, false) => return None,
            };
            candidates = signs
                .iter()
                .flat_map(|&sign| {
                    candidates.iter().map(move |signs| [&signs[..], &[sign]].concat())
                })
                .collect();
        }
        let mirrors = candidates.into_iter().map(|signs| Self { normal, signs });
        mirrors.into_iter().find(|mirror| mirror.holds(system))
    }

    fn holds(&self, system: &SystemDescription) -> bool {
        let joints = system.joint_count();
        let limits = system.joint_limits.iter().zip(&self.signs);
        let symmetric = limits
            .clone()
            .all(|(limits, &sign)| sign > 0.0 || limits.angle_min_rad == -limits.angle_max_rad);
        let model = &system.model;
        let reflection = self.reflection();
        symmetric
            && Halton::new(joints).take(POSTURES).all(|unit| {
                let posture = system.joint_angles_at(&unit);
                let image = self.joints(&posture);
                let inertia = model.locked_inertia(&posture);
                let expected = reflection * inertia * reflection;
                let center = reflected(self.normal, &model.center_of_mass(&posture));
                (model.center_of_mass(&image) - center).norm() <= TOLERANCE
                    && (model.locked_inertia(&image) - expected).norm()
                        <= TOLERANCE * inertia.norm()
                    && (0..joints).all(|joint| {
                        let expected = -reflected(self.normal, &of_joint(model, &posture, joint));
                        let found = of_joint(model, &image, joint) * self.signs[joint];
                        (found - expected).norm() <= TOLERANCE * inertia.norm()
                    })
            })
    }

    /// The mirror image of a motion, the mirror held to the base's first attitude.
    pub(crate) fn image(&self, motion: &Trajectory) -> Trajectory {
        let start = Quaternion::from_array(motion.start().attitude);
        let polar = |v: &[f64; 3]| {
            start.to_inertial(&reflected(self.normal, &start.to_body(&Vector3::from(*v)))).into()
        };
        let nodes = motion.nodes().iter().map(|node| {
            let turned = start.conjugate().product(&Quaternion::from_array(node.attitude));
            let axial = -reflected(self.normal, &turned.vector);
            let image = Quaternion::new(turned.w, axial.x, axial.y, axial.z);
            Node {
                position_m: polar(&node.position_m),
                attitude: start.product(&image).to_array(),
                velocity_m_s: polar(&node.velocity_m_s),
                angular_rate_rad_s: (-reflected(
                    self.normal,
                    &Vector3::from(node.angular_rate_rad_s),
                ))
                .into(),
                joint_angles_rad: self.joints(&node.joint_angles_rad),
                joint_rates_rad_s: self.joints(&node.joint_rates_rad_s),
                ..node.clone()
            }
        });
        let intervals = motion.intervals().iter().map(|interval| ControlInterval {
            joint_accelerations_rad_s2: self.joints(&interval.joint_accelerations_rad_s2),
            joint_jerks_rad_s3: self.joints(&interval.joint_jerks_rad_s3),
            joint_torques_n_m: self.joints(&interval.joint_torques_n_m),
            ..interval.clone()
        });
        joined(nodes.collect(), intervals.collect())
    }

    fn joints(&self, values: &[f64]) -> Vec<f64> {
        values.iter().zip(&self.signs).map(|(value, sign)| value * sign).collect()
    }

    fn reflection(&self) -> Matrix3<f64> {
        Matrix3::from_diagonal(&reflected(self.normal, &Vector3::repeat(1.0)))
    }
}

/// A motion run backwards, from the attitude at which it started. Without momentum it is a motion
/// of the same arm, from the posture in which the first one ended.
pub(crate) fn reversed(motion: &Trajectory) -> Trajectory {
    let [start, end] =
        [motion.start(), motion.end()].map(|node| Quaternion::from_array(node.attitude));
    let placed = |v: Vector3<f64>| start.to_inertial(&end.to_body(&v));
    let end_position = Vector3::from(motion.end().position_m);
    let nodes = motion.nodes().iter().rev().map(|node| Node {
        time_s: motion.end().time_s - node.time_s,
        position_m: placed(Vector3::from(node.position_m) - end_position).into(),
        attitude: start
            .product(&end.conjugate().product(&Quaternion::from_array(node.attitude)))
            .to_array(),
        velocity_m_s: (-placed(Vector3::from(node.velocity_m_s))).into(),
        angular_rate_rad_s: node.angular_rate_rad_s.map(|rate| -rate),
        joint_angles_rad: node.joint_angles_rad.clone(),
        joint_rates_rad_s: node.joint_rates_rad_s.iter().map(|rate| -rate).collect(),
        power_w: -node.power_w,
        ..node.clone()
    });
    let lengths = motion.nodes().windows(2).map(|pair| pair[1].time_s - pair[0].time_s);
    let intervals = motion.intervals().iter().zip(lengths).rev().map(|(interval, length_s)| {
        let jerks = interval.joint_jerks_rad_s3.iter();
        ControlInterval {
            joint_accelerations_rad_s2: interval.joint_accelerations_after(length_s),
            joint_jerks_rad_s3: jerks.map(|jerk| -jerk).collect(),
            ..interval.clone()
        }
    });
    joined(nodes.collect(), intervals.collect())
}

fn joined(nodes: Vec<Node>, intervals: Vec<ControlInterval>) -> Trajectory {
    Trajectory::new(nodes, intervals).expect("as many of each as there were")
}

fn reflected(normal: usize, v: &Vector3<f64>) -> Vector3<f64> {
    let mut image = *v;
    image[normal] = -image[normal];
    image
}

/// H̃(q, e): the momentum of one joint's unit rate.
fn of_joint(model: &System, posture: &[f64], joint: usize) -> Vector3<f64> {
    let mut rates = vec![0.0; posture.len()];
    rates[joint] = 1.0;
    model.h_tilde(posture, &rates)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use righting_ocp::Control;

    use super::*;
    use crate::planner::Planner;
    use righting_scenario::scenario::Scenario;
    use righting_verifier::verify;

    fn system(name: &str) -> SystemDescription {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/systems");
        SystemDescription::read(&folder.join(format!("{name}.json"))).unwrap()
    }

    #[test]
    fn an_arm_that_bends_in_one_plane_has_two_mirrors() {
        // The base is a cube: both the plane of the arm and the one across it will do.
        for (name, across) in [("single_link_2dof", [1.0, -1.0]), ("xlink_4dof", [1.0, -1.0])] {
            let mirrors = Mirror::all(&system(name));
            assert_eq!(mirrors.len(), 2, "{name}: {mirrors:?}");
            // The first joint turns about z, the others bend the arm.
            let bends: Vec<f64> = mirrors.iter().map(|mirror| mirror.signs[1]).collect();
            assert!(mirrors.iter().all(|mirror| mirror.signs[0] == -1.0), "{name}: {mirrors:?}");
            assert!(across.iter().all(|sign| bends.contains(sign)), "{name}: {mirrors:?}");
        }
        assert!(Mirror::all(&system("canadarm2")).is_empty());
    }

    #[test]
    fn the_image_of_a_plan_is_a_plan_of_the_image() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/slew_2dof.json");
        let shipped = Scenario::read(&file).unwrap();
        let varied = |axis: [f64; 3]| {
            let mut changed = shipped.resolved().clone();
            changed.horizon.steps = 120.0;
            changed.maneuver.axis = Some(axis);
            Scenario::from_file(changed, &file).unwrap()
        };
        let plan =
            Planner::new().plan(&varied([0.6, 0.2, 0.5]), &mut |_| Control::Continue).unwrap();
        for mirror in Mirror::all(shipped.system()) {
            let axis = -reflected(mirror.normal, &Vector3::new(0.6, 0.2, 0.5));
            let verification = verify(&varied(axis.into()), &mirror.image(&plan.trajectory));
            assert!(verification.passed, "{mirror:?}: {verification:?}");
        }
    }

    #[test]
    fn backwards_twice_is_forwards() {
        let node = |time_s: f64, angle: f64| Node {
            time_s,
            position_m: [0.1 * time_s, 0.0, angle],
            attitude: Quaternion::from_axis_angle(&Vector3::new(0.6, 0.0, 0.8), angle).to_array(),
            velocity_m_s: [0.1, 0.0, 0.2],
            angular_rate_rad_s: [0.3, 0.1, 0.2],
            joint_angles_rad: vec![angle],
            joint_rates_rad_s: vec![0.5],
            power_w: 1.0,
            wheel_momenta_n_m_s: Vec::new(),
        };
        let interval = |u: f64| ControlInterval {
            joint_accelerations_rad_s2: vec![u],
            joint_jerks_rad_s3: vec![0.2],
            joint_torques_n_m: vec![2.0 * u],
            wheel_torques_n_m: Vec::new(),
        };
        let nodes = vec![node(0.0, 0.0), node(1.0, 0.3), node(2.0, 0.4)];
        let motion = joined(nodes, vec![interval(0.1), interval(0.2)]);
        let backwards = reversed(&motion);
        let turned = Quaternion::from_array(backwards.end().attitude);
        let (_, angle_rad) = turned.to_axis_angle();
        assert!((angle_rad - 0.4).abs() < 1e-12);
        assert_eq!(backwards.end().joint_rates_rad_s, [-0.5]);
        // The last interval's acceleration grows from 0.2 to 0.4.
        assert!((backwards.intervals()[0].joint_accelerations_rad_s2[0] - 0.4).abs() < 1e-15);
        let again = reversed(&backwards);
        for (interval, other) in motion.intervals().iter().zip(again.intervals()) {
            let [u, there] =
                [interval, other].map(|interval| interval.joint_accelerations_rad_s2[0]);
            assert!((u - there).abs() < 1e-15);
            assert_eq!(interval.joint_jerks_rad_s3, other.joint_jerks_rad_s3);
        }
        for (node, other) in motion.nodes().iter().zip(again.nodes()) {
            assert!((node.state().attitude.angle_to(&other.state().attitude)).abs() < 1e-7);
            assert!(
                (Vector3::from(node.position_m) - Vector3::from(other.position_m)).norm() < 1e-12
            );
            assert_eq!(node.joint_rates_rad_s, other.joint_rates_rad_s);
        }
    }
}
