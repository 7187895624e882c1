//! What is refused, and with which words.

mod support;

use nalgebra::{Matrix3, Rotation3, Vector3};
use righting_multibody::{
    Base, DhConvention, InertialFrame, Link, ModelError, Mount, Part, Payload, State, System,
};

fn rod() -> Link {
    Link::rod(2.0, 0.5, 0.0, 0.1, 0.0)
}

fn build(
    change: impl FnOnce(&mut Base, &mut Mount, &mut Vec<Link>, &mut Option<Payload>),
) -> Result<System, ModelError> {
    let mut base = Base::uniform_cube(100.0, 1.0).unwrap();
    let mut mount = Mount::at(Vector3::new(0.0, 0.0, 0.5));
    let mut links = vec![rod(), rod()];
    let mut payload = None;
    change(&mut base, &mut mount, &mut links, &mut payload);
    System::new(base, mount, DhConvention::Modified, links, payload)
}

fn error(
    change: impl FnOnce(&mut Base, &mut Mount, &mut Vec<Link>, &mut Option<Payload>),
) -> ModelError {
    build(change).unwrap_err()
}

#[test]
fn sound_models_are_taken() {
    let system = build(|_, _, _, _| ()).unwrap();
    assert_eq!((system.joint_count(), system.total_mass()), (2, 104.0));
    let diagonal = Matrix3::from_diagonal(&Vector3::new(0.0, 0.2, 0.2));
    build(|_, _, links, payload| {
        links[0].inertia_kg_m2 = Some(diagonal);
        links[1].mass_kg = 0.0;
        *payload = Some(Payload { mass_kg: 0.0, inertia_kg_m2: Some(Matrix3::zeros()) });
    })
    .unwrap();
}

#[test]
fn numbers_must_be_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let named = |error: ModelError, part: Part, quantity: &str| match error {
            ModelError::NotFinite { part: p, quantity: q, .. } => {
                assert_eq!((p, q), (part, quantity));
            }
            other => panic!("{other}"),
        };
        let link = Part::Link(1);
        named(error(|base, _, _, _| base.mass_kg = bad), Part::Base, "mass_kg");
        named(error(|base, _, _, _| base.inertia_kg_m2[4] = bad), Part::Base, "inertia_kg_m2");
        named(error(|_, mount, _, _| mount.position_m.x = bad), Part::Mount, "position_m");
        named(error(|_, _, links, _| links[1].mass_kg = bad), link, "mass_kg");
        named(error(|_, _, links, _| links[1].a_m = bad), link, "a_m");
        named(error(|_, _, links, _| links[1].alpha_rad = bad), link, "alpha_rad");
        named(error(|_, _, links, _| links[1].d_m = bad), link, "d_m");
        named(error(|_, _, links, _| links[1].theta_rad = bad), link, "theta_rad");
        let center = Some(Vector3::new(0.0, bad, 0.0));
        named(error(|_, _, l, _| l[1].center_of_mass_m = center), link, "center_of_mass_m");
        let payload = Some(Payload { mass_kg: bad, inertia_kg_m2: None });
        named(error(|_, _, _, p| *p = payload), Part::Payload, "mass_kg");
    }
}

#[test]
fn masses() {
    assert_eq!(
        error(|_, _, links, _| links[1].mass_kg = -3.0),
        ModelError::NegativeMass { part: Part::Link(1), mass_kg: -3.0 }
    );
    assert_eq!(error(|base, _, _, _| base.mass_kg = 0.0), ModelError::MasslessBase);
    assert_eq!(error(|_, _, links, _| links.clear()), ModelError::EmptyChain);
    let inertia_kg_m2 = Some(Matrix3::identity());
    assert_eq!(
        error(|_, _, _, payload| *payload = Some(Payload { mass_kg: 0.0, inertia_kg_m2 })),
        ModelError::InertiaWithoutMass { part: Part::Payload }
    );
    for side_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(Base::uniform_cube(1.0, side_m), Err(ModelError::CubeSide { .. })));
    }
}

#[test]
fn inertias() {
    let skewed = Matrix3::new(1.0, 0.1, 0.0, 0.2, 1.0, 0.0, 0.0, 0.0, 1.0);
    assert_eq!(
        error(|base, _, _, _| base.inertia_kg_m2 = skewed),
        ModelError::NotSymmetric { part: Part::Base, row: 0, column: 1, upper: 0.1, lower: 0.2 }
    );
    let of_link = |x, y, z| {
        let matrix = Matrix3::from_diagonal(&Vector3::new(x, y, z));
        error(move |_, _, links, _| links[0].inertia_kg_m2 = Some(matrix))
    };
    assert!(matches!(
        of_link(1.0, 1.0, -0.5),
        ModelError::NotPositive { part: Part::Link(0), zero_allowed: true, .. }
    ));
    assert!(matches!(
        of_link(1.0, 1.0, 2.1),
        ModelError::TriangleInequality { part: Part::Link(0), .. }
    ));
    let flat = Matrix3::from_diagonal(&Vector3::new(0.0, 1.0, 1.0));
    assert!(matches!(
        error(|base, _, _, _| base.inertia_kg_m2 = flat),
        ModelError::NotPositive { part: Part::Base, zero_allowed: false, .. }
    ));
}

