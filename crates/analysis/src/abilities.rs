//! What an arm can do at all.

use righting_scenario::scenario::DEFAULT_CLEARANCE_M;
use righting_scenario::{CollisionModel, Scenario, SystemDescription};

use crate::detumble::inertia_range_kg_m2;
use crate::holonomy::{TurnRates, TurnableAxes};

/// What an arm can do to its base, before any maneuver is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Abilities {
    /// About which axes it turns the base.
    pub axes: TurnableAxes,
    /// How fast, by loops through one posture.
    pub rates: TurnRates,
    /// The smallest and the largest principal inertia of the whole system with its joints held, kg m².
    pub inertia_range_kg_m2: [f64; 2],
}

impl Abilities {
    /// Of a system: loops go through the posture `start_rad` (one angle a joint, rad) and ignore clearances,
    /// inertias are of postures that keep those of `collision`.
    ///
    /// # Panics
    /// `start_rad` does not have one angle a joint.
    pub fn of(system: &SystemDescription, start_rad: &[f64], collision: &CollisionModel) -> Self {
        Self {
            axes: TurnableAxes::new(system),
            rates: TurnRates::new(system, start_rad),
            inertia_range_kg_m2: inertia_range_kg_m2(system, collision),
        }
    }

    /// Of a system, with loops through the middle posture and the clearance that scenarios have by default.
    pub fn of_system(system: &SystemDescription) -> Self {
        let middle = system.joint_angles_at(&vec![0.5; system.joint_count()]);
        Self::of(system, &middle, &CollisionModel::new(system, DEFAULT_CLEARANCE_M))
    }

    /// Of a scenario's system, with loops through the posture at its start.
    pub fn of_scenario(scenario: &Scenario) -> Self {
        let start = &scenario.initial().joint_angles_rad;
        Self::of(scenario.system(), start, scenario.collision())
    }

    /// The most by which a detumble can divide a rate: that of a spin about the axis of the smallest inertia
    /// that ends about the axis of the largest.
    pub fn best_detumble_factor(&self) -> f64 {
        let [smallest, largest] = self.inertia_range_kg_m2;
        largest / smallest
    }
}
