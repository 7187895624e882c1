//! System files among the settings of a sweep.

use std::path::Path;

use righting_scenario::json::{Location, shown};
use righting_scenario::{Error, SystemFile};
use serde_json::{Value, json};

use crate::file::Dimension;

/// The field that holds a whole system.
pub(crate) const SYSTEM: &str = "system";

/// Puts the systems inline that a dimension, which stands at `place` in `file`, names as settings of `system`, so
/// that the sweep needs no other file. Paths start from the folder of `file`.
///
/// # Errors
/// Those of reading a system file.
pub(crate) fn put_systems_inline(
    dimension: &mut Dimension,
    file: &Path,
    place: &Location,
) -> Result<(), Error> {
    if let Some(zipped) = &mut dimension.zip {
        let place = place.key("zip");
        for (index, dimension) in zipped.iter_mut().enumerate() {
            put_systems_inline(dimension, file, &place.index(index))?;
        }
    }
    if dimension.field.as_deref() != Some(SYSTEM) {
        return Ok(());
    }
    for (index, value) in dimension.values.iter_mut().flatten().enumerate() {
        let Value::String(path) = &*value else { continue };
        let path = file.parent().unwrap_or(Path::new("")).join(path);
        let place = place.key("values").index(index);
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("urdf")) {
            let expected =
                "the path of a system file, which `righting import` makes of a URDF file";
            return Err(place.refuse(shown(value), expected));
        }
        let system = SystemFile::read(&path).map_err(|error| match error {
            Error::Field { .. } | Error::NotJson { .. } | Error::Kind { .. } => error,
            unreadable => place.refuse(
                shown(value),
                format_args!("the path of a system file, or a system ({unreadable})"),
            ),
        })?;
        *value = json!(system.resolved);
    }
    Ok(())
}
