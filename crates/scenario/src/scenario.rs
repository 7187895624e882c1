//! A maneuver to plan, checked: what a scenario file means.

use std::path::Path;

use nalgebra::Vector3;
use righting_multibody::{External, JointKind, Quaternion, System};
use righting_scalar::Scalar;
use sha2::{Digest, Sha256};

use crate::collision::CollisionModel;
use crate::end::{check_end_clearances, end_coordinates};
use crate::environment::Environment;
use crate::error::Error;
use crate::file::{self, SystemReference};
use crate::initial::Initial;
use crate::joint_limits::JointLimits;
use crate::json::{Bounds, Document, FileKind, Location, Number};
use crate::pointing::{Pointing, pointing};
use crate::robustness::Robustness;
use crate::rounding::{COMPUTED, PRINTED};
use crate::start_clearance::Start;
use crate::start_limits::widen_to_start;
use crate::start_loads;
use crate::system_description::SystemDescription;
use crate::system_reference::resolve_system;
use crate::waypoints::{Waypoint, check_company, end_in_last, waypoints};
use crate::wheels::{Wheel, any_works, end_momenta, reaction, stored};

pub use crate::horizon::{FreeDuration, Horizon, LONGEST_S, MAX_STEPS};
pub use crate::maneuver::{Maneuver, Slew};
pub use crate::solver_settings::{MAX_ITERATIONS, MAX_STARTS, SolverSettings};
pub use crate::weights::{REFERENCE_INTERVAL_S, Weights};

/// The clearance of a scenario that gives none, m.
pub const DEFAULT_CLEARANCE_M: f64 = 0.01;

const CLEARANCE_M: Bounds = Bounds::Between(0.0, 1e8);

/// A checked scenario. SI units and radians; nothing in it can be wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    pub(crate) system: SystemDescription,
    pub(crate) initial: Initial,
    pub(crate) maneuver: Maneuver,
    pub(crate) waypoints: Vec<Waypoint>,
    pub(crate) horizon: Horizon,
    pub(crate) free_duration: Option<FreeDuration>,
    pub(crate) weights: Weights,
    pub(crate) is_end_hard: bool,
    pub(crate) end_angles_rad: Vec<Option<f64>>,
    pub(crate) end_wheel_momenta_n_m_s: Vec<Option<f64>>,
    pub(crate) wheels: Vec<Wheel>,
    pub(crate) environment: Option<Environment>,
    pub(crate) robustness: Option<Robustness>,
    pub(crate) pointing: Vec<Pointing>,
    pub(crate) collision: CollisionModel,
    pub(crate) solver: SolverSettings,
    pub(crate) resolved: file::Scenario,
    pub(crate) notes: Vec<String>,
}

impl Scenario {
    /// Reads and checks a scenario file and its system.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Field`] for a field that is wrong.
    pub fn read(file: &Path) -> Result<Self, Error> {
        let document = Document::read(file, FileKind::Scenario)?;
        Self::from_file(document.decode()?, file)
    }

