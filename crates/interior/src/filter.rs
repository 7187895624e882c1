//! Which trial points the line search accepts (W&B section 2.3).

/// γ_θ: relative decrease of θ that suffices (W&B eq. 18; option `gamma_theta`).
const GAMMA_THETA: f64 = 1e-5;
/// γ_φ: decrease of φ that suffices, relative to θ (W&B eq. 18; option `gamma_phi`).
const GAMMA_PHI: f64 = 1e-8;
/// δ of the switching condition (W&B eq. 19; option `delta`).
const DELTA: f64 = 1.0;
/// s_φ of the switching condition (W&B eq. 19; option `s_phi`).
const S_PHI: f64 = 2.3;
/// s_θ of the switching condition (W&B eq. 19; option `s_theta`).
const S_THETA: f64 = 1.1;
/// η_φ of the Armijo condition (W&B eq. 20; option `eta_phi`).
const ETA_PHI: f64 = 1e-8;
/// γ_α of the least step length (W&B eq. 23; option `alpha_min_frac`).
const ALPHA_MIN_FRACTION: f64 = 0.05;
/// θ_max over the violation at the start, or one (W&B eq. 21; option `theta_max_fact`).
const THETA_MAX_FACTOR: f64 = 1e4;
/// θ_min over the violation at the start, or one (W&B before eq. 19; option `theta_min_fact`).
const THETA_MIN_FACTOR: f64 = 1e-4;
/// By how much φ may grow, relative to its size (option `obj_max_inc`, five orders of magnitude) …
const MOST_GROWTH: f64 = 1e5;
/// … which counts as this at least: φ of no size would forbid all growth.
const LEAST_SIZE: f64 = 10.0;
/// After so many line searches in a row whose last rejection was due to the filter it is emptied
/// (W&B section 3.2; option `filter_reset_trigger`).
const FILTER_RESET_TRIGGER: usize = 5;
/// So often at most (option `max_filter_resets`).
const MOST_FILTER_RESETS: usize = 5;
/// Rounding errors of φ and θ, in units of their last place: smaller differences tell nothing. W&B
/// relax their tests by as much.
const ROUNDING: f64 = 10.0 * f64::EPSILON;

/// What the line search compares: the constraint violation θ = ‖c‖₁ and the barrier function φ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Measures {
    pub(crate) violation: f64,
    pub(crate) barrier: f64,
}

/// Where a line search starts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ReferencePoint {
    pub(crate) measures: Measures,
    /// ∇φᵀ d.
    pub(crate) slope: f64,
}

/// Pairs of θ and φ that no later point may be worse than in both.
#[derive(Debug, Default)]
pub(crate) struct Filter {
    entries: Vec<Measures>,
    /// θ_max and θ_min, from the first line search on.
    limits: Option<(f64, f64)>,
    /// Whether the last rejection was due to the filter.
    rejected_last: bool,
    /// Line searches in a row of which that is true.
    rejections: usize,
    /// How often they have emptied it.
    resets: usize,
}

impl Filter {
    pub(crate) fn reset(&mut self) {
        self.entries.clear();
        self.rejected_last = false;
        self.rejections = 0;
    }

    /// α_min, the step length at which the line search is given up (W&B eq. 23).
    pub(crate) fn least_step(&self, reference: &ReferencePoint) -> f64 {
        let ReferencePoint { measures: Measures { violation, .. }, slope } = *reference;
        let mut least = GAMMA_THETA;
        if slope < 0.0 {
            least = least.min(GAMMA_PHI * violation / -slope);
            if self.limits.is_some_and(|(_, theta_min)| violation <= theta_min) {
                least = least.min(DELTA * violation.powf(S_THETA) / (-slope).powf(S_PHI));
            }
        }
        ALPHA_MIN_FRACTION * least
    }

    /// Whether a trial point may be accepted (step ).
    pub(crate) fn accepts(
        &mut self,
        reference: &ReferencePoint,
        step: f64,
        trial: &Measures,
    ) -> bool {
        let violation = reference.measures.violation.max(1.0);
        let limits = (THETA_MAX_FACTOR * violation, THETA_MIN_FACTOR * violation);
        let (theta_max, theta_min) = *self.limits.get_or_insert(limits);
        if trial.violation > theta_max {
            return false;
        }
        let is_descent_step =
            switching_condition(reference, step) && reference.measures.violation <= theta_min;
        let improves = match is_descent_step {
            true => armijo_condition(reference, step, trial),
            false => sufficient_progress(&reference.measures, trial),
        };
        if !improves {
            self.rejected_last = false;
            return false;
        }
        let passes =
            |entry: &Measures| trial.barrier <= entry.barrier || trial.violation <= entry.violation;
        if !self.entries.iter().all(passes) {
            self.rejected_last = true;
            return false;
        }
        if self.rejected_last {
            self.rejections += 1;
            if self.rejections >= FILTER_RESET_TRIGGER && self.resets < MOST_FILTER_RESETS {
                self.reset();
                self.resets += 1;
            }
        } else {
            self.rejections = 0;
        }
        self.rejected_last = false;
        true
    }

