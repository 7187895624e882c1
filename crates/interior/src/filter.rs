//! Which trial points the line search takes. (Wächter & Biegler 2006, section 2.3.)

const ETA_PHI: f64 = 1e-8;
const DELTA: f64 = 1.0;
const S_PHI: f64 = 2.3;
const S_THETA: f64 = 1.1;
const GAMMA_PHI: f64 = 1e-8;
const GAMMA_THETA: f64 = 1e-5;
const ALPHA_MIN_FRACTION: f64 = 0.05;
const THETA_MAX_FACTOR: f64 = 1e4;
const THETA_MIN_FACTOR: f64 = 1e-4;
/// The barrier function may grow by so many orders of magnitude.
const MOST_GROWTH: f64 = 5.0;
/// After so many iterations whose last rejection was due to the filter it is emptied.
const FILTER_RESET_TRIGGER: usize = 5;

/// What the line search compares: constraint violation θ (1-norm) and barrier function φ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Merit {
    pub(crate) violation: f64,
    pub(crate) barrier: f64,
}

/// Where a line search starts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reference {
    pub(crate) merit: Merit,
    /// ∇φ along the step.
    pub(crate) slope: f64,
}

/// Pairs of θ and φ that no later point may be worse than in both.
#[derive(Debug, Default)]
pub(crate) struct Filter {
    entries: Vec<Merit>,
    /// θ_max and θ_min, from the first line search on.
    limits: Option<(f64, f64)>,
    rejected_last: bool,
    rejections: usize,
}

impl Filter {
    pub(crate) fn reset(&mut self) {
        self.entries.clear();
        self.rejected_last = false;
        self.rejections = 0;
    }

    /// The step length at which the search is given up.
    pub(crate) fn least_step(&self, reference: &Reference) -> f64 {
        let Reference { merit: Merit { violation, .. }, slope } = *reference;
        let mut least = GAMMA_THETA;
        if slope < 0.0 {
            least = least.min(GAMMA_PHI * violation / -slope);
            if self.limits.is_some_and(|(_, theta_min)| violation <= theta_min) {
                least = least.min(DELTA * violation.powf(S_THETA) / (-slope).powf(S_PHI));
            }
        }
        ALPHA_MIN_FRACTION * least
    }

    /// Whether a trial point may be taken.
    pub(crate) fn accepts(&mut self, reference: &Reference, step: f64, trial: &Merit) -> bool {
        let violation = reference.merit.violation.max(1.0);
        let limits = (THETA_MAX_FACTOR * violation, THETA_MIN_FACTOR * violation);
        let (theta_max, theta_min) = *self.limits.get_or_insert(limits);
        if trial.violation > theta_max {
            return false;
        }
        let improves = match switches(reference, step) && reference.merit.violation <= theta_min {
            true => descends(reference, step, trial),
            false => is_better(&reference.merit, trial),
        };
        if !improves {
            self.rejected_last = false;
            return false;
        }
        let passes =
            |entry: &Merit| trial.barrier <= entry.barrier || trial.violation <= entry.violation;
        if !self.entries.iter().all(passes) {
            self.rejected_last = true;
            return false;
        }
        if self.rejected_last {
            self.rejections += 1;
            if self.rejections >= FILTER_RESET_TRIGGER {
                self.reset();
            }
        } else {
            self.rejections = 0;
        }
        self.rejected_last = false;
        true
    }

    /// Remembers where the step came from unless it was one of descent.
    pub(crate) fn step_taken(&mut self, reference: &Reference, step: f64, trial: &Merit) {
        if switches(reference, step) && descends(reference, step, trial) {
            return;
        }
        let Merit { violation, barrier } = reference.merit;
        let entry = Merit {
            violation: (1.0 - GAMMA_THETA) * violation,
            barrier: barrier - GAMMA_PHI * violation,
        };
        self.entries.retain(|old| old.barrier < entry.barrier || old.violation < entry.violation);
        self.entries.push(entry);
    }
}

/// Whether the step promises more descent of φ than there is violation to reduce.
fn switches(reference: &Reference, step: f64) -> bool {
    let Reference { merit: Merit { violation, .. }, slope } = *reference;
    slope < 0.0 && step * (-slope).powf(S_PHI) > DELTA * violation.powf(S_THETA)
}

/// Armijo's condition.
fn descends(reference: &Reference, step: f64, trial: &Merit) -> bool {
    let before = reference.merit.barrier;
    at_most(trial.barrier - before, ETA_PHI * step * reference.slope, before)
}

fn is_better(before: &Merit, trial: &Merit) -> bool {
    let growth = trial.barrier - before.barrier;
    if growth > 0.0 {
        let size = before.barrier.abs();
        let order = if size > 10.0 { size.log10() } else { 1.0 };
        if growth.log10() > MOST_GROWTH + order {
            return false;
        }
    }
    at_most(trial.violation, (1.0 - GAMMA_THETA) * before.violation, before.violation)
        || at_most(growth, -GAMMA_PHI * before.violation, before.barrier)
}

/// a ≤ b up to the rounding of numbers of this size.
fn at_most(a: f64, b: f64, size: f64) -> bool {
    a - b <= 10.0 * f64::EPSILON * size.abs()
}
