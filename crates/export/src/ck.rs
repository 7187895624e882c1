//! SPICE kernels: the attitude as a C-kernel of type 3, with its clock and its frame.

use std::fmt::Write;

use jiff::civil::DateTime;
use righting_results::{Solution, Trajectory};
use righting_scenario::error::Mismatch;

use crate::ExportError;
use crate::attitude::{plain, unit};
use crate::daf::Daf;
use crate::defaults::{DEFAULT_EPOCH, DEFAULT_FRAME, DEFAULT_TIME_SYSTEM};
use crate::time_scales::ephemeris_time_s;

/// What kernels say beyond the trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct CkOptions {
    /// What the maneuver is, in words.
    pub maneuver: String,
    /// Time of the first node, in the time system.
    pub epoch: DateTime,
    /// UTC, TAI, GPS, TT or TDB.
    pub time_system: String,
    /// The inertial frame that the plan's inertial axes are: EME2000, J2000, ICRF or ECLIPJ2000.
    pub inertial_frame: String,
    /// Name of the spacecraft; the body frame is called so with `_BODY` after it.
    pub object_name: String,
    /// NAIF's number of the spacecraft, below zero. The body frame has this times 1000.
    pub naif_id: i32,
}

/// The spacecraft's number where none is given: one that no mission has.
const NO_NAIF_ID: i32 = -999;

impl CkOptions {
    /// Of a maneuver of a system: in UTC and EME2000 from J2000's noon on.
    pub fn new(maneuver: String, system: &str) -> Self {
        Self {
            maneuver,
            epoch: DEFAULT_EPOCH,
            time_system: DEFAULT_TIME_SYSTEM.to_owned(),
            inertial_frame: DEFAULT_FRAME.to_owned(),
            object_name: system.to_owned(),
            naif_id: NO_NAIF_ID,
        }
    }
}

/// The three kernels that together tell the attitude.
#[derive(Clone, Debug, PartialEq)]
pub struct SpiceKernels {
    /// C-kernel (`.bc`).
    pub ck: Vec<u8>,
    /// Clock kernel (`.tsc`): microseconds since the first node.
    pub clock: String,
    /// Frame kernel (`.tf`): the body frame and the spacecraft's name.
    pub frame: String,
}

/// Ticks of the clock in a second.
const TICKS_PER_S: f64 = 1e6;
/// Nodes between two entries of a segment's directory.
const DIRECTORY: usize = 100;
/// The longest name of a spacecraft with which `FRAME_…_BODY` is a kernel variable.
const LONGEST_NAME: usize = 21;

/// The attitude and the angular rate at every node as SPICE kernels.
///
/// The C-kernel has one segment of type 3, linear interpolation between nodes, over one interval. Its
/// quaternions are SPICE's: of the matrix that takes inertial coordinates to body ones. Its rates are in
/// inertial axes. Times are ticks of the clock kernel, unrounded.
///
/// # Errors
/// [`ExportError::Value`] for an option that kernels cannot hold.
pub fn ck(
    solution: &Solution,
    trajectory: &Trajectory,
    options: &CkOptions,
) -> Result<SpiceKernels, ExportError> {
    let epoch_s = ephemeris_time_s(options.epoch, &options.time_system)?;
    let inertial = frame_code(&options.inertial_frame)?;
    let name = symbol(&options.object_name);
    let body =
        options.naif_id.checked_mul(1000).filter(|_| options.naif_id < 0).ok_or_else(|| {
            let mismatch = Mismatch::new(options.naif_id, "a number from -2147483 to -1");
            ExportError::Value { keyword: "NAIF ID", mismatch }
        })?;
    let start_s = trajectory.start().time_s;
    let nodes = trajectory.nodes();
    let ticks: Vec<f64> = nodes.iter().map(|node| (node.time_s - start_s) * TICKS_PER_S).collect();
    let mut data = Vec::with_capacity(8 * nodes.len() + 4);
    for node in nodes {
        let attitude = unit(node);
        let rate = attitude * nalgebra::Vector3::from(node.angular_rate_rad_s);
        data.extend([attitude.w, -attitude.i, -attitude.j, -attitude.k]);
        data.extend(rate.iter());
    }
    data.extend(&ticks);
    data.extend(
        ticks.iter().skip(DIRECTORY - 1).step_by(DIRECTORY).take((ticks.len() - 1) / DIRECTORY),
    );
    // One interval of interpolation, without a directory.
    data.extend([ticks[0], 1.0, nodes.len() as f64]);
    let comments = [
        format!("Planned by Righting {}", plain(&solution.versions.righting)),
        plain(&options.maneuver),
        format!("scenario SHA-256 {}", plain(&solution.scenario_sha256)),
    ];
    let has_rates = 1;
    let segment_type = 3;
    let ck = Daf {
        kind: "DAF/CK",
        name: &plain(&solution.scenario.name),
        comments: &comments,
        segment: &format!("{name}_BODY"),
        summary: [ticks[0], ticks[ticks.len() - 1]],
        codes: [body, inertial, segment_type, has_rates],
        data: &data,
    };
    let end_ticks = ticks[ticks.len() - 1];
    Ok(SpiceKernels {
        ck: ck.to_bytes(),
        clock: clock_kernel(options.naif_id, epoch_s, end_ticks),
        frame: frame_kernel(&name, options.naif_id, body),
    })
}

