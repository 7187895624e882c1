//! The nearest of many solved maneuvers is a start; what is no maneuver of that arm is left alone.

use std::fs;
use std::path::Path;

use righting_planner::PlanLibrary;
use righting_results::{SOLUTION_FILE, Solution, TRAJECTORY_FILE, Trajectory};
use righting_scenario::{Scenario, file};
use righting_test_support::{shipped, solution_of, true_slew, varied};
use tempfile::TempDir;

/// A library under construction: every entry is the same true slew, told as another one.
struct Shelf {
    folder: TempDir,
    scenario: Scenario,
    trajectory: Trajectory,
    solution: Solution,
}

impl Shelf {
    fn new() -> Self {
        let coarse = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 40.0);
        let (scenario, trajectory) = true_slew(&coarse);
        let solution = solution_of(&scenario, &trajectory);
        assert!(solution.verification.passed);
        Self { folder: tempfile::tempdir().unwrap(), scenario, trajectory, solution }
    }

    fn kinds(&self) -> Vec<file::JointKind> {
        self.scenario.system().model.joint_kinds()
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Adds an entry, its scenario changed.
    fn add(&self, name: &str, change: impl FnOnce(&mut file::Scenario)) {
        let folder = self.path().join(name);
        fs::create_dir(&folder).unwrap();
        let mut solution = self.solution.clone();
        change(&mut solution.scenario);
        solution.write_json(&folder.join(SOLUTION_FILE)).unwrap();
        self.trajectory.write_csv(&self.kinds(), &folder.join(TRAJECTORY_FILE)).unwrap();
    }

    /// Name and distance of the entry chosen for a variant of the scenario.
    fn nearest(&self, change: impl FnOnce(&mut file::Scenario)) -> (String, f64) {
        let mut library = PlanLibrary::read(self.path()).unwrap();
        let near = library.nearest(&varied(&self.scenario, change)).unwrap();
        assert_eq!(near.trajectory, self.trajectory);
        (near.name, near.distance)
    }
}

fn turned_by(angle_deg: f64) -> impl FnOnce(&mut file::Scenario) {
    move |file| file.maneuver.angle_deg = Some(angle_deg)
}

fn inline(file: &mut file::Scenario) -> &mut file::System {
    match &mut file.system {
        file::SystemReference::Inline(system) => system,
        file::SystemReference::File(path) => panic!("{path} is not resolved"),
    }
}

#[test]
fn the_nearest_goal_duration_posture_and_mass_is_chosen() {
    let shelf = Shelf::new();
    shelf.add("10_deg", turned_by(10.0));
    shelf.add("20_deg", turned_by(20.0));
    shelf.add("20_deg_other_way", turned_by(-20.0));
    shelf.add("20_deg_slow", |file| {
        file.maneuver.angle_deg = Some(20.0);
        file.horizon.duration_s = file.horizon.duration_s.times(2.0);
    });
    shelf.add("20_deg_bent", |file| {
        file.maneuver.angle_deg = Some(20.0);
        file.initial.joint_angles_deg[1] += 60.0;
    });
    shelf.add("20_deg_heavy", |file| {
        file.maneuver.angle_deg = Some(20.0);
        inline(file).base.mass_kg *= 3.0;
    });
    for (angle_deg, name) in [(13.0, "10_deg"), (17.0, "20_deg"), (-3.0, "10_deg")] {
        let (found, distance) = shelf.nearest(turned_by(angle_deg));
        assert_eq!(found, name);
        let expected = if name == "10_deg" { 10.0_f64 } else { 20.0 } - angle_deg;
        assert!((distance - expected.to_radians().abs()).abs() < 1e-12, "{angle_deg}: {distance}");
    }
    assert_eq!(shelf.nearest(turned_by(-18.0)).0, "20_deg_other_way");
    // The axis of the other way around is the opposite axis.
    let opposite = |file: &mut file::Scenario| {
        file.maneuver.axis = file.maneuver.axis.map(|axis| axis.map(|x| -5.0 * x));
        file.maneuver.angle_deg = Some(20.0);
    };
    let (name, distance) = shelf.nearest(opposite);
    assert!(name == "20_deg_other_way" && distance < 1e-12, "{name} {distance}");
    let (name, distance) = shelf.nearest(|file| {
        file.maneuver.angle_deg = Some(20.0);
        file.horizon.duration_s = file.horizon.duration_s.times(4.0);
    });
    assert!(name == "20_deg_slow" && (distance - 2.0_f64.ln()).abs() < 1e-12, "{name} {distance}");
    let (name, distance) = shelf.nearest(|file| {
        file.maneuver.angle_deg = Some(20.0);
        file.initial.joint_angles_deg[1] += 90.0;
    });
    let expected = 30.0_f64.to_radians();
    assert!(name == "20_deg_bent" && (distance - expected).abs() < 1e-12, "{name} {distance}");
    let (name, distance) = shelf.nearest(|file| {
        file.maneuver.angle_deg = Some(20.0);
        inline(file).base.mass_kg *= 6.0;
    });
    assert!(name == "20_deg_heavy" && (distance - 2.0_f64.ln()).abs() < 1e-12, "{name} {distance}");
}

#[test]
fn what_is_no_verified_plan_of_the_arm_is_skipped_by_name() {
    let shelf = Shelf::new();
    shelf.add("good", turned_by(10.0));
    shelf.add("longer", |file| inline(file).links[3].a_m *= 1.5);
    shelf.add("no_motion", turned_by(20.0));
    fs::remove_file(shelf.path().join("no_motion").join(TRAJECTORY_FILE)).unwrap();
    fs::create_dir(shelf.path().join("half")).unwrap();
    shelf.add("torn", |_| {});
    fs::write(shelf.path().join("torn").join(SOLUTION_FILE), "{\"schema\": \"righting").unwrap();
    shelf.add("unproven", |_| {});
    let mut unproven = shelf.solution.clone();
    unproven.verification.passed = false;
    unproven.write_json(&shelf.path().join("unproven").join(SOLUTION_FILE)).unwrap();
    // Neither is an entry.
    fs::write(shelf.path().join("README"), "a library").unwrap();
    fs::create_dir(shelf.path().join(".hidden")).unwrap();

    let mut library = PlanLibrary::read(shelf.path()).unwrap();
    let asked = varied(&shelf.scenario, turned_by(20.0));
    assert_eq!(library.nearest(&asked).unwrap().name, "good");
    let mut skipped: Vec<String> = library.skipped().iter().map(ToString::to_string).collect();
    skipped.sort();
    let expected = [
        "half: solution.json: cannot be read: no such file",
        "longer: is of another arm",
        "no_motion: trajectory.csv: cannot be read: no such file",
        "torn: solution.json: schema: line 1, column 20: not JSON: EOF while parsing a string",
        "unproven: holds no verified plan",
    ];
    assert_eq!(skipped, expected);
}

#[test]
fn another_type_of_maneuver_is_no_start_and_no_fault() {
    let shelf = Shelf::new();
    shelf.add("slew", |_| {});
    let mut library = PlanLibrary::read(shelf.path()).unwrap();
    assert_eq!(library.nearest(&shipped("detumble_4dof")), None);
    assert!(library.skipped().is_empty());
    assert_eq!(library.len(), 1);
    let empty = tempfile::tempdir().unwrap();
    let mut library = PlanLibrary::read(empty.path()).unwrap();
    assert!(library.is_empty() && library.nearest(&shelf.scenario).is_none());
    assert!(PlanLibrary::read(&empty.path().join("absent")).is_err());
}
