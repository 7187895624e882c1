//! Random systems and states for property tests.

use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use righting_multibody::{
    Base, BodyJoint, DhConvention, InertialFrame, JointedBody, Link, Mount, Payload, Placement,
    Quaternion, RigidBody, State, System,
};
use std::f64::consts::{FRAC_PI_2, PI};

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
}

fn rotation() -> impl Strategy<Value = Rotation3<f64>> {
    vector(PI).prop_map(Rotation3::new)
}

/// The inertia of three point pairs on rotated axes: positive definite, triangle inequality kept.
fn inertia(size: f64) -> impl Strategy<Value = Matrix3<f64>> {
    ([0.05..1.0, 0.05..1.0, 0.05..1.0], rotation()).prop_map(move |(second, rotation)| {
        let [x, y, z]: [f64; 3] = second;
        let moments = Vector3::new(y + z, x + z, x + y) * size;
        let turned = rotation.matrix() * Matrix3::from_diagonal(&moments);
        let matrix = turned * rotation.matrix().transpose();
        (matrix + matrix.transpose()) * 0.5
    })
}

/// Any angle, with right angles common as on real arms.
fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => Just(0.0),
        3 => (-2..=2_i32).prop_map(|n| f64::from(n) * FRAC_PI_2),
        2 => -PI..PI,
    ]
}

fn length() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 2 => -1.0..1.0_f64]
}

fn link() -> impl Strategy<Value = Link> {
    let mass = prop_oneof![1 => Just(0.0), 4 => 0.1..8.0_f64];
    let frame = prop::option::of(Just(InertialFrame::Own));
    let shape = prop_oneof![
        3 => Just((None, None)),
        1 => vector(0.4).prop_map(|center| (Some(center), None)),
        1 => inertia(0.5).prop_map(|matrix| (None, Some(matrix))),
        2 => (vector(0.4), inertia(0.5)).prop_map(|(center, matrix)| (Some(center), Some(matrix))),
    ];
    (mass, length(), angle(), length(), angle(), shape, frame).prop_map(
        |(mass_kg, a_m, alpha_rad, d_m, theta_rad, (center_of_mass_m, inertia_kg_m2), frame)| {
            // A frame of its own is for a link that says where it is in that.
            let is_given = center_of_mass_m.is_some() && inertia_kg_m2.is_some();
            Link {
                inertial_frame: frame.filter(|_| is_given && mass_kg > 0.0),
                center_of_mass_m,
                inertia_kg_m2: inertia_kg_m2.filter(|_| mass_kg > 0.0),
                ..Link::rod(mass_kg, a_m, alpha_rad, d_m, theta_rad)
            }
        },
    )
}

fn base() -> impl Strategy<Value = Base> {
    let cube = (0.4..1.0_f64).prop_map(|side| Base::uniform_cube(20.0, side).unwrap());
    let any = (inertia(10.0), vector(0.3)).prop_map(|(inertia_kg_m2, center_of_mass_m)| Base {
        mass_kg: 20.0,
        center_of_mass_m,
        inertia_kg_m2,
    });
    prop_oneof![cube, any]
}

fn mount() -> impl Strategy<Value = Mount> {
    let on_top = (0.0..0.5_f64).prop_map(|z| Mount::at(Vector3::new(0.0, 0.0, z)));
    let upside_down = Just(Mount {
        position_m: Vector3::new(0.0, -0.3, 0.0),
        rotation: Rotation3::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2),
    });
    let any =
        (vector(0.5), rotation()).prop_map(|(position_m, rotation)| Mount { position_m, rotation });
    prop_oneof![2 => on_top, 1 => upside_down, 2 => any]
}

fn payload() -> impl Strategy<Value = Option<Payload>> {
    let held = (0.1..10.0_f64, proptest::option::of(inertia(1.0)))
        .prop_map(|(mass_kg, inertia_kg_m2)| Payload { mass_kg, inertia_kg_m2 });
    proptest::option::of(held)
}

/// Where a joint is: anywhere, or as on real arms at right angles, along an axis or at no distance.
fn placement() -> impl Strategy<Value = Placement> {
    let rpy = [angle(), angle(), angle()];
    let rotation = rpy.prop_map(|[roll, pitch, yaw]| Placement::rotation_of_rpy(roll, pitch, yaw));
    let position = prop_oneof![
        1 => Just(Vector3::zeros()),
        2 => (length(), length()).prop_map(|(x, z)| Vector3::new(x, 0.0, z)),
        2 => vector(0.6),
    ];
    (position, rotation).prop_map(|(position_m, rotation)| Placement { position_m, rotation })
}

