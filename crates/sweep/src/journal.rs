//! Files of records: only ever appended to, one writer at a time, readable whatever happened.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::SweepError;
use crate::record::Record;

/// How long a record may be in the system's memory only. A killed process loses none of those, a
/// machine without power at most these.
const SYNC_EVERY: Duration = Duration::from_secs(1);
/// Longer lines are no records.
const LONGEST_LINE: u64 = 1 << 20;

/// A file of records, open to take more.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    synced: Instant,
}

/// What reading a file of records came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct JournalContents {
    /// Whole records.
    pub records: usize,
    /// Lines that are none: cut off or changed.
    pub damaged: usize,
}

impl Journal {
    /// Opens or makes a file of records and locks it against other writers.
    ///
    /// # Errors
    /// [`SweepError::Busy`] while another process writes it; [`SweepError::Write`].
    pub fn open(path: &Path) -> Result<Self, SweepError> {
        let failed = |source| SweepError::Write { path: path.to_owned(), source };
        let options = OpenOptions::new().read(true).append(true).create(true).clone();
        let mut file = options.open(path).map_err(failed)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(SweepError::Busy { path: path.to_owned() });
            }
            // Some shared file systems have no locks: then it is up to the user.
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        let length = file.metadata().map_err(failed)?.len();
        let mut last = [b'\n'];
        if length > 0 {
            file.seek(SeekFrom::Start(length - 1)).map_err(failed)?;
            file.read_exact(&mut last).map_err(failed)?;
        }
        let mut journal = Self { path: path.to_owned(), file, synced: Instant::now() };
        if last != *b"\n" {
            // The end of a line that a dying process could not finish.
            journal.write(b"\n")?;
        }
        Ok(journal)
    }

    /// Appends a record in one write.
    ///
    /// # Errors
    /// [`SweepError::Write`], such as of a full disk.
    pub fn append(&mut self, record: &Record) -> Result<(), SweepError> {
        self.write(record.to_line().as_bytes())?;
        if self.synced.elapsed() >= SYNC_EVERY {
            self.sync()?;
        }
        Ok(())
    }

    /// Waits until all records are on the disk.
    ///
    /// # Errors
    /// [`SweepError::Write`].
    pub fn sync(&mut self) -> Result<(), SweepError> {
        let failed = |source| SweepError::Write { path: self.path.clone(), source };
        self.file.sync_data().map_err(failed)?;
        self.synced = Instant::now();
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), SweepError> {
        let failed = |source| SweepError::Write { path: self.path.clone(), source };
        self.file.write_all(bytes).map_err(failed)
    }
}

/// Reads every whole record of a file, in the order of writing. A file that is not there is empty.
///
/// # Errors
/// [`SweepError::Read`]. Damaged lines are no error: they are counted.
pub fn read_journal(
    path: &Path,
    mut on_record: impl FnMut(Record),
) -> Result<JournalContents, SweepError> {
    let failed = |source| SweepError::Read { path: path.to_owned(), source };
    let mut contents = JournalContents::default();
    let file = match File::open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(contents),
        Err(error) => return Err(failed(error)),
    };
    let mut reader = BufReader::with_capacity(1 << 16, file);
    let mut line = Vec::new();
    loop {
        line.clear();
        let read = reader.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line);
        if read.map_err(failed)? == 0 {
            return Ok(contents);
        }
        match line.strip_suffix(b"\n").and_then(Record::from_line) {
            Some(record) => {
                contents.records += 1;
                on_record(record);
            }
            None if line == b"\n" => {}
            None => contents.damaged += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::CaseId;
    use crate::outcome::{Outcome, Trouble};
    use crate::record::RunFacts;

    fn record(id: u64) -> Record {
        Record {
            case_id: CaseId(id),
            outcome: Outcome::of_trouble(Trouble::Refused, "no"),
            run: RunFacts { solve_s: 0.0, attempts: 1 },
        }
    }

    fn ids(path: &Path) -> (Vec<u64>, usize) {
        let mut ids = Vec::new();
        let contents = read_journal(path, |record| ids.push(record.case_id.0)).unwrap();
        assert_eq!(contents.records, ids.len());
        (ids, contents.damaged)
    }

    #[test]
    fn a_line_cut_off_anywhere_costs_that_record_only() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("records");
        assert_eq!(ids(&path), (vec![], 0));
        let line = record(1).to_line();
        // Without its end only, a record is whole.
        for cut in 1..line.len() - 1 {
            std::fs::write(&path, format!("{line}{}", &line[..cut])).unwrap();
            Journal::open(&path).unwrap().append(&record(2)).unwrap();
            assert_eq!(ids(&path), (vec![1, 2], 1), "{cut}");
        }
    }

    #[test]
    fn there_is_one_writer() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("records");
        let first = Journal::open(&path).unwrap();
        let refused = Journal::open(&path).unwrap_err();
        assert!(matches!(refused, SweepError::Busy { .. }), "{refused}");
        drop(first);
        Journal::open(&path).unwrap();
    }

    #[test]
    fn garbage_is_counted_and_skipped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("records");
        let mut bytes = vec![0; 3 << 20];
        bytes.push(b'\n');
        bytes.extend(record(3).to_line().bytes());
        std::fs::write(&path, bytes).unwrap();
        let (ids, damaged) = ids(&path);
        assert_eq!(ids, [3]);
        assert!(damaged > 0);
    }
}
