//! What can go wrong in putting a plan into another format.

use righting_scenario::error::Mismatch;

/// Why a plan could not be put into a format.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A value is not one that the format takes.
    #[error("{keyword}: {mismatch}")]
    Value {
        /// The keyword it is for.
        keyword: &'static str,
        /// The value, and what the format takes.
        mismatch: Mismatch,
    },
    /// The time tags would not increase or leave the calendar.
    #[error(
        "time tags: {}",
        Mismatch::new(
            format_args!("a step of {step_s} s from {epoch}"),
            "at least 1e-9 s, up to the year 9999"
        )
    )]
    TimeTags {
        /// The step of the trajectory, s.
        step_s: f64,
        /// Its first time.
        epoch: String,
    },
    /// The nodes are too near each other in time for the format's clock.
    #[error("time from the start: {}", Mismatch::new(format_args!("a step of {step_s} s"), "at least 1e-9 s"))]
    Steps {
        /// The step of the trajectory, s.
        step_s: f64,
    },
    /// The motion of the plan cannot be followed.
    #[error("the motion cannot be followed beyond {time_s} s")]
    Motion {
        /// Where it ends.
        time_s: f64,
    },
    /// The format takes serial arms only.
    #[error(
        "system: {}",
        Mismatch::new(
            "an arm that branches",
            "serial arms on the base: this format has no branches"
        )
    )]
    Branches,
    /// The format knows neither wheels nor what acts from outside.
    #[error(
        "scenario: {}",
        Mismatch::new(
            "wheels or an environment",
            "neither: this format has none, the format mujoco has both"
        )
    )]
    Surroundings,
    /// The format takes joints that turn only.
    #[error(
        "system: {}",
        Mismatch::new(
            format_args!("joint {joint}, which slides"),
            "joints that turn: this format has no others in an arm"
        )
    )]
    Slides {
        /// The name of the joint.
        joint: String,
    },
    /// An archive could not be made.
    #[error("cannot make the archive: {0}")]
    Archive(#[from] zip::result::ZipError),
}
