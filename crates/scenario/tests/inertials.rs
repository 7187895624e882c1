//! Published inertias that no body has, and the frames that inertials are in.

use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Vector3};
use righting_multibody::nearest_inertia;
use righting_scenario::{Error, Scenario, file};
use righting_test_support::scenarios;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn system(path: &Path) -> file::System {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn xlink() -> file::System {
    system(&scenarios().join("systems/xlink_4dof.json"))
}

/// A slew from zero joint angles, its system inline.
fn checked(mut system: file::System) -> Result<Scenario, Error> {
    // Clearances are no matter here.
    system.base.keep_out_radius_m = Some(0.0);
    for link in &mut system.links {
        link.body_exempt = false;
        (link.angle_min_deg, link.angle_max_deg) = (None, None);
    }
    let joints = system.links.len();
    let scenario = file::Scenario {
        name: "inertials".to_owned(),
        description: None,
        system: file::SystemReference::Inline(Box::new(system)),
        system_options: None,
        initial: file::Initial {
            joint_angles_deg: (0..joints).map(|joint| 20.0 + 10.0 * joint as f64).collect(),
            ..file::Initial::default()
        },
        maneuver: file::Maneuver {
            kind: file::ManeuverType::Slew,
            axis: Some([1.0, 0.0, 0.0]),
            angle_deg: Some(10.0),
            target_attitude: None,
            waypoints: Vec::new(),
        },
        horizon: file::Horizon { duration_s: file::Duration::Given(60.0), steps: 60.0 },
        weights: file::Weights::default(),
        end: None,
        wheels: Vec::new(),
        environment: None,
        robustness: None,
        pointing: Vec::new(),
        collision: file::Collision { clearance_m: Some(0.0) },
        solver: file::Solver::default(),
    };
    Scenario::from_file(scenario, Path::new("inertials.json"))
}

#[track_caller]
fn assert_refused(refused: Result<Scenario, Error>, message: &str) {
    let refused = refused.expect_err(message).to_string();
    assert!(refused.contains(message), "`{refused}` does not say `{message}`");
}

fn diagonal(moments: [f64; 3]) -> [[f64; 3]; 3] {
    let [x, y, z] = moments;
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| rows[row][column])
}

#[test]
fn published_tensors_are_refused_with_their_moments_and_projected_on_request() {
    let raw = system(&data("tecsas_raw.json"));
    assert_refused(
        checked(raw.clone()),
        "system.links[0].inertia_kg_m2: found principal moments -0.000521349, 0.000511434 and \
         0.00220678, expected the smallest to be zero or more (set system.project_inertias to true for \
         the nearest inertia that a rigid body can have)",
    );
    let scenario = checked(file::System { project_inertias: true, ..raw.clone() }).unwrap();
    // Five of its seven tensors are no body's, and those alone are changed, in the resolved file too.
    let changed: Vec<usize> = (0..7)
        .filter(|&link| {
            let [given, taken] = [&raw, scenario.resolved_system()]
                .map(|system| matrix(system.links[link].inertia_kg_m2.unwrap()));
            let model = scenario.system().model.rows().unwrap().links[link].inertia_kg_m2.unwrap();
            assert_eq!(taken, model);
            assert!((taken - nearest_inertia(&given)).norm() < 1e-15);
            taken != given
        })
        .collect();
    let of = |link: &usize| format!("system.links[{link}].inertia_kg_m2: changed by ");
    let notes = scenario.notes();
    assert_eq!(notes.len(), changed.len(), "{notes:?}");
    assert!(changed.iter().zip(notes).all(|(link, note)| note.starts_with(&of(link))), "{notes:?}");
    assert_eq!(changed, [0, 1, 2, 3, 5]);
    let resolved = scenario.resolved().clone();
    let again = Scenario::from_file(resolved, Path::new("resolved.json")).unwrap();
    assert_eq!(again.notes(), [""; 0]);
    assert_eq!(again.system(), scenario.system());
}