fn joint() -> impl Strategy<Value = BodyJoint> {
    let axis = prop_oneof![
        Just(Vector3::x()),
        Just(-Vector3::y()),
        Just(Vector3::z()),
        Just(-2.0 * Vector3::z()),
        vector(1.0).prop_filter("a direction", |axis| axis.norm() > 1e-3),
    ];
    prop_oneof![
        1 => Just(BodyJoint::Fixed),
        4 => axis.clone().prop_map(BodyJoint::Revolute),
        2 => axis.prop_map(BodyJoint::Prismatic),
    ]
}

fn rigid_body() -> impl Strategy<Value = RigidBody> {
    let massless = RigidBody {
        mass_kg: 0.0,
        center_of_mass_m: Vector3::zeros(),
        inertia_kg_m2: Matrix3::zeros(),
    };
    let any = (
        0.1..8.0_f64,
        vector(0.4),
        prop_oneof![Just(Matrix3::zeros()).boxed(), inertia(0.5).boxed()],
    );
    let any = any.prop_map(|(mass_kg, center_of_mass_m, inertia_kg_m2)| RigidBody {
        mass_kg,
        center_of_mass_m,
        inertia_kg_m2,
    });
    prop_oneof![1 => Just(massless), 4 => any]
}

/// Any tree of one to eight bodies in any order, some of them fixed; a serial one half of the time.
pub fn tree() -> impl Strategy<Value = System> {
    let body = (placement(), joint(), rigid_body(), any::<prop::sample::Index>());
    let bodies = (vec(body, 1..=8), any::<bool>());
    let shuffled = bodies.prop_flat_map(|(bodies, is_serial)| {
        let order: Vec<usize> = (0..bodies.len()).collect();
        (Just(bodies), Just(is_serial), Just(order).prop_shuffle())
    });
    (base(), shuffled).prop_filter_map("a joint", |(base, (bodies, is_serial, order))| {
        // Body i is carried by an earlier one, and then stands at `order[i]` of the list.
        let mut list: Vec<Option<JointedBody>> = vec![None; bodies.len()];
        for (i, (placement, joint, body, at)) in bodies.into_iter().enumerate() {
            let before = if is_serial { i } else { at.index(i + 1) };
            let parent = before.checked_sub(1).map(|parent| order[parent]);
            list[order[i]] = Some(JointedBody { parent, placement, joint, body });
        }
        let list: Vec<JointedBody> = list.into_iter().flatten().collect();
        let has_joint = list.iter().any(JointedBody::is_movable);
        has_joint.then(|| System::of_bodies(base, list).unwrap())
    })
}

/// Any system of one to six joints, or a tree.
pub fn system() -> impl Strategy<Value = System> {
    prop_oneof![rows(), tree()]
}

/// Any system of one to six joints in rows.
fn rows() -> impl Strategy<Value = System> {
    let convention = prop_oneof![Just(DhConvention::Standard), Just(DhConvention::Modified)];
    (base(), mount(), convention, vec(link(), 1..=6), payload()).prop_map(
        |(base, mount, convention, links, payload)| {
            System::new(base, mount, convention, links, payload).unwrap()
        },
    )
}

/// A system in motion: state and joint accelerations.
pub fn motion() -> impl Strategy<Value = (System, State<f64>, Vec<f64>)> {
    system().prop_flat_map(|system| {
        let j = system.joint_count();
        let joints = (vec(-PI..PI, j), vec(-2.0..2.0_f64, j), vec(-2.0..2.0_f64, j));
        (Just(system), vector(2.0), attitude(), vector(1.0), vector(1.0), joints).prop_map(
            |(system, position, attitude, velocity, angular_rate, (angles, rates, u))| {
                let state = State {
                    position,
                    attitude,
                    velocity,
                    angular_rate,
                    joint_angles: angles,
                    joint_rates: rates,
                };
                (system, state, u)
            },
        )
    })
}

pub fn attitude() -> impl Strategy<Value = Quaternion<f64>> {
    (vector(1.0), -PI..PI).prop_filter_map("an axis", |(axis, angle)| {
        let axis = axis.try_normalize(1e-3)?;
        Some(Quaternion::from_axis_angle(&axis, angle))
    })
}
