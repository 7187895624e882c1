//! `trajectory.csv`: one row a node, 17 significant digits, read back bit for bit.
//!
//! The columns of a joint have the units of its coordinate in their names: `q3_rad`, `tau3_n_m`, or where
//! joint 3 slides `q3_m`, `f3_n`.

use std::fmt;
use std::io::{self, Write};
use std::path::Path;

use csv::{ReaderBuilder, StringRecord};
use righting_scenario::error::{Error, Mismatch};
use righting_scenario::file::JointKind;
use righting_scenario::file_io;
use righting_scenario::json::shown_text;

use crate::trajectory::{ControlInterval, Node, Trajectory};

/// Columns before the joint columns.
const BASE_COLUMNS: [&str; 14] = [
    "t_s", "rx_m", "ry_m", "rz_m", "qw", "qx", "qy", "qz", "vx_m_s", "vy_m_s", "vz_m_s",
    "wx_rad_s", "wy_rad_s", "wz_rad_s",
];

/// The first of the columns that a trajectory with jerks has beside those of any other.
const FIRST_JERKS: [&str; 2] = ["j1_rad_s3", "j1_m_s3"];
/// How the columns of the wheels' momenta begin.
const WHEEL_MOMENTUM: &str = "hw";

/// The header of a trajectory of joints of these kinds; `with_jerks` adds the columns of their jerks, and then come
/// momenta and torques of the `wheels`.
pub fn header(kinds: &[JointKind], with_jerks: bool, wheels: usize) -> Vec<String> {
    let per = |count: usize, prefix: &'static str, unit: &'static str| {
        (1..=count).map(move |i| format!("{prefix}{i}_{unit}"))
    };
    let joints = kinds.len();
    let per_joint = |of: fn(JointKind, usize) -> String| {
        kinds.iter().enumerate().map(move |(joint, &kind)| of(kind, joint + 1))
    };
    let names = [
        per_joint(|kind, i| format!("q{i}_{}", unit(kind))),
        per_joint(|kind, i| format!("dq{i}_{}_s", unit(kind))),
        per_joint(|kind, i| format!("u{i}_{}_s2", unit(kind))),
        per_joint(|kind, i| match kind {
            JointKind::Revolute => format!("tau{i}_n_m"),
            JointKind::Prismatic => format!("f{i}_n"),
        }),
    ];
    BASE_COLUMNS
        .iter()
        .map(|&name| name.to_owned())
        .chain(names.into_iter().flatten())
        .chain(std::iter::once("power_w".to_owned()))
        .chain(per_joint(|kind, i| format!("j{i}_{}_s3", unit(kind))).take(if with_jerks {
            joints
        } else {
            0
        }))
        .chain(per(wheels, WHEEL_MOMENTUM, "n_m_s"))
        .chain(per(wheels, "tauw", "n_m"))
        .collect()
}

/// Unit of a joint's coordinate in names.
fn unit(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "rad",
        JointKind::Prismatic => "m",
    }
}

/// The kinds of joints that the names of their first columns say.
fn kinds(head: &StringRecord, joints: usize) -> Vec<JointKind> {
    let first = head.iter().skip(BASE_COLUMNS.len()).take(joints);
    let kind = |name: &str| match name.ends_with("_m") {
        true => JointKind::Prismatic,
        false => JointKind::Revolute,
    };
    first.map(kind).collect()
}

impl Trajectory {
    /// Writes the table of joints of these kinds, one each, to `file`, whole or not at all: a temporary file
    /// beside it is renamed.
    ///
    /// # Errors
    /// [`Error::Write`] if the folder is missing, read-only or full.
    pub fn write_csv(&self, kinds: &[JointKind], file: &Path) -> Result<(), Error> {
        file_io::replace(file, |writer| self.print_csv(kinds, writer))
    }

