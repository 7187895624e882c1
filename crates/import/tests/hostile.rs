//! Files that were damaged at random: refused or read, but never a panic nor a number that is none.
//!
//! `PROPTEST_CASES=1000000 cargo test --release -p righting-import --test hostile` looks for longer.

use proptest::prelude::*;
use righting_import::{Options, ReadOptions, Robot, System};

const WHOLE: &str = include_str!("data/gripper.urdf");

/// What numbers, names and tags are replaced by.
const WORDS: [&str; 28] = [
    "0",
    "-1",
    "1e308",
    "-1e-320",
    "nan",
    "inf",
    "1e999",
    "0 0 0",
    "1 2",
    "1e200 1e200 1e-200",
    "",
    "bus",
    "arm",
    "finger_l",
    "link",
    "joint",
    "robot",
    "revolute",
    "prismatic",
    "fixed",
    "floating",
    "planar",
    "continuous",
    "mesh",
    "sphere",
    "<",
    "\"",
    "&lt;",
];

/// One piece of damage.
#[derive(Clone, Debug)]
enum Damage {
    /// A quoted value becomes a word.
    Value(prop::sample::Index, prop::sample::Index),
    /// A line is lost.
    Loss(prop::sample::Index),
    /// A line stands somewhere else too.
    Copy(prop::sample::Index, prop::sample::Index),
    /// A character becomes another.
    Character(prop::sample::Index, char),
}

fn damage() -> impl Strategy<Value = Damage> {
    let place = any::<prop::sample::Index>;
    prop_oneof![
        6 => (place(), place()).prop_map(|(at, word)| Damage::Value(at, word)),
        1 => place().prop_map(Damage::Loss),
        2 => (place(), place()).prop_map(|(from, to)| Damage::Copy(from, to)),
        1 => (place(), any::<char>()).prop_map(|(at, to)| Damage::Character(at, to)),
    ]
}

fn damaged(text: &str, damage: &Damage) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    match damage {
        Damage::Value(at, word) => {
            let mut parts: Vec<&str> = text.split('"').collect();
            if parts.len() > 2 {
                // Every other part stands between quotes.
                let index = 2 * at.index((parts.len() - 1) / 2) + 1;
                parts[index] = WORDS[word.index(WORDS.len())];
            }
            parts.join("\"")
        }
        Damage::Loss(at) => {
            lines.remove(at.index(lines.len()));
            lines.join("\n")
        }
        Damage::Copy(from, to) => {
            let line = lines[from.index(lines.len())];
            lines.insert(to.index(lines.len()), line);
            lines.join("\n")
        }
        Damage::Character(at, to) => {
            let at = at.index(text.chars().count().max(1));
            text.chars().enumerate().map(|(k, c)| if k == at { *to } else { c }).collect()
        }
    }
}

