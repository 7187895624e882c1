//! The scenarios that ship are valid, mean what the paper says, and match the published schema.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use righting_multibody::DhConvention;
use righting_scenario::bodies::Piece;
use righting_scenario::collision::Between;
use righting_scenario::file::{Formulation, Guess, NamedGuess};
use righting_scenario::{Maneuver, Scenario, SystemDescription, schema};
use righting_test_support::json_schema::violation;
use righting_test_support::{scenarios, shipped};
use serde_json::Value;

fn json_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|end| end == "json")).collect();
    files.sort();
    files
}

const SYSTEMS: [&str; 4] = ["2dof", "4dof", "canadarm2_table", "canadarm2"];

#[test]
fn every_scenario_and_system_is_valid_and_named_after_its_file() {
    let names: BTreeSet<String> = json_files(&scenarios())
        .iter()
        .map(|file| {
            let scenario = Scenario::read(file).unwrap();
            let stem = file.file_stem().unwrap().to_str().unwrap();
            assert_eq!(scenario.name(), stem);
            stem.to_owned()
        })
        .collect();
    let kinds = ["slew", "detumble"];
    let expected = SYSTEMS.iter().flat_map(|system| {
        kinds
            .iter()
            .flat_map(move |kind| [format!("{kind}_{system}"), format!("{kind}_{system}_full")])
    });
    assert_eq!(names, expected.chain(["slew75_4dof".to_owned()]).collect());
    for file in json_files(&scenarios().join("real")) {
        let scenario = Scenario::read(&file).unwrap();
        assert_eq!(scenario.name(), file.file_stem().unwrap().to_str().unwrap());
    }
    for file in json_files(&scenarios().join("systems")) {
        let system = SystemDescription::read(&file).unwrap();
        assert_eq!(system.name, file.file_stem().unwrap().to_str().unwrap());
    }
}

#[test]
fn the_paper_s_folder_holds_the_shipped_maneuvers() {
    let files = json_files(&scenarios().join("paper"));
    assert_eq!(files.len(), 9);
    for file in files {
        let scenario = Scenario::read(&file).unwrap();
        let shipped = shipped(file.file_stem().unwrap().to_str().unwrap());
        assert_eq!(scenario.resolved(), shipped.resolved());
    }
}

#[test]
fn the_paper_s_maneuvers_have_the_paper_s_size() {
    for system in SYSTEMS {
        for (kind, suffix, formulation) in [
            ("slew", "", Formulation::Reduced),
            ("slew", "_full", Formulation::Full),
            ("detumble", "", Formulation::Reduced),
            ("detumble", "_full", Formulation::Full),
        ] {
            let scenario = shipped(&format!("{kind}_{system}{suffix}"));
            assert_eq!(scenario.solver().formulation, formulation);
            assert_eq!(scenario.solver().guess, Guess::Named(NamedGuess::Auto));
            assert_eq!(scenario.horizon().steps, 600);
            assert!((scenario.horizon().step_s() - 0.05).abs() < 1e-15);
            assert_eq!(scenario.collision().clearance_m, 0.01);
            let weights = scenario.weights();
            assert_eq!(weights, righting_scenario::Weights::defaults(scenario.maneuver()));
            match scenario.maneuver() {
                Maneuver::Slew(slew) => {
                    assert_eq!(kind, "slew");
                    assert_eq!(slew.angle_rad, 20.0_f64.to_radians());
                    assert!((slew.target.w - 10.0_f64.to_radians().cos()).abs() < 1e-15);
                    assert!((slew.axis.norm() - 1.0).abs() < 1e-15);
                    assert_eq!(scenario.initial().angular_momentum_n_m_s.norm(), 0.0);
                }
                Maneuver::Detumble => {
                    assert_eq!(kind, "detumble");
                    let rate = scenario.initial().angular_rate_rad_s;
                    assert_eq!(rate.as_slice(), [0.0, 0.0, -20.0_f64.to_radians()]);
                    let full = scenario.initial().angular_momentum_n_m_s;
                    assert!(full.norm() > 1.0);
                }
            }
        }
    }
}

