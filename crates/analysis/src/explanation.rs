//! What an arm can do in numbers, as explain.json holds it.

use righting_scenario::{Maneuver, Scenario, Slew, SystemDescription};
use schemars::JsonSchema;
use serde::Serialize;

use crate::abilities::Abilities;
use crate::detumble::rate_bound_rad_s;
use crate::impossible::Impossible;

/// What an arm can do, and what a scenario asks. Joints are counted from one, vectors are in body axes.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Righting explain")]
pub struct Explanation<'a> {
    /// "righting.explain/1".
    pub schema: &'static str,
    /// Name of the system.
    pub system: &'a str,
    /// Name of the scenario, if one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scenario: Option<&'a str>,
    /// Number of joints.
    pub joints: usize,
    /// Joints whose limits leave them no motion.
    pub locked_joints: Vec<usize>,
    /// Joints that move, but neither turn the base nor change how the others do.
    pub idle_joints: Vec<usize>,
    /// Dimensions of the group that the base's attitudes stay in: 0 (it does not turn), 1 (about one axis)
    /// or 3 (about every axis, unless only one joint counts).
    pub rank: usize,
    /// The only axis about which the base turns; absent if the rank is not 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub only_axis: Option<[f64; 3]>,
    /// How far the base turns a radian of a joint, root mean square over the joints' ranges, about the three
    /// axes for which that is most and least, rad/rad.
    pub singular_values: [f64; 3],
    /// No motion of the joints turns the base faster, as far as postures were looked at, deg/s.
    pub fastest_deg_s: f64,
    /// Loops of the joints through the posture at the start, or the middle one of a system.
    pub loops: Loops,
    /// Inertia of the whole system with its joints held, over the postures within limits and clearances.
    pub inertia: Inertia,
    /// Present for a scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub maneuver: Option<Asked>,
}

/// Loops of the joints through one posture.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Loops {
    /// How many were looked at.
    pub count: usize,
    /// The axes about which they turn the base most, less and least.
    pub principal_axes: [[f64; 3]; 3],
    /// How far a loop turns it about each, root mean square, deg.
    pub turns_deg: [f64; 3],
    /// How fast the best mixture of them turns it about each, deg/s.
    pub rates_deg_s: [f64; 3],
}

/// Principal inertias of the whole system.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Inertia {
    /// Smallest principal inertia, kg m².
    pub smallest_kg_m2: f64,
    /// Largest principal inertia, kg m².
    pub largest_kg_m2: f64,
    /// Their ratio: no detumble divides a rate by more.
    pub best_detumble_factor: f64,
}

/// What a scenario asks, beside what its arm can do.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Asked {
    /// "slew" or "detumble".
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// Duration asked, s.
    pub duration_s: f64,
    /// Whether nothing is known that makes it impossible. That is no promise of a plan.
    pub possible: bool,
    /// Why it is impossible.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Where the axis is what makes it impossible: those about which the base can turn by the angle asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub possible_axes: Option<Vec<[f64; 3]>>,
    /// Slew: the axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// Slew: the angle, deg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// Slew: how many attitudes it reaches on its way; absent without any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waypoints: Option<usize>,
    /// Slew by an arm that turns the base about one axis only: the angle between that axis and the one asked,
    /// deg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub off_axis_deg: Option<f64>,
    /// Slew: how fast loops turn the base about the axis, deg/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate_deg_s: Option<f64>,
    /// Slew: a first estimate of the time needed, s; absent where no motion looked at turns the base about
    /// the axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimated_s: Option<f64>,
    /// Slew: the joints' rates do not allow less, as far as postures were looked at, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_s: Option<f64>,
    /// Detumble: the rate left by stopping the arm where it starts, deg/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_deg_s: Option<f64>,
    /// Detumble: no motion that stops the arm leaves less, deg/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound_deg_s: Option<f64>,
}

impl<'a> Explanation<'a> {
    /// Of a system, with loops through the middle posture and the clearance that scenarios have by default.
    pub fn of_system(system: &'a SystemDescription) -> Self {
        Self::new(system, None, &Abilities::of_system(system))
    }

