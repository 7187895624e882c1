//! The posture in which an arm shall end.

use righting_multibody::JointKind;

use crate::collision::CollisionModel;
use crate::error::Error;
use crate::file::{self, JointWords};
use crate::halton::Halton;
use crate::initial::{Initial, checked, joint_coordinate};
use crate::json::{Location, Number};
use crate::rounding::COMPUTED;
use crate::system_description::SystemDescription;

/// Postures of the free joints that are looked at to tell which distances the given ones decide.
const POSTURES: usize = 4;

/// Checks the joint coordinates of an end that was read from `place`: one a joint, rad or m; none where the
/// joint is free.
pub(crate) fn end_coordinates(
    end: Option<&file::End>,
    system: &SystemDescription,
    place: &Location,
) -> Result<Vec<Option<f64>>, Error> {
    let Some(end) = end else { return Ok(vec![None; system.joint_count()]) };
    let kinds = system.model.joint_kinds();
    let free = |kind| file::of_kind(&kinds, kind, &vec![None; kinds.len()]);
    let given = [
        &end.joint_angles_deg.clone().unwrap_or_else(|| free(JointKind::Revolute))[..],
        &end.joint_travels_m.clone().unwrap_or_else(|| free(JointKind::Prismatic)),
    ];
    checked(given, JointWords::coordinates, system, place, |value, joint, place| {
        value.map(|value| joint_coordinate(value, joint, system, place)).transpose()
    })
}

/// Refuses an end in which something is too close whatever the free joints do.
pub(crate) fn check_end_clearances(
    system: &SystemDescription,
    collision: &CollisionModel,
    initial: &Initial,
    end_angles_rad: &[Option<f64>],
    place: &Location,
) -> Result<(), Error> {
    if end_angles_rad.iter().all(Option::is_none) {
        return Ok(());
    }
    let model = &system.model;
    let slack_m = COMPUTED * model.size_m();
    let distances = |free: &[f64]| -> Vec<f64> {
        let angles = end_angles_rad.iter().zip(free).map(|(given, free)| given.unwrap_or(*free));
        let posture = model.kinematics(&angles.collect::<Vec<_>>());
        collision.clearances(&posture).map(|clearance| clearance.distance_m).collect()
    };
    let at_start = distances(&initial.joint_angles_rad);
    let elsewhere: Vec<Vec<f64>> = Halton::new(system.joint_count())
        .take(POSTURES)
        .map(|sample| distances(&system.joint_angles_at(&sample)))
        .collect();
    for (index, (pair, &distance_m)) in collision.pairs.iter().zip(&at_start).enumerate() {
        let is_decided = elsewhere.iter().all(|other| (other[index] - distance_m).abs() <= slack_m);
        if is_decided && distance_m < pair.least_m - slack_m {
            return Err(place.refuse(
                format_args!(
                    "an end with {} {} m apart",
                    system.names.between(&pair.between),
                    Number::rounded(distance_m, 6)
                ),
                format_args!("at least {} m", Number::rounded(pair.least_m, 6)),
            ));
        }
    }
    Ok(())
}
