//! What many flights say together.

use std::time::Duration;

use schemars::JsonSchema;
use serde::Serialize;

use crate::end::End;
use crate::flight::Flight;

/// How values are spread; null where there are none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Distribution {
    /// Half are no larger.
    pub median: Option<f64>,
    /// 95 % are no larger.
    pub p95: Option<f64>,
    /// The largest.
    pub max: Option<f64>,
}

/// How long replans took, ms; null where there were none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Latency {
    /// Half took no longer.
    pub median: Option<f64>,
    /// 99.9 % took no longer.
    pub p999: Option<f64>,
    /// The longest.
    pub max: Option<f64>,
}

/// The ends of flights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Ends {
    /// Angle between the attitude at the end and the target, deg.
    pub final_error_deg: Distribution,
    /// Angular rate of the base at the end, deg/s.
    pub final_rate_deg_s: Distribution,
}

/// Many flights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Summary {
    /// How many.
    pub flights: usize,
    /// Those that could be followed to their end both ways.
    pub completed: usize,
    /// Replans that were missed, in all.
    pub missed_replans: usize,
    /// Measurements that were lost, in all.
    pub lost_measurements: usize,
    /// With what is done about it.
    #[serde(flatten)]
    pub flown: Ends,
    /// Wall time of the replans.
    pub replan_ms: Latency,
    /// The same plants flown open loop.
    pub open_loop: Ends,
}

impl Summary {
    /// Of flights in any order.
    pub fn of(flights: &[Flight]) -> Self {
        let is_completed = |flight: &&Flight| {
            flight.flown.is_finite() && flight.open_loop.is_none_or(|end| end.is_finite())
        };
        let replans = flights.iter().flat_map(|flight| &flight.log.replans);
        let times_ms = sorted(replans.map(|time: &Duration| 1e3 * time.as_secs_f64()));
        Self {
            flights: flights.len(),
            completed: flights.iter().filter(is_completed).count(),
            missed_replans: flights.iter().map(|flight| flight.log.missed).sum(),
            lost_measurements: flights.iter().map(|flight| flight.log.lost).sum(),
            flown: Ends::of(flights.iter().map(|flight| flight.flown)),
            replan_ms: Latency {
                median: quantile(&times_ms, 0.5),
                p999: quantile(&times_ms, 0.999),
                max: times_ms.last().copied(),
            },
            open_loop: Ends::of(flights.iter().filter_map(|flight| flight.open_loop)),
        }
    }
}

impl Ends {
    fn of(ends: impl Iterator<Item = End> + Clone) -> Self {
        Self {
            final_error_deg: Distribution::of(ends.clone().map(|end| end.error_rad.to_degrees())),
            final_rate_deg_s: Distribution::of(ends.map(|end| end.rate_rad_s.to_degrees())),
        }
    }
}

impl Distribution {
    /// Of values in any order; those that are no numbers are left out.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let sorted = sorted(values);
        Self {
            median: quantile(&sorted, 0.5),
            p95: quantile(&sorted, 0.95),
            max: sorted.last().copied(),
        }
    }
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The least value that so large a share does not exceed.
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let rank = ((share * sorted.len() as f64).ceil() as usize).max(1);
    sorted.get(rank - 1).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values_that_were_there() {
        let of_20 = Distribution::of((1..=20).rev().map(f64::from));
        assert_eq!(of_20.median, Some(10.0));
        assert_eq!(of_20.p95, Some(19.0));
        assert_eq!(of_20.max, Some(20.0));
        let with_a_lost_one = Distribution::of([f64::NAN, 3.0].into_iter());
        assert_eq!(with_a_lost_one.p95, Some(3.0));
        assert_eq!(Distribution::of(std::iter::empty()).median, None);
    }
}
