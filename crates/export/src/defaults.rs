//! What attitude files say where nothing is said.

use jiff::civil::DateTime;

/// Time of the first node: noon of 2000-01-01.
pub(crate) const DEFAULT_EPOCH: DateTime = DateTime::constant(2000, 1, 1, 12, 0, 0, 0);
/// The inertial frame that the plan's inertial axes are.
pub(crate) const DEFAULT_FRAME: &str = "EME2000";
/// The time system of the epoch.
pub(crate) const DEFAULT_TIME_SYSTEM: &str = "UTC";
