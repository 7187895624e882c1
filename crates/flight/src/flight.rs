//! One plant, flown both ways.

use crate::end::End;
use crate::guidance::Log;

/// One plant, flown both ways.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight {
    /// Which flight, counted from zero.
    pub number: usize,
    /// The end of the plan flown as it is; none where the plant is not ours to fly twice.
    pub open_loop: Option<End>,
    /// The end with what is done about it.
    pub flown: End,
    /// What happened on the way.
    pub log: Log,
}