    /// Adds where an accepted step came from, unless it was one of descent (W&B eq. 22).
    pub(crate) fn augment(&mut self, reference: &ReferencePoint, step: f64, trial: &Measures) {
        if switching_condition(reference, step) && armijo_condition(reference, step, trial) {
            return;
        }
        let Measures { violation, barrier } = reference.measures;
        let entry = Measures {
            violation: (1.0 - GAMMA_THETA) * violation,
            barrier: barrier - GAMMA_PHI * violation,
        };
        // What the new entry dominates it says as well.
        self.entries.retain(|old| old.barrier < entry.barrier || old.violation < entry.violation);
        self.entries.push(entry);
    }
}

/// Whether the step promises more descent of φ than there is violation to reduce (W&B eq. 19).
fn switching_condition(reference: &ReferencePoint, step: f64) -> bool {
    let ReferencePoint { measures: Measures { violation, .. }, slope } = *reference;
    slope < 0.0 && step * (-slope).powf(S_PHI) > DELTA * violation.powf(S_THETA)
}

/// Whether φ decreases by a fraction of what its slope promises (W&B eq. 20).
fn armijo_condition(reference: &ReferencePoint, step: f64, trial: &Measures) -> bool {
    let before = reference.measures.barrier;
    at_most(trial.barrier - before, ETA_PHI * step * reference.slope, before)
}

/// Whether θ or φ decreases enough (W&B eq. 18), and φ does not grow out of all proportion.
fn sufficient_progress(before: &Measures, trial: &Measures) -> bool {
    let growth = trial.barrier - before.barrier;
    if growth > MOST_GROWTH * before.barrier.abs().max(LEAST_SIZE) {
        return false;
    }
    at_most(trial.violation, (1.0 - GAMMA_THETA) * before.violation, before.violation)
        || at_most(growth, -GAMMA_PHI * before.violation, before.barrier)
}

/// a ≤ b up to the rounding of numbers of this size.
fn at_most(a: f64, b: f64, size: f64) -> bool {
    a - b <= ROUNDING * size.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measures(violation: f64, barrier: f64) -> Measures {
        Measures { violation, barrier }
    }

    fn reference(violation: f64, barrier: f64, slope: f64) -> ReferencePoint {
        ReferencePoint { measures: measures(violation, barrier), slope }
    }

    #[test]
    fn near_feasibility_a_promising_step_has_to_descend() {
        let mut filter = Filter::default();
        let feasible = reference(0.0, 1.0, -1.0);
        assert!(filter.accepts(&feasible, 1.0, &measures(1e-6, 0.5)));
        // Less violation does not make up for a barrier function that grows.
        assert!(!filter.accepts(&feasible, 1.0, &measures(0.0, 1.1)));
        // Far from feasibility either is progress enough.
        let infeasible = reference(10.0, 1.0, -1.0);
        assert!(filter.accepts(&infeasible, 1.0, &measures(9.0, 2.0)));
        assert!(filter.accepts(&infeasible, 1.0, &measures(10.0, 0.5)));
        assert!(!filter.accepts(&infeasible, 1.0, &measures(10.0, 1.0)));
    }

    #[test]
    fn what_a_step_came_from_dominates_later_points_unless_it_descended() {
        let mut filter = Filter::default();
        let start = reference(1.0, 0.0, 0.0);
        filter.augment(&start, 1.0, &measures(0.5, 1.0));
        let later = reference(2.0, 10.0, 0.0);
        assert!(!filter.accepts(&later, 1.0, &measures(1.5, 5.0)));
        assert!(filter.accepts(&later, 1.0, &measures(0.9, 5.0)));

        let mut filter = Filter::default();
        filter.augment(&reference(1e-9, 0.0, -1.0), 1.0, &measures(1e-9, -0.5));
        assert!(filter.accepts(&later, 1.0, &measures(1.5, 5.0)));
    }

    #[test]
    fn five_rejections_in_a_row_empty_the_filter_five_times_at_most() {
        let mut filter = Filter::default();
        let later = reference(2.0, 10.0, 0.0);
        let (dominated, accepted) = (measures(1.5, 5.0), measures(0.5, 5.0));
        for resets in 0..=MOST_FILTER_RESETS {
            filter.augment(&reference(1.0, 0.0, 0.0), 1.0, &accepted);
            for _ in 0..FILTER_RESET_TRIGGER {
                assert!(!filter.accepts(&later, 1.0, &dominated));
                assert!(filter.accepts(&later, 1.0, &accepted));
            }
            let is_empty = filter.accepts(&later, 1.0, &dominated);
            assert_eq!(is_empty, resets < MOST_FILTER_RESETS, "{resets}");
        }
    }

    #[test]
    fn steps_shrink_until_neither_measure_could_improve() {
        let mut filter = Filter::default();
        let ascent = reference(1.0, 0.0, 1.0);
        assert_eq!(filter.least_step(&ascent), ALPHA_MIN_FRACTION * GAMMA_THETA);
        let descent = reference(1.0, 0.0, -1.0);
        assert_eq!(filter.least_step(&descent), ALPHA_MIN_FRACTION * GAMMA_PHI);
        // Within θ_min the switching condition counts as well.
        assert!(filter.accepts(&descent, 1.0, &measures(0.5, 0.0)));
        let nearly = reference(1e-9, 0.0, -1.0);
        let expected = ALPHA_MIN_FRACTION * 1e-9_f64.powf(S_THETA).min(GAMMA_PHI * 1e-9);
        assert_eq!(filter.least_step(&nearly), expected);
    }
}