fn assert_finite(system: &System, text: &str) {
    let bodies = std::iter::once(&system.base).chain(system.bodies.iter().map(|body| &body.body));
    for body in bodies {
        assert!(body.mass_kg.is_finite());
        let numbers = body.center_of_mass_m.iter().chain(&body.inertia_kg_m2);
        assert!(numbers.into_iter().all(|entry| entry.is_finite()), "{text}");
    }
    for body in &system.bodies {
        let placement = &body.joint.placement;
        let numbers =
            placement.position_m.iter().chain(&placement.rotation).chain(&body.joint.axis);
        assert!(numbers.into_iter().all(|entry| entry.is_finite()));
        for shape in &body.shapes {
            let capsule = shape.bounding_capsule();
            assert!(capsule.ends_m.iter().flatten().all(|entry| entry.is_finite()));
            assert!(capsule.radius_m.is_finite());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_damage_does_any(
        damages in prop::collection::vec(damage(), 1..6),
        base in any::<prop::sample::Index>(),
        point_masses in any::<bool>(),
        project_inertias in any::<bool>(),
    ) {
        let text = damages.iter().fold(WHOLE.to_owned(), |text, damage| {
            if text.is_empty() { text } else { damaged(&text, damage) }
        });
        let options = ReadOptions { folder: None, point_masses, project_inertias };
        match Robot::from_urdf(&text, &options) {
            Ok(robot) => {
                let base = ["bus", "arm", "finger_l", "sensor"][base.index(4)];
                for options in [Options::floating(base), Options::floating(robot.root())] {
                    match robot.system(&options) {
                        Ok(system) => assert_finite(&system, &text),
                        Err(error) => prop_assert!(!error.to_string().contains('\n')),
                    }
                }
            }
            Err(error) => prop_assert!(!error.to_string().contains('\n'), "{}", error),
        }
    }
}

/// A tetrahedron in three formats.
fn mesh(format: usize) -> (&'static str, Vec<u8>) {
    let corners = [[0.0_f32, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.3]];
    let faces = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
    match format {
        0 => {
            let mut bytes = vec![b' '; 80];
            bytes.extend(4_u32.to_le_bytes());
            for face in faces {
                bytes.extend([0_u8; 12]);
                for value in face.iter().flat_map(|&corner| corners[corner]) {
                    bytes.extend(value.to_le_bytes());
                }
                bytes.extend([0_u8; 2]);
            }
            ("a.stl", bytes)
        }
        1 => {
            let mut text = String::from("solid a\n");
            for face in faces {
                text += "facet normal 0 0 1\nouter loop\n";
                for [x, y, z] in face.map(|corner| corners[corner]) {
                    text += &format!("vertex {x} {y} {z}\n");
                }
                text += "endloop\nendfacet\n";
            }
            ("a.stl", (text + "endsolid a\n").into_bytes())
        }
        _ => {
            let mut text = String::from("mtllib a.mtl\n");
            for [x, y, z] in corners {
                text += &format!("v {x} {y} {z}\n");
            }
            for [a, b, c] in faces {
                text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
            }
            ("a.obj", text.into_bytes())
        }
    }
}

fn robot_with(
    file: &str,
    folder: &std::path::Path,
) -> Result<System, righting_import::ImportError> {
    let text = format!(
        "<robot name='r'><link name='a'><collision><geometry><mesh filename='package://meshes/{file}'/>\
         </geometry></collision></link></robot>"
    );
    let options = ReadOptions { folder: Some(folder.to_owned()), ..ReadOptions::default() };
    Robot::from_urdf(&text, &options)?.system(&Options::floating("a"))
}

#[test]
fn a_capsule_stands_for_a_mesh_of_each_format() {
    for format in 0..3 {
        let folder = tempfile::tempdir().unwrap();
        let (file, bytes) = mesh(format);
        std::fs::create_dir_all(folder.path().join("meshes/urdf")).unwrap();
        std::fs::write(folder.path().join("meshes").join(file), bytes).unwrap();
        let system = robot_with(file, &folder.path().join("meshes/urdf")).unwrap();
        assert!(system.notes[1].starts_with("capsules stand for meshes"), "{:?}", system.notes);
        let capsule = system.base_shapes[0].bounding_capsule();
        let [from, to] = capsule.ends_m;
        for corner in [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.3]] {
            let corner = nalgebra::Vector3::from(corner.map(|value: f32| f64::from(value)));
            let along = to - from;
            let share = along.dot(&(corner - from)) / along.norm_squared().max(1e-300);
            let off_m = (corner - from - along * share.clamp(0.0, 1.0)).norm();
            assert!(off_m <= capsule.radius_m * (1.0 + 1e-12));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_damaged_mesh_does_any(
        format in 0..3_usize,
        damages in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        length in any::<prop::sample::Index>(),
        is_cut in any::<bool>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let (file, mut bytes) = mesh(format);
        for (at, byte) in damages {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if is_cut {
            bytes.truncate(length.index(bytes.len()));
        }
        std::fs::create_dir_all(folder.path().join("meshes")).unwrap();
        std::fs::write(folder.path().join("meshes").join(file), bytes).unwrap();
        match robot_with(file, folder.path()) {
            Ok(system) => {
                for shape in &system.base_shapes {
                    prop_assert!(shape.bounding_capsule().radius_m.is_finite());
                }
            }
            Err(error) => prop_assert!(!error.to_string().contains('\n'), "{}", error),
        }
    }
}
