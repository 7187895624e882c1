//! Whole files, read with a size limit and written whole or not at all.

use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::Path;

use tempfile::Builder;

use crate::error::Error;

/// The largest JSON file that is read.
pub const JSON_LIMIT_BYTES: u64 = 64 << 20;

/// Opens a file; `expected` says what it should be, for the message about a directory.
///
/// # Errors
/// [`Error::Read`] and [`Error::Directory`].
pub fn open(file: &Path, expected: &'static str) -> Result<File, Error> {
    let failed = |source| Error::Read { file: file.to_owned(), source };
    let opened = File::open(file).map_err(failed)?;
    if opened.metadata().map_err(failed)?.is_dir() {
        return Err(Error::Directory { file: file.to_owned(), expected });
    }
    Ok(opened)
}

/// Reads a text file of at most `limit_bytes`; `expected` says what it should be.
///
/// # Errors
/// [`Error::Read`], [`Error::Directory`] and [`Error::TooLarge`].
pub fn read(file: &Path, expected: &'static str, limit_bytes: u64) -> Result<String, Error> {
    let failed = |source| Error::Read { file: file.to_owned(), source };
    let opened = open(file, expected)?;
    let bytes = opened.metadata().map_err(failed)?.len();
    if bytes > limit_bytes {
        return Err(Error::TooLarge { file: file.to_owned(), bytes, limit_bytes });
    }
    read_from(opened, file, limit_bytes)
}

/// Reads a text of at most `limit_bytes`; `name` stands for its file in errors.
///
/// # Errors
/// [`Error::Read`] and [`Error::TooLarge`].
pub fn read_from(source: impl Read, name: &Path, limit_bytes: u64) -> Result<String, Error> {
    let mut text = String::new();
    let read = source.take(limit_bytes + 1).read_to_string(&mut text);
    read.map_err(|source| Error::Read { file: name.to_owned(), source })?;
    match text.len() as u64 {
        bytes if bytes > limit_bytes => {
            Err(Error::TooLarge { file: name.to_owned(), bytes, limit_bytes })
        }
        _ => Ok(text),
    }
}

/// Replaces `file` by what `print` writes, or leaves it as it was, also when the machine stops.
///
/// # Errors
/// [`Error::Write`] if the folder is missing, read-only or full.
pub fn replace(
    file: &Path,
    print: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> Result<(), Error> {
    let failed = |source| Error::Write { file: file.to_owned(), source };
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let temporary =
        ordinary_file().tempfile_in(folder.unwrap_or(Path::new("."))).map_err(failed)?;
    let mut writer = BufWriter::new(temporary);
    print(&mut writer).map_err(failed)?;
    let temporary = writer.into_inner().map_err(|error| failed(error.into_error()))?;
    temporary.as_file().sync_data().map_err(failed)?;
    temporary.persist(file).map_err(|error| failed(error.error))?;
    Ok(())
}

/// Removes `file`, if it is there.
///
/// # Errors
/// [`Error::Remove`] if it cannot be removed.
pub fn remove(file: &Path) -> Result<(), Error> {
    match std::fs::remove_file(file) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(Error::Remove { file: file.to_owned(), source })
        }
        _ => Ok(()),
    }
}

/// A temporary file with the permissions of any new file, since it becomes one.
fn ordinary_file() -> Builder<'static, 'static> {
    #[allow(unused_mut)]
    let mut builder = Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_or_left_and_nothing_else_stays() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.svg");
        replace(&file, |writer| writer.write_all(b"first")).unwrap();
        replace(&file, |writer| writer.write_all(b"second")).unwrap();
        let torn = replace(&file, |writer| {
            writer.write_all(b"thi")?;
            Err(io::Error::from(io::ErrorKind::StorageFull))
        });
        assert!(torn.unwrap_err().to_string().contains("a.svg: cannot be written: "));
        assert_eq!(std::fs::read(&file).unwrap(), b"second");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_is_not_there_is_removed_already() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.png");
        std::fs::write(&file, "").unwrap();
        remove(&file).unwrap();
        assert!(!file.exists());
        remove(&file).unwrap();
        std::fs::create_dir(&file).unwrap();
        let refused = remove(&file).unwrap_err().to_string();
        assert!(refused.contains("a.png: cannot be replaced: "), "{refused}");
    }
}
