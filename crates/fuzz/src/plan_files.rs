//! The two files of a plan, varied: tables and solutions are read or refused, and what is read is verified without a
//! panic.

use std::sync::LazyLock;

use arbitrary::{Result, Unstructured};
use righting_multibody::JointKind;
use righting_results::solution::solution_schema;
use righting_results::{SOLUTION_FILE, Solution, TRAJECTORY_FILE, Trajectory};
use righting_verifier::verify_directory;
use serde_json::Value;

use crate::from_schema::Schema;
use crate::hostile;
use crate::json::change_bytes;
use crate::refusal::{same_twice, well_said};
use crate::target::Outcome;
use crate::workspace::Workspace;

/// A small plan of the 2-joint arm, as `solve` wrote it.
const SOLUTION: &str = include_str!("../corpus/plan/solution.json");
const TABLE: &str = include_str!("../corpus/plan/trajectory.csv");

const CELLS: [&str; 12] =
    ["", "nan", "inf", "-inf", "1e999", "0", "-1", "1e308", "\"1\"", "\"", "x,y", "0x1p3"];

fn table(u: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let mut rows: Vec<Vec<String>> =
        TABLE.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    for _ in 0..u.int_in_range(0..=3)? {
        let row = u.choose_index(rows.len())?;
        let column = u.choose_index(rows[row].len().max(1))?;
        match u.int_in_range(0..=5)? {
            0 => drop(rows.remove(row)),
            1 => rows.insert(row, rows[row].clone()),
            2 => rows[row].truncate(column),
            3 => rows[row].push("0".to_owned()),
            _ => {
                let cell = match u.arbitrary()? {
                    true => (*u.choose(&CELLS)?).to_owned(),
                    false => hostile::number(u)?.to_string(),
                };
                if let Some(there) = rows[row].get_mut(column) {
                    *there = cell;
                }
            }
        }
        if rows.is_empty() {
            break;
        }
    }
    let lines = rows.iter().map(|row| row.join(",") + "\n");
    let mut bytes = lines.collect::<String>().into_bytes();
    if u.ratio(1, 8)? {
        change_bytes(u, &mut bytes)?;
    }
    Ok(bytes)
}

fn solution(u: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    static SCHEMA: LazyLock<Value> = LazyLock::new(solution_schema);
    let schema = Schema::new(&SCHEMA);
    let mut value: Value = serde_json::from_str(SOLUTION).expect("the committed plan");
    match u.ratio(1, 8)? {
        true => value = schema.value(u, 0)?,
        false => schema.vary(u, &mut value)?,
    }
    let mut text = value.to_string().into_bytes();
    if u.ratio(1, 8)? {
        change_bytes(u, &mut text)?;
    }
    Ok(text)
}

/// Reads a table; what is accepted is the same after it was written and read.
pub(crate) fn check_table(
    u: &mut Unstructured<'_>,
    workspace: &Workspace,
) -> std::result::Result<Outcome, String> {
    let bytes = table(u).map_err(|error| error.to_string())?;
    let file = workspace.write(TRAJECTORY_FILE, &bytes);
    let read = || Trajectory::read_csv(&file).map_err(|error| error.to_string());
    match same_twice(read(), read())? {
        Err(message) if message.starts_with("trajectory: ") => Ok(Outcome::Refused),
        Err(message) => well_said(&message, file.display()).map(|()| Outcome::Refused),
        Ok(trajectory) => {
            let copy = workspace.file("copy.csv");
            // The kinds are in the header alone.
            let kinds = vec![JointKind::Revolute; trajectory.joints()];
            trajectory.write_csv(&kinds, &copy).map_err(|error| error.to_string())?;
            match Trajectory::read_csv(&copy) {
                Ok(again) if again == trajectory => Ok(Outcome::Accepted),
                Ok(_) => Err("a table is another one after it was written and read".to_owned()),
                Err(error) => Err(format!("a table that was written is refused: {error}")),
            }
        }
    }
}

/// Reads and verifies a folder; what is accepted is the same solution after it was written and read.
pub(crate) fn check_folder(
    u: &mut Unstructured<'_>,
    workspace: &Workspace,
) -> std::result::Result<Outcome, String> {
    let shown = |error: arbitrary::Error| error.to_string();
    let file = workspace.write(SOLUTION_FILE, &solution(u).map_err(shown)?);
    let bytes = match u.ratio(1, 4).map_err(shown)? {
        true => table(u).map_err(shown)?,
        false => TABLE.as_bytes().to_vec(),
    };
    workspace.write(TRAJECTORY_FILE, &bytes);
    let read = || Solution::read_json(&file).map_err(|error| error.to_string());
    if let Ok(solution) = same_twice(read(), read())? {
        let copy = workspace.file("copy.json");
        solution.write_json(&copy).map_err(|error| error.to_string())?;
        let again = Solution::read_json(&copy).map_err(|error| error.to_string())?;
        if format!("{again:?}") != format!("{solution:?}") {
            return Err("a solution is another one after it was written and read".to_owned());
        }
    }
    let verified = || {
        let verified = verify_directory(workspace.path()).map_err(|error| error.to_string())?;
        Ok(verified.solution.verification)
    };
    match same_twice(verified(), verified())? {
        Err(message) if message.starts_with("trajectory: ") => Ok(Outcome::Refused),
        Err(message) => well_said(&message, workspace.path().display()).map(|()| Outcome::Refused),
        Ok(_) => Ok(Outcome::Accepted),
    }
}
