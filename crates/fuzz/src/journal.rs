//! Files of records, damaged: what is whole is read, and nothing else.

use std::collections::BTreeMap;

use arbitrary::{Result, Unstructured};
use righting_sweep::{
    CaseId, Journal, Outcome as CaseOutcome, Record, RunFacts, Trouble, read_journal,
};

use crate::hostile;
use crate::json::change_bytes;
use crate::target::Outcome;
use crate::workspace::Workspace;

const TROUBLES: [Trouble; 3] = [Trouble::Refused, Trouble::Crashed, Trouble::Hung];

fn record(u: &mut Unstructured<'_>, id: u64) -> Result<Record> {
    let outcome = CaseOutcome::of_trouble(*u.choose(&TROUBLES)?, hostile::text(u)?);
    let run = RunFacts { solve_s: f64::from(u.arbitrary::<u16>()?), attempts: u.arbitrary()? };
    Ok(Record { case_id: CaseId(id), outcome, run })
}

fn records(u: &mut Unstructured<'_>) -> Result<Vec<Record>> {
    let count = u.int_in_range(1..=5)?;
    (0..count).map(|id| record(u, id)).collect()
}

/// Damages a file of records anywhere, reads it, writes on, and reads it again.
pub(crate) fn check(
    u: &mut Unstructured<'_>,
    workspace: &Workspace,
) -> std::result::Result<Outcome, String> {
    let shown = |error: arbitrary::Error| error.to_string();
    let written = records(u).map_err(shown)?;
    let added = record(u, 99).map_err(shown)?;
    let mut bytes = written.iter().map(Record::to_line).collect::<String>().into_bytes();
    let before = bytes.clone();
    change_bytes(u, &mut bytes).map_err(shown)?;
    let file = workspace.write("records.jsonl", &bytes);
    let read = || {
        let mut found: BTreeMap<u64, String> = BTreeMap::new();
        let contents = read_journal(&file, |record| {
            found.insert(record.case_id.0, record.to_line());
        });
        contents.map(|contents| (contents, found)).map_err(|error| error.to_string())
    };
    let (contents, found) = read()?;
    let known: BTreeMap<u64, String> =
        written.iter().map(|record| (record.case_id.0, record.to_line())).collect();
    if let Some((id, line)) = found.iter().find(|(id, line)| known.get(id) != Some(line)) {
        return Err(format!("record {id} was never written: {line:?}"));
    }
    // A line that stands whole in the damaged file is read.
    let lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    let is_there = |line: &String| lines.contains(&line.as_bytes());
    if let Some((id, _)) = known.iter().find(|(id, line)| is_there(line) && !found.contains_key(id))
    {
        return Err(format!("record {id} is whole and was not read"));
    }
    let mut journal = Journal::open(&file).map_err(|error| error.to_string())?;
    journal.append(&added).map_err(|error| error.to_string())?;
    drop(journal);
    let (_, after) = read()?;
    let keeps = found.iter().all(|(id, line)| after.get(id) == Some(line));
    if !keeps || after.get(&99) != Some(&added.to_line()) {
        return Err(format!("after {contents:?} a record was lost or not added"));
    }
    Ok(if bytes == before { Outcome::Accepted } else { Outcome::Refused })
}
