//! Random shapes of arms and bases.

use proptest::collection::vec;
use proptest::prelude::*;
use righting_scenario::file::{self, SystemReference};

fn point(size: f64) -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-size..size)
}

fn sphere(size: f64) -> impl Strategy<Value = file::Sphere> {
    (point(size), 0.0..0.1_f64).prop_map(|(center_m, radius_m)| file::Sphere { center_m, radius_m })
}

fn capsule(size: f64) -> impl Strategy<Value = file::Capsule> {
    (point(size), point(size), 0.0..0.1_f64).prop_map(|(from_m, to_m, radius_m)| file::Capsule {
        from_m,
        to_m,
        radius_m,
    })
}

fn shape() -> impl Strategy<Value = file::Shape> {
    prop_oneof![
        sphere(0.5).prop_map(|sphere| file::Shape { sphere: Some(sphere), capsule: None }),
        capsule(0.5).prop_map(|capsule| file::Shape { sphere: None, capsule: Some(capsule) }),
    ]
}

fn keep_out() -> impl Strategy<Value = file::KeepOut> {
    let none = file::KeepOut::default;
    let cuboid = (point(1.5), prop::array::uniform3(0.0..0.8_f64))
        .prop_map(|(center_m, size_m)| file::Cuboid { center_m, size_m });
    prop_oneof![
        1 => sphere(1.5).prop_map(move |sphere| file::KeepOut { sphere: Some(sphere), ..none() }),
        1 => capsule(1.5).prop_map(move |capsule| file::KeepOut { capsule: Some(capsule), ..none() }),
        2 => cuboid.prop_map(move |cuboid| file::KeepOut { cuboid: Some(cuboid), ..none() }),
    ]
}

/// How bodies look.
#[derive(Clone, Debug)]
pub struct Bodies {
    keep_out: Vec<file::KeepOut>,
    links: Vec<(Option<f64>, Option<Vec<file::Shape>>)>,
    payload: Option<f64>,
}

impl Bodies {
    /// Gives the system of a scenario, which is inline, these shapes; those of links in turn.
    pub fn give(&self, scenario: &mut file::Scenario) {
        let SystemReference::Inline(system) = &mut scenario.system else { panic!("inline") };
        system.base.keep_out = Some(self.keep_out.clone());
        for (link, (radius_m, shapes)) in system.links.iter_mut().zip(self.links.iter().cycle()) {
            link.radius_m = radius_m.filter(|_| shapes.is_none());
            link.shapes.clone_from(shapes);
        }
        for (body, (_, shapes)) in system.bodies.iter_mut().flatten().zip(self.links.iter().cycle())
        {
            body.shapes.clone_from(shapes);
        }
        if let Some(payload) = &mut system.payload {
            payload.radius_m = self.payload;
        }
    }
}

/// Any shapes, those of thin links too.
pub fn bodies() -> impl Strategy<Value = Bodies> {
    let link = (prop::option::of(0.0..0.1_f64), prop::option::weighted(0.3, vec(shape(), 0..3)));
    (vec(keep_out(), 0..4), vec(link, 1..6), prop::option::of(0.0..0.2_f64))
        .prop_map(|(keep_out, links, payload)| Bodies { keep_out, links, payload })
}