    /// Of a scenario's system, with loops through the posture at its start, and of its maneuver.
    pub fn of_scenario(scenario: &'a Scenario) -> Self {
        Self::new(scenario.system(), Some(scenario), &Abilities::of_scenario(scenario))
    }

    /// Of abilities that are known: those of `system`, which is the scenario's if one is given.
    pub fn new(
        system: &'a SystemDescription,
        scenario: Option<&'a Scenario>,
        abilities: &Abilities,
    ) -> Self {
        let Abilities { axes, rates, inertia_range_kg_m2 } = abilities;
        let counted = |joints: &[usize]| joints.iter().map(|joint| joint + 1).collect();
        let [smallest_kg_m2, largest_kg_m2] = *inertia_range_kg_m2;
        Self {
            schema: "righting.explain/1",
            system: &system.name,
            scenario: scenario.map(Scenario::name),
            joints: system.joint_count(),
            locked_joints: counted(&axes.locked_joints),
            idle_joints: counted(&axes.idle_joints),
            rank: axes.rank(),
            only_axis: axes.only_axis().map(Into::into),
            singular_values: axes.singular_values,
            fastest_deg_s: axes.fastest_rad_s.to_degrees(),
            loops: Loops {
                count: rates.loops,
                principal_axes: rates.principal_axes.map(Into::into),
                turns_deg: rates.turns_rad.map(f64::to_degrees),
                rates_deg_s: rates.rates_rad_s.map(f64::to_degrees),
            },
            inertia: Inertia {
                smallest_kg_m2,
                largest_kg_m2,
                best_detumble_factor: abilities.best_detumble_factor(),
            },
            maneuver: scenario.map(|scenario| asked(scenario, abilities)),
        }
    }
}

fn asked(scenario: &Scenario, abilities: &Abilities) -> Asked {
    let reason = Impossible::of(scenario);
    let axes = |reason: &Impossible| {
        let axes = reason.possible_axes();
        (!axes.is_empty()).then(|| axes.iter().map(|axis| (*axis).into()).collect())
    };
    let (slew, is_detumble) = match scenario.maneuver() {
        Maneuver::Slew(slew) => (Some(slew), false),
        Maneuver::Detumble => (None, true),
    };
    // Of a slew with waypoints those of its legs, one after the other.
    let turns = |slew: &Slew| -> Vec<Slew> {
        let legs = scenario.legs().into_iter();
        match scenario.waypoints() {
            [] => vec![slew.clone()],
            _ => legs
                .filter_map(|leg| scenario.clone().with_leg(&leg).maneuver().slew().cloned())
                .collect(),
        }
    };
    let estimated_s = |slew: &Slew| -> Option<f64> {
        turns(slew).iter().map(|turn| abilities.rates.duration_s(&turn.axis, turn.angle_rad)).sum()
    };
    let least_s = |slew: &Slew| match turns(slew).iter().map(|turn| turn.angle_rad.abs()).sum() {
        0.0 => Some(0.0),
        angle => Some(angle / abilities.axes.fastest_rad_s).filter(|least| least.is_finite()),
    };
    Asked {
        kind: if is_detumble { "detumble" } else { "slew" },
        duration_s: scenario.horizon().duration_s,
        possible: reason.is_none(),
        possible_axes: reason.as_ref().and_then(axes),
        axis: slew.map(|slew| slew.axis.into()),
        angle_deg: slew.map(|slew| slew.angle_rad.to_degrees()),
        waypoints: Some(scenario.waypoints().len()).filter(|count| *count > 0),
        off_axis_deg: slew
            .and_then(|slew| abilities.axes.off_axis_rad(&slew.axis))
            .map(f64::to_degrees),
        rate_deg_s: slew.map(|slew| abilities.rates.about(&slew.axis).to_degrees()),
        estimated_s: slew.filter(|_| reason.is_none()).and_then(estimated_s),
        least_s: slew.and_then(least_s),
        stopped_deg_s: is_detumble.then(|| scenario.stopped_rate_rad_s().to_degrees()),
        bound_deg_s: is_detumble.then(|| rate_bound_rad_s(scenario).to_degrees()),
        reason: reason.map(|reason| reason.to_string()),
    }
}