    /// Prints the table: the cells of accelerations, torques and jerks in the last row are empty.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn print_csv(&self, kinds: &[JointKind], writer: &mut dyn Write) -> io::Result<()> {
        let names = header(kinds, self.has_jerks(), self.wheels());
        writeln!(writer, "{}", names.join(","))?;
        for (k, node) in self.nodes().iter().enumerate() {
            write!(writer, "{:.16e}", node.time_s)?;
            let base = [&node.position_m[..], &node.attitude, &node.velocity_m_s];
            let rates = [&node.angular_rate_rad_s[..], &node.joint_angles_rad];
            for value in
                base.into_iter().chain(rates).chain([&node.joint_rates_rad_s[..]]).flatten()
            {
                write!(writer, ",{value:.16e}")?;
            }
            match self.intervals().get(k) {
                Some(interval) => {
                    let accelerations = &interval.joint_accelerations_rad_s2;
                    for value in accelerations.iter().chain(&interval.joint_torques_n_m) {
                        write!(writer, ",{value:.16e}")?;
                    }
                }
                None => write!(writer, "{}", ",".repeat(2 * self.joints()))?,
            }
            write!(writer, ",{:.16e}", node.power_w)?;
            match self.intervals().get(k) {
                Some(interval) => {
                    for jerk in &interval.joint_jerks_rad_s3 {
                        write!(writer, ",{jerk:.16e}")?;
                    }
                }
                None if self.has_jerks() => write!(writer, "{}", ",".repeat(self.joints()))?,
                None => {}
            }
            for momentum in &node.wheel_momenta_n_m_s {
                write!(writer, ",{momentum:.16e}")?;
            }
            match self.intervals().get(k) {
                Some(interval) => {
                    for torque in &interval.wheel_torques_n_m {
                        write!(writer, ",{torque:.16e}")?;
                    }
                }
                None => write!(writer, "{}", ",".repeat(self.wheels()))?,
            }
            writeln!(writer)?;
        }
        Ok(())
    }

    /// Reads a table written by [`write_csv`](Self::write_csv).
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::Table`] and [`Error::Cell`] with the line and the column.
    pub fn read_csv(file: &Path) -> Result<Self, Error> {
        let source = file_io::open(file, "a trajectory table")?;
        let mut reader = ReaderBuilder::new().has_headers(false).flexible(true).from_reader(source);
        let mut rows = Vec::new();
        for record in reader.records() {
            rows.push(record.map_err(|error| unreadable(file, error))?);
        }
        parse(file, &rows)
    }
}

/// Builds a trajectory from the rows of a table, the header first.
fn parse(file: &Path, rows: &[StringRecord]) -> Result<Trajectory, Error> {
    let wrong = |line: u64, found: &dyn fmt::Display, expected: &dyn fmt::Display| {
        let problem = Mismatch::new(found, expected).to_string();
        Error::Table { file: file.to_owned(), line, problem }
    };
    let Some((head, body)) = rows.split_first() else {
        return Err(wrong(1, &"an empty file", &"a header and rows"));
    };
    let has_jerks = head.iter().any(|name| FIRST_JERKS.contains(&name));
    let columns_a_joint = if has_jerks { 5 } else { 4 };
    let wheels = head.iter().filter(|name| name.starts_with(WHEEL_MOMENTUM)).count();
    let others = BASE_COLUMNS.len() + 1 + 2 * wheels;
    let joints = head.len().saturating_sub(others) / columns_a_joint;
    let names = header(&kinds(head, joints), has_jerks, wheels);
    if joints == 0 || head.len() != names.len() {
        let of_wheels = if wheels > 0 { ", 2 for each wheel" } else { "" };
        let expected =
            format!("14 columns, {columns_a_joint} for each joint{of_wheels} and power_w");
        return Err(wrong(1, &format_args!("{} columns", head.len()), &expected));
    }
    if let Some((found, name)) = head.iter().zip(&names).find(|(found, name)| found != name) {
        return Err(wrong(
            1,
            &format_args!("column `{}`", shown_text(found)),
            &format_args!("`{name}`"),
        ));
    }
    if body.len() < 2 {
        return Err(wrong(1, &format_args!("{} rows", body.len()), &"at least 2"));
    }

    let mut nodes = Vec::with_capacity(body.len());
    let mut intervals = Vec::with_capacity(body.len() - 1);
    for (k, record) in body.iter().enumerate() {
        let line = record.position().map_or(k as u64 + 2, csv::Position::line);
        if record.len() != names.len() {
            return Err(wrong(line, &format_args!("{} cells", record.len()), &names.len()));
        }
        let mut row = Row { file, line, names: &names, record, next: 0 };
        let last = k + 1 == body.len();
        let mut node = Node {
            time_s: row.number()?,
            position_m: row.numbers()?,
            attitude: row.numbers()?,
            velocity_m_s: row.numbers()?,
            angular_rate_rad_s: row.numbers()?,
            joint_angles_rad: row.several(joints)?,
            joint_rates_rad_s: row.several(joints)?,
            power_w: 0.0,
            wheel_momenta_n_m_s: Vec::new(),
        };
        if last {
            row.empty(2 * joints)?;
        } else {
            intervals.push(ControlInterval {
                joint_accelerations_rad_s2: row.several(joints)?,
                joint_jerks_rad_s3: Vec::new(),
                joint_torques_n_m: row.several(joints)?,
                wheel_torques_n_m: Vec::new(),
            });
        }
        node.power_w = row.number()?;
        let mut begins = intervals.last_mut().filter(|_| !last);
        match &mut begins {
            _ if !has_jerks => {}
            Some(interval) => interval.joint_jerks_rad_s3 = row.several(joints)?,
            None => row.empty(joints)?,
        }
        node.wheel_momenta_n_m_s = row.several(wheels)?;
        match begins {
            Some(interval) => interval.wheel_torques_n_m = row.several(wheels)?,
            None => row.empty(wheels)?,
        }
        nodes.push(node);
    }
    Ok(Trajectory::new(nodes, intervals)?)
}

/// A cursor over one row's cells that names the cell it fails at.
struct Row<'a> {
    file: &'a Path,
    line: u64,
    names: &'a [String],
    record: &'a StringRecord,
    next: usize,
}

impl Row<'_> {
    fn number(&mut self) -> Result<f64, Error> {
        let text = &self.record[self.next];
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        let value = value.ok_or_else(|| self.refuse("a finite number"))?;
        self.next += 1;
        Ok(value)
    }

    fn numbers<const COUNT: usize>(&mut self) -> Result<[f64; COUNT], Error> {
        let mut values = [0.0; COUNT];
        for value in &mut values {
            *value = self.number()?;
        }
        Ok(values)
    }

    fn several(&mut self, count: usize) -> Result<Vec<f64>, Error> {
        (0..count).map(|_| self.number()).collect()
    }

    fn empty(&mut self, count: usize) -> Result<(), Error> {
        for _ in 0..count {
            if !self.record[self.next].is_empty() {
                return Err(self.refuse("an empty cell in the last row"));
            }
            self.next += 1;
        }
        Ok(())
    }

    fn refuse(&self, expected: &str) -> Error {
        Error::Cell {
            file: self.file.to_owned(),
            line: self.line,
            column: self.names[self.next].clone(),
            mismatch: Mismatch::new(
                format_args!("`{}`", shown_text(&self.record[self.next])),
                expected,
            ),
        }
    }
}

fn unreadable(file: &Path, error: csv::Error) -> Error {
    let line = error.position().map_or(1, csv::Position::line);
    let problem = error.to_string();
    match error.into_kind() {
        csv::ErrorKind::Io(source) => Error::Read { file: file.to_owned(), source },
        _ => Error::Table { file: file.to_owned(), line, problem },
    }
}
