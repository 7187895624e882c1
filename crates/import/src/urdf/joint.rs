//! The element `<joint>`.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::origin;
use crate::document::Element;
use crate::error::{ImportError, quoted};
use crate::notes::Notes;
use crate::robot::{Joint, JointKind, Limits};

/// From here on a limit means that there is none.
const UNLIMITED: f64 = 1e9;
/// Two turns, rad: beyond, a limit may be meant in degrees.
const DOUBTFUL_RAD: f64 = 4.0 * std::f64::consts::PI;

pub(super) fn joint(
    element: Element<'_>,
    link_of: &HashMap<String, usize>,
    notes: &mut Notes,
) -> Result<Joint, ImportError> {
    let kind_name = element.required_text("type")?;
    let kind = match kind_name {
        "revolute" | "continuous" => JointKind::Turning,
        "prismatic" => JointKind::Sliding,
        "fixed" => JointKind::Fixed,
        "floating" | "planar" => JointKind::Loose,
        other => {
            let expected = "revolute, continuous, prismatic, fixed, floating or planar";
            return Err(element.place_of("type").refuse(quoted(other), expected));
        }
    };
    let end = |tag| -> Result<usize, ImportError> {
        let end = element.required_child(tag)?;
        let name = end.required_text("link")?;
        let index = link_of.get(name).copied();
        index.ok_or_else(|| end.place_of("link").refuse(quoted(name), "the name of a link"))
    };
    let (parent, child) = (end("parent")?, end("child")?);
    if parent == child {
        return Err(element.place().refuse("one link as parent and child", "two"));
    }
    // A joint that does not move has neither, whatever stands there: many files have an axis of zeros.
    let (axis, limits) = match kind {
        JointKind::Fixed | JointKind::Loose => (Vector3::x(), Limits::NONE),
        _ => (axis(element)?, limits(element, kind_name, notes)?),
    };
    Ok(Joint {
        name: element.required_text("name")?.to_owned(),
        place: element.place(),
        kind,
        parent,
        child,
        placement: origin(element)?,
        axis,
        limits,
        mimic: None,
    })
}

fn axis(joint: Element<'_>) -> Result<Vector3<f64>, ImportError> {
    let Some(element) = joint.child("axis")? else { return Ok(Vector3::x()) };
    let axis = Vector3::from(element.vector("xyz")?.unwrap_or([1.0, 0.0, 0.0]));
    // Scaled first, so that no length overflows or vanishes.
    match (axis / axis.amax()).try_normalize(0.0) {
        Some(unit) if axis.amax() > 0.0 => Ok(unit),
        _ => Err(element.place_of("xyz").refuse("[0, 0, 0]", "an axis of any length but zero")),
    }
}

fn limits(joint: Element<'_>, kind_name: &str, notes: &mut Notes) -> Result<Limits, ImportError> {
    let Some(element) = joint.child("limit")? else {
        if kind_name != "continuous" {
            notes.push(joint.place().note("no <limit>: taken without limits of its coordinate"));
        }
        return Ok(Limits::NONE);
    };
    let (lower, upper) = match kind_name {
        "continuous" => (f64::NEG_INFINITY, f64::INFINITY),
        // URDF's defaults are zero.
        _ => (
            coordinate(element, "lower", f64::NEG_INFINITY)?,
            coordinate(element, "upper", f64::INFINITY)?,
        ),
    };
    if lower > upper {
        let expected = format!("at most the upper limit, {upper}");
        return Err(element.place_of("lower").refuse(lower, expected));
    }
    let is_doubtful = |limit: f64| limit.is_finite() && limit.abs() > DOUBTFUL_RAD;
    if kind_name == "revolute" && (is_doubtful(lower) || is_doubtful(upper)) {
        notes.push(element.place().note(format_args!(
            "from {lower} to {upper} rad, more than two turns: taken as it is, but are these degrees?"
        )));
    }
    Ok(Limits { lower, upper, rate_max: rate(element, notes)?, effort_max: effort(element)? })
}

/// A limit; `none` where it is so far out on that side that it is none.
fn coordinate(limit: Element<'_>, name: &str, none: f64) -> Result<f64, ImportError> {
    let value = limit.number_or_infinity(name)?.unwrap_or(0.0);
    match value.abs() {
        magnitude if magnitude >= UNLIMITED && value.signum() == none.signum() => Ok(none),
        magnitude if magnitude > Limits::FARTHEST => {
            let expected =
                format!("at most {} in magnitude: URDF is in rad and m", Limits::FARTHEST);
            Err(limit.place_of(name).refuse(value, expected))
        }
        _ => Ok(value),
    }
}

/// The largest rate; zero stands for none in files that a program has made.
fn rate(limit: Element<'_>, notes: &mut Notes) -> Result<Option<f64>, ImportError> {
    match limit.number_or_infinity("velocity")? {
        Some(rate) if rate < 0.0 => {
            Err(limit.place_of("velocity").refuse(rate, "a largest velocity, zero or more"))
        }
        Some(0.0) => {
            notes.push(limit.place_of("velocity").note("0, taken as not given"));
            Ok(None)
        }
        Some(rate) if rate >= UNLIMITED => Ok(None),
        rate => Ok(rate),
    }
}

fn effort(limit: Element<'_>) -> Result<f64, ImportError> {
    match limit.number_or_infinity("effort")? {
        Some(effort) if effort < 0.0 => {
            Err(limit.place_of("effort").refuse(effort, "a largest effort, zero or more"))
        }
        Some(effort) if effort > 0.0 && effort < UNLIMITED => Ok(effort),
        _ => Ok(f64::INFINITY),
    }
}