    /// Reads and checks a scenario from its text; `file` names it in errors, and a relative system
    /// path starts from its folder.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, Error> {
        Self::from_file(Document::parse(file, text, FileKind::Scenario)?.decode()?, file)
    }

    /// Checks a scenario; `file` names it in errors, and a relative system path starts from its
    /// folder. [`varied`](Self::varied) is for variants of a checked scenario.
    ///
    /// # Errors
    /// [`Error::Field`] for a field that is wrong; those of reading the system.
    pub fn from_file(scenario: file::Scenario, file: &Path) -> Result<Self, Error> {
        Self::from_file_at(scenario, file, &Location::root(file))
    }

    /// [`from_file`](Self::from_file) for a scenario that stands at `place` in `file`.
    ///
    /// # Errors
    /// As [`from_file`](Self::from_file).
    pub fn from_file_at(
        mut scenario: file::Scenario,
        file: &Path,
        place: &Location,
    ) -> Result<Self, Error> {
        if scenario.name.trim().is_empty() {
            return Err(place.key("name").refuse("\"\"", "a name"));
        }
        let mut notes = Vec::new();
        let (mut system, system_place) = resolve_system(&mut scenario, file, place, &mut notes)?;
        let initial_place = place.key("initial");
        if let SystemReference::Inline(file) = &mut scenario.system {
            widen_to_start(&scenario.initial, file, &system_place, &mut notes);
            system.joint_limits = file.joints().iter().map(JointLimits::of).collect();
        }
        let initial = Initial::from_file(&scenario.initial, &system, &initial_place, &mut notes)?;
        let rate_place = initial_place.key("angular_rate_deg_s");
        if let SystemReference::Inline(file) = &scenario.system {
            start_loads::check((&system, file), &initial, &rate_place, &system_place)?;
        }
        let maneuver_place = place.key("maneuver");
        end_in_last(&mut scenario.maneuver);
        let maneuver =
            Maneuver::from_file(&scenario.maneuver, &initial, &maneuver_place, &mut notes)?;
        let environment = match &mut scenario.environment {
            Some(given) => {
                Some(Environment::from_file(given, &place.key("environment"), &mut notes)?)
            }
            None => None,
        };
        let wheels = Wheel::all_from_file(&scenario.wheels, &place.key("wheels"))?;
        let needs_none = environment.is_none() && !any_works(&wheels);
        if needs_none || maneuver == Maneuver::Detumble {
            let momentum_note =
                check_momentum(&scenario.initial, &initial, &maneuver, &system, &initial_place)?;
            notes.extend(momentum_note);
        }
        let (horizon, free_duration) =
            Horizon::from_file(&scenario.horizon, &place.key("horizon"))?;
        let solver = SolverSettings::from_file(&scenario.solver, &place.key("solver"))?;
        let robustness_place = place.key("robustness");
        let robustness = scenario
            .robustness
            .as_mut()
            .map(|given| Robustness::from_file(given, (&maneuver, solver), &robustness_place));
        let robustness = robustness.transpose()?;
        let waypoints = match maneuver.slew().filter(|_| !scenario.maneuver.waypoints.is_empty()) {
            Some(slew) => {
                let is_free = free_duration.is_some();
                check_company(is_free, solver, place)?;
                let given = &mut scenario.maneuver.waypoints;
                let place = maneuver_place.key("waypoints");
                waypoints(given, (&initial, slew), horizon, &place, &mut notes)?
            }
            None => Vec::new(),
        };
        let pointing = pointing(
            &scenario.pointing,
            (&initial, &maneuver, &waypoints),
            (horizon.duration_s, free_duration.is_some()),
            &place.key("pointing"),
        )?;
        let weights = Weights::from_file(
            &scenario.weights,
            &maneuver,
            (free_duration.is_some(), !wheels.is_empty()),
            &place.key("weights"),
        )?;
        let is_end_hard = match scenario.end.as_ref().and_then(|end| end.hard) {
            Some(hard) => hard,
            None => !solver.is_paper() && !scenario.weights.has_end(),
        };
        let end_place = place.key("final");
        let end_angles_rad = end_coordinates(scenario.end.as_ref(), &system, &end_place)?;
        let end_momenta_n_m_s =
            scenario.end.as_ref().and_then(|end| end.wheel_momenta_n_m_s.as_deref());
        let end_momenta_place = end_place.key("wheel_momenta_n_m_s");
        let end_wheel_momenta_n_m_s = end_momenta(end_momenta_n_m_s, &wheels, &end_momenta_place)?;
        let clearance_place = place.key("collision").key("clearance_m");
        let clearance_m = match scenario.collision.clearance_m {
            Some(clearance_m) => clearance_place.within(clearance_m, CLEARANCE_M)?,
            None => DEFAULT_CLEARANCE_M,
        };
        let start = Start {
            system: &system,
            joint_angles_rad: &initial.joint_angles_rad,
            angles: initial_place.key("joint_angles_deg"),
            place: system_place,
            clearance: clearance_place,
        };
        let collision = start.collision_model(clearance_m, &mut notes)?;
        let posture_place = end_place.key("joint_angles_deg");
        check_end_clearances(&system, &collision, &initial, &end_angles_rad, &posture_place)?;
        let kinds = system.model.joint_kinds();
        let at_rest = |kind| file::of_kind(&kinds, kind, &vec![0.0; kinds.len()]);
        let given = scenario.initial.clone();
        let resolved = file::Scenario {
            initial: file::Initial {
                joint_rates_deg_s: Some(
                    given.joint_rates_deg_s.unwrap_or_else(|| at_rest(JointKind::Revolute)),
                ),
                joint_speeds_m_s: kinds.contains(&JointKind::Prismatic).then(|| {
                    given.joint_speeds_m_s.unwrap_or_else(|| at_rest(JointKind::Prismatic))
                }),
                angular_rate_deg_s: Some(given.angular_rate_deg_s.unwrap_or_default()),
                attitude: Some(given.attitude.unwrap_or([1.0, 0.0, 0.0, 0.0])),
                ..given
            },
            weights: weights.to_file(free_duration.is_some(), !wheels.is_empty()),
            end: Some(file::End {
                hard: Some(is_end_hard),
                ..scenario.end.clone().unwrap_or_default()
            }),
            collision: file::Collision { clearance_m: Some(collision.clearance_m) },
            solver: solver.to_file(),
            ..scenario
        };
        Ok(Self {
            system,
            initial,
            maneuver,
            waypoints,
            horizon,
            free_duration,
            weights,
            is_end_hard,
            end_angles_rad,
            end_wheel_momenta_n_m_s,
            wheels,
            environment,
            robustness,
            pointing,
            collision,
            solver,
            resolved,
            notes,
        })
    }

    /// Name of the scenario.
    pub fn name(&self) -> &str {
        &self.resolved.name
    }

    /// The system.
    pub fn system(&self) -> &SystemDescription {
        &self.system
    }

    /// State at the start.
    pub fn initial(&self) -> &Initial {
        &self.initial
    }

    /// What to do.
    pub fn maneuver(&self) -> &Maneuver {
        &self.maneuver
    }

    /// The attitudes that a slew reaches on the way.
    pub fn waypoints(&self) -> &[Waypoint] {
        &self.waypoints
    }

    /// Duration and grid; the longest duration where the plan chooses it.
    pub fn horizon(&self) -> Horizon {
        self.horizon
    }

    /// The shortest duration, where the plan chooses it.
    pub fn free_duration(&self) -> Option<FreeDuration> {
        self.free_duration
    }

    /// The same scenario with a duration that was chosen; [`resolved`](Self::resolved) stays as it was.
    pub fn with_duration(self, duration_s: f64) -> Self {
        let horizon = Horizon { duration_s, ..self.horizon };
        Self { horizon, free_duration: None, ..self }
    }

    /// Weights of the objective.
    pub fn weights(&self) -> Weights {
        self.weights
    }

    /// A checked variant: this scenario as its [`resolved`](Self::resolved) file says it, with a change.
    ///
    /// # Errors
    /// [`Error::Field`] for a field that is wrong then, in a file named as the scenario.
    pub fn varied(&self, change: impl FnOnce(&mut file::Scenario)) -> Result<Self, Error> {
        let mut file = self.resolved.clone();
        change(&mut file);
        Self::from_file(file, Path::new(self.name()))
    }

    /// The same scenario with another duration and grid; [`resolved`](Self::resolved) stays as it was.
    pub fn with_horizon(self, horizon: Horizon) -> Self {
        Self { horizon, ..self }
    }

    /// The same scenario with other weights; [`resolved`](Self::resolved) stays as it was.
    pub fn with_weights(self, weights: Weights) -> Self {
        Self { weights, ..self }
    }

    /// The same scenario with other masses; [`resolved`](Self::resolved) stays as it was.
    pub fn with_model(self, model: System) -> Self {
        Self { system: SystemDescription { model, ..self.system }, ..self }
    }

    /// Whether the end is met as well as numbers allow, rather than traded for effort.
    pub fn is_end_hard(&self) -> bool {
        self.is_end_hard
    }

    /// The coordinates in which joints shall end, one a joint, rad or m; none where the joint is free.
    pub fn end_angles_rad(&self) -> &[Option<f64>] {
        &self.end_angles_rad
    }

    /// The momenta that the wheels store in the end, one a wheel, N m s; none where a wheel's is free.
    pub fn end_wheel_momenta_n_m_s(&self) -> &[Option<f64>] {
        &self.end_wheel_momenta_n_m_s
    }

    /// The reaction wheels, failed ones among them.
    pub fn wheels(&self) -> &[Wheel] {
        &self.wheels
    }

    /// What acts from outside; none where the file gives nothing, and angular momentum is conserved.
    pub fn environment(&self) -> Option<&Environment> {
        self.environment.as_ref()
    }

    /// The same where anything in it acts.
    pub fn acting_environment(&self) -> Option<&Environment> {
        self.environment.as_ref().filter(|environment| environment.acts())
    }

    /// Whether a slew may have angular momentum: wheels that work can take it, or something acts from outside.
    pub fn may_have_momentum(&self) -> bool {
        self.environment.is_some() || any_works(&self.wheels)
    }

    /// Whether the base may drift at the end of a slew as its angular momentum has it: what comes from outside is
    /// nothing that a plan could take away, unless wheels hold it that are not asked to give up what they store. The
    /// rate that shall be zero is then the one beyond that drift.
    pub fn may_drift(&self) -> bool {
        let wheels_give_up = self.weights.wheel_momentum > 0.0
            || self.end_wheel_momenta_n_m_s.iter().any(Option::is_some);
        let wheels_hold = any_works(&self.wheels) && !wheels_give_up;
        self.environment.is_some() && self.maneuver != Maneuver::Detumble && !wheels_hold
    }

    /// What acts on the system in an attitude (body → inertial) at a time since the start, if anything does: its
    /// surroundings, and the wheels where the base turns at `angular_rate` (body axes) while they have such momenta and
    /// torques (one value a wheel).
    pub fn external<T: Scalar>(
        &self,
        attitude: &Quaternion<T>,
        angular_rate: &Vector3<T>,
        time: T,
        (momenta, torques): (&[T], &[T]),
    ) -> Option<External<T>> {
        let surrounding =
            self.acting_environment().map(|environment| environment.external(attitude, time));
        if self.wheels.is_empty() {
            return surrounding;
        }
        let [in_store, given] = [momenta, torques].map(|values| stored(&self.wheels, values));
        let reaction = reaction(angular_rate, &in_store, &given);
        Some(match surrounding {
            None => External { torque: reaction, gravity_gradient: None },
            Some(external) => External {
                torque: Vector3::from_fn(|i, _| external.torque[i] + reaction[i]),
                ..external
            },
        })
    }

    /// Masses that the plan shall not depend on more than it must, if there are any.
    pub fn robustness(&self) -> Option<Robustness> {
        self.robustness
    }

    /// The cones that instruments keep out of, or stay in.
    pub fn pointing(&self) -> &[Pointing] {
        &self.pointing
    }

    /// The joint angles that the weight `joint_angle` asks for at the end, rad: those in which the joints
    /// shall end, and of free ones those of the start.
    pub fn desired_joint_angles_rad(&self) -> Vec<f64> {
        let start = self.initial.joint_angles_rad.iter();
        start.zip(&self.end_angles_rad).map(|(start, end)| end.unwrap_or(*start)).collect()
    }

    /// Which links keep how far from what.
    pub fn collision(&self) -> &CollisionModel {
        &self.collision
    }

    /// How to solve.
    pub fn solver(&self) -> SolverSettings {
        self.solver
    }

    /// The rate that the base has once the arm is simply stopped in its posture at the start,
    /// ‖Ĩ(q₀)⁻¹ h₀‖, rad/s: its rate at the start if the joints are at rest there.
    pub fn stopped_rate_rad_s(&self) -> f64 {
        stopped_rate_rad_s(&self.initial, &self.system)
    }

    /// What was accepted with an assumption, a sentence each, beginning with the field: rounding that
    /// was taken off, inertias that were changed, what may be meant otherwise. Empty where all was said.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The scenario as a file, its system inline and every default filled in; numbers that
    /// [`notes`](Self::notes) say were taken otherwise stand as taken.
    pub fn resolved(&self) -> &file::Scenario {
        &self.resolved
    }

    /// The system in [`resolved`](Self::resolved), where it stands inline.
    pub fn resolved_system(&self) -> &file::System {
        match &self.resolved.system {
            SystemReference::Inline(system) => system,
            SystemReference::File(_) => unreachable!("a checked scenario has its system inline"),
        }
    }
}