#[test]
fn a_base_and_a_payload_are_projected_too() {
    let mut planar = xlink();
    planar.project_inertias = true;
    planar.base.cube_side_m = None;
    planar.base.inertia_kg_m2 = Some(diagonal([0.0, 0.0, 6.0]));
    let payload = file::Payload {
        mass_kg: 5.0,
        inertia_kg_m2: Some(diagonal([1.0, 1.0, 2.3])),
        radius_m: None,
        shapes: None,
    };
    planar.payload = Some(payload);
    let scenario = checked(planar.clone()).unwrap();
    let base = scenario.system().model.base().inertia_kg_m2;
    assert!((base - matrix(diagonal([2.0, 2.0, 4.0]))).norm() < 1e-14);
    assert_eq!(
        scenario.notes(),
        [
            "system.base.inertia_kg_m2: changed by 58 % (Frobenius norm) to the nearest inertia that a \
             rigid body can have: principal moments from 0, 0, 6 to 2, 2, 4",
            "system.payload.inertia_kg_m2: changed by 6.4 % (Frobenius norm) to the nearest inertia that \
             a rigid body can have: principal moments from 1, 1, 2.3 to 1.1, 1.1, 2.2"
        ]
    );
    // The base's must be positive definite: a line's is not, and no way out is named that is none.
    planar.base.inertia_kg_m2 = Some(diagonal([-1.0, 2.0, 2.0]));
    let refused = checked(planar.clone()).unwrap_err().to_string();
    assert!(refused.ends_with("expected the smallest to be more than zero"), "{refused}");
    planar.project_inertias = false;
    let refused = checked(planar).unwrap_err().to_string();
    assert!(refused.ends_with("expected the smallest to be more than zero"), "{refused}");
}