#[test]
fn frames_of_a_mass() {
    let own = |center: Option<Vector3<f64>>, inertia: Option<Matrix3<f64>>| {
        build(|_, _, links, _| {
            links[1].inertial_frame = Some(InertialFrame::Own);
            links[1].center_of_mass_m = center;
            links[1].inertia_kg_m2 = inertia;
        })
    };
    let (center, inertia) = (Some(Vector3::x()), Some(Matrix3::identity()));
    let missing = |quantity| Err(ModelError::MissingInertial { part: Part::Link(1), quantity });
    assert_eq!(own(None, inertia), missing("center_of_mass_m"));
    assert_eq!(own(center, None), missing("inertia_kg_m2"));
    let moved = own(center, inertia).unwrap();
    // Frame 2 moves with joint 2, the frame before it does not.
    let centers = |q: f64| moved.kinematics(&[0.0, q]).centers_of_mass[1];
    assert!((centers(1.0) - centers(0.0)).norm() > 0.1);
    build(|_, _, links, _| {
        links[1].mass_kg = 0.0;
        links[1].inertial_frame = Some(InertialFrame::Own);
    })
    .unwrap();
    // To say the convention's frame changes nothing.
    let said = build(|_, _, l, _| l[0].inertial_frame = Some(InertialFrame::Previous)).unwrap();
    let unsaid = build(|_, _, _, _| ()).unwrap();
    assert_eq!(said.locked_inertia(&[0.3, 0.7]), unsaid.locked_inertia(&[0.3, 0.7]));

    let standard = |frame| {
        let links = vec![Link { inertial_frame: Some(frame), ..rod() }];
        let base = Base::uniform_cube(100.0, 1.0).unwrap();
        System::new(base, Mount::at(Vector3::zeros()), DhConvention::Standard, links, None)
    };
    standard(InertialFrame::Own).unwrap();
    let refused = standard(InertialFrame::Previous).unwrap_err();
    assert_eq!(refused, ModelError::PreviousFrame { part: Part::Link(0) });
}

#[test]
fn mounts() {
    let stretched = Rotation3::from_matrix_unchecked(Matrix3::identity() * 1.1);
    let mirrored = Rotation3::from_matrix_unchecked(-Matrix3::identity());
    for rotation in [stretched, mirrored] {
        assert!(matches!(
            error(|_, mount, _, _| mount.rotation = rotation),
            ModelError::NotARotation { .. }
        ));
    }
}

#[test]
fn huge_numbers_are_refused_not_computed_with() {
    type Change = fn(&mut Vec<Link>);
    let changes: [(&str, Change); 5] = [
        ("length", |links| links[1].a_m = 1e308),
        ("mass", |links| links[0].mass_kg = 1e308),
        ("total mass", |links| links.iter_mut().for_each(|link| link.mass_kg = 1.7e308)),
        ("inertia", |links| links[1].inertia_kg_m2 = Some(Matrix3::identity() * 1.5e308)),
        ("offset", |links| links[0].d_m = 1e200),
    ];
    for (name, change) in changes {
        let result = build(|_, _, links, _| change(links));
        assert!(matches!(result, Err(ModelError::Overflow { .. })), "{name}: {result:?}");
    }
    let error = error(|_, mount, _, _| mount.position_m.x = 1e200);
    assert_eq!(error, ModelError::Overflow { part: Part::Base });
}

#[test]
fn messages_name_part_value_and_what_is_expected() {
    assert_eq!(
        error(|_, _, links, _| links[1].mass_kg = -3.0).to_string(),
        "link 2: mass_kg: found -3, expected zero or more"
    );
    let matrix = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -0.5));
    assert_eq!(
        error(|base, _, _, _| base.inertia_kg_m2 = matrix).to_string(),
        "base: smallest principal moment of inertia_kg_m2: found -0.5, expected more than zero"
    );
}

#[test]
fn state_vectors_have_thirteen_and_twice_the_joints() {
    assert!(State::from_slice(&[0.0; 12]).is_none());
    assert!(State::from_slice(&[0.0; 14]).is_none());
    let x: Vec<f64> = (0..State::<f64>::dimension(2)).map(|i| i as f64).collect();
    let state = State::from_slice(&x).unwrap();
    assert_eq!(state.to_vec(), x);
    assert_eq!(state.attitude.w, 3.0);
    assert_eq!(state.joint_rates, [15.0, 16.0]);
}
