//! Plans in the formats of other programs, read back by other means.

use crate::program::{files_in, folder_with, righting, small_detumble, small_slew, solve};

/// An Attitude Ephemeris Message as its standard defines it (CCSDS 504.0-B-2): keywords, and data
/// lines of EPOCH Q1 Q2 Q3 QC ANGVEL_X ANGVEL_Y ANGVEL_Z.
struct Message {
    keywords: Vec<(String, String)>,
    lines: Vec<(f64, [f64; 4], [f64; 3])>,
}

impl Message {
    fn parse(text: &str) -> Self {
        let (head, rest) = text.split_once("DATA_START\n").expect("a data section");
        let data = rest.strip_suffix("DATA_STOP\n").expect("its end");
        assert!(text.is_ascii() && text.lines().all(|line| line.len() <= 254));
        let keywords = head.lines().filter_map(|line| line.split_once(" = "));
        let keywords = keywords.map(|(key, value)| (key.to_owned(), value.to_owned())).collect();
        let lines = data.lines().map(|line| {
            let mut cells = line.split(' ');
            let tag = cells.next().expect("an epoch");
            let (date, time) = tag.split_once('T').expect("a date and a time");
            assert_eq!(date, "2027-03-01", "{line}");
            let clock: Vec<f64> = time.split(':').map(|part| part.parse().expect("")).collect();
            let seconds = 3600.0 * clock[0] + 60.0 * clock[1] + clock[2];
            let numbers: Vec<f64> = cells.map(|cell| cell.parse().expect("a number")).collect();
            let [q1, q2, q3, qc, x, y, z] = numbers[..] else { panic!("{line}") };
            (seconds, [q1, q2, q3, qc], [x, y, z])
        });
        Self { keywords, lines: lines.collect() }
    }

    fn get(&self, keyword: &str) -> &str {
        let found = self.keywords.iter().find(|(key, _)| key == keyword);
        found.map_or_else(|| panic!("no {keyword}"), |(_, value)| value)
    }
}

/// The matrix that takes coordinates in frame A to coordinates in frame B (annex F2).
fn frame_transformation([q1, q2, q3, qc]: [f64; 4]) -> [[f64; 3]; 3] {
    let square = |q: f64| q * q;
    [
        [
            square(q1) - square(q2) - square(q3) + square(qc),
            2.0 * (q1 * q2 + q3 * qc),
            2.0 * (q1 * q3 - q2 * qc),
        ],
        [
            2.0 * (q1 * q2 - q3 * qc),
            -square(q1) + square(q2) - square(q3) + square(qc),
            2.0 * (q2 * q3 + q1 * qc),
        ],
        [
            2.0 * (q1 * q3 + q2 * qc),
            2.0 * (q2 * q3 - q1 * qc),
            -square(q1) - square(q2) + square(q3) + square(qc),
        ],
    ]
}

fn exported(scenario: &serde_json::Value) -> Message {
    let folder = folder_with(scenario);
    assert_eq!(solve(folder.path()).code, 0);
    let run = righting(
        folder.path(),
        &["export", "out", "--format", "aem", "--epoch", "2027-03-01T23:59:00Z"],
    );
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(run.stdout, "out/attitude.aem\n");
    let text = std::fs::read_to_string(folder.path().join("out/attitude.aem")).expect("written");
    assert!(text.starts_with("CCSDS_AEM_VERS = 2.0\n"));
    Message::parse(&text)
}

#[test]
fn a_message_tells_frames_times_and_attitude() {
    let message = exported(&small_slew());
    for (keyword, value) in [
        ("ORIGINATOR", "RIGHTING"),
        ("OBJECT_NAME", "TWO_JOINTS"),
        ("OBJECT_ID", "UNKNOWN"),
        ("REF_FRAME_A", "EME2000"),
        ("REF_FRAME_B", "SC_BODY_1"),
        ("TIME_SYSTEM", "UTC"),
        ("START_TIME", "2027-03-01T23:59:00.000"),
        ("STOP_TIME", "2027-03-01T23:59:20.000"),
        ("ATTITUDE_TYPE", "QUATERNION/ANGVEL"),
        ("ANGVEL_FRAME", "SC_BODY_1"),
    ] {
        assert_eq!(message.get(keyword), value);
    }
    assert_eq!(message.lines.len(), 41);
    assert!(message.lines.windows(2).all(|pair| (pair[1].0 - pair[0].0 - 0.5).abs() < 1e-9));
    // The slew turns the body by 2° about x: y of the body leans towards z of the inertial frame.
    let (sin, cos) = 2f64.to_radians().sin_cos();
    let last = frame_transformation(message.lines[40].1);
    for (row, expected) in last.iter().zip([[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]]) {
        for (found, expected) in row.iter().zip(expected) {
            assert!((found - expected).abs() < 2e-3, "{last:?}");
        }
    }
    assert!((last[1][2] - sin).abs() < 0.1 * sin);
}

