//! `trajectory.csv` is read back bit for bit, and a damaged table is refused with the place.

use std::fs;
use std::path::Path;

use righting_results::{ControlInterval, Node, Trajectory};
use righting_scenario::Error;
use righting_scenario::file::JointKind;

/// A trajectory of awkward numbers: every bit pattern of a finite double is fair.
fn awkward(joints: usize, steps: usize, with_jerks: bool, wheels: usize) -> Trajectory {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut number = || loop {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let value = f64::from_bits(state);
        if value.is_finite() {
            return value;
        }
    };
    let mut several = |count: usize| (0..count).map(|_| number()).collect::<Vec<_>>();
    let nodes = (0..=steps)
        .map(|k| Node {
            time_s: k as f64 * 0.1,
            position_m: [-0.0, f64::MIN_POSITIVE / 8.0, f64::MAX],
            attitude: several(4).try_into().unwrap(),
            velocity_m_s: several(3).try_into().unwrap(),
            angular_rate_rad_s: several(3).try_into().unwrap(),
            joint_angles_rad: several(joints),
            joint_rates_rad_s: several(joints),
            power_w: several(1)[0],
            wheel_momenta_n_m_s: several(wheels),
        })
        .collect();
    let intervals = (0..steps)
        .map(|_| ControlInterval {
            joint_accelerations_rad_s2: several(joints),
            joint_jerks_rad_s3: several(if with_jerks { joints } else { 0 }),
            joint_torques_n_m: several(joints),
            wheel_torques_n_m: several(wheels),
        })
        .collect();
    Trajectory::new(nodes, intervals).unwrap()
}

fn turning(joints: usize) -> Vec<JointKind> {
    vec![JointKind::Revolute; joints]
}

fn bits(trajectory: &Trajectory) -> Vec<u64> {
    let mut text = Vec::new();
    trajectory.print_csv(&turning(trajectory.joints()), &mut text).unwrap();
    let nodes = trajectory.nodes().iter().flat_map(|node| {
        let arrays = [&node.position_m[..], &node.attitude, &node.velocity_m_s];
        let rest = [&node.angular_rate_rad_s[..], &node.joint_angles_rad, &node.joint_rates_rad_s];
        let rest = rest.into_iter().chain([&node.wheel_momenta_n_m_s[..]]);
        let scalars = [node.time_s, node.power_w];
        arrays.into_iter().chain(rest).flatten().copied().chain(scalars).collect::<Vec<_>>()
    });
    let intervals = trajectory.intervals().iter().flat_map(|interval| {
        let ControlInterval {
            joint_accelerations_rad_s2,
            joint_jerks_rad_s3,
            joint_torques_n_m,
            wheel_torques_n_m,
        } = interval;
        let of_joints = [&joint_accelerations_rad_s2[..], joint_jerks_rad_s3, joint_torques_n_m];
        [&of_joints.concat()[..], wheel_torques_n_m].concat()
    });
    nodes.chain(intervals).map(f64::to_bits).collect()
}

#[test]
fn the_header_is_the_contract() {
    let mut text = Vec::new();
    awkward(2, 1, false, 0).print_csv(&turning(2), &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "t_s,rx_m,ry_m,rz_m,qw,qx,qy,qz,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,\
         q1_rad,q2_rad,dq1_rad_s,dq2_rad_s,u1_rad_s2,u2_rad_s2,tau1_n_m,tau2_n_m,power_w"
    );
    assert_eq!(lines.len(), 3);
    let first: Vec<&str> = lines[1].split(',').collect();
    let last: Vec<&str> = lines[2].split(',').collect();
    assert!(first.iter().all(|cell| cell.parse::<f64>().is_ok()));
    assert!(last[18..22].iter().all(|cell| cell.is_empty()));
    assert!(last[22].parse::<f64>().is_ok());
    assert_eq!(first[4].chars().filter(char::is_ascii_digit).count().min(17), 17);
}