/// SPICE's number of an inertial frame.
fn frame_code(name: &str) -> Result<i32, ExportError> {
    match name.trim().to_ascii_uppercase().as_str() {
        "EME2000" | "J2000" | "ICRF" => Ok(1),
        "ECLIPJ2000" => Ok(17),
        _ => {
            let expected = "EME2000, J2000, ICRF or ECLIPJ2000";
            let mismatch = Mismatch::new(format_args!("{name:?}"), expected);
            Err(ExportError::Value { keyword: "frame", mismatch })
        }
    }
}

/// A name in capitals, digits and underscores.
fn symbol(name: &str) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' };
    name.trim().chars().map(allowed).take(LONGEST_NAME).collect()
}

/// A clock of seconds and microseconds that runs with TDB and starts at the first node.
fn clock_kernel(naif_id: i32, epoch_s: f64, end_ticks: f64) -> String {
    let id = -naif_id;
    let last = end_ticks.ceil();
    kernel(
        "KPL/SCLK",
        "A clock that counts microseconds of TDB since the first node of the plan.",
        &[
            "SCLK_KERNEL_ID = ( @2000-01-01 )".to_owned(),
            format!("SCLK_DATA_TYPE_{id} = ( 1 )"),
            format!("SCLK01_TIME_SYSTEM_{id} = ( 1 )"),
            format!("SCLK01_N_FIELDS_{id} = ( 2 )"),
            format!("SCLK01_MODULI_{id} = ( 1000000000 1000000 )"),
            format!("SCLK01_OFFSETS_{id} = ( 0 0 )"),
            format!("SCLK01_OUTPUT_DELIM_{id} = ( 1 )"),
            format!("SCLK_PARTITION_START_{id} = ( 0.0 )"),
            format!("SCLK_PARTITION_END_{id} = ( {last:e} )"),
            format!("SCLK01_COEFFICIENTS_{id} = ( 0.0 {epoch_s:.16e} 1.0 )"),
        ],
    )
}

fn frame_kernel(name: &str, naif_id: i32, body: i32) -> String {
    kernel(
        "KPL/FK",
        "The body frame of the plan, whose attitude the C-kernel has.",
        &[
            format!("FRAME_{name}_BODY = {body}"),
            format!("FRAME_{body}_NAME = '{name}_BODY'"),
            format!("FRAME_{body}_CLASS = 3"),
            format!("FRAME_{body}_CLASS_ID = {body}"),
            format!("FRAME_{body}_CENTER = {naif_id}"),
            format!("CK_{body}_SCLK = {naif_id}"),
            format!("CK_{body}_SPK = {naif_id}"),
            format!("NAIF_BODY_NAME += ( '{name}' )"),
            format!("NAIF_BODY_CODE += ( {naif_id} )"),
        ],
    )
}

/// A text kernel.
fn kernel(kind: &str, comment: &str, assignments: &[String]) -> String {
    let mut text = format!("{kind}\n\n{comment}\n\n\\begindata\n\n");
    for assignment in assignments {
        writeln!(text, "{assignment}").expect("a string takes all that is written to it");
    }
    text.push_str("\n\\begintext\n");
    text
}