/// Seen from the body, what stands still turns backwards: Ṁ = −[ω]× M, with ω in deg/s and body axes;
/// over one interval the mean of both ends is near.
#[test]
fn a_message_s_rates_are_those_of_its_attitudes() {
    let mut fine = small_detumble();
    fine["horizon"]["steps"] = serde_json::json!(160);
    let lines = exported(&fine).lines;
    let mut largest = 0.0_f64;
    for two in lines.windows(2) {
        let step_s = two[1].0 - two[0].0;
        let matrices = [0, 1].map(|i| frame_transformation(two[i].1));
        let slope = |at: usize, row: usize, column: usize| -> f64 {
            let [x, y, z] = two[at].2.map(f64::to_radians);
            let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
            -(0..3).map(|k| cross[row][k] * matrices[at][k][column]).sum::<f64>()
        };
        for (row, column) in (0..9).map(|i| (i / 3, i % 3)) {
            let found = (matrices[1][row][column] - matrices[0][row][column]) / step_s;
            let expected = 0.5 * (slope(0, row, column) + slope(1, row, column));
            largest = largest.max(expected.abs());
            assert!((found - expected).abs() < 1e-3, "{found} {expected}");
        }
    }
    assert!(largest > 0.05, "{largest} rad/s shows little");
}

/// A reader of NumPy's archives as its documents describe them: stored members of a ZIP file, each a
/// dictionary and doubles.
fn array(archive: &[u8], name: &str) -> (String, Vec<f64>) {
    let name = format!("{name}.npy");
    let at = (0..archive.len() - name.len())
        .find(|&i| {
            archive[i..].starts_with(b"PK\x03\x04")
                && archive[i + 30..].starts_with(name.as_bytes())
        })
        .unwrap_or_else(|| panic!("no {name}"));
    let short = |i: usize| usize::from(u16::from_le_bytes([archive[i], archive[i + 1]]));
    let size = short(at + 22) + (short(at + 24) << 16);
    let start = at + 30 + short(at + 26) + short(at + 28);
    let npy = &archive[start..start + size];
    assert_eq!(npy[..8], *b"\x93NUMPY\x01\x00");
    let header = usize::from(u16::from_le_bytes([npy[8], npy[9]]));
    assert_eq!((10 + header) % 64, 0);
    let text = std::str::from_utf8(&npy[10..10 + header]).expect("text").trim().to_owned();
    let cells = npy[10 + header..].chunks_exact(8);
    let double = |cell: &[u8]| f64::from_le_bytes(cell.try_into().expect("eight bytes"));
    (text, cells.map(double).collect())
}