#[test]
fn links_collide_as_the_design_says() {
    assert!(shipped("slew_2dof").collision().pairs.is_empty());
    let bodies = |links: &[usize]| -> Vec<Between> {
        links.iter().map(|&link| Between::Body(Piece::link(link))).collect()
    };
    let apart = |pairs: &[(usize, usize)]| -> Vec<Between> {
        pairs.iter().map(|&(a, b)| Between::links(a, b)).collect()
    };
    let kept = |scenario: &Scenario| -> Vec<Between> {
        scenario.collision().pairs.iter().map(|pair| pair.between).collect()
    };
    let xlink = shipped("slew_4dof");
    assert_eq!(kept(&xlink), [bodies(&[1, 2, 3]), apart(&[(0, 2), (0, 3), (1, 3)])].concat());
    for (name, convention) in [
        ("slew_canadarm2_table", DhConvention::Standard),
        ("slew_canadarm2", DhConvention::Modified),
    ] {
        let arm = shipped(name);
        assert_eq!(arm.system().model.rows().unwrap().convention, convention);
        let pairs = [(1, 3), (1, 4), (1, 5), (2, 4), (2, 5), (3, 5)];
        assert_eq!(kept(&arm), [bodies(&[3, 4, 5]), apart(&pairs)].concat());
        let radius = 3.0_f64.sqrt();
        assert!((arm.collision().pairs[0].least_m - radius - 0.01).abs() < 1e-15);
        assert_eq!(arm.system().model.total_mass(), 401_500.0);
    }
}

#[test]
fn the_base_starts_with_the_velocity_that_leaves_the_center_of_mass_at_rest() {
    for system in SYSTEMS {
        let scenario = shipped(&format!("detumble_{system}"));
        let initial = scenario.initial();
        let model = &scenario.system().model;
        let momentum = model.linear_momentum(&initial.state());
        let scale = model.total_mass() * initial.velocity_m_s.norm();
        assert!(scale > 0.0 && momentum.norm() <= 1e-13 * scale, "{system}: {momentum}");
    }
}

#[test]
fn the_resolved_scenario_is_the_same_problem() {
    for file in json_files(&scenarios()) {
        let scenario = Scenario::read(&file).unwrap();
        let text = serde_json::to_string_pretty(scenario.resolved()).unwrap();
        let again = Scenario::parse(&text, Path::new("elsewhere/resolved.json")).unwrap();
        assert_eq!(again, scenario);
        assert_eq!(again.resolved().sha256(), scenario.resolved().sha256());
        assert_eq!(scenario.resolved().sha256().len(), 64);
    }
    let (a, b) = (shipped("slew_4dof"), shipped("slew_4dof_full"));
    assert_ne!(a.resolved().sha256(), b.resolved().sha256());
}

#[test]
fn the_schemas_accept_what_ships_and_refuse_what_the_reader_refuses() {
    let scenario_schema = schema::scenario_schema();
    let system_schema = schema::system_schema();
    let json = |file: &Path| -> Value {
        serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
    };
    for file in json_files(&scenarios()) {
        assert_eq!(violation(&scenario_schema, &json(&file)), None);
        let resolved = serde_json::to_value(Scenario::read(&file).unwrap().resolved()).unwrap();
        assert_eq!(violation(&scenario_schema, &resolved), None);
    }
    for file in json_files(&scenarios().join("systems")) {
        assert_eq!(violation(&system_schema, &json(&file)), None);
    }

    let good = json(&scenarios().join("slew_4dof.json"));
    for (pointer, value) in [
        ("/horizon/steps", Value::from(0)),
        ("/horizon/steps", Value::from(1_000_000_000)),
        ("/horizon/duration_s", Value::from("30")),
        ("/maneuver/type", Value::from("spin")),
        ("/maneuver/axis", Value::from(vec![1.0, 0.0])),
        ("/solver/formulation", Value::from("fulll")),
        ("/weights/control", Value::from(-1)),
        ("/system", Value::from(7)),
    ] {
        let mut bad = good.clone();
        *bad.pointer_mut(pointer).unwrap() = value;
        assert!(violation(&scenario_schema, &bad).is_some(), "{pointer}");
    }
    let system = json(&scenarios().join("systems/xlink_4dof.json"));
    for (pointer, key, value, is_accepted) in [
        ("/links/2", "inertial_frame", Value::from("own"), true),
        ("/links/2", "inertial_frame", Value::from("previous"), true),
        ("/links/2", "inertial_frame", Value::from("next"), false),
        ("", "project_inertias", Value::from(true), true),
        ("", "project_inertias", Value::from("yes"), false),
        ("", "project_inertia", Value::from(true), false),
    ] {
        let mut changed = system.clone();
        changed.pointer_mut(pointer).unwrap()[key] = value.clone();
        let violation = violation(&system_schema, &changed);
        assert_eq!(violation.is_none(), is_accepted, "{pointer} {key} {value}: {violation:?}");
    }
    let mut unknown = good.clone();
    unknown["horizon"]["step"] = Value::from(600);
    assert!(violation(&scenario_schema, &unknown).is_some());
    let mut aimless = good;
    aimless["maneuver"].as_object_mut().unwrap().remove("axis");
    assert!(violation(&scenario_schema, &aimless).is_some());
}
