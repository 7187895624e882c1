//! A folder of solved maneuvers, from which a plan takes the nearest as one more start.
//!
//! Every subfolder is what a solve has written: `solution.json` and `trajectory.csv`. An entry is of
//! use for a maneuver of the same type by the same arm, that is, with the same joints: as many, with
//! equal Denavit–Hartenberg rows and an equal mount, and with equal waypoints. Masses and limits may differ.
//!
//! The nearest entry is the one with the least √(Δ_goal² + Δ_duration² + Δ_joints² + Δ_mass²), where
//!
//! - Δ_goal is the distance of the slews' rotation vectors, rad, or of a detumble's initial angular
//!   rates (body axes), as a share of the larger one;
//! - Δ_duration is |ln| of the ratio of durations;
//! - Δ_joints is the distance of the initial joint angles, rad;
//! - Δ_mass is the largest |ln| of a ratio of masses, of the base, a link or the payload; 1 where
//!   there is a mass in only one of the two.
//!
//! Among equals the first by name is taken.

use std::cmp::Ordering;
use std::fmt;
use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use righting_results::solution::{SCHEMA, Status};
use righting_results::trajectory::Trajectory;
use righting_results::{SOLUTION_FILE, TRAJECTORY_FILE};
use righting_scenario::error::{Error, Mismatch};
use righting_scenario::file::{self, JointKind, ManeuverType, SystemReference};
use righting_scenario::json::{Document, FileKind};
use righting_scenario::scenario::Scenario;
use serde::Deserialize;

/// The solved maneuvers of a folder. Only their `solution.json` have been read.
#[derive(Clone, Debug)]
pub struct PlanLibrary {
    folder: PathBuf,
    entries: Vec<Entry>,
    skipped: Vec<Skipped>,
}

#[derive(Clone, Debug)]
struct Entry {
    name: String,
    folder: PathBuf,
    scenario: file::Scenario,
}

/// A subfolder that is of no use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// Its name.
    pub name: String,
    /// Why.
    pub reason: String,
}

impl fmt::Display for Skipped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.name, self.reason)
    }
}

/// The entry to start from.
#[derive(Clone, Debug, PartialEq)]
pub struct Neighbor {
    /// Name of its folder.
    pub name: String,
    /// How far its maneuver is from the one to plan, as the [module](self) measures it.
    pub distance: f64,
    /// Its motion.
    pub trajectory: Trajectory,
}

/// What is needed of a `solution.json` to choose an entry.
#[derive(Deserialize)]
struct Card {
    schema: String,
    scenario: file::Scenario,
    status: Status,
    verification: Verdict,
}

#[derive(Deserialize)]
struct Verdict {
    passed: bool,
}

impl PlanLibrary {
    /// Looks into every subfolder of `folder`, hidden ones left out. One that does not hold a
    /// verified plan is skipped.
    ///
    /// # Errors
    /// [`Error::Read`] if `folder` cannot be listed.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let failed = |source| Error::Read { file: folder.to_owned(), source };
        let mut folders: Vec<(String, PathBuf)> = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if !name.starts_with('.') && entry.path().is_dir() {
                folders.push((name, entry.path()));
            }
        }
        folders.sort();
        let mut library =
            Self { folder: folder.to_owned(), entries: Vec::new(), skipped: Vec::new() };
        for (name, folder) in folders {
            match read_scenario(&folder) {
                Ok(scenario) => library.entries.push(Entry { name, folder, scenario }),
                Err(reason) => library.skipped.push(Skipped { name, reason }),
            }
        }
        Ok(library)
    }

    /// The folder it was read from.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// How many maneuvers it holds, whatever their arm.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The subfolders that were of no use so far.
    pub fn skipped(&self) -> &[Skipped] {
        &self.skipped
    }

    /// The nearest maneuver of the scenario's type and arm, none if there is none. Entries of
    /// another arm, and those near ones whose trajectory cannot be read, join the
    /// [skipped](Self::skipped).
    pub fn nearest(&mut self, scenario: &Scenario) -> Option<Neighbor> {
        let asked = scenario.resolved();
        let mut ranked: Vec<(f64, &Entry)> = Vec::new();
        for entry in &self.entries {
            if !is_same_arm(asked, &entry.scenario) {
                let reason = "is of another arm".to_owned();
                self.skipped.push(Skipped { name: entry.name.clone(), reason });
            } else if let Some(distance) = distance(asked, &entry.scenario) {
                ranked.push((distance, entry));
            }
        }
        // The sort is stable and the entries stand by name.
        ranked.sort_by(|(a, _), (b, _)| a.partial_cmp(b).unwrap_or(Ordering::Equal));
        for (distance, entry) in ranked {
            let read = Trajectory::read_csv(&entry.folder.join(TRAJECTORY_FILE));
            let reason = match read {
                Ok(trajectory) if trajectory.joints() == scenario.system().joint_count() => {
                    return Some(Neighbor { name: entry.name.clone(), distance, trajectory });
                }
                Ok(_) => format!("{TRAJECTORY_FILE} is of another arm"),
                Err(error) => within(&entry.folder, &error),
            };
            self.skipped.push(Skipped { name: entry.name.clone(), reason });
        }
        None
    }
}

