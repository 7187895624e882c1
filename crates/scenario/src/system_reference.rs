//! The system that a scenario names: in a file of its own, in a robot's file, or inline.

use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::file::{self, SystemReference};
use crate::json::{Location, shown};
use crate::system_description::{SystemDescription, read_system};
use crate::urdf::{is_urdf, system_from_urdf};

/// Puts the system of `scenario`, which stands at `place` in `file`, inline and checks it; complaints about
/// a system file name that file. Returns the place where it stands too.
pub(crate) fn resolve_system(
    scenario: &mut file::Scenario,
    file: &Path,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<(SystemDescription, Location), Error> {
    let options_place = place.key("system_options");
    let place = place.key("system");
    let options = scenario.system_options.take();
    let path = match &mut scenario.system {
        SystemReference::File(path) => path.clone(),
        SystemReference::Inline(_) if options.is_some() => {
            return Err(options_place.refuse("options of a system that stands here", WITH_URDF));
        }
        SystemReference::Inline(system) => {
            return Ok((SystemDescription::from_file(system, &place, notes)?, place));
        }
    };
    if path.is_empty() {
        return Err(place.refuse("\"\"", "the path of a system file, or a system"));
    }
    let system_file: PathBuf = file.parent().unwrap_or(Path::new("")).join(&path);
    let read = match options {
        Some(options) if is_urdf(&system_file) => {
            system_from_urdf(&system_file, &options, &options_place, notes)
        }
        None if is_urdf(&system_file) => {
            return Err(options_place.missing("`base`, the link that floats, or `on`, and limits"));
        }
        Some(_) => return Err(options_place.refuse("options of a system file", WITH_URDF)),
        None => read_system(&system_file),
    };
    let mut system = read.map_err(|error| match error {
        Error::Field { .. } | Error::NotJson { .. } | Error::Kind { .. } | Error::Robot { .. } => {
            error
        }
        unreadable => place.refuse(
            shown(&path.as_str().into()),
            format_args!("the path of a system file ({unreadable})"),
        ),
    })?;
    let system_place = Location::root(&system_file);
    let description = SystemDescription::from_file(&mut system, &system_place, notes)?;
    scenario.system = SystemReference::Inline(Box::new(system));
    Ok((description, system_place))
}

/// What options of a system go with.
const WITH_URDF: &str = "none, or the path of a URDF file (ending in .urdf) as `system`";
