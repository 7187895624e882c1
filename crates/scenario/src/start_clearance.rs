//! Whether a maneuver starts clear, and which links may start inside the keep-out sphere.
//!
//! One rule for `body_exempt`: a link that starts inside the keep-out sphere with its clearance is
//! refused unless it is exempt, and one that starts outside is refused if it is.

use crate::collision::{Between, Clearance, CollisionModel, distance_to_body, has_length};
use crate::error::Error;
use crate::halton::Halton;
use crate::json::{Location, Number};
use crate::rounding::{COMPUTED, PRINTED};
use crate::system_description::SystemDescription;

/// Arm postures tried to see whether an exempt link can leave the keep-out sphere.
const SAMPLES: usize = 2000;
/// As many of the links that start too close are named.
const MOST_NAMED: usize = 4;

/// A start whose clearances are looked at.
pub(crate) struct Start<'a> {
    pub system: &'a SystemDescription,
    pub joint_angles_rad: &'a [f64],
    /// Where the joint angles stand.
    pub angles: Location,
    /// Where the system's links stand.
    pub links: Location,
    /// Where the clearance stands, or would.
    pub clearance: Location,
}

impl Start<'_> {
    /// The clearances that this start keeps: of `clearance_m`, or of what it has where that is less by
    /// no more than the rounding of printed joint angles. A note says so.
    ///
    /// # Errors
    /// A link that starts too close to something, or that is exempt without need.
    pub fn collision_model(
        &self,
        clearance_m: f64,
        notes: &mut Vec<String>,
    ) -> Result<CollisionModel, Error> {
        let asked = CollisionModel::new(self.system, clearance_m);
        for (a, b, between_m) in asked.neighbors_across_links(&self.system.model) {
            notes.push(self.clearance.note(format_args!(
                "links {} and {} are never farther apart than what is between them, {} m: no \
                 clearance is kept between them",
                a + 1,
                b + 1,
                Number::rounded(between_m, 3)
            )));
        }
        self.check_exemptions(&asked, notes)?;
        let missing_m = self.missing_m(&asked);
        if missing_m <= self.slack_m() {
            return Ok(asked);
        }
        let lowered_m = clearance_m - missing_m;
        let is_rounding = missing_m <= PRINTED * self.reach_m() && lowered_m >= 0.0;
        let lowered = CollisionModel::new(self.system, lowered_m);
        if !is_rounding || !self.is_good(&lowered) {
            return Err(self.refusal(&asked));
        }
        notes.push(self.clearance.note(format_args!(
            "{} instead of {}: the start has no more, by rounding only",
            Number(lowered_m),
            Number(clearance_m)
        )));
        Ok(lowered)
    }

    /// How far the arm reaches from the base's center of mass, m: the size of what is rounded.
    fn reach_m(&self) -> f64 {
        let model = &self.system.model;
        model.mount().position_m.norm() + model.length_m()
    }

    /// How far inside a clearance arithmetic alone may put a start, m.
    fn slack_m(&self) -> f64 {
        COMPUTED * self.reach_m()
    }

    fn clearances(&self, collision: &CollisionModel) -> Vec<Clearance> {
        let posture = self.system.model.kinematics(self.joint_angles_rad);
        collision.clearances(&posture).collect()
    }

    /// The most that a distance at the start lacks, m; less than zero if none lacks any.
    fn missing_m(&self, collision: &CollisionModel) -> f64 {
        let clearances = self.clearances(collision).into_iter();
        let missing_m = clearances.map(|clearance| clearance.least_m - clearance.distance_m);
        missing_m.fold(f64::NEG_INFINITY, f64::max)
    }

    /// An exempt link that starts outside the keep-out sphere with its clearance, and its distance from
    /// the base's center of mass, m.
    fn needless_exemption(&self, collision: &CollisionModel) -> Option<(usize, f64)> {
        let posture = self.system.model.kinematics(self.joint_angles_rad);
        let inside_m = collision.body_distance_m + self.slack_m();
        self.exempt()
            .map(|link| (link, distance_to_body(&posture, link)))
            .find(|&(_, distance_m)| distance_m > inside_m)
    }

    /// Exempt links with length.
    fn exempt(&self) -> impl Iterator<Item = usize> {
        let system = self.system;
        (0..system.joint_count())
            .filter(move |&link| system.body_exempt[link] && has_length(&system.model, link))
    }

    /// Whether nothing is too close and nothing exempt without need.
    fn is_good(&self, collision: &CollisionModel) -> bool {
        self.missing_m(collision) <= self.slack_m() && self.needless_exemption(collision).is_none()
    }

    /// What is too close, and which fields to change.
    fn refusal(&self, collision: &CollisionModel) -> Error {
        let mut close = self.clearances(collision);
        close.retain(|clearance| clearance.distance_m < clearance.least_m - self.slack_m());
        let mut found: Vec<String> = close.iter().take(MOST_NAMED).map(distance).collect();
        if close.len() > MOST_NAMED {
            found.push(format!("{} more too close", close.len() - MOST_NAMED));
        }
        let inside: Vec<usize> = close
            .iter()
            .filter_map(|clearance| match clearance.between {
                Between::LinkAndBody(link) => Some(link),
                Between::Links(..) => None,
            })
            .collect();
        let mut least = Vec::new();
        if !inside.is_empty() {
            let body_m = meters(collision.body_distance_m);
            least.push(format!("{body_m} m, keep-out radius and clearance"));
        }
        if inside.len() < close.len() {
            least.push(format!("the clearance, {} m", meters(collision.clearance_m)));
        }
        let mut expected = format!("at least {}", least.join(", and between links "));
        let ways_out = self.ways_out(collision.clearance_m, &inside);
        if !ways_out.is_empty() {
            expected.push_str(&format!(" (or set {})", ways_out.join(", or ")));
        }
        self.angles.refuse(format!("a start with {}", found.join(", ")), expected)
    }

    /// Fields that make this start a good one. Each was tried.
    fn ways_out(&self, clearance_m: f64, inside: &[usize]) -> Vec<String> {
        let mut exempting = self.system.clone();
        for &link in inside {
            exempting.body_exempt[link] = true;
        }
        let exempting = self.of(&exempting);
        let exempt = |&link: &usize| self.links.index(link).key("body_exempt").path().to_owned();
        let exempt = inside.iter().map(exempt).collect::<Vec<_>>().join(" and ");
        let lower = |start: &Start<'_>| {
            let asked = CollisionModel::new(start.system, clearance_m);
            let has_m = clearance_m - start.missing_m(&asked);
            let lower_m = if has_m > 0.0 { rounded_down(has_m) } else { has_m };
            (lower_m >= 0.0 && start.is_good(&CollisionModel::new(start.system, lower_m)))
                .then(|| format!("{} to {}", self.clearance.path(), Number(lower_m)))
        };
        let mut ways_out = Vec::new();
        if !inside.is_empty()
            && exempting.is_good(&CollisionModel::new(exempting.system, clearance_m))
        {
            ways_out.push(exempt.clone());
        }
        ways_out.extend(lower(self));
        if ways_out.is_empty() && !inside.is_empty() {
            ways_out.extend(lower(&exempting).map(|lower| format!("{exempt}, and {lower}")));
        }
        ways_out
    }

    /// The same start of another system.
    fn of<'a>(&'a self, system: &'a SystemDescription) -> Start<'a> {
        Start {
            system,
            joint_angles_rad: self.joint_angles_rad,
            angles: self.angles.clone(),
            links: self.links.clone(),
            clearance: self.clearance.clone(),
        }
    }

    /// Refuses an exemption that the start does not need, and notes that of a link that can leave the
    /// keep-out sphere.
    fn check_exemptions(
        &self,
        collision: &CollisionModel,
        notes: &mut Vec<String>,
    ) -> Result<(), Error> {
        if let Some((link, distance_m)) = self.needless_exemption(collision) {
            let allowed = format!(
                "false: link {} starts {} m from the base's center of mass, outside the keep-out \
                 sphere with its clearance, {} m",
                link + 1,
                meters(distance_m),
                meters(collision.body_distance_m)
            );
            return Err(self.links.index(link).key("body_exempt").refuse(true, allowed));
        }
        let exempt: Vec<usize> = self.exempt().collect();
        if exempt.is_empty() {
            return Ok(());
        }
        let joints = self.system.joint_count();
        let mut farthest_m = vec![0.0_f64; joints];
        for sample in Halton::new(joints).take(SAMPLES) {
            let posture = self.system.model.kinematics(&self.system.joint_angles_at(&sample));
            for &link in &exempt {
                farthest_m[link] = farthest_m[link].max(distance_to_body(&posture, link));
            }
        }
        let inside_m = collision.body_distance_m + self.slack_m();
        for link in exempt.into_iter().filter(|&link| farthest_m[link] > inside_m) {
            notes.push(self.links.index(link).key("body_exempt").note(format_args!(
                "link {} starts inside the keep-out sphere and can leave it: it is not kept away \
                 from the base anywhere",
                link + 1
            )));
        }
        Ok(())
    }
}

/// Such as "links 1 and 3 0.04 m apart".
fn distance(clearance: &Clearance) -> String {
    let distance_m = meters(clearance.distance_m);
    match clearance.between {
        Between::LinkAndBody(link) => {
            format!("link {} {distance_m} m from the base's center of mass", link + 1)
        }
        Between::Links(a, b) => format!("links {} and {} {distance_m} m apart", a + 1, b + 1),
    }
}

/// A length as a message gives it.
fn meters(length_m: f64) -> Number {
    Number::rounded(length_m, 6)
}

/// A positive number rounded down to three significant digits.
fn rounded_down(value: f64) -> f64 {
    let scale = 10.0_f64.powi(2 - value.log10().floor() as i32);
    let Number(rounded) = Number::rounded((value * scale).floor() / scale, 3);
    rounded
}
