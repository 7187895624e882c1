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
        let lowered = CollisionModel::new(self.system, lowered_m);
        let is_rounding = missing_m <= PRINTED * self.reach_m() && lowered_m >= 0.0;
        if !is_rounding || self.missing_m(&lowered) > self.slack_m() {
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

    /// What is too close, and which fields to change.
    fn refusal(&self, collision: &CollisionModel) -> Error {
        let meters = |length_m: f64| Number::rounded(length_m, 6);
        let mut close = self.clearances(collision);
        close.retain(|clearance| clearance.distance_m < clearance.least_m - self.slack_m());
        let named = close.iter().take(MOST_NAMED).map(|clearance| {
            let distance_m = meters(clearance.distance_m);
            match clearance.between {
                Between::LinkAndBody(link) => {
                    format!("link {} {distance_m} m from the base's center of mass", link + 1)
                }
                Between::Links(a, b) => {
                    format!("links {} and {} {distance_m} m apart", a + 1, b + 1)
                }
            }
        });
        let mut found = format!("a start with {}", named.collect::<Vec<_>>().join(", "));
        if close.len() > MOST_NAMED {
            found.push_str(&format!(" and {} more too close", close.len() - MOST_NAMED));
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
        self.angles.refuse(found, expected)
    }

    /// Fields that make this start a good one. Each was tried.
    fn ways_out(&self, clearance_m: f64, inside: &[usize]) -> Vec<String> {
        let mut exempting = self.system.clone();
        for &link in inside {
            exempting.body_exempt[link] = true;
        }
        let exempt = |&link: &usize| self.links.index(link).key("body_exempt").path().to_owned();
        let exempt = inside.iter().map(exempt).collect::<Vec<_>>().join(" and ");
        let missing_m = |system: &SystemDescription, clearance_m: f64| {
            self.of(system).missing_m(&CollisionModel::new(system, clearance_m))
        };
        let lower = |system: &SystemDescription| {
            let has_m = clearance_m - missing_m(system, clearance_m);
            let lower_m = if has_m > 0.0 { rounded_down(has_m) } else { has_m };
            (lower_m >= 0.0 && missing_m(system, lower_m) <= self.slack_m())
                .then(|| format!("{} to {}", self.clearance.path(), Number(lower_m)))
        };
        let is_exempting = !inside.is_empty();
        let is_enough = is_exempting && missing_m(&exempting, clearance_m) <= self.slack_m();
        let ways_out: Vec<String> =
            is_enough.then(|| exempt.clone()).into_iter().chain(lower(self.system)).collect();
        if !ways_out.is_empty() || !is_exempting {
            return ways_out;
        }
        lower(&exempting).map(|lower| format!("{exempt}, and {lower}")).into_iter().collect()
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
        let Self { system, joint_angles_rad, .. } = self;
        let model = &system.model;
        let exempt: Vec<usize> = (0..system.joint_count())
            .filter(|&link| system.body_exempt[link] && has_length(model, link))
            .collect();
        if exempt.is_empty() {
            return Ok(());
        }
        let posture = model.kinematics(joint_angles_rad);
        let inside_m = collision.body_distance_m + self.slack_m();
        for &link in &exempt {
            let distance_m = distance_to_body(&posture, link);
            if distance_m > inside_m {
                let allowed = format!(
                    "false: link {} starts {} m from the base's center of mass, outside the \
                     keep-out sphere with its clearance, {} m",
                    link + 1,
                    Number::rounded(distance_m, 6),
                    Number::rounded(collision.body_distance_m, 6)
                );
                return Err(self.links.index(link).key("body_exempt").refuse(true, allowed));
            }
        }
        let mut farthest_m = vec![0.0_f64; system.joint_count()];
        for sample in Halton::new(system.joint_count()).take(SAMPLES) {
            let posture = model.kinematics(&system.joint_angles_at(&sample));
            for &link in &exempt {
                farthest_m[link] = farthest_m[link].max(distance_to_body(&posture, link));
            }
        }
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

/// A positive number rounded down to three significant digits.
fn rounded_down(value: f64) -> f64 {
    let scale = 10.0_f64.powi(2 - value.log10().floor() as i32);
    let Number(rounded) = Number::rounded((value * scale).floor() / scale, 3);
    rounded
}
