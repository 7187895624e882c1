//! How far a plant is from the model that it was planned with.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use righting_scenario::file;

/// The largest differences from the model; each number is drawn evenly between them, either way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spreads {
    /// Of every mass, as a share of it. The inertia of a body that has none of its own goes with its mass.
    pub masses: f64,
    /// Of the inertias that are given, as a share of them.
    pub inertias: f64,
    /// Of every center of mass that is given, along each axis, m.
    pub centers_m: f64,
    /// Of the place of the mount, or of every joint on the base, along each axis, m.
    pub mount_m: f64,
}

impl Spreads {
    /// A system that differs by no more than this.
    pub(crate) fn applied(&self, system: &file::System, draws: &mut ChaCha8Rng) -> file::System {
        let mut plant = system.clone();
        let mut share = |most: f64| 1.0 + most * draws.random_range(-1.0..=1.0);
        let mut scaled = |mass_kg: &mut f64, inertia: &mut Option<[[f64; 3]; 3]>| {
            *mass_kg *= share(self.masses);
            let factor = share(self.inertias);
            inertia.iter_mut().flatten().flatten().for_each(|entry| *entry *= factor);
        };
        let base = &mut plant.base;
        // The inertia of a cube can differ by itself.
        if let Some(side_m) = base.cube_side_m.take() {
            let moment = base.mass_kg * side_m.powi(2) / 6.0;
            base.inertia_kg_m2 = Some([[moment, 0.0, 0.0], [0.0, moment, 0.0], [0.0, 0.0, moment]]);
            base.keep_out_radius_m.get_or_insert(side_m * 0.75_f64.sqrt());
        }
        scaled(&mut base.mass_kg, &mut base.inertia_kg_m2);
        for link in &mut plant.links {
            scaled(&mut link.mass_kg, &mut link.inertia_kg_m2);
        }
        for body in plant.bodies.iter_mut().flatten() {
            scaled(&mut body.mass_kg, &mut body.inertia_kg_m2);
        }
        if let Some(payload) = &mut plant.payload {
            scaled(&mut payload.mass_kg, &mut payload.inertia_kg_m2);
        }
        let mut moved = |place: &mut [f64; 3], most: f64| {
            place.iter_mut().for_each(|entry| *entry += most * draws.random_range(-1.0..=1.0));
        };
        for link in &mut plant.links {
            if let Some(center) = &mut link.center_of_mass_m {
                moved(center, self.centers_m);
            }
        }
        for body in plant.bodies.iter_mut().flatten() {
            if let Some(center) = &mut body.center_of_mass_m {
                moved(center, self.centers_m);
            }
        }
        if let Some(mount) = &mut plant.mount {
            moved(&mut mount.position_m, self.mount_m);
        }
        let base = plant.base.name();
        let on_base = plant.bodies.iter_mut().flatten().filter(|body| body.parent == base);
        for body in on_base {
            moved(body.joint.position_m.get_or_insert_default(), self.mount_m);
        }
        plant
    }
}
