//! Meshes of links, for the capsules around them.

use std::fs;
use std::path::{Path, PathBuf};

use mesh_loader::Loader;
use nalgebra::Vector3;

/// The largest mesh file that is read.
const LIMIT_BYTES: u64 = 64 << 20;
/// Endings of the files that are read.
const READ: [&str; 2] = [".stl", ".obj"];
/// What a file name in a package begins with.
const PACKAGE: &str = "package://";

/// The corners of a mesh, in its file's units; or why there are none.
///
/// `name` is as URDF gives it. A file of a package is looked for from `folder`, that of the robot's file,
/// upward, as programs without ROS do: `package://arm/meshes/a.stl` is `arm/meshes/a.stl` in any folder
/// above.
pub(crate) fn corners(name: &str, folder: Option<&Path>) -> Result<Vec<Vector3<f64>>, String> {
    let is_read = READ.iter().any(|ending| name.to_lowercase().ends_with(ending));
    if !is_read {
        return Err("neither STL nor OBJ".to_owned());
    }
    let folder = folder.ok_or("not asked for")?;
    let file = find(name, folder).ok_or("no such file")?;
    let size = fs::metadata(&file).map_err(|error| error.to_string())?.len();
    if size > LIMIT_BYTES {
        return Err(format!("{size} bytes, more than {LIMIT_BYTES}"));
    }
    let bytes = fs::read(&file).map_err(|error| error.to_string())?;
    // Colors stand in other files, which nobody needs here.
    let no_other = |_: &Path| Err::<Vec<u8>, _>(std::io::ErrorKind::NotFound.into());
    let scene = Loader::default()
        .load_from_slice_with_reader(&bytes, &file, no_other)
        .map_err(|error| error.to_string())?;
    let vertices = scene.meshes.iter().flat_map(|mesh| &mesh.vertices);
    let corners: Vec<Vector3<f64>> = vertices.map(|v| Vector3::from(*v).map(f64::from)).collect();
    match corners.iter().all(|corner| corner.iter().all(|entry| entry.is_finite())) {
        true if !corners.is_empty() => Ok(corners),
        true => Err("no corners".to_owned()),
        false => Err("corners that are not finite".to_owned()),
    }
}

fn find(name: &str, folder: &Path) -> Option<PathBuf> {
    let is_file = |path: &PathBuf| path.is_file();
    match name.strip_prefix(PACKAGE) {
        Some(rest) => {
            let above = folder.canonicalize().ok()?;
            above.ancestors().map(|above| above.join(rest)).find(is_file)
        }
        None => {
            let path = name.strip_prefix("file://").unwrap_or(name);
            Some(folder.join(path)).filter(is_file)
        }
    }
}
