use righting_nlp::{Options, Problem};

use crate::barrier::longest_primal_step;
use crate::barrier_parameter::BarrierParameter;
use crate::error::FailureReason;
use crate::filter::ReferencePoint;
use crate::iterate::Iterate;
use crate::primal_point::PrimalPoint;
use crate::program::Program;
use crate::search_direction::{NewtonSystem, SearchDirection};

/// Where a solve is: what line search and corrections work on.
pub(crate) struct State<'a, P: ?Sized, L: ?Sized> {
    pub(crate) program: Program<'a, P>,
    pub(crate) newton: NewtonSystem<'a, L>,
    pub(crate) options: &'a Options,
    pub(crate) barrier: BarrierParameter,
    pub(crate) iterate: Iterate,
    pub(crate) direction: SearchDirection,
}

impl<P: Problem + ?Sized, L: ?Sized> State<'_, P, L> {
    /// What the line search from here measures its trial points against.
    pub(crate) fn reference(&self) -> ReferencePoint {
        let mu = self.barrier.mu;
        ReferencePoint {
            measures: self.iterate.point.measures(mu),
            slope: self.direction.slope(&self.program, &self.iterate, mu),
        }
    }
    /// The longest step along the direction that the fraction to the boundary allows.
    pub(crate) fn longest_step(&self) -> f64 {
        let distances = &self.iterate.point.distances;
        longest_primal_step(&self.program.bounds, distances, &self.direction.w, self.barrier.tau)
    }

    /// Evaluates the functions so far along the direction; false where one is not defined.
    pub(crate) fn try_step(
        &mut self,
        length: f64,
        trial: &mut PrimalPoint,
    ) -> Result<bool, FailureReason> {
        let Self { program, iterate, direction, barrier, .. } = self;
        for ((trial, w), dw) in trial.w.iter_mut().zip(&iterate.point.w).zip(&direction.w) {
            *trial = w + length * dw;
        }
        match trial.evaluate(program, &iterate.z, barrier.mu) {
            Ok(()) => Ok(true),
            Err(FailureReason::Undefined) => Ok(false),
            Err(other) => Err(other),
        }
    }
}