#[test]
fn a_tensor_that_is_off_by_printing_is_a_body_s() {
    let with = |rows: [[f64; 3]; 3]| {
        let mut system = xlink();
        system.links[1].inertia_kg_m2 = Some(rows);
        checked(system)
    };
    // A plate's, 1/3 + 1/3 = 2/3 in six digits.
    let plate = with(diagonal([0.333333, 0.333333, 0.666667])).unwrap();
    let [note] = plate.notes() else { panic!("{:?}", plate.notes()) };
    assert!(note.starts_with("system.links[1].inertia_kg_m2: changed by 7.1e-5 %"), "{note}");
    let skewed = with([[1.0, 0.123456, 0.0], [0.123457, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap();
    let inertia = skewed.system().model.rows().unwrap().links[1].inertia_kg_m2.unwrap();
    assert_eq!((inertia.m12, skewed.notes().len()), (0.1234565, 1));
    assert_refused(
        with(diagonal([0.3333, 0.3333, 0.6667])),
        "found principal moments 0.3333, 0.3333 and 0.6667, expected the largest to be at most the sum \
         of the other two, 0.6666 (set system.project_inertias to true",
    );
    assert_refused(
        with([[1.0, 0.1, 0.0], [0.2, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        "system.links[1].inertia_kg_m2[0][1]: found 0.1, expected 0.2, the entry [1][0]: an inertia \
         matrix is symmetric (set system.project_inertias to true",
    );
}

/// A Craig table whose rows have the inertials of link i in frame i, and the same arm as it had to be
/// said without `inertial_frame`: each link's inertials on the next row, before an eighth joint.
#[test]
fn own_frames_are_those_of_craig_s_tables() {
    let shifted = system(&data("panda_craig_dummy2.json"));
    let mut table = system(&data("panda_craig_naive.json"));
    for (row, next) in table.links.iter_mut().zip(&shifted.links[1..]) {
        row.inertial_frame = Some(file::InertialFrame::Own);
        // The last row of the other one holds the hand too.
        (row.mass_kg, row.center_of_mass_m, row.inertia_kg_m2) =
            (next.mass_kg, next.center_of_mass_m, next.inertia_kg_m2);
    }
    let naive = system(&data("panda_craig_naive.json"));
    for link in 0..6 {
        assert_eq!(table.links[link].inertia_kg_m2, naive.links[link].inertia_kg_m2);
    }
    let (table, shifted) = (checked(table).unwrap(), checked(shifted).unwrap());
    assert_eq!((table.notes(), shifted.notes()), ([].as_slice(), [].as_slice()));
    let [table, shifted] = [table, shifted].map(|scenario| scenario.system().model.clone());
    let omega = Vector3::new(0.3, -0.2, 0.5);
    for sample in 0..20 {
        let q: Vec<f64> =
            (0..7).map(|joint| (1.7 * (sample * 7 + joint) as f64).sin() * 2.0).collect();
        let qdot: Vec<f64> = q.iter().map(|angle| (3.0 * angle).cos()).collect();
        let with_dummy = |values: &[f64]| [values, &[0.0]].concat();
        let (q8, qdot8) = (with_dummy(&q), with_dummy(&qdot));
        let gap = table.locked_inertia(&q) - shifted.locked_inertia(&q8);
        assert!(gap.norm() < 1e-12, "{gap}");
        let gap = table.angular_momentum(&omega, &q, &qdot)
            - shifted.angular_momentum(&omega, &q8, &qdot8);
        assert!(gap.norm() < 1e-12, "{gap}");
        let gap = table.center_of_mass(&q) - shifted.center_of_mass(&q8);
        assert!(gap.norm() < 1e-13, "{gap}");
    }
}

#[test]
fn a_file_that_looks_like_a_craig_table_is_noted_until_it_says_what_it_means() {
    let naive = system(&data("panda_craig_naive.json"));
    let noted = checked(naive.clone()).unwrap();
    let [note] = noted.notes() else { panic!("{:?}", noted.notes()) };
    assert!(
        note.starts_with(
            "system.links[0].inertial_frame: missing, so the 2.7907 kg of row 1 are fixed"
        ),
        "{note}"
    );
    assert!(note.contains("set inertial_frame \"own\" on every link"), "{note}");
    // The note can be followed either way.
    for frame in [file::InertialFrame::Own, file::InertialFrame::Previous] {
        let mut said = naive.clone();
        said.links.iter_mut().for_each(|link| link.inertial_frame = Some(frame));
        let said = checked(said).unwrap();
        assert_eq!(said.notes(), [""; 0]);
        let q = said.initial().joint_angles_rad.clone();
        let gap = said.system().model.locked_inertia(&q) - noted.system().model.locked_inertia(&q);
        assert_eq!(frame == file::InertialFrame::Previous, gap.norm() == 0.0);
    }
    let mut without_inertials = naive;
    for link in &mut without_inertials.links {
        (link.center_of_mass_m, link.inertia_kg_m2) = (None, None);
    }
    assert_eq!(checked(without_inertials).unwrap().notes(), [""; 0]);
}

#[test]
fn frames_that_say_nothing_are_refused() {
    let mut standard = xlink();
    standard.links[2].inertial_frame = Some(file::InertialFrame::Previous);
    assert_refused(
        checked(standard.clone()),
        "system.links[2].inertial_frame: found \"previous\", expected \"own\": with standard parameters \
         the mass of row i moves with frame i",
    );
    standard.links[2].inertial_frame = Some(file::InertialFrame::Own);
    checked(standard).unwrap();

    let own = |change: fn(&mut file::Link)| {
        let mut table = system(&data("panda_craig_naive.json"));
        table.links[2].inertial_frame = Some(file::InertialFrame::Own);
        change(&mut table.links[2]);
        checked(table)
    };
    own(|_| ()).unwrap();
    let message = "one in the link's own frame: the segment that gives a default moves with the frame \
                   before";
    assert_refused(
        own(|link| link.center_of_mass_m = None),
        &format!("system.links[2].center_of_mass_m: missing, expected {message}"),
    );
    assert_refused(
        own(|link| link.inertia_kg_m2 = None),
        &format!("system.links[2].inertia_kg_m2: missing, expected {message}"),
    );
    own(|link| {
        (link.mass_kg, link.center_of_mass_m, link.inertia_kg_m2) = (0.0, None, None);
    })
    .unwrap();
}