#[test]
fn joints_that_slide_have_metres_in_their_names() {
    let mut text = Vec::new();
    let kinds = [JointKind::Prismatic, JointKind::Revolute, JointKind::Prismatic];
    let trajectory = awkward(3, 1, true, 0);
    trajectory.print_csv(&kinds, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let names = "q1_m,q2_rad,q3_m,dq1_m_s,dq2_rad_s,dq3_m_s,u1_m_s2,u2_rad_s2,u3_m_s2,f1_n,tau2_n_m,f3_n,\
                 power_w,j1_m_s3,j2_rad_s3,j3_m_s3\n";
    assert!(text.split_once("wz_rad_s,").unwrap().1.starts_with(names), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("trajectory.csv");
    trajectory.write_csv(&kinds, &file).unwrap();
    assert_eq!(bits(&Trajectory::read_csv(&file).unwrap()), bits(&trajectory));
    // All columns of a joint have one unit.
    let mixed = refusal(&text.replace("dq1_m_s", "dq1_rad_s"));
    assert!(mixed.contains("found column `dq1_rad_s`, expected `dq1_m_s`"), "{mixed}");
}

#[test]
fn jerks_stand_after_all_other_columns() {
    let mut text = Vec::new();
    awkward(2, 1, true, 0).print_csv(&turning(2), &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].ends_with(",tau2_n_m,power_w,j1_rad_s3,j2_rad_s3"), "{}", lines[0]);
    assert!(lines[1].split(',').all(|cell| cell.parse::<f64>().is_ok()));
    assert!(lines[2].ends_with(",,"), "{}", lines[2]);
    assert!(refusal(&text.replace(",j2_rad_s3", "")).contains("found 24 columns, expected 14"));
    let full = text.trim_end().strip_suffix(",,").unwrap().to_owned() + ",0,";
    assert!(refusal(&full).starts_with("line 3, column j1_rad_s3: found `0`, expected an empty"));
}

#[test]
fn wheels_stand_last() {
    let mut text = Vec::new();
    awkward(1, 1, true, 2).print_csv(&turning(1), &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let expected = ",power_w,j1_rad_s3,hw1_n_m_s,hw2_n_m_s,tauw1_n_m,tauw2_n_m";
    assert!(lines[0].ends_with(expected), "{}", lines[0]);
    assert!(lines[1].split(',').all(|cell| cell.parse::<f64>().is_ok()));
    assert!(lines[2].ends_with(",,"), "{}", lines[2]);
    assert!(refusal(&text.replace(",tauw2_n_m", "")).contains("2 for each wheel and power_w"));
}

#[test]
fn a_table_is_read_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    for (joints, steps) in [(1, 1), (2, 7), (7, 600)] {
        for (with_jerks, wheels) in [(false, 0), (true, 0), (false, 3), (true, 4)] {
            let file = folder.path().join("trajectory.csv");
            let trajectory = awkward(joints, steps, with_jerks, wheels);
            trajectory.write_csv(&turning(joints), &file).unwrap();
            let read = Trajectory::read_csv(&file).unwrap();
            assert_eq!(bits(&read), bits(&trajectory));
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "temporary files are gone");
}

fn refusal(text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("trajectory.csv");
    fs::write(&file, text).unwrap();
    let message = Trajectory::read_csv(&file).unwrap_err().to_string();
    let place = format!("{}: ", file.display());
    message.strip_prefix(&place).expect("the message starts with the file").to_owned()
}

#[test]
fn damaged_tables_are_refused_with_the_place() {
    let mut good = Vec::new();
    awkward(1, 2, false, 0).print_csv(&turning(1), &mut good).unwrap();
    let good = String::from_utf8(good).unwrap();
    let rows: Vec<&str> = good.lines().collect();

    assert!(refusal("").contains("found an empty file, expected a header and rows"));
    assert!(refusal(rows[0]).contains("found 0 rows, expected at least 2"));
    assert!(refusal(&good.replace("qw,qx", "qx,qw")).contains("found column `qx`, expected `qw`"));
    let short = format!("{}\n{}\n1,2,3\n", rows[0], rows[1]);
    assert!(refusal(&short).starts_with("line 3: found 3 cells, expected 19"));
    let cells: Vec<&str> = rows[1].split(',').collect();
    for (column, value) in [(0, "NaN"), (4, "inf"), (16, ""), (18, "seven")] {
        let mut damaged = cells.clone();
        damaged[column] = value;
        let message = refusal(&[rows[0], &damaged.join(","), rows[2], rows[3]].join("\n"));
        let name = rows[0].split(',').nth(column).unwrap();
        assert!(
            message.starts_with(&format!("line 2, column {name}: found `{value}`, expected ")),
            "{message}"
        );
    }
    let whole_last = [rows[0], rows[1], rows[1]].join("\n");
    assert!(refusal(&whole_last).starts_with("line 3, column u1_rad_s2"));
}

/// Found by fuzzing.
#[test]
fn what_a_cell_holds_does_not_spoil_the_message() {
    let mut text = Vec::new();
    awkward(1, 2, false, 0).print_csv(&turning(1), &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    for hostile in ["1\u{9b}2J", &"9".repeat(10_000)] {
        let message = refusal(&text.replacen("-0.0000000000000000e0,", &format!("{hostile}x,"), 1));
        assert!(message.contains("line 2, column rx_m"), "{message}");
        assert!(!message.contains(char::is_control) && message.len() < 300, "{message:?}");
    }
    let message = refusal(&text.replacen("t_s", &"t".repeat(10_000), 1));
    assert!(message.len() < 300, "{message}");
}

#[test]
fn files_that_cannot_be_opened_or_written_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.csv");
    assert!(matches!(Trajectory::read_csv(&missing), Err(Error::Read { .. })));
    assert!(matches!(Trajectory::read_csv(folder.path()), Err(Error::Directory { .. })));
    let nowhere = Path::new("no-such-folder/trajectory.csv");
    let message = awkward(1, 1, false, 0).write_csv(&turning(1), nowhere).unwrap_err().to_string();
    assert_eq!(message, "no-such-folder/trajectory.csv: cannot be written: no such file");
}