impl PlanLibrary {
    /// What a reader of a plan should know of the library's part in it.
    pub(crate) fn note(&self, nearest: Option<&Neighbor>) -> String {
        let shown = self.folder.display();
        match nearest {
            Some(Neighbor { name, distance, .. }) => {
                format!("library maneuver {name} was a start too (distance {distance:.3})")
            }
            None if self.is_empty() => {
                format!("library {shown} is empty: a plan joins it by --out {shown}/NAME")
            }
            None => format!("library {shown} holds no maneuver of this type by this arm"),
        }
    }
}

/// The resolved scenario of a verified plan, or why the folder holds none.
fn read_scenario(folder: &Path) -> Result<file::Scenario, String> {
    let document = Document::read(&folder.join(SOLUTION_FILE), FileKind::Solution);
    let card: Card =
        document.and_then(|document| document.decode()).map_err(|error| within(folder, &error))?;
    if card.schema != SCHEMA {
        let quoted = [&card.schema, SCHEMA].map(|name| format!("\"{name}\""));
        let mismatch = Mismatch::new(&quoted[0], &quoted[1]);
        return Err(format!("{SOLUTION_FILE}: schema: {mismatch}"));
    }
    if !(card.status.is_acceptable() && card.verification.passed) {
        return Err("holds no verified plan".to_owned());
    }
    Ok(card.scenario)
}

/// An error about a file of an entry, told without the path of the entry.
fn within(folder: &Path, error: &Error) -> String {
    let text = error.to_string();
    let prefix = format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR);
    text.strip_prefix(&prefix).map_or(text.clone(), str::to_owned)
}

fn system(scenario: &file::Scenario) -> Option<&file::System> {
    match &scenario.system {
        SystemReference::Inline(system) => Some(system),
        SystemReference::File(_) => None,
    }
}

/// Whether two resolved scenarios are of the same arm, as the [module](self) means it.
pub fn is_same_arm(a: &file::Scenario, b: &file::Scenario) -> bool {
    let (Some(a), Some(b)) = (system(a), system(b)) else { return false };
    let row = |link: &file::Link| [link.a_m, link.alpha_deg, link.d_m, link.theta_deg];
    let rows = a.links.len() == b.links.len()
        && a.links.iter().zip(&b.links).all(|(a, b)| row(a) == row(b));
    let bodies = match (&a.bodies, &b.bodies) {
        (Some(a), Some(b)) => is_same_tree(a, b),
        (a, b) => a.is_none() && b.is_none(),
    };
    rows && bodies && a.dh_convention == b.dh_convention && a.mount == b.mount
}

