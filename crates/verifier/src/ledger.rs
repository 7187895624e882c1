//! Checks as they are made: of each, the worst place only.

use righting_results::verification::{Check, Sense, Verification};
use righting_scenario::collision::Between;
use righting_scenario::{Names, file};

/// How much worse than the worst place so far another has to be to be worth finding, as a share of the
/// tolerance, where the check fails anyway.
const RESOLUTION: f64 = 0.1;

/// The checks made so far.
#[derive(Debug)]
pub(super) struct Ledger {
    pub report: Verification,
    /// What joints and bodies are called.
    names: Names,
}

/// One check, at the place where it is closest to failing so far.
#[derive(Debug)]
pub(super) struct Worst {
    name: &'static str,
    unit: &'static str,
    tolerance: f64,
    is_limit: bool,
    place: Option<Place>,
}

#[derive(Clone, Copy, Debug)]
struct Place {
    value: f64,
    limit: f64,
    sense: Sense,
    subject: Option<Subject>,
    time_s: Option<f64>,
}

/// What a check is about, counted from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    Joint(usize),
    Clearance(Between),
}

impl Subject {
    fn called(&self, names: &Names) -> String {
        match self {
            Self::Joint(joint) => names.joint(*joint),
            Self::Clearance(between) => names.between(between),
        }
    }
}

impl Place {
    /// How far past the limit the value is; NaN if the value is.
    fn excess(&self) -> f64 {
        match self.sense {
            Sense::AtMost => self.value - self.limit,
            Sense::AtLeast => self.limit - self.value,
        }
    }
}

impl Worst {
    pub fn new(name: &'static str, unit: &'static str, tolerance: f64) -> Self {
        Self { name, unit, tolerance, is_limit: false, place: None }
    }

    /// Of a limit that holds along the way.
    pub fn of_limit(name: &'static str, unit: &'static str, tolerance: f64) -> Self {
        Self { is_limit: true, ..Self::new(name, unit, tolerance) }
    }

    /// A value that must not exceed `limit`.
    pub fn at_most(
        &mut self,
        value: f64,
        limit: f64,
        subject: Option<Subject>,
        time_s: Option<f64>,
    ) {
        self.look(Place { value, limit, sense: Sense::AtMost, subject, time_s });
    }

    /// A value that must not fall below `limit`.
    pub fn at_least(
        &mut self,
        value: f64,
        limit: f64,
        subject: Option<Subject>,
        time_s: Option<f64>,
    ) {
        self.look(Place { value, limit, sense: Sense::AtLeast, subject, time_s });
    }

    /// Which values that must not fall below `limit` still count: those that fail, and where the check
    /// fails already those that are worse.
    pub fn counts_below(&self, limit: f64) -> f64 {
        let fails_below = limit - self.tolerance;
        match self.place {
            Some(worst) if worst.value < fails_below => worst.value - RESOLUTION * self.tolerance,
            _ => fails_below,
        }
    }

    /// The value at the worst place; 0 if there was nothing to look at.
    pub fn value(&self) -> f64 {
        self.place.map_or(0.0, |place| place.value)
    }

    /// A value that is not a number is the worst of all, and stays it.
    fn look(&mut self, place: Place) {
        let is_worse = match &self.place {
            None => true,
            Some(worst) if worst.excess().is_nan() => false,
            Some(worst) => place.excess().is_nan() || place.excess() > worst.excess(),
        };
        if is_worse {
            self.place = Some(place);
        }
    }
}

impl Ledger {
    /// What has been checked so far of a system.
    pub fn new(system: &file::System, report: Verification) -> Self {
        Self { report, names: Names::of(system) }
    }

    /// Enters a check, unless there was nothing to look at. Returns whether it passed.
    pub fn add(&mut self, worst: Worst) -> bool {
        let subject = worst.place.and_then(|place| place.subject);
        let subject = subject.map(|subject| subject.called(&self.names));
        self.enter(worst, subject)
    }

    /// As [`add`](Self::add), about something that has a name.
    pub fn add_of(&mut self, worst: Worst, subject: &str) -> bool {
        self.enter(worst, Some(subject.to_owned()))
    }

    fn enter(&mut self, worst: Worst, subject: Option<String>) -> bool {
        let Some(place) = worst.place else { return true };
        let passed = place.excess() <= worst.tolerance;
        self.report.checks.push(Check {
            name: worst.name.to_owned(),
            subject,
            value: place.value,
            limit: place.limit,
            sense: place.sense,
            tolerance: worst.tolerance,
            unit: worst.unit.to_owned(),
            time_s: place.time_s,
            is_limit: worst.is_limit,
            passed,
        });
        passed
    }

    /// Enters a count that must be a certain one.
    pub fn require_equal(&mut self, name: &'static str, found: usize, needed: usize) {
        let mut worst = Worst::new(name, "", 0.0);
        worst.at_most(found as f64, needed as f64, None, None);
        worst.at_least(found as f64, needed as f64, None, None);
        self.add(worst);
    }

    /// The verdict.
    pub fn finish(mut self) -> Verification {
        self.report.passed = self.report.checks.iter().all(|check| check.passed);
        self.report
    }
}
