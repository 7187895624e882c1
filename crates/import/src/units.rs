//! Whether masses and lengths look like SI units.

use crate::error::ImportError;
use crate::robot::{Joint, Link};

/// How many times larger than the whole robot a link's radius of gyration may be. With inertias in
/// kg mm² it is a thousand times what it should be; placeholders in public files go up to ten.
const LARGEST_GYRATION: f64 = 30.0;

/// Refuses an inertia that is far too large for the robot's size and the link's mass.
pub(crate) fn check(links: &[Link], joints: &[Joint]) -> Result<(), ImportError> {
    let between_joints: f64 = joints.iter().map(|joint| joint.placement.position_m.norm()).sum();
    let inside: f64 = links.iter().map(|link| link.body.center_of_mass_m.norm()).sum();
    let size_m = between_joints + inside;
    for link in links.iter().filter(|link| link.body.mass_kg > 0.0 && size_m > 0.0) {
        let gyration_m = (link.body.inertia_kg_m2.amax() / link.body.mass_kg).sqrt();
        if gyration_m > LARGEST_GYRATION * size_m {
            let found = format!(
                "an inertia of {:e} kg m² at a mass of {} kg, a radius of gyration of {gyration_m:.3} m",
                link.body.inertia_kg_m2.amax(),
                link.body.mass_kg
            );
            let expected = format!(
                "less than {LARGEST_GYRATION} times the size of the robot, {size_m:.3} m: URDF is in kg, m \
                 and kg m²"
            );
            return Err(link.place.refuse(found, expected));
        }
    }
    Ok(())
}
