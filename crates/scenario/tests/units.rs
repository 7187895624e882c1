//! A scenario in other units is the same scenario: what is accepted, refused, kept apart and noted.

use std::path::Path;

use righting_scenario::collision::Between;
use righting_scenario::{Error, Scenario, file};
use righting_test_support::shipped;
use righting_test_support::units::Units;

const UNITS: [Units; 8] = [
    Units { length: 1e3, mass: 1.0, time: 1.0 },
    Units { length: 1e-3, mass: 1.0, time: 1.0 },
    Units { length: 1.0, mass: 1e6, time: 1.0 },
    Units { length: 1.0, mass: 1e-6, time: 1.0 },
    Units { length: 1.0, mass: 1.0, time: 1e2 },
    Units { length: 1.0, mass: 1.0, time: 1e-2 },
    Units { length: 1e3, mass: 1e6, time: 1e2 },
    Units { length: 1e-3, mass: 1e-6, time: 1e-2 },
];

fn checked(file: file::Scenario) -> Result<Scenario, Error> {
    Scenario::from_file(file, Path::new("units.json"))
}

/// What keeps apart.
fn kept(scenario: &Scenario) -> Vec<Between> {
    scenario.collision().pairs.iter().map(|pair| pair.between).collect()
}

/// The part of a complaint or a note that has no units: the field.
fn field(text: &str) -> &str {
    text.split(": ").find(|part| *part != "units.json").unwrap()
}

#[test]
fn every_shipped_maneuver_is_accepted_in_any_units() {
    for name in
        ["slew_2dof", "slew_4dof", "slew_canadarm2", "detumble_4dof", "detumble_canadarm2_table"]
    {
        let scenario = shipped(name);
        for units in UNITS {
            let other = checked(units.of(scenario.resolved())).unwrap();
            assert_eq!(other.notes(), [""; 0], "{name} {units:?}");
            assert_eq!(kept(&other), kept(&scenario));
        }
    }
}

#[test]
fn a_fast_spin_is_one_on_a_slow_clock() {
    let mut file = shipped("detumble_4dof").resolved().clone();
    file.initial.angular_rate_deg_s = Some([2400.0, -3600.0, 20_000.0]);
    let scenario = checked(file).unwrap();
    for units in UNITS {
        checked(units.of(scenario.resolved())).unwrap();
    }
}

/// Everything that is compared is compared with something of its own kind.
#[test]
fn what_is_refused_or_noted_is_so_in_any_units() {
    type Change = fn(&mut file::Scenario, &mut file::System);
    let cases: [(Change, bool); 10] = [
        // A momentum of the sixth digit, and one of the fourth.
        (|file, _| file.initial.joint_rates_deg_s = Some(vec![0.0, 1e-9, 0.0, 0.0]), false),
        (|file, _| moving(file, 1e-6), true),
        (|file, _| moving(file, 1e-4), false),
        // A start inside the clearance by the ninth digit, by the sixth, and by the fourth.
        (|file, system| near(file, system, 1e-11), true),
        (|file, system| near(file, system, 5e-6), true),
        (|file, system| near(file, system, 1e-4), false),
        // Links without length, short ones, and exemptions.
        (|_, system| system.links[1].a_m = 1e-12, true),
        (|_, system| system.links[1].a_m = 6e-3, true),
        (|_, system| system.links[0].body_exempt = false, false),
        (|_, system| system.links[2].body_exempt = true, false),
    ];
    for (case, (change, is_accepted)) in cases.into_iter().enumerate() {
        let mut file = shipped("slew_4dof").resolved().clone();
        let file::SystemReference::Inline(mut system) = file.system.clone() else {
            panic!("inline")
        };
        system.links[2].angle_max_deg = Some(179.0);
        change(&mut file, &mut system);
        file.system = file::SystemReference::Inline(system);
        let verdict = |result: Result<Scenario, Error>| match result {
            Ok(scenario) => (
                true,
                scenario.notes().iter().map(|note| field(note).to_owned()).collect(),
                kept(&scenario),
            ),
            Err(error) => (false, vec![field(&error.to_string()).to_owned()], Vec::new()),
        };
        let here = verdict(checked(file.clone()));
        assert_eq!(here.0, is_accepted, "case {case}: {here:?}");
        for units in UNITS {
            assert_eq!(verdict(checked(units.of(&file))), here, "case {case} {units:?}");
        }
    }
}

/// Joint 1 and the base turn against each other, but for a part `leftover` of the base's rate.
fn moving(file: &mut file::Scenario, leftover: f64) {
    let at_rest = shipped("slew_4dof");
    let model = &at_rest.system().model;
    let q = &at_rest.initial().joint_angles_rad;
    let momentum = nalgebra::Vector3::zeros();
    let omega = model.reduced_angular_rate(q, &[0.1, 0.0, 0.0, 0.0], &momentum);
    let about_z_deg_s = omega.z.to_degrees();
    file.initial.joint_rates_deg_s = Some(vec![0.1_f64.to_degrees(), 0.0, 0.0, 0.0]);
    let leftover_deg_s = 0.1_f64.to_degrees() * leftover;
    file.initial.angular_rate_deg_s = Some([0.0, 0.0, about_z_deg_s + leftover_deg_s]);
}

/// Link 3 is folded back along link 2: its end is nearer to that than the clearance by `missing_m`.
fn near(file: &mut file::Scenario, system: &mut file::System, missing_m: f64) {
    system.base.keep_out_radius_m = Some(0.0);
    system.links[0].body_exempt = false;
    file.initial.joint_angles_deg = vec![0.0, 0.0, 176.0, 0.0];
    file.collision.clearance_m = Some(0.25 * 4.0_f64.to_radians().sin() + missing_m);
}
