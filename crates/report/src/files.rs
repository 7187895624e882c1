//! Files that are either whole or not there.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::ReportError;

/// Writes `contents` to `directory/name` by way of a temporary file in the same folder, so that a
/// reader or an interruption never meets half a file. Returns the path.
///
/// # Errors
/// [`ReportError::Write`] with the path and the cause.
pub fn write_whole(directory: &Path, name: &str, contents: &[u8]) -> Result<PathBuf, ReportError> {
    let path = directory.join(name);
    let failed = |source| ReportError::Write { path: path.clone(), source };
    let mut builder = tempfile::Builder::new();
    let builder = builder.prefix(name).suffix(".tmp");
    #[cfg(unix)]
    let builder = {
        // Results are for everyone the user's umask lets read them, unlike temporary files.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666))
    };
    let mut file = builder.tempfile_in(directory).map_err(failed)?;
    file.write_all(contents).map_err(failed)?;
    file.persist(&path).map_err(|error| failed(error.error))?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_a_file_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        write_whole(folder.path(), "a.svg", b"first").unwrap();
        let path = write_whole(folder.path(), "a.svg", b"second").unwrap();
        assert_eq!(std::fs::read(path).unwrap(), b"second");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn names_the_path_it_could_not_write() {
        let folder = tempfile::tempdir().unwrap();
        let error = write_whole(&folder.path().join("absent"), "a.svg", b"").unwrap_err();
        assert!(error.to_string().contains("a.svg"), "{error}");
    }
}
