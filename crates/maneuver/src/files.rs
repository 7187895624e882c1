//! Whole files, read with a size limit and written whole or not at all.

use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::Path;

use tempfile::Builder;

use crate::error::Error;

/// The largest JSON file that is read.
pub const JSON_LIMIT_BYTES: u64 = 64 << 20;

/// Opens a file; `needed` says what it should be, for the message about a directory.
pub(crate) fn open(file: &Path, needed: &'static str) -> Result<File, Error> {
    let failed = |source| Error::Read { file: file.to_owned(), source };
    let opened = File::open(file).map_err(failed)?;
    if opened.metadata().map_err(failed)?.is_dir() {
        return Err(Error::Directory { file: file.to_owned(), needed });
    }
    Ok(opened)
}

/// Reads a text file of at most `limit_bytes`; `needed` says what it should be.
///
/// # Errors
/// [`Error::Read`], [`Error::Directory`] and [`Error::TooLarge`].
pub fn read(file: &Path, needed: &'static str, limit_bytes: u64) -> Result<String, Error> {
    let failed = |source| Error::Read { file: file.to_owned(), source };
    let opened = open(file, needed)?;
    let too_large = |bytes| Error::TooLarge { file: file.to_owned(), bytes, limit_bytes };
    let announced = opened.metadata().map_err(failed)?.len();
    if announced > limit_bytes {
        return Err(too_large(announced));
    }
    let mut text = String::new();
    opened.take(limit_bytes + 1).read_to_string(&mut text).map_err(failed)?;
    if text.len() as u64 > limit_bytes {
        return Err(too_large(text.len() as u64));
    }
    Ok(text)
}

/// Replaces `file` by what `print` writes, or leaves it as it was.
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
    temporary.persist(file).map_err(|error| failed(error.error))?;
    Ok(())
}

/// A temporary file with the permissions of any new file, since it becomes one.
fn ordinary_file() -> Builder<'static, 'static> {
    #[allow(unused_mut)]
    let mut builder = Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}
