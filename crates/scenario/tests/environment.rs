//! What acts from outside, as a file says it.

use righting_scenario::Scenario;
use righting_scenario::file::{Environment, GravityGradient, OrbitalElements};
use righting_test_support::{shipped, varied};

/// A start that is later on the orbit has the Earth where the orbit says for then.
#[test]
fn an_orbit_goes_on() {
    let elements = OrbitalElements {
        inclination_deg: 51.6,
        right_ascension_deg: 200.0,
        argument_of_latitude_deg: 359.0,
    };
    let gradient = GravityGradient { altitude_km: 400.0, orbit_attitude: None, elements: None };
    let attitude = Some([0.1, 0.7, -0.5, 0.5]);
    for (given, time_s) in [
        (gradient.clone(), 700.0),
        (GravityGradient { orbit_attitude: attitude, ..gradient.clone() }, -90.0),
        (GravityGradient { elements: Some(elements), ..gradient }, 4000.0),
    ] {
        let orbit = |gradient: &GravityGradient| {
            let scenario: Scenario = varied(&shipped("slew_2dof"), |file| {
                let gravity_gradient = Some(gradient.clone());
                file.environment = Some(Environment { gravity_gradient, ..Environment::default() });
            });
            scenario.environment().unwrap().orbit.unwrap()
        };
        let mut later = given.clone();
        later.move_on(time_s);
        let (first, then) = (orbit(&given), orbit(&later));
        for after_s in [0.0, 1000.0] {
            let expected = first.nadir_at(time_s + after_s);
            let found = then.nadir_at(after_s);
            assert!((found - expected).norm() < 1e-9, "{given:?}: {found} {expected}");
        }
    }
}
