//! The shared library of Ipopt: opened when it is first needed, or linked.

use thiserror::Error;

/// The name that programs linked to the library ask for.
#[cfg(feature = "dlopen")]
pub(crate) const NAME: &str = env!("IPOPT_LIBRARY");
#[cfg(not(feature = "dlopen"))]
pub(crate) const NAME: &str = "libipopt";

/// Why Ipopt cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum LoadError {
    /// The system does not find the library, or not all of what it needs.
    #[error(
        "Ipopt {} cannot be loaded: looked for {looked_for}: {reason}; \
         on Debian: apt-get install {PACKAGE}",
        crate::VERSION
    )]
    NotLoaded {
        /// The names tried.
        looked_for: String,
        /// What the system says of them.
        reason: String,
    },
    /// The library is not what its name says.
    #[error(
        "{library} has no function {function}; expected the library of Ipopt {}",
        crate::VERSION
    )]
    NoFunction {
        /// The library.
        library: &'static str,
        /// What it lacks.
        function: &'static str,
    },
    /// Its callbacks have other types than those that this crate was built for.
    #[error(
        "found {library} with the interface of Ipopt {}, expected that of {}: build again",
        if cfg!(ipopt_bool) { "3.13 or older" } else { "3.14 or newer" },
        crate::VERSION
    )]
    OtherInterface {
        /// The library.
        library: &'static str,
    },
}

/// What brings the library on Debian, whatever its version.
const PACKAGE: &str = "coinor-libipopt-dev";

/// The open library.
#[derive(Debug)]
pub(crate) struct Library(#[cfg(any(unix, feature = "dlopen"))] libloading::Library);

impl Library {
    /// # Safety
    /// `T` must be the type of the function that has this name.
    #[cfg(feature = "dlopen")]
    pub(crate) unsafe fn function<T: Copy>(&self, function: &'static str) -> Result<T, LoadError> {
        // SAFETY: the caller's promise.
        let found = unsafe { self.optional_function(function) };
        found.ok_or(LoadError::NoFunction { library: NAME, function })
    }

    /// The function of this name, if the library or one that it needs has it.
    ///
    /// # Safety
    /// As [`Library::function`].
    #[cfg(any(unix, feature = "dlopen"))]
    pub(crate) unsafe fn optional_function<T: Copy>(&self, function: &'static str) -> Option<T> {
        // SAFETY: the caller's promise. The library is never closed, so the pointer stays good.
        unsafe { self.0.get::<T>(function).ok().map(|symbol| *symbol) }
    }

    #[cfg(not(any(unix, feature = "dlopen")))]
    pub(crate) unsafe fn optional_function<T: Copy>(&self, _function: &'static str) -> Option<T> {
        None
    }
}

/// The library, opened by the first call and never closed.
#[cfg(feature = "dlopen")]
pub(crate) fn library() -> Result<&'static Library, LoadError> {
    use std::sync::OnceLock;
    static LIBRARY: OnceLock<Result<Library, LoadError>> = OnceLock::new();
    LIBRARY.get_or_init(open).as_ref().map_err(Clone::clone)
}

#[cfg(feature = "dlopen")]
fn open() -> Result<Library, LoadError> {
    use std::path::Path;
    let directory = env!("IPOPT_DIRECTORY");
    let mut names = vec![NAME.to_owned()];
    if !directory.is_empty() {
        names.insert(0, Path::new(directory).join(NAME).to_string_lossy().into_owned());
    }
    let mut reason = String::new();
    for name in &names {
        // SAFETY: what the library and those it needs do when they are opened is set up memory of
        // their own and, where MUMPS is built for MPI, MPI; so do programs linked to it.
        match unsafe { libloading::Library::new(name) } {
            Ok(library) => return Ok(Library(library)),
            Err(error) => reason = said(&error),
        }
    }
    Err(LoadError::NotLoaded { looked_for: names.join(", then "), reason })
}

/// The system's own words, without the crate's around them.
#[cfg(feature = "dlopen")]
fn said(error: &libloading::Error) -> String {
    use std::error::Error;
    error.source().map_or_else(|| error.to_string(), ToString::to_string)
}

/// The library that the program is linked to; where the system does not say which that is, the program.
#[cfg(all(unix, not(feature = "dlopen")))]
pub(crate) fn library() -> Result<&'static Library, LoadError> {
    use libloading::os::unix::Library as Opened;
    use std::sync::LazyLock;
    static LIBRARY: LazyLock<Library> =
        LazyLock::new(|| Library(linked().unwrap_or_else(Opened::this).into()));
    Ok(&LIBRARY)
}

/// The linked library by the file that is in use, so that what it needs is found too: by name, nothing of it is
/// found from within a module that keeps its libraries to itself, such as Python's.
#[cfg(all(unix, not(feature = "dlopen")))]
fn linked() -> Option<libloading::os::unix::Library> {
    use std::ffi::{CStr, OsStr, c_void};
    use std::mem::MaybeUninit;
    use std::os::unix::ffi::OsStrExt;
    let mut found = MaybeUninit::<libc::Dl_info>::zeroed();
    let function = crate::CreateIpoptProblem as *const c_void;
    // SAFETY: dladdr only reads the address, and fills in what it says it has found; what it points to stays as
    // long as the library is loaded, which is as long as the program.
    let file = unsafe {
        if libc::dladdr(function, found.as_mut_ptr()) == 0
            || found.assume_init().dli_fname.is_null()
        {
            return None;
        }
        CStr::from_ptr(found.assume_init().dli_fname)
    };
    let file = OsStr::from_bytes(file.to_bytes());
    // SAFETY: nothing is loaded, and so nothing run: the library is in use already.
    unsafe { libloading::os::unix::Library::open(Some(file), libc::RTLD_NOLOAD | libc::RTLD_LAZY) }
        .ok()
}

#[cfg(not(any(unix, feature = "dlopen")))]
pub(crate) fn library() -> Result<&'static Library, LoadError> {
    Ok(&Library())
}
