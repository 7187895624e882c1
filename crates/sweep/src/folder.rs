//! The folder of a sweep: what is planned, and what is done of it.
//!
//! ```text
//! DIR/sweep.json           the sweep with its base scenario inline: enough for any machine
//! DIR/records/1-of-1.jsonl the records of a shard
//! DIR/plans/CASE_ID/       the plan of a case, where plans are kept
//! DIR/results.csv, …       what a merge makes of them
//! ```

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use righting_scenario::file_io;
use righting_scenario::json::{Document, FileKind, Location};
use serde::{Deserialize, Serialize};

use crate::case::CaseId;
use crate::error::SweepError;
use crate::file;
use crate::journal::{Journal, JournalContents, read_journal};
use crate::record::Record;
use crate::shard::Shard;
use crate::sweep::Sweep;

/// Value of the field `schema` of `sweep.json`.
const SCHEMA: &str = "righting.sweep/1";
const MANIFEST: &str = "sweep.json";
const RECORDS: &str = "records";
const PLANS: &str = "plans";

/// The contents of `sweep.json`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object: a planned sweep")]
struct Manifest {
    schema: String,
    /// The program that planned it.
    righting: String,
    cases: u64,
    sweep: file::Sweep,
}

/// The folder of a planned sweep.
#[derive(Clone, Debug)]
pub struct SweepFolder {
    path: PathBuf,
}

impl SweepFolder {
    /// The folder at `path`, planned or not.
    pub fn at(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// [`plan`](Self::plan)s a sweep here, unless there are records that are not to be gone on with.
    ///
    /// # Errors
    /// [`SweepError::Occupied`] when there are and this does not `resume` them; those of `plan` and
    /// [`read_records`](Self::read_records).
    pub fn begin(&self, sweep: &Sweep, version: &str, resume: bool) -> Result<(), SweepError> {
        if !resume {
            let records = self.read_records(|_| {})?.records;
            if records > 0 {
                return Err(SweepError::Occupied { folder: self.path.clone(), records });
            }
        }
        self.plan(sweep, version)
    }

    /// Writes `sweep.json` and makes room for records. `version` names the program.
    ///
    /// # Errors
    /// [`SweepError::Write`]; [`SweepError::Input`] around one.
    pub fn plan(&self, sweep: &Sweep, version: &str) -> Result<(), SweepError> {
        let records = self.path.join(RECORDS);
        std::fs::create_dir_all(&records)
            .map_err(|source| SweepError::Write { path: records, source })?;
        let manifest = Manifest {
            schema: SCHEMA.to_owned(),
            righting: version.to_owned(),
            cases: sweep.len() as u64,
            sweep: sweep.resolved().clone(),
        };
        file_io::replace(&self.path.join(MANIFEST), |writer| {
            serde_json::to_writer_pretty(&mut *writer, &manifest)?;
            writeln!(writer)
        })?;
        Ok(())
    }

    /// The folder of the plans that are kept, one a case; there or not.
    pub fn plans(&self) -> PathBuf {
        self.path.join(PLANS)
    }

    /// The planned sweep.
    ///
    /// # Errors
    /// [`SweepError::Input`] if there is none or it is damaged.
    pub fn sweep(&self) -> Result<Sweep, SweepError> {
        let path = self.path.join(MANIFEST);
        let document = Document::read(&path, FileKind::PlannedSweep)?;
        let manifest: Manifest = document.decode()?;
        let place = Location::root(&path);
        if manifest.schema != SCHEMA {
            let found = format!("\"{}\"", manifest.schema);
            return Err(place.key("schema").refuse(found, format!("\"{SCHEMA}\"")).into());
        }
        Ok(Sweep::from_file_at(manifest.sweep, &path, &place.key("sweep"))?)
    }

    /// Opens the records of a shard to take more.
    ///
    /// # Errors
    /// Those of [`Journal::open`].
    pub fn journal(&self, shard: Shard) -> Result<Journal, SweepError> {
        Journal::open(&self.path.join(RECORDS).join(shard.file_name()))
    }

    /// The cases that a shard need not do again: those in its own file; for the whole sweep, those
    /// in any file.
    ///
    /// # Errors
    /// [`SweepError::Read`].
    pub fn done(&self, shard: Shard) -> Result<HashSet<CaseId>, SweepError> {
        let mut done = HashSet::new();
        let mut on_record = |record: Record| {
            done.insert(record.case_id);
        };
        if shard.is_whole() {
            self.read_records(on_record)?;
        } else {
            read_journal(&self.path.join(RECORDS).join(shard.file_name()), &mut on_record)?;
        }
        Ok(done)
    }

    /// Reads every record there is, file by file in the order of their names.
    ///
    /// # Errors
    /// [`SweepError::Read`].
    pub fn read_records(
        &self,
        mut on_record: impl FnMut(Record),
    ) -> Result<JournalContents, SweepError> {
        let folder = self.path.join(RECORDS);
        let failed = |source| SweepError::Read { path: folder.clone(), source };
        let mut files = Vec::new();
        match std::fs::read_dir(&folder) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => return Err(failed(error)),
            Ok(entries) => {
                for entry in entries {
                    let path = entry.map_err(failed)?.path();
                    if path.extension().is_some_and(|extension| extension == "jsonl") {
                        files.push(path);
                    }
                }
            }
        }
        files.sort();
        let mut all = JournalContents::default();
        for file in files {
            let contents = read_journal(&file, &mut on_record)?;
            all.records += contents.records;
            all.damaged += contents.damaged;
        }
        Ok(all)
    }
}