/// Whether the joints of bodies are where those of others are.
fn is_same_tree(a: &[file::Body], b: &[file::Body]) -> bool {
    let place = |body: &file::Body| {
        let file::Joint { kind, position_m, rpy_deg, rotation, axis, .. } = body.joint;
        (body.parent.clone(), kind, (position_m, rpy_deg, rotation, axis))
    };
    let names = |bodies: &[file::Body]| -> Vec<String> {
        bodies.iter().map(|body| body.name.clone()).collect()
    };
    names(a) == names(b) && a.iter().map(place).eq(b.iter().map(place))
}

/// How far two maneuvers of the same arm are from each other; none if they are of different types.
fn distance(a: &file::Scenario, b: &file::Scenario) -> Option<f64> {
    if a.maneuver.kind != b.maneuver.kind {
        return None;
    }
    let goal = match a.maneuver.kind {
        ManeuverType::Slew if a.maneuver.waypoints != b.maneuver.waypoints => return None,
        ManeuverType::Slew => (rotation_vector(a)? - rotation_vector(b)?).norm(),
        ManeuverType::Detumble => {
            let [a, b] = [a, b].map(|scenario| {
                Vector3::from(scenario.initial.angular_rate_deg_s.unwrap_or_default())
            });
            let larger = a.norm().max(b.norm());
            if larger > 0.0 { (a - b).norm() / larger } else { 0.0 }
        }
    };
    let [a_s, b_s] = [a, b].map(|scenario| scenario.horizon.duration_s.longest_s());
    let duration = (a_s / b_s).ln();
    let angles = a.initial.joint_angles_deg.iter().zip(&b.initial.joint_angles_deg);
    let angles = angles.map(|(a, b)| (a - b).to_radians());
    // Of the range that the joint has.
    let ranges = sliding_ranges_m(a);
    let travels = a.initial.joint_travels_m.iter().zip(&b.initial.joint_travels_m).zip(ranges);
    let travels = travels.map(|((a, b), range_m)| (a - b) / range_m);
    let joints: f64 = angles.chain(travels).map(|off| off.powi(2)).sum();
    let mass = masses(a).zip(masses(b)).map(|(a, b)| log_ratio(a, b)).fold(0.0, f64::max);
    let distance = (goal.powi(2) + duration.powi(2) + joints + mass.powi(2)).sqrt();
    distance.is_finite().then_some(distance)
}

/// Axis times angle, rad.
fn rotation_vector(scenario: &file::Scenario) -> Option<Vector3<f64>> {
    let (axis, angle_deg) = scenario.slew_axis_and_angle_deg()?;
    let axis = Vector3::from(axis).try_normalize(f64::MIN_POSITIVE)?;
    Some(axis * angle_deg.to_radians())
}

/// The lengths of the ways of the joints that slide, m; 1 for none.
fn sliding_ranges_m(scenario: &file::Scenario) -> Vec<f64> {
    let joints = system(scenario).map_or_else(Vec::new, file::System::joints);
    let sliding = joints.into_iter().filter(|joint| joint.kind == JointKind::Prismatic);
    let range_m = |joint: file::JointRow| joint.max.zip(joint.min).map(|(max, min)| max - min);
    sliding.map(|joint| range_m(joint).filter(|range_m| *range_m > 0.0).unwrap_or(1.0)).collect()
}

/// Of the base, the payload and every link or body.
fn masses(scenario: &file::Scenario) -> impl Iterator<Item = f64> {
    let system = system(scenario);
    let base = system.map(|system| system.base.mass_kg);
    let payload = system.map(|system| system.payload.as_ref().map_or(0.0, |body| body.mass_kg));
    let links = system.into_iter().flat_map(|system| &system.links).map(|link| link.mass_kg);
    let bodies = system.into_iter().flat_map(|system| system.bodies.iter().flatten());
    base.into_iter().chain(payload).chain(links).chain(bodies.map(|body| body.mass_kg))
}

fn log_ratio(a: f64, b: f64) -> f64 {
    match (a > 0.0, b > 0.0) {
        (true, true) => (a / b).ln().abs(),
        (false, false) => 0.0,
        _ => 1.0,
    }
}