impl file::Scenario {
    /// SHA-256 of the compact JSON of this scenario, hexadecimal. For a resolved scenario it
    /// identifies the problem, the system included.
    pub fn sha256(&self) -> String {
        let text = serde_json::to_vec(self).unwrap_or_default();
        Sha256::digest(&text).iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// A slew that starts with angular momentum cannot end at rest; a detumble without any has nothing
/// to do. Momentum that printed rates leave by their rounding does no harm to a slew; the note says
/// how large it is.
fn check_momentum(
    given: &file::Initial,
    initial: &Initial,
    maneuver: &Maneuver,
    system: &SystemDescription,
    place: &Location,
) -> Result<Option<String>, Error> {
    let rate_rad_s = stopped_rate_rad_s(initial, system);
    let fastest_rad_s = initial
        .joint_rates_rad_s
        .iter()
        .zip(system.radians_a_unit())
        .map(|(rate, counts)| rate.abs() * counts)
        .fold(initial.angular_rate_rad_s.norm(), f64::max);
    let place = place.key("angular_rate_deg_s");
    let [x, y, z] = given.angular_rate_deg_s.unwrap_or_default().map(Number);
    let value = format!("[{x}, {y}, {z}]");
    let turns = rate_rad_s > COMPUTED * fastest_rad_s;
    match (maneuver, given.angular_rate_deg_s) {
        (Maneuver::Slew(_), _) if rate_rad_s > PRINTED * fastest_rad_s => Err(place.refuse(
            value,
            format!(
                "a rate at which the system has no angular momentum, since a slew ends at rest (it \
                 would turn at {} deg/s with the arm stopped)",
                Number::rounded(rate_rad_s.to_degrees(), 4)
            ),
        )),
        (Maneuver::Slew(_), _) if turns => Ok(Some(place.note(format_args!(
            "the system would turn at {} deg/s with the arm stopped, where a slew starts without \
             angular momentum: taken for rounding of the rates, and kept",
            Number::rounded(rate_rad_s.to_degrees(), 2)
        )))),
        (Maneuver::Detumble, None) if !turns => {
            Err(place.missing("the angular rate that a detumble takes out"))
        }
        (Maneuver::Detumble, Some(_)) if !turns => {
            Err(place.refuse(value, "a vector that is not zero: a detumble takes it out"))
        }
        _ => Ok(None),
    }
}

/// ‖Ĩ(q₀)⁻¹ h₀‖, rad/s.
fn stopped_rate_rad_s(initial: &Initial, system: &SystemDescription) -> f64 {
    let momentum = initial.attitude.to_body(&initial.angular_momentum_n_m_s);
    let arm_at_rest = vec![0.0; system.joint_count()];
    let model = &system.model;
    model.reduced_angular_rate(&initial.joint_angles_rad, &arm_at_rest, &momentum).norm()
}
