//! Joint limits that a start is past by rounding.

use crate::file;
use crate::json::{Location, Number};
use crate::names::Names;
use crate::rounding::PRINTED;

/// A start is past a limit by rounding up to this, deg: what two angles of three digits before the
/// point differ by when both are printed to six digits.
const PRINTED_DEG: f64 = 1e-3;

/// Widens limits to the start where it is past them by no more than the rounding of printed digits,
/// and notes it. A locked joint is locked at its start. In the file, so that everyone judges by the same
/// limits.
pub(crate) fn widen_to_start(
    initial: &file::Initial,
    system: &mut file::System,
    place: &Location,
    notes: &mut Vec<String>,
) {
    let rates_deg_s = initial.joint_rates_deg_s.as_deref().unwrap_or_default();
    let names = Names::of(system);
    for (joint, mut row) in system.joints().into_iter().enumerate() {
        let joint_place = row.at(place);
        let mut note = |name: &str, limit: f64, start: f64| {
            notes.push(joint_place.key(name).note(format_args!(
                "{} instead of {}: {} starts there, past its limit by rounding only",
                Number(start),
                Number(limit),
                names.joint(joint)
            )));
        };
        if let Some(&start_deg) = initial.joint_angles_deg.get(joint) {
            widen_angles(&mut row, start_deg, &mut note);
        }
        if let Some(&start_deg_s) = rates_deg_s.get(joint) {
            widen_rate(&mut row, start_deg_s.abs(), &mut note);
        }
        system.set_limits(&row);
    }
}

fn widen_angles(row: &mut file::JointRow, start_deg: f64, note: &mut impl FnMut(&str, f64, f64)) {
    let is_rounding =
        |past_deg: f64| 0.0 < past_deg && past_deg <= PRINTED_DEG.max(PRINTED * start_deg.abs());
    let is_locked = row.angle_min_deg.is_some() && row.angle_min_deg == row.angle_max_deg;
    if let Some(min_deg) = row.angle_min_deg.filter(|min_deg| is_rounding(min_deg - start_deg)) {
        note("angle_min_deg", min_deg, start_deg);
        row.angle_min_deg = Some(start_deg);
        row.angle_max_deg = if is_locked { Some(start_deg) } else { row.angle_max_deg };
    } else if let Some(max_deg) =
        row.angle_max_deg.filter(|max_deg| is_rounding(start_deg - max_deg))
    {
        note("angle_max_deg", max_deg, start_deg);
        row.angle_max_deg = Some(start_deg);
        row.angle_min_deg = if is_locked { Some(start_deg) } else { row.angle_min_deg };
    }
}

fn widen_rate(row: &mut file::JointRow, start_deg_s: f64, note: &mut impl FnMut(&str, f64, f64)) {
    let Some(limit_deg_s) = row.rate_max_deg_s else { return };
    let past_deg_s = start_deg_s - limit_deg_s;
    if 0.0 < past_deg_s && past_deg_s <= PRINTED * limit_deg_s {
        note("rate_max_deg_s", limit_deg_s, start_deg_s);
        row.rate_max_deg_s = Some(start_deg_s);
    }
}
