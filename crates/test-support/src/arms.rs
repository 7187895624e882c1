//! Random arms as scenario files say them.

use std::ops::RangeInclusive;
use std::path::Path;

use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use righting_scenario::{Scenario, file};

/// A unit quaternion w, x, y, z.
pub fn rotation() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(-1.0..1.0_f64).prop_filter_map("a direction", |wxyz| {
        let norm = wxyz.iter().map(|part| part * part).sum::<f64>().sqrt();
        (norm > 0.1).then(|| wxyz.map(|part| part / norm))
    })
}

/// The inertia of a body with these second moments about axes turned by a rotation vector.
pub(crate) fn inertia(size: f64) -> impl Strategy<Value = [[f64; 3]; 3]> {
    let axes = prop::array::uniform3(-3.0..3.0_f64);
    (prop::array::uniform3(0.05..1.0_f64), axes).prop_map(move |([x, y, z], axes)| {
        let turn = Rotation3::new(Vector3::from(axes));
        let moments = Matrix3::from_diagonal(&(Vector3::new(y + z, x + z, x + y) * size));
        let matrix = turn.matrix() * moments * turn.matrix().transpose();
        let symmetric = (matrix + matrix.transpose()) / 2.0;
        [0, 1, 2].map(|row| [0, 1, 2].map(|column| symmetric[(row, column)]))
    })
}

/// Any angle in degrees, right angles as often as on real arms.
pub(crate) fn angle_deg() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => Just(0.0),
        3 => (-2..=2_i32).prop_map(|quarters| 90.0 * f64::from(quarters)),
        2 => -180.0..180.0_f64,
    ]
}

/// None, almost none, little, or some.
pub(crate) fn length_m() -> impl Strategy<Value = f64> {
    prop_oneof![4 => Just(0.0), 1 => -1e-12..1e-12_f64, 1 => -0.02..0.02_f64, 8 => -1.0..1.0_f64]
}

fn link() -> impl Strategy<Value = file::Link> {
    let mass_kg = prop_oneof![1 => Just(0.0), 4 => 0.1..8.0_f64];
    let center = prop::option::of(prop::array::uniform3(-0.4..0.4_f64));
    let own = prop::option::of(inertia(0.5));
    let frame = prop::option::of(Just(file::InertialFrame::Own));
    (mass_kg, length_m(), angle_deg(), length_m(), angle_deg(), center, own, frame).prop_map(
        |(mass_kg, a_m, alpha_deg, d_m, theta_deg, center_of_mass_m, inertia_kg_m2, frame)| {
            file::Link {
                name: None,
                mass_kg,
                a_m,
                alpha_deg,
                d_m,
                theta_deg,
                angle_min_deg: None,
                angle_max_deg: None,
                rate_max_deg_s: 1000.0,
                acceleration_max_deg_s2: 1000.0,
                jerk_max_deg_s3: None,
                torque_max_n_m: None,
                drive: None,
                body_exempt: false,
                // In its own frame a mass needs both.
                inertial_frame: frame
                    .filter(|_| center_of_mass_m.is_some() && inertia_kg_m2.is_some()),
                center_of_mass_m,
                inertia_kg_m2: inertia_kg_m2.filter(|_| mass_kg > 0.0),
                radius_m: None,
                shapes: None,
            }
        },
    )
}

pub(crate) fn base() -> impl Strategy<Value = file::Base> {
    let cube = (0.4..1.0_f64).prop_map(|side_m| (Some(side_m), None));
    let any = (inertia(10.0), prop::option::of(prop::array::uniform3(-0.3..0.3_f64)));
    let any = any.prop_map(|(inertia, center_m)| (None, Some(inertia), center_m));
    let cube = cube.prop_map(|(cube_side_m, inertia)| (cube_side_m, inertia, None));
    prop_oneof![cube, any].prop_map(|(cube_side_m, inertia_kg_m2, center_of_mass_m)| file::Base {
        name: None,
        mass_kg: 20.0,
        cube_side_m,
        inertia_kg_m2,
        center_of_mass_m,
        keep_out_radius_m: Some(0.0),
        angular_rate_max_deg_s: None,
        keep_out: None,
    })
}

fn payload() -> impl Strategy<Value = file::Payload> {
    (0.1..10.0_f64, prop::option::of(inertia(1.0))).prop_map(|(mass_kg, inertia_kg_m2)| {
        file::Payload { mass_kg, inertia_kg_m2, radius_m: None, shapes: None }
    })
}

/// A scenario at rest with an arm of any number of joints in `joints`, either convention, any mount.
pub fn arm(joints: RangeInclusive<usize>) -> impl Strategy<Value = Scenario> {
    let mount = (prop::array::uniform3(-0.5..0.5_f64), prop::option::of(rotation()));
    let convention =
        prop_oneof![Just(file::DhConvention::Standard), Just(file::DhConvention::Modified)];
    (base(), mount, convention, vec(link(), joints), prop::option::of(payload())).prop_map(
        |(base, (position_m, rotation), dh_convention, links, payload)| {
            let system = file::System {
                name: "arm".to_owned(),
                description: None,
                base,
                mount: Some(file::Mount {
                    position_m,
                    rotation,
                    force_max_n: None,
                    moment_max_n_m: None,
                }),
                dh_convention: Some(dh_convention),
                links,
                bodies: None,
                project_inertias: false,
                payload,
                ignored_pairs: None,
            };
            at_rest(system)
        },
    )
}

/// A scenario with this system at rest, all joints at zero.
pub(crate) fn at_rest(system: file::System) -> Scenario {
    let kinds = system.joint_kinds();
    let mut initial = file::Initial::default();
    initial.set_resting_joints(&kinds, &vec![0.0; kinds.len()]);
    let scenario = file::Scenario {
        name: "arm at rest".to_owned(),
        description: None,
        system: file::SystemReference::Inline(Box::new(system)),
        system_options: None,
        initial,
        maneuver: file::Maneuver {
            kind: file::ManeuverType::Slew,
            axis: Some([0.0, 0.0, 1.0]),
            angle_deg: Some(10.0),
            target_attitude: None,
            waypoints: Vec::new(),
        },
        horizon: file::Horizon { duration_s: file::Duration::Given(10.0), steps: 10.0 },
        weights: file::Weights::default(),
        end: None,
        wheels: Vec::new(),
        environment: None,
        robustness: None,
        pointing: Vec::new(),
        collision: file::Collision { clearance_m: Some(0.0) },
        solver: file::Solver::default(),
    };
    Scenario::from_file(scenario, Path::new("arm.json")).expect("a sound arm")
}
