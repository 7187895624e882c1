//! What can stop a sweep.

use std::io;
use std::path::PathBuf;

/// Why a sweep cannot start or go on. A case that fails stops nothing: it is a record.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The sweep file or its scenario is wrong.
    #[error(transparent)]
    Input(#[from] righting_scenario::Error),
    /// The folder has records of an earlier run, and nobody asked to go on from there.
    #[error("{}: has {records} records of an earlier run", folder.display())]
    Occupied {
        /// The folder.
        folder: PathBuf,
        /// How many.
        records: usize,
    },
    /// Another process writes the same records.
    #[error("{}: another process is writing it", path.display())]
    Busy {
        /// The file of records.
        path: PathBuf,
    },
    /// Records cannot be read.
    #[error("{}: cannot be read: {}", path.display(), plain(source))]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Records or results cannot be written.
    #[error("{}: cannot be written: {}", path.display(), plain(source))]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// No worker process comes up.
    #[error("a worker process does not start: {reason}")]
    Worker {
        /// Why.
        reason: String,
    },
}

/// An I/O error in few words, without the operating system's error number.
fn plain(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::StorageFull => "the disk is full".to_owned(),
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".to_owned(),
        io::ErrorKind::FileTooLarge => "a limit on file sizes is reached".to_owned(),
        io::ErrorKind::QuotaExceeded => "the disk quota is used up".to_owned(),
        _ => {
            let text = error.to_string();
            text.split(" (os error").next().unwrap_or(&text).to_lowercase()
        }
    }
}
