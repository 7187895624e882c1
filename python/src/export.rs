//! A plan, or its system, as files of other programs.

use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use pyo3::types::PyDict;
use righting_export::{
    AemOptions, CkOptions, JointTrajectory, SpiceKernels, StkOptions, aem, basilisk, ck, mat, mjcf,
    mujoco, npz, stk, urdf,
};
use righting_report::maneuver_phrase;
use righting_scenario::file_io;
use righting_scenario::json::FileKind;

use crate::failure::{Failure, Outcome};
use crate::plan::Plan;

const FORMATS: &str = "\"urdf\", \"mjcf\", \"joint-trajectory\", \"ck\", \"stk\", \"aem\", \"npz\", \"mat\", \
                       \"basilisk\" or \"mujoco\"";

/// Writes a proven plan in a format, and returns the files.
pub fn export(
    plan: &Plan,
    format: &str,
    file: &Path,
    message: Option<&Bound<'_, PyDict>>,
) -> Outcome<Vec<PathBuf>> {
    let files = contents(plan.proven()?, format, file, Message(message))?;
    let failed = Failure::of_input(FileKind::Solution);
    if let Some(folder) = file.parent() {
        let made = std::fs::create_dir_all(folder)
            .map_err(|source| righting_scenario::Error::Write { file: folder.to_owned(), source });
        made.map_err(&failed)?;
    }
    for (file, contents) in &files {
        file_io::replace(file, |writer| writer.write_all(contents)).map_err(&failed)?;
    }
    Ok(files.into_iter().map(|(file, _)| file).collect())
}

/// Every file with its contents, the one that is asked for first.
fn contents(
    plan: &Plan,
    format: &str,
    file: &Path,
    message: Message<'_, '_>,
) -> Outcome<Vec<(PathBuf, Vec<u8>)>> {
    let Plan { scenario, solution, trajectory, .. } = plan;
    let system = scenario.system();
    let maneuver = maneuver_phrase(solution);
    let contents = match format {
        "aem" => {
            let names = ["epoch", "frame", "time_system", "object_name", "object_id", "originator"];
            message.require(format, &names)?;
            let mut options = AemOptions::new(maneuver, &system.name);
            message.set_time("epoch", &mut options.epoch)?;
            message.set("frame", &mut options.inertial_frame)?;
            message.set("time_system", &mut options.time_system)?;
            message.set("object_name", &mut options.object_name)?;
            message.set("object_id", &mut options.object_id)?;
            message.set("originator", &mut options.originator)?;
            aem(solution, trajectory, &options)?.into_bytes()
        }
        "stk" => {
            message.require(format, &["epoch", "frame"])?;
            let mut options = StkOptions::new(maneuver);
            message.set_time("epoch", &mut options.epoch)?;
            message.set("frame", &mut options.inertial_frame)?;
            stk(solution, trajectory, &options)?.into_bytes()
        }
        "ck" => {
            let names = ["epoch", "frame", "time_system", "object_name", "naif_id"];
            message.require(format, &names)?;
            let mut options = CkOptions::new(maneuver, &system.name);
            message.set_time("epoch", &mut options.epoch)?;
            message.set("frame", &mut options.inertial_frame)?;
            message.set("time_system", &mut options.time_system)?;
            message.set("object_name", &mut options.object_name)?;
            message.set("naif_id", &mut options.naif_id)?;
            return spice_files(file, ck(solution, trajectory, &options)?);
        }
        _ => {
            message.require(format, &[])?;
            match format {
                "npz" => npz(trajectory)?,
                "mat" => mat(trajectory),
                "urdf" => urdf(system).into_bytes(),
                "mjcf" => mjcf(system, trajectory).into_bytes(),
                "joint-trajectory" => {
                    let motion = JointTrajectory::new(scenario, trajectory)?;
                    let is_json = file.extension().is_some_and(|extension| extension == "json");
                    if is_json { motion.to_json() } else { motion.to_yaml() }.into_bytes()
                }
                "mujoco" => mujoco(scenario, solution, trajectory, &maneuver)?,
                "basilisk" => basilisk(scenario, solution, trajectory, &maneuver)?,
                other => {
                    let found = format!("{other:?}");
                    return Err(Failure::Argument { name: "format", found, expected: FORMATS });
                }
            }
        }
    };
    Ok(vec![(file.to_owned(), contents)])
}

/// The C-kernel, and its clock and frame beside it.
fn spice_files(file: &Path, kernels: SpiceKernels) -> Outcome<Vec<(PathBuf, Vec<u8>)>> {
    let SpiceKernels { ck, clock, frame } = kernels;
    let [clock_file, frame_file] = ["tsc", "tf"].map(|extension| file.with_extension(extension));
    if file == clock_file || file == frame_file {
        return Err(Failure::Argument {
            name: "file",
            found: file.display().to_string(),
            expected: "another ending than .tsc and .tf, those of the kernels beside the C-kernel",
        });
    }
    Ok(vec![
        (file.to_owned(), ck),
        (clock_file, clock.into_bytes()),
        (frame_file, frame.into_bytes()),
    ])
}

/// What a caller says beyond the plan.
struct Message<'a, 'py>(Option<&'a Bound<'py, PyDict>>);

impl<'py> Message<'_, 'py> {
    /// Refuses what the format has no place for.
    fn require(&self, format: &str, taken: &[&str]) -> Outcome<()> {
        let given: Vec<String> = match self.0 {
            Some(message) => message.keys().extract()?,
            None => Vec::new(),
        };
        match given.into_iter().find(|name| !taken.contains(&name.as_str())) {
            Some(name) => {
                let found = format!("{name} of \"{format}\"");
                let expected = "an argument that this format takes";
                Err(Failure::Argument { name: "message", found, expected })
            }
            None => Ok(()),
        }
    }

    fn get(&self, name: &str) -> Outcome<Option<Bound<'py, PyAny>>> {
        Ok(match self.0 {
            Some(message) => message.get_item(name)?.filter(|value| !value.is_none()),
            None => None,
        })
    }

    /// Sets an option to what was given for it.
    fn set<T>(&self, name: &str, option: &mut T) -> Outcome<()>
    where
        T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
    {
        if let Some(value) = self.get(name)? {
            *option = value.extract()?;
        }
        Ok(())
    }

    /// The same of a civil time; a closing Z, which stands for UTC, is taken.
    fn set_time(&self, name: &'static str, option: &mut jiff::civil::DateTime) -> Outcome<()> {
        if let Some(value) = self.get(name)? {
            let text: String = value.extract()?;
            let time = text.strip_suffix('Z').unwrap_or(&text).parse();
            *option = time.map_err(|_| Failure::Argument {
                name,
                found: format!("{text:?}"),
                expected: "a time such as \"2027-03-01T12:00:00\"",
            })?;
        }
        Ok(())
    }
}
