use crate::initial_guess::InitialGuess;
use crate::primal_dual_point::PrimalDualPoint;

/// Where a solve starts.
#[derive(Debug, Clone)]
pub enum OcpStart {
    /// States and controls; the multipliers are estimated.
    Guess(InitialGuess),
    /// A point with multipliers, from an earlier solve of a problem of the same size.
    Warm(PrimalDualPoint),
}
