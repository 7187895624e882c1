//! Joint limits that a start is past by rounding.

use righting_multibody::JointKind;

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
    let kinds = system.joint_kinds();
    let coordinates =
        file::in_joint_order(&kinds, &initial.joint_angles_deg, &initial.joint_travels_m);
    let rates = initial.rates_in_joint_order(&kinds);
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
        if let Some(&start) = coordinates.get(joint) {
            widen_range(&mut row, start, &mut note);
        }
        if let Some(&start) = rates.get(joint) {
            widen_rate(&mut row, start.abs(), &mut note);
        }
        system.set_limits(&row);
    }
}

fn widen_range(row: &mut file::JointRow, start: f64, note: &mut impl FnMut(&str, f64, f64)) {
    let least = match row.kind {
        JointKind::Revolute => PRINTED_DEG,
        JointKind::Prismatic => 0.0,
    };
    let range = row.max.unwrap_or(0.0) - row.min.unwrap_or(0.0);
    let scale = match row.kind {
        JointKind::Revolute => start.abs(),
        // What is printed of a travel has the digits of the range that it is in.
        JointKind::Prismatic => start.abs().max(range),
    };
    let is_rounding = |past: f64| 0.0 < past && past <= least.max(PRINTED * scale);
    let words = row.words();
    let is_locked = row.min.is_some() && row.min == row.max;
    if let Some(min) = row.min.filter(|min| is_rounding(min - start)) {
        note(words.min, min, start);
        row.min = Some(start);
        row.max = if is_locked { Some(start) } else { row.max };
    } else if let Some(max) = row.max.filter(|max| is_rounding(start - max)) {
        note(words.max, max, start);
        row.max = Some(start);
        row.min = if is_locked { Some(start) } else { row.min };
    }
}

fn widen_rate(row: &mut file::JointRow, start: f64, note: &mut impl FnMut(&str, f64, f64)) {
    let Some(limit) = row.rate_max else { return };
    let past = start - limit;
    if 0.0 < past && past <= PRINTED * limit {
        note(row.words().rate_max, limit, start);
        row.rate_max = Some(start);
    }
}
