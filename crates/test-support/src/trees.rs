//! Random trees of bodies as scenario files say them.

use std::ops::RangeInclusive;

use proptest::collection::vec;
use proptest::prelude::*;
use righting_scenario::{Scenario, file};

use crate::arms::{angle_deg, at_rest, base, inertia, length_m, rotation};

fn joint() -> impl Strategy<Value = file::Joint> {
    let kind = prop_oneof![
        1 => Just(file::JointType::Fixed),
        3 => Just(file::JointType::Revolute),
        1 => Just(file::JointType::Continuous),
        2 => Just(file::JointType::Prismatic),
    ];
    let position = prop_oneof![
        1 => Just(None),
        2 => (length_m(), length_m()).prop_map(|(x, z)| Some([x, 0.0, z])),
        2 => prop::array::uniform3(-0.6..0.6_f64).prop_map(Some),
    ];
    let orientation = prop_oneof![
        1 => Just((None, None)),
        3 => [angle_deg(), angle_deg(), angle_deg()].prop_map(|rpy| (Some(rpy), None)),
        1 => rotation().prop_map(|wxyz| (None, Some(wxyz))),
    ];
    let axis = prop_oneof![
        1 => Just(None),
        2 => Just(Some([1.0, 0.0, 0.0])),
        2 => Just(Some([0.0, -2.0, 0.0])),
        1 => prop::array::uniform3(0.1..1.0_f64).prop_map(Some),
    ];
    (kind, position, orientation, axis).prop_map(|(kind, position_m, (rpy_deg, rotation), axis)| {
        let moves = kind.joint_kind();
        let turns = moves == Some(file::JointKind::Revolute);
        let slides = moves == Some(file::JointKind::Prismatic);
        file::Joint {
            position_m,
            rpy_deg,
            rotation,
            axis: axis.filter(|_| moves.is_some()),
            rate_max_deg_s: turns.then_some(1000.0),
            acceleration_max_deg_s2: turns.then_some(1000.0),
            travel_min_m: slides.then_some(-4.0),
            travel_max_m: slides.then_some(4.0),
            speed_max_m_s: slides.then_some(20.0),
            acceleration_max_m_s2: slides.then_some(20.0),
            ..file::Joint::of_kind(kind)
        }
    })
}

fn body() -> impl Strategy<Value = file::Body> {
    let mass_kg = prop_oneof![1 => Just(0.0), 4 => 0.1..8.0_f64];
    let center = prop::option::of(prop::array::uniform3(-0.4..0.4_f64));
    (joint(), mass_kg, center, prop::option::of(inertia(0.5))).prop_map(
        |(joint, mass_kg, center_of_mass_m, inertia_kg_m2)| file::Body {
            name: String::new(),
            parent: String::new(),
            joint,
            mass_kg,
            center_of_mass_m,
            inertia_kg_m2: inertia_kg_m2.filter(|_| mass_kg > 0.0),
            shapes: None,
            body_exempt: false,
        },
    )
}

/// A scenario at rest with a tree of any number of bodies in `bodies`, fixed ones among them, in any order
/// of the list; joints are named `joint_1` and so on, as those of rows are in exports.
pub fn tree(bodies: RangeInclusive<usize>) -> impl Strategy<Value = Scenario> {
    let bodies = vec((body(), any::<prop::sample::Index>()), bodies);
    let in_order = bodies.prop_flat_map(|bodies| {
        let order: Vec<usize> = (0..bodies.len()).collect();
        (Just(bodies), Just(order).prop_shuffle())
    });
    (base(), in_order).prop_filter_map("a joint", |(base, (bodies, order))| {
        let mut listed: Vec<(usize, file::Body)> = bodies
            .into_iter()
            .enumerate()
            .map(|(number, (body, before))| {
                // The base, or a body with a smaller number.
                let parent = match before.index(number + 1) {
                    0 => "base".to_owned(),
                    before => format!("body_{before}"),
                };
                (order[number], file::Body { name: format!("body_{}", number + 1), parent, ..body })
            })
            .collect();
        listed.sort_by_key(|(place, _)| *place);
        let mut bodies: Vec<file::Body> = listed.into_iter().map(|(_, body)| body).collect();
        let moving = bodies.iter_mut().filter(|body| body.joint.kind != file::JointType::Fixed);
        let mut joints = 0;
        for body in moving {
            joints += 1;
            body.joint.name = Some(format!("joint_{joints}"));
        }
        (joints > 0).then(|| {
            at_rest(file::System {
                name: "tree".to_owned(),
                description: None,
                base,
                mount: None,
                dh_convention: None,
                links: Vec::new(),
                bodies: Some(bodies),
                project_inertias: false,
                payload: None,
                ignored_pairs: None,
            })
        })
    })
}
