//! The systems of the paper's Table I.

use nalgebra::Vector3;
use righting_multibody::{
    Base, BodyJoint, DhConvention, JointedBody, Link, Mount, Placement, RigidBody, System,
};

/// A row of Table I: mass, a, α in degrees, d, θ in degrees.
type Row = (f64, f64, f64, f64, f64);

fn system(mass_kg: f64, side_m: f64, convention: DhConvention, rows: &[Row]) -> System {
    let link = |&(mass_kg, a_m, alpha_deg, d_m, theta_deg): &Row| {
        Link::rod(mass_kg, a_m, f64::to_radians(alpha_deg), d_m, f64::to_radians(theta_deg))
    };
    System::new(
        Base::uniform_cube(mass_kg, side_m).unwrap(),
        Mount::at(Vector3::new(0.0, 0.0, side_m / 2.0)),
        convention,
        rows.iter().map(link).collect(),
        None,
    )
    .unwrap()
}

/// (a).
pub fn single_link_2dof() -> System {
    let rows = [(0.0, 0.0, -90.0, 0.0, 0.0), (25.0, 1.0, 0.0, 0.0, -90.0)];
    system(300.0, 0.5, DhConvention::Standard, &rows)
}

/// (b).
pub fn xlink_4dof() -> System {
    let rows = [
        (7.0, 0.0, 90.0, 0.25, -180.0),
        (6.0, 0.25, 0.0, 0.0, 90.0),
        (6.0, 0.25, 0.0, 0.0, 0.0),
        (6.0, 0.25, 0.0, 0.0, 0.0),
    ];
    system(300.0, 0.5, DhConvention::Standard, &rows)
}

const CANADARM2: [Row; 7] = [
    (0.0, 0.0, 0.0, 0.0, 0.0),
    (60.0, 0.0, 90.0, 0.635, 0.0),
    (70.0, 0.0, -90.0, 0.756, 0.0),
    (620.0, 6.85, 0.0, 0.0, 0.0),
    (620.0, 6.85, 0.0, 0.756, 0.0),
    (70.0, 0.0, 90.0, 0.635, 0.0),
    (60.0, 0.0, -90.0, 0.0, 0.0),
];

/// (c) read as standard rows, as the table's head says.
pub fn canadarm2_table() -> System {
    system(400_000.0, 2.0, DhConvention::Standard, &CANADARM2)
}

/// (c) read as Craig's rows, which the real arm has.
pub fn canadarm2() -> System {
    system(400_000.0, 2.0, DhConvention::Modified, &CANADARM2)
}

/// All four with their names.
pub fn all() -> [(&'static str, System); 4] {
    [
        ("single_link_2dof", single_link_2dof()),
        ("xlink_4dof", xlink_4dof()),
        ("canadarm2_table", canadarm2_table()),
        ("canadarm2", canadarm2()),
    ]
}

/// A system of standard rows written as bodies: the frame of body i is where row i turns, its joint where
/// frame i−1 is.
pub fn as_bodies(system: &System) -> System {
    let rows = system.rows().unwrap();
    assert_eq!(rows.convention, DhConvention::Standard);
    let mount = &rows.mount;
    let mut before = Placement { position_m: mount.position_m, rotation: *mount.rotation.matrix() };
    let mut bodies = Vec::new();
    for (k, link) in rows.links.iter().enumerate() {
        let offset = Vector3::new(link.a_m, 0.0, link.d_m);
        let across = offset.cross_matrix();
        let turned = Placement::rotation_of_rpy(0.0, 0.0, link.theta_rad);
        bodies.push(JointedBody {
            parent: k.checked_sub(1),
            placement: Placement { rotation: before.rotation * turned, ..before },
            joint: BodyJoint::Revolute(Vector3::z()),
            body: RigidBody {
                mass_kg: link.mass_kg,
                center_of_mass_m: offset / 2.0,
                inertia_kg_m2: across * across * (-link.mass_kg / 12.0),
            },
        });
        let rotation = Placement::rotation_of_rpy(link.alpha_rad, 0.0, 0.0);
        before = Placement { position_m: offset, rotation };
    }
    System::of_bodies(system.base().clone(), bodies).unwrap()
}
