//! Whether a maneuver starts clear, and which links may start inside what the base keeps out.
//!
//! One rule for `body_exempt`: a link that starts inside the keep-out sphere or a shape of the base with its
//! clearance is refused unless it is exempt, and one that starts outside of all is refused if it is.

use nalgebra::Vector3;
use righting_multibody::Kinematics;

use crate::bodies::{ArmPart, Piece};
use crate::collision::{Between, Clearance, CollisionModel, Pair, base_pairs};
use crate::error::Error;
use crate::halton::Halton;
use crate::json::{Location, Number};
use crate::rounding::{COMPUTED, PRINTED};
use crate::system_description::SystemDescription;

/// Arm postures tried to see whether an exempt link can leave what the base keeps out.
const SAMPLES: usize = 2000;
/// As many of the links that start too close are named.
const MOST_NAMED: usize = 4;

/// A start whose clearances are looked at.
pub(crate) struct Start<'a> {
    pub system: &'a SystemDescription,
    pub joint_angles_rad: &'a [f64],
    /// Where the joint angles stand.
    pub angles: Location,
    /// Where the system stands.
    pub place: Location,
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
        for (between, between_m) in asked.neighbors_across_links(self.system) {
            notes.push(self.clearance.note(format_args!(
                "{} are never farther apart than what is between them, {} m: no clearance is \
                 kept between them",
                self.system.names.between(&between),
                Number::rounded(between_m, 3)
            )));
        }
        self.check_exemptions(&asked, notes)?;
        let missing_m = self.missing_m(&asked);
        if missing_m <= self.slack_m() {
            return Ok(asked);
        }
        let lowered_m = clearance_m - missing_m;
        let is_rounding = missing_m <= PRINTED * self.system.model.size_m() && lowered_m >= 0.0;
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

    /// How far inside a clearance arithmetic alone may put a start, m.
    fn slack_m(&self) -> f64 {
        COMPUTED * self.system.model.size_m()
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

    /// An exempt link that starts outside of all that the base keeps out with its clearance, and what of
    /// that is nearest, if there is anything.
    fn needless_exemption(
        &self,
        collision: &CollisionModel,
    ) -> Option<(ArmPart, Option<Clearance>)> {
        let posture = self.system.model.kinematics(self.joint_angles_rad);
        self.exempt()
            .into_iter()
            .map(|part| (part, nearest(&self.off_base(part, collision), &posture)))
            .find(|(_, nearest)| nearest.is_none_or(|nearest| self.is_kept(&nearest)))
    }

    /// A link or body and everything that the base keeps out, kept apart or not.
    fn off_base(&self, part: ArmPart, collision: &CollisionModel) -> Vec<Pair> {
        base_pairs(self.system, collision.clearance_m, |solid| solid.piece.part == part)
    }

    /// Whether a distance is kept, but for rounding.
    fn is_kept(&self, clearance: &Clearance) -> bool {
        clearance.distance_m > clearance.least_m + self.slack_m()
    }

    /// Exempt links and bodies that are solid.
    fn exempt(&self) -> Vec<ArmPart> {
        let is_exempt = |part: &ArmPart| place(*part).is_some_and(|k| self.system.body_exempt[k]);
        let mut exempt: Vec<ArmPart> =
            self.system.solids.iter().map(|solid| solid.piece.part).filter(is_exempt).collect();
        exempt.dedup();
        exempt
    }

    /// Where the exemption of a link or body stands.
    fn exemption(&self, part: ArmPart) -> Location {
        let place = match part {
            ArmPart::Link(link) => self.place.key("links").index(link),
            ArmPart::Body(body) => self.place.key("bodies").index(body),
            ArmPart::Payload => self.place.key("payload"),
        };
        place.key("body_exempt")
    }

    /// Whether nothing is too close and nothing exempt without need.
    fn is_good(&self, collision: &CollisionModel) -> bool {
        self.missing_m(collision) <= self.slack_m() && self.needless_exemption(collision).is_none()
    }

    /// What is too close, and which fields to change.
    fn refusal(&self, collision: &CollisionModel) -> Error {
        let mut close = self.clearances(collision);
        close.retain(|clearance| clearance.distance_m < clearance.least_m - self.slack_m());
        let mut found: Vec<String> =
            close.iter().take(MOST_NAMED).map(|close| self.distance(close)).collect();
        if close.len() > MOST_NAMED {
            found.push(format!("{} more too close", close.len() - MOST_NAMED));
        }
        let (body, others): (Vec<Clearance>, Vec<Clearance>) =
            close.iter().partition(|clearance| matches!(clearance.between, Between::Body(_)));
        let mut least = Vec::new();
        if let Some(radius_m) = self.system.keep_out_radius_m.filter(|_| !body.is_empty()) {
            let body_m = meters(radius_m + collision.clearance_m);
            least.push(format!("{body_m} m, keep-out radius and clearance"));
        }
        if !others.is_empty() {
            least.push(format!("the clearance, {} m", meters(collision.clearance_m)));
        }
        let is_between_arm = others.iter().all(|other| other.between.off_base().is_none());
        let and = if is_between_arm { ", and between links " } else { ", and otherwise " };
        let mut expected = format!("at least {}", least.join(and));
        let ways_out = self.ways_out(collision.clearance_m, &close);
        if !ways_out.is_empty() {
            expected.push_str(&format!(" (or set {})", ways_out.join(", or ")));
        }
        self.angles.refuse(format!("a start with {}", found.join(", ")), expected)
    }

    /// Fields that make this start a good one, where these are too close. Each was tried.
    fn ways_out(&self, clearance_m: f64, close: &[Clearance]) -> Vec<String> {
        let mut inside: Vec<ArmPart> = Vec::new();
        for clearance in close {
            if let Some(Piece { part, .. }) = clearance.between.off_base()
                && place(part).is_some()
                && !inside.contains(&part)
            {
                inside.push(part);
            }
        }
        let mut exempting = self.system.clone();
        for place in inside.iter().filter_map(|&part| place(part)) {
            exempting.body_exempt[place] = true;
        }
        let exempting = self.of(&exempting);
        let exempt = |&part: &ArmPart| self.exemption(part).path().to_owned();
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
        // What was given a shape may be where it is on purpose.
        let is_solid =
            |clearance: &Clearance| clearance.between.is_of_shapes() || clearance.distance_m < 0.0;
        if close.len() <= MOST_NAMED && close.iter().any(is_solid) {
            let mut ignoring = self.system.clone();
            ignoring.ignored_pairs.extend(close.iter().map(|clearance| clearance.between.named()));
            let ignoring = self.of(&ignoring);
            if ignoring.is_good(&CollisionModel::new(ignoring.system, clearance_m)) {
                let names: Vec<String> =
                    close.iter().map(|clearance| clearance.between.field_names()).collect();
                let place = self.place.key("ignored_pairs");
                ways_out.push(format!("{} to [{}]", place.path(), names.join(", ")));
            }
        }
        ways_out
    }

    /// The same start of another system.
    fn of<'a>(&'a self, system: &'a SystemDescription) -> Start<'a> {
        Start {
            system,
            joint_angles_rad: self.joint_angles_rad,
            angles: self.angles.clone(),
            place: self.place.clone(),
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
        if let Some((part, nearest)) = self.needless_exemption(collision) {
            return Err(self.exemption(part).refuse(true, self.clear_start(part, nearest)));
        }
        let exempt = self.exempt();
        if exempt.is_empty() {
            return Ok(());
        }
        let pairs: Vec<Vec<Pair>> =
            exempt.iter().map(|&part| self.off_base(part, collision)).collect();
        let mut can_leave = vec![false; exempt.len()];
        for sample in Halton::new(self.system.joint_count()).take(SAMPLES) {
            let posture = self.system.model.kinematics(&self.system.joint_angles_at(&sample));
            for (can_leave, pairs) in can_leave.iter_mut().zip(&pairs) {
                *can_leave |=
                    nearest(pairs, &posture).is_some_and(|nearest| self.is_kept(&nearest));
            }
        }
        let of_base = match self.system.keep_out.is_empty() {
            true => "the keep-out sphere",
            false => "what the base keeps out",
        };
        for (part, _) in exempt.into_iter().zip(can_leave).filter(|(_, can_leave)| *can_leave) {
            notes.push(self.exemption(part).note(format_args!(
                "{} starts inside {of_base} and can leave it: it is not kept away from the base \
                 anywhere",
                self.system.names.part(part)
            )));
        }
        Ok(())
    }

    /// Why a link or body needs no exemption: what of the base is nearest to it at the start.
    fn clear_start(&self, part: ArmPart, nearest: Option<Clearance>) -> String {
        let part = self.system.names.part(part);
        match nearest {
            Some(Clearance { between: Between::Body(_), distance_m, least_m }) => format!(
                "false: {part} starts {} m from the {}, outside the keep-out sphere with its \
                 clearance, {} m",
                meters(distance_m),
                self.center(),
                meters(least_m)
            ),
            Some(clearance) => format!(
                "false: {}, the nearest of what the base keeps out, at the start, and the clearance is {} m",
                self.distance(&clearance),
                meters(clearance.least_m)
            ),
            None => {
                format!("false: the base keeps nothing out, and {part} is free to be anywhere")
            }
        }
    }

    /// Such as "links 1 and 3 0.04 m apart" or "link 2 0.04 m inside base.keep_out[0]".
    fn distance(&self, clearance: &Clearance) -> String {
        let Clearance { between, distance_m, .. } = *clearance;
        let names = &self.system.names;
        let by_m = meters(distance_m.abs());
        match (between, distance_m < 0.0) {
            (Between::Body(piece), _) => {
                format!(
                    "{} {} m from the {}",
                    names.piece(piece),
                    meters(distance_m),
                    self.center()
                )
            }
            (Between::KeepOut(piece, k), false) => {
                format!("{} {by_m} m from base.keep_out[{k}]", names.piece(piece))
            }
            (Between::KeepOut(piece, k), true) => {
                format!("{} {by_m} m inside base.keep_out[{k}]", names.piece(piece))
            }
            (Between::Pieces(..), false) => format!("{} {by_m} m apart", names.between(&between)),
            (Between::Pieces(..), true) => {
                format!("{} {by_m} m into each other", names.between(&between))
            }
        }
    }

    /// What the keep-out sphere is about.
    fn center(&self) -> &'static str {
        match self.system.model.base().center_of_mass_m == Vector3::zeros() {
            true => "base's center of mass",
            false => "origin of the body frame",
        }
    }
}

/// The place of a link or body among the exemptions.
fn place(part: ArmPart) -> Option<usize> {
    match part {
        ArmPart::Link(place) | ArmPart::Body(place) => Some(place),
        ArmPart::Payload => None,
    }
}

/// The pair with the least room.
fn nearest(pairs: &[Pair], posture: &Kinematics<f64>) -> Option<Clearance> {
    let room_m = |clearance: &Clearance| clearance.distance_m - clearance.least_m;
    let clearances = pairs.iter().map(|pair| pair.clearance(posture));
    clearances.min_by(|a, b| room_m(a).total_cmp(&room_m(b)))
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
