//! Maneuvers of random well-formed systems: 2 to 12 joints in chains and trees, masses far apart, axes that coincide,
//! and every field that a scenario may have.

use arbitrary::{Result, Unstructured};
use serde_json::{Map, Value, json};

use crate::from_schema::Schema;
use crate::json::schema_of_scenarios;

/// Steps of the grid, at the most.
const MOST_STEPS: usize = 6;
/// The optimizer gets no more iterations.
const MOST_ITERATIONS: usize = 30;

/// A share of a range.
fn within(u: &mut Unstructured<'_>, least: f64, most: f64) -> Result<f64> {
    Ok(least + (most - least) * f64::from(u.arbitrary::<u16>()?) / f64::from(u16::MAX))
}

/// A size over so many powers of ten.
fn size(u: &mut Unstructured<'_>, least_power: f64, most_power: f64) -> Result<f64> {
    Ok(10f64.powf(within(u, least_power, most_power)?))
}

fn vector(u: &mut Unstructured<'_>, most: f64) -> Result<[f64; 3]> {
    Ok([within(u, -most, most)?, within(u, -most, most)?, within(u, -most, most)?])
}

/// An axis of a joint: often one of the frame's, so that axes are parallel or coincide.
fn axis(u: &mut Unstructured<'_>) -> Result<[f64; 3]> {
    Ok(match u.int_in_range(0..=4)? {
        0 => [1.0, 0.0, 0.0],
        1 | 2 => [0.0, 0.0, 1.0],
        3 => [0.0, -1.0, 0.0],
        _ => {
            let [x, y, z] = vector(u, 1.0)?;
            [x, y, if z == 0.0 { 1.0 } else { z }]
        }
    })
}

/// A body of an arm; its joint may sit where the one before it does.
fn body(u: &mut Unstructured<'_>, number: usize, mass_kg: f64) -> Result<Value> {
    let parent = match (number, u.ratio(4, 5)?) {
        (0, _) => "base".to_owned(),
        (_, true) => format!("b{}", number - 1),
        (_, false) => format!("b{}", u.int_in_range(0..=number - 1)?),
    };
    let position_m = if u.ratio(1, 4)? { [0.0; 3] } else { vector(u, 0.6)? };
    let mut joint = json!({
        "type": if u.ratio(1, 8)? { "continuous" } else { "revolute" },
        "position_m": position_m,
        "axis": axis(u)?,
        "rate_max_deg_s": size(u, -1.0, 2.5)?,
        "acceleration_max_deg_s2": size(u, -1.0, 2.5)?,
    });
    if joint["type"] == "revolute" && u.ratio(1, 2)? {
        joint["angle_min_deg"] = json!(-within(u, 5.0, 350.0)?);
        joint["angle_max_deg"] = json!(within(u, 5.0, 350.0)?);
    }
    if u.ratio(1, 8)? {
        joint["torque_max_n_m"] = json!(size(u, 0.0, 4.0)?);
    }
    let center = vector(u, 0.3)?;
    let mut body = json!({
        "name": format!("b{number}"),
        "parent": parent,
        "joint": joint,
        "mass_kg": mass_kg * size(u, -1.0, 1.0)?,
        "center_of_mass_m": center,
        "body_exempt": true,
    });
    if u.ratio(1, 2)? {
        let moment = body["mass_kg"].as_f64().unwrap_or(1.0) * size(u, -4.0, 0.0)?;
        body["inertia_kg_m2"] = json!([[moment, 0.0, 0.0], [0.0, moment, 0.0], [0.0, 0.0, moment]]);
    }
    Ok(body)
}

fn system(u: &mut Unstructured<'_>) -> Result<(Value, usize)> {
    let joints = u.int_in_range(2..=12)?;
    // From a gnat on a station to an arm that is all there is.
    let arm_kg = size(u, -3.0, 4.0)?;
    let bodies: Vec<Value> =
        (0..joints).map(|number| body(u, number, arm_kg)).collect::<Result<_>>()?;
    let system = json!({
        "name": "random",
        "base": { "mass_kg": size(u, -1.0, 5.0)?, "cube_side_m": size(u, -1.0, 1.0)? },
        "bodies": bodies,
    });
    Ok((system, joints))
}

fn maneuver(u: &mut Unstructured<'_>) -> Result<(Value, [f64; 3])> {
    if u.ratio(1, 3)? {
        let rate = vector(u, 20.0)?;
        let [x, y, z] = rate;
        return Ok((json!({ "type": "detumble" }), [x, y, if z == 0.0 { 1.0 } else { z }]));
    }
    let mut axis = vector(u, 1.0)?;
    axis[0] += 1.5;
    let slew = json!({ "type": "slew", "axis": axis, "angle_deg": within(u, -180.0, 180.0)? });
    Ok((slew, [0.0; 3]))
}

/// A scenario as a value, most often an allowed one.
pub(crate) fn scenario(u: &mut Unstructured<'_>) -> Result<Value> {
    let (system, joints) = system(u)?;
    let (maneuver, rate) = maneuver(u)?;
    let angles: Vec<f64> =
        (0..joints).map(|_| Ok(4.0 * within(u, -1.0, 1.0)?)).collect::<Result<_>>()?;
    let formulation = if u.ratio(1, 3)? { "full" } else { "reduced" };
    let mut scenario = json!({
        "name": "random",
        "system": system,
        "initial": { "joint_angles_deg": angles, "angular_rate_deg_s": rate },
        "maneuver": maneuver,
        "horizon": { "duration_s": size(u, 0.0, 2.5)?, "steps": u.int_in_range(1..=MOST_STEPS)? },
        "collision": { "clearance_m": 0.0 },
        "solver": {
            "formulation": formulation,
            "guess": if u.arbitrary()? { "auto" } else { "constant" },
            "optimizer": if u.ratio(1, 4)? { "interior" } else { "ipopt" },
        },
    });
    let schema = Schema::new(schema_of_scenarios());
    if u.ratio(1, 2)? {
        schema.vary(u, &mut scenario)?;
    }
    Ok(scenario)
}

/// Keeps a scenario small, whatever its fields say: few steps, few iterations.
pub(crate) fn keep_small(scenario: &mut Value) {
    let Some(fields) = scenario.as_object_mut() else { return };
    let limit = |object: &mut Map<String, Value>, field: &str, most: usize| {
        let there = object.get(field).and_then(Value::as_f64);
        let least = there.map_or(most as f64, |there| there.min(most as f64));
        object.insert(field.to_owned(), json!(least));
    };
    if let Some(horizon) = fields.get_mut("horizon").and_then(Value::as_object_mut) {
        limit(horizon, "steps", MOST_STEPS);
    }
    if let Some(solver) = fields.get_mut("solver").and_then(Value::as_object_mut) {
        limit(solver, "max_iterations", MOST_ITERATIONS);
        if solver.get("guess").is_some_and(Value::is_object) {
            solver.insert("guess".to_owned(), json!("auto"));
        }
    }
}
