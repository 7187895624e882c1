//! A Python script that flies a plan in Basilisk.

use std::fmt::Write;

use nalgebra::{Matrix3, SymmetricEigen};
use righting_multibody::{JointKind, Placement, RigidBody};
use righting_results::{Solution, Trajectory};
use righting_scenario::Scenario;

use super::Flight;
use super::python::{Constants, row};
use crate::ExportError;
use crate::arm::{Arm, Hinge};
use crate::xml::number;

/// The least principal moment of a body relative to its mass and the square of the system's size. A
/// flight may amplify an error by 1e10, so it is as small as rounding allows.
const LEAST: f64 = 1e-15;

/// A Python script that builds the system in Basilisk, a spacecraft with a
/// `spinningBodyNDOFStateEffector` for every arm, and flies the plan by its torques alone, nothing correcting them;
/// it prints how far the end is from the plan's, and how far the largest torques are from those that
/// Basilisk finds for the plan's accelerations. Everything it needs is in it. `maneuver` says in words
/// what is flown.
///
/// A joint that turns no inertia holds its angle at the start, and of two joints on one axis without
/// inertia between them the second makes the motion of both: torques tell no more. Bodies on joints
/// that do not turn are part of the body before. Basilisk needs principal moments above zero: the
/// least is 1e-15 of mass times the square of the system's size.
///
/// # Errors
/// [`ExportError::Motion`] for a motion that cannot be followed, [`ExportError::Branches`] for joints that
/// branch beyond the base, [`ExportError::Slides`] for joints that slide, [`ExportError::Surroundings`] for a
/// scenario with wheels or an environment.
pub fn basilisk(
    scenario: &Scenario,
    solution: &Solution,
    trajectory: &Trajectory,
    maneuver: &str,
) -> Result<Vec<u8>, ExportError> {
    if !scenario.wheels().is_empty() || scenario.environment().is_some() {
        return Err(ExportError::Surroundings);
    }
    let flight = Flight::new(scenario, trajectory)?;
    let goes_on = |(index, hinge): (usize, &Hinge)| {
        hinge.parent.is_none() || hinge.parent == index.checked_sub(1)
    };
    if !flight.arm.hinges.iter().enumerate().all(goes_on) {
        return Err(ExportError::Branches);
    }
    let mut moving = flight.arm.hinges.iter().filter(|hinge| hinge.held_at.is_none());
    if let Some(hinge) = moving.find(|hinge| hinge.kind == JointKind::Prismatic) {
        return Err(ExportError::Slides { joint: hinge.joint.clone() });
    }
    let mut constants = Constants::new(&flight, solution, trajectory, maneuver);
    let (base, arms) = turning_bodies(&flight.arm);
    let attitudes = trajectory.nodes().iter().flat_map(|node| node.attitude);
    constants.array("ATTITUDES", &[trajectory.nodes().len(), 4], attitudes);
    let rates = trajectory.nodes().iter().flat_map(|node| node.angular_rate_rad_s);
    constants.array("ANGULAR_RATES", &[trajectory.nodes().len(), 3], rates);
    constants.value("BASE", &body(&base, None));
    let mut list = String::from("[\n");
    let size_m = scenario.system().model.size_m();
    let mut line = |text: &str| {
        writeln!(list, "    {text}").expect("a string takes all that is written to it");
    };
    for bodies in &arms {
        line("[");
        for (placement, mass) in bodies {
            line(&format!("    {},", body(&with_moments(mass, size_m), Some(placement))));
        }
        line("],");
    }
    list.push(']');
    constants.value("ARMS", &list);
    Ok(constants.into_script(include_str!("basilisk.py")))
}

/// A body with its frame's place in that of the body before.
type Placed = (Placement, RigidBody);

/// The base and, of every arm, the bodies on joints that turn, each with what is fixed to it.
fn turning_bodies(arm: &Arm) -> (RigidBody, Vec<Vec<Placed>>) {
    let mut base = arm.base;
    let mut arms: Vec<Vec<Placed>> = Vec::new();
    let mut end = Placement::identity();
    for hinge in &arm.hinges {
        if hinge.parent.is_none() {
            arms.push(Vec::new());
            end = Placement::identity();
        }
        let Some(bodies) = arms.last_mut() else { continue };
        end = end.then(&hinge.placed());
        match (hinge.held_at, bodies.last_mut()) {
            (None, _) => {
                bodies.push((end, hinge.body));
                end = Placement::identity();
            }
            (Some(_), Some((_, last))) => *last = last.joined(&hinge.body, &end),
            (Some(_), None) => base = base.joined(&hinge.body, &end),
        }
    }
    arms.retain(|bodies| !bodies.is_empty());
    (base, arms)
}

/// The body with no principal moment below the least that is told from zero.
fn with_moments(body: &RigidBody, size_m: f64) -> RigidBody {
    let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(body.inertia_kg_m2);
    let least = LEAST * body.mass_kg * size_m.powi(2);
    if eigenvalues.min() >= least {
        return *body;
    }
    let moments = Matrix3::from_diagonal(&eigenvalues.map(|moment| moment.max(least)));
    let inertia = eigenvectors * moments * eigenvectors.transpose();
    RigidBody { inertia_kg_m2: (inertia + inertia.transpose()) * 0.5, ..*body }
}

/// A dictionary in Python's words.
fn body(body: &RigidBody, placement: Option<&Placement>) -> String {
    let matrix = |matrix: &Matrix3<f64>| {
        let rows = matrix.row_iter().map(|of_row| row(of_row.iter().copied()));
        format!("[{}]", rows.collect::<Vec<_>>().join(", "))
    };
    let mut text = format!(
        "dict(mass_kg={}, center_m={}, inertia_kg_m2={}",
        number(body.mass_kg),
        row(body.center_of_mass_m.iter().copied()),
        matrix(&body.inertia_kg_m2),
    );
    if let Some(Placement { position_m, rotation }) = placement {
        let position = row(position_m.iter().copied());
        let to_body = matrix(&rotation.transpose());
        write!(text, ", position_m={position}, from_parent={to_body}")
            .expect("a string takes all that is written to it");
    }
    text.push(')');
    text
}