#[test]
fn an_archive_holds_the_table() {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let run =
        righting(folder.path(), &["export", "out", "--format", "npz", "--out", "elsewhere/a.npz"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let archive = std::fs::read(folder.path().join("elsewhere/a.npz")).expect("written");
    let table = std::fs::read_to_string(folder.path().join("out/trajectory.csv")).expect("there");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let groups = [
        ("t_s", "t_s", 1),
        ("r_m", "rx_m", 3),
        ("q_wxyz", "qw", 4),
        ("v_m_s", "vx_m_s", 3),
        ("w_rad_s", "wx_rad_s", 3),
        ("q_rad", "q1_rad", 2),
        ("dq_rad_s", "dq1_rad_s", 2),
        ("u_rad_s2", "u1_rad_s2", 2),
        ("tau_n_m", "tau1_n_m", 2),
        ("power_w", "power_w", 1),
    ];
    for (name, first, width) in groups {
        let (header, values) = array(&archive, name);
        let column = rows[0].iter().position(|cell| *cell == first).expect("a column");
        let cells: Vec<f64> = rows[1..]
            .iter()
            .flat_map(|row| &row[column..column + width])
            .filter(|cell| !cell.is_empty())
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        assert_eq!(values, cells, "{name}");
        let count = cells.len() / width;
        let shape = if width == 1 { format!("({count},)") } else { format!("({count}, {width})") };
        let expected = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        assert_eq!(header, expected);
    }
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let folder = folder_with(&small_slew());
    let run = |options: &[&str]| {
        righting(folder.path(), &[&["export", "out", "--format", "aem"], options].concat())
    };
    run(&[]).assert_refused("no such file");
    assert_eq!(solve(folder.path()).code, 0);
    run(&["--object-name", "ÉTOILE"])
        .assert_refused("OBJECT_NAME: found \"ÉTOILE\", expected 1 to 200 printable ASCII");
    run(&["--object-id", ""]).assert_refused("OBJECT_ID");
    run(&["--epoch", "9999-12-31T23:59:59"]).assert_refused("time tags: found a step of 0.5 s from 9999-12-31T23:59:59, expected at least 1e-9 s, up to the year 9999\n");
    let late = run(&["--epoch", "tomorrow"]);
    assert!(
        late.code == 2 && late.stderr.contains("expected a time such as 2027-03-01T12:00:00\n"),
        "{}",
        late.stderr
    );
    assert!(!files_in(&folder.path().join("out")).contains(&"attitude.aem".to_owned()));
    // A plan that does not hold is not handed on.
    let table = folder.path().join("out/trajectory.csv");
    let text = std::fs::read_to_string(&table).expect("readable");
    let changed = text.replacen("0.0000000000000000e0,", "1.0000000000000000e-2,", 2);
    std::fs::write(&table, changed).expect("writable");
    assert_eq!(run(&[]).code, 4);
    assert!(!files_in(&folder.path().join("out")).contains(&"attitude.aem".to_owned()));
}

/// A plan with every export of its own format beside it.
fn exported_as(formats: &[&str]) -> tempfile::TempDir {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    for format in formats {
        let run = righting(folder.path(), &["export", "out", "--format", format]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{format}");
        for file in run.stdout.lines() {
            assert!(folder.path().join(file).is_file(), "{format}: {file}");
        }
    }
    folder
}

#[test]
fn every_format_has_files_of_its_own_and_the_next_plan_removes_them() {
    let formats = [
        "urdf",
        "mjcf",
        "joint-trajectory",
        "ck",
        "stk",
        "aem",
        "npz",
        "mat",
        "basilisk",
        "mujoco",
    ];
    let files = [
        "attitude.a",
        "attitude.aem",
        "attitude.bc",
        "attitude.tf",
        "attitude.tsc",
        "fly_basilisk.py",
        "fly_mujoco.py",
        "joint_trajectory.yaml",
        "system.urdf",
        "system.xml",
        "trajectory.mat",
        "trajectory.npz",
    ];
    let folder = exported_as(&formats);
    let out = folder.path().join("out");
    for file in files {
        assert!(files_in(&out).contains(&file.to_owned()), "{file}");
    }
    // What belongs to an earlier plan is not taken for the next one's.
    let mut impossible = small_slew();
    impossible["horizon"]["duration_s"] = serde_json::json!(0.01);
    std::fs::write(folder.path().join("scenario.json"), impossible.to_string()).expect("writable");
    assert_eq!(solve(folder.path()).code, 3);
    for file in files {
        assert!(!files_in(&out).contains(&file.to_owned()), "{file}");
    }
}

#[test]
fn a_joint_trajectory_is_yaml_or_json_of_the_same_numbers() {
    let folder = exported_as(&["joint-trajectory"]);
    let run = righting(
        folder.path(),
        &["export", "out", "--format", "joint-trajectory", "--out", "elsewhere/m.json"],
    );
    assert_eq!((run.code, run.stdout.as_str()), (0, "elsewhere/m.json\n"));
    let text = std::fs::read_to_string(folder.path().join("elsewhere/m.json")).expect("written");
    let message: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(message["joint_names"], serde_json::json!(["joint_1", "joint_2"]));
    let points = message["points"].as_array().expect("points");
    assert_eq!(points.len(), 41);
    let half = serde_json::json!({ "sec": 19, "nanosec": 500_000_000 });
    assert_eq!(points[39]["time_from_start"], half);
    let yaml = std::fs::read_to_string(folder.path().join("out/joint_trajectory.yaml"));
    let yaml = yaml.expect("written");
    let lines: Vec<&str> = yaml.lines().collect();
    assert!(lines.contains(&"joint_names: [joint_1, joint_2]"));
    assert!(lines.contains(&"    time_from_start: {sec: 19, nanosec: 500000000}"));
    for key in ["positions", "velocities", "accelerations", "effort"] {
        let rows = lines.iter().filter_map(|line| line.split_once(&format!("{key}: ")));
        let rows: Vec<serde_json::Value> = rows
            .map(|(_, row)| serde_json::from_str(&row.replace("e+", "e")).expect("numbers"))
            .collect();
        let of_json: Vec<_> = points.iter().map(|point| point[key].clone()).collect();
        assert_eq!(rows, of_json, "{key}");
    }
}

#[test]
fn an_stk_file_has_the_numbers_of_the_message() {
    let folder = exported_as(&["stk", "aem"]);
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let (file, message) = (read("attitude.a"), read("attitude.aem"));
    assert!(file.starts_with("stk.v.11.0\n") && file.ends_with("\nEND Attitude\n"));
    assert!(file.contains("\nScenarioEpoch 1 Jan 2000 12:00:00.000000000\n"));
    assert!(file.contains("\nNumberOfAttitudePoints 41\n"));
    assert!(file.contains("\nCoordinateAxes J2000\n"));
    let after = |text: &str, mark: &str| -> Vec<String> {
        let rows = text.lines().skip_while(|line| *line != mark).skip(1);
        let rows = rows.filter_map(|line| line.split_once(' ')).map(|(_, rest)| rest.to_owned());
        rows.filter(|rest| rest.contains(' ')).collect()
    };
    let found = after(&file, "AttitudeTimeQuatAngVels");
    assert_eq!(found.len(), 41);
    assert_eq!(found, after(&message, "DATA_START"));
}

/// A MATLAB file of level 5 as its format's document describes it.
#[test]
fn a_matlab_file_holds_the_columns() {
    let folder = exported_as(&["mat"]);
    let bytes = std::fs::read(folder.path().join("out/trajectory.mat")).expect("written");
    assert!(bytes.starts_with(b"MATLAB 5.0 MAT-file"));
    assert_eq!(bytes[124..128], *b"\x00\x01IM");
    let int = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    let double = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"));
    let mut at = 128;
    let mut matrices = std::collections::BTreeMap::new();
    while at < bytes.len() {
        assert_eq!(int(at), 14, "a matrix");
        let end = at + 8 + int(at + 4) as usize;
        // Flags, dimensions, name, values: each padded to eight bytes.
        assert_eq!((int(at + 8), int(at + 12), int(at + 16)), (6, 8, 6));
        let [rows, columns] = [int(at + 32), int(at + 36)].map(|length| length as usize);
        let length = int(at + 44) as usize;
        let name = String::from_utf8(bytes[at + 48..at + 48 + length].to_vec()).expect("a name");
        let values = at + 48 + length.next_multiple_of(8);
        assert_eq!(int(values) as usize, 9);
        assert_eq!(int(values + 4) as usize, 8 * rows * columns, "{name}");
        let value = move |row: usize, column: usize| values + 8 + 8 * (column * rows + row);
        matrices.insert(name, (rows, columns, value));
        at = end;
    }
    assert_eq!(at, bytes.len());
    let table = std::fs::read_to_string(folder.path().join("out/trajectory.csv")).expect("there");
    let cell = |row: usize, name: &str| -> f64 {
        let mut lines = table.lines();
        let column = lines.next().expect("a header").split(',').position(|cell| cell == name);
        let line = lines.nth(row).expect("a row");
        line.split(',').nth(column.expect("a column")).expect("a cell").parse().expect("a number")
    };
    let at = |name: &str, row, column| double((matrices[name].2)(row, column));
    assert_eq!((matrices["q_wxyz"].0, matrices["q_wxyz"].1), (41, 4));
    assert_eq!((matrices["tau_n_m"].0, matrices["tau_n_m"].1), (40, 2));
    assert_eq!((matrices["t_s"].0, matrices["t_s"].1), (41, 1));
    assert_eq!(at("t_s", 17, 0), cell(17, "t_s"));
    assert_eq!(at("q_wxyz", 30, 2), cell(30, "qy"));
    assert_eq!(at("tau_n_m", 5, 1), cell(5, "tau2_n_m"));
}

/// A C-kernel read by the required reading of DAF and CK files.
#[test]
fn a_c_kernel_holds_attitudes_rates_and_times() {
    let folder = exported_as(&["ck"]);
    let out = folder.path().join("out");
    let bytes = std::fs::read(out.join("attitude.bc")).expect("written");
    let int = |at: usize| i32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    let word = |address: usize| {
        let at = 8 * (address - 1);
        f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"))
    };
    assert!(bytes.starts_with(b"DAF/CK  ") && bytes.len().is_multiple_of(1024));
    assert_eq!((int(8), int(12)), (2, 6));
    assert_eq!(&bytes[88..96], b"LTL-IEEE");
    assert_eq!(&bytes[699..727], b"FTPSTR:\r:\n:\r\n:\r\0:\x81:\x10\xce:ENDFTP");
    let summary = (int(76) - 1) as usize * 128 + 1;
    assert_eq!([0, 1, 2].map(|i| word(summary + i)), [0.0, 0.0, 1.0]);
    assert_eq!([3, 4].map(|i| word(summary + i)), [0.0, 20e6]);
    let codes: Vec<i32> = (0..6).map(|i| int(8 * (summary + 4) + 4 * i)).collect();
    let [body, frame, kind, has_rates, first, last] = codes[..] else { panic!("six") };
    assert_eq!((body, frame, kind, has_rates), (-999_000, 1, 3, 1));
    let (first, last) = (first as usize, last as usize);
    assert_eq!((word(last), word(last - 1), word(last - 2)), (41.0, 1.0, 0.0));
    assert_eq!(last - first + 1, 41 * 8 + 3);
    assert_eq!(int(84) as usize, last + 1);
    let table = std::fs::read_to_string(out.join("trajectory.csv")).expect("there");
    for (k, line) in table.lines().skip(1).enumerate() {
        let cells: Vec<f64> =
            line.split(',').take(14).map(|cell| cell.parse().expect("a number")).collect();
        let found = [0, 1, 2, 3].map(|i| word(first + 7 * k + i));
        // Of the matrix from inertial to body coordinates.
        for (found, (sign, cell)) in
            found.iter().zip([1.0, -1.0, -1.0, -1.0].iter().zip(&cells[4..]))
        {
            assert!((found - sign * cell).abs() < 1e-9, "{k}");
        }
        let rate = |i: usize| word(first + 7 * k + 4 + i);
        let norm =
            |rate: &dyn Fn(usize) -> f64| (0..3).map(|i| rate(i).powi(2)).sum::<f64>().sqrt();
        assert!((norm(&rate) - norm(&|i| cells[11 + i])).abs() < 1e-12, "{k}");
        assert_eq!(word(first + 41 * 7 + k), cells[0] * 1e6, "{k}");
    }
    let clock = std::fs::read_to_string(out.join("attitude.tsc")).expect("written");
    assert!(clock.starts_with("KPL/SCLK\n") && clock.contains("SCLK01_MODULI_999 = ( "));
    let frame = std::fs::read_to_string(out.join("attitude.tf")).expect("written");
    assert!(frame.contains("FRAME_TWO_JOINTS_BODY = -999000\n"));
    let run = righting(folder.path(), &["export", "out", "--format", "ck", "--out", "a.tf"]);
    run.assert_refused("give it another ending");
    let run = righting(folder.path(), &["export", "out", "--format", "ck", "--naif-id", "5"]);
    run.assert_refused("NAIF ID: found 5, expected a number from -2147483 to -1");
    let run = righting(folder.path(), &["export", "out", "--format", "ck", "--frame", "ITRF"]);
    run.assert_refused("frame: found \"ITRF\", expected EME2000, J2000, ICRF or ECLIPJ2000");
}

#[test]
fn a_flight_has_the_plan_and_the_model_in_it() {
    let folder = exported_as(&["mujoco", "basilisk"]);
    for (name, module) in [("fly_mujoco.py", "import mujoco\n"), ("fly_basilisk.py", "Basilisk")] {
        let text = std::fs::read_to_string(folder.path().join("out").join(name)).expect("written");
        assert!(text.starts_with("#!/usr/bin/env python3\n") && text.contains(module), "{name}");
        assert!(text.contains("\nMANEUVER = \"slew of 2° about [1, 0, 0] in 20 s\"\n"), "{name}");
        assert!(text.contains("\nJOINTS = [\"joint_1\", \"joint_2\"]\n"), "{name}");
        assert!(!text.contains("# CONSTANTS"), "{name}");
        let (_, torques) = text.split_once("\nTORQUE_COEFFICIENTS = ").expect("torques");
        assert!(torques.contains("(40, 7, 2, ))\n"), "{name}");
    }
}

#[test]
fn every_format_refuses_a_plan_that_does_not_hold() {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let table = folder.path().join("out/trajectory.csv");
    let text = std::fs::read_to_string(&table).expect("readable");
    let changed = text.replacen("0.0000000000000000e0,", "1.0000000000000000e-2,", 2);
    std::fs::write(&table, changed).expect("writable");
    let before = files_in(&folder.path().join("out"));
    for format in ["urdf", "mjcf", "joint-trajectory", "ck", "stk", "mat", "basilisk", "mujoco"] {
        let run = righting(folder.path(), &["export", "out", "--format", format]);
        assert_eq!(run.code, 4, "{format}");
    }
    assert_eq!(files_in(&folder.path().join("out")), before);
}
