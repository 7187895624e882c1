//! How a node's values are collected from the triplets.

use super::lanes::copy_short;
use super::pattern::{BlockEntry, NodePattern, Position};
use super::structure::Coupling;

/// Consecutive triplets that are consecutive in the node's storage too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Run {
    pub destination: u32,
    pub length: u32,
}

/// What goes into one storage: runs, and positions that get another value on top.
#[derive(Debug, Clone, Default)]
pub(super) struct CopyPlan {
    pub runs: Vec<Run>,
    pub repeats: Vec<u32>,
    /// The node's triplets that these take, by their number within the node.
    run_triplets: Vec<u32>,
    repeat_triplets: Vec<u32>,
}

/// How triplets come into a node's storage, shared by all nodes whose triplets come in the same
/// order. A node's *sources* are triplet indices: for the assembly and then for the Jacobian, the
/// first of each run, then one for each repeated value.
#[derive(Debug, Clone)]
pub(super) struct Gather {
    /// What each of the node's triplets couples, in triplet order.
    couplings: Vec<Coupling>,
    pub pattern: usize,
    pub assembly: CopyPlan,
    pub jacobian: CopyPlan,
}

impl Gather {
    /// The plan for a node with these couplings and entries; `triplets` are their indices, `sorted` their
    /// order by entry.
    pub fn new(
        couplings: Vec<Coupling>,
        entries: &[BlockEntry],
        triplets: &[u32],
        sorted: &[u32],
        pattern: &NodePattern,
        pattern_index: usize,
    ) -> Self {
        let (mut assembly, mut jacobian) = (CopyPlan::default(), CopyPlan::default());
        let mut previous = None;
        for &number in sorted {
            let entry = entries[number as usize];
            let (plan, position) = match pattern.position(entry) {
                Position::Assembly(position) => (&mut assembly, position),
                Position::Jacobian(position) => (&mut jacobian, position),
            };
            plan.push(position as u32, number, previous == Some(entry), triplets);
            previous = Some(entry);
        }
        Self { couplings, pattern: pattern_index, assembly, jacobian }
    }

    /// Appends the sources of a node, if its triplets come in this plan's order.
    pub fn try_sources(
        &self,
        couplings: &[Coupling],
        triplets: &[u32],
        sources: &mut Vec<u32>,
    ) -> bool {
        let start = sources.len();
        let fits = self.couplings == couplings
            && self.assembly.try_sources(triplets, sources)
            && self.jacobian.try_sources(triplets, sources);
        if !fits {
            sources.truncate(start);
        }
        fits
    }
}

impl CopyPlan {
    fn push(&mut self, destination: u32, number: u32, repeated: bool, triplets: &[u32]) {
        if repeated {
            self.repeats.push(destination);
            self.repeat_triplets.push(number);
            return;
        }
        let follows = self
            .run_triplets
            .last()
            .is_some_and(|&last| triplets[last as usize] + 1 == triplets[number as usize]);
        match self.runs.last_mut() {
            Some(run) if follows && run.destination + run.length == destination => run.length += 1,
            _ => self.runs.push(Run { destination, length: 1 }),
        }
        self.run_triplets.push(number);
    }

    fn try_sources(&self, triplets: &[u32], sources: &mut Vec<u32>) -> bool {
        let mut rest = &self.run_triplets[..];
        for run in &self.runs {
            let (own, after) = rest.split_at(run.length as usize);
            rest = after;
            let first = triplets[own[0] as usize];
            sources.push(first);
            let contiguous = own
                .iter()
                .zip(first..)
                .all(|(&number, source)| triplets[number as usize] == source);
            if !contiguous {
                return false;
            }
        }
        sources.extend(self.repeat_triplets.iter().map(|&number| triplets[number as usize]));
        true
    }

    /// Number of sources.
    pub fn sources(&self) -> usize {
        self.runs.len() + self.repeats.len()
    }

    /// Collects the values into the storage.
    #[inline(always)]
    pub fn collect(&self, sources: &[u32], values: &[f64], storage: &mut [f64]) {
        let (run_sources, repeat_sources) = sources.split_at(self.runs.len());
        for (run, &source) in self.runs.iter().zip(run_sources) {
            let (to, from) = (run.destination as usize, source as usize);
            let length = run.length as usize;
            copy_short(&values[from..from + length], &mut storage[to..to + length]);
        }
        for (&to, &from) in self.repeats.iter().zip(repeat_sources) {
            storage[to as usize] += values[from as usize];
        }
    }
}
