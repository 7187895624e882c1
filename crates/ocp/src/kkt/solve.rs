//! Backward and forward sweep over a right-hand side.

use pulp::{Simd, WithSimd};

use super::dims::{NodeOffsets, SystemLayout};
use super::elimination::Elimination;
use super::lanes::{AlignedVec, add_rows, dot, reset, vectors, vectors_mut, zeros};
use super::node::NodeFactor;
use super::packed::subtract_product;
use super::pattern::NodePattern;
use super::structure::Structure;

/// Scratch of the sweeps.
#[derive(Debug, Clone)]
pub(super) struct SolveWorkspace {
    /// Unknowns of a node as in a row of its matrix: leading, then states, padded.
    local: AlignedVec,
    /// The same with the leading ones in elimination order, delayed ones among them.
    ordered: AlignedVec,
    /// Constraint rows of a node as the Jacobian's products take them.
    rows: AlignedVec,
    /// Next states.
    states: AlignedVec,
    /// Defect multipliers, or what they are solved from.
    multipliers: AlignedVec,
    /// Regularised defects' inner unknowns.
    inner: AlignedVec,
}

impl Default for SolveWorkspace {
    fn default() -> Self {
        let empty = || zeros(0);
        Self {
            local: empty(),
            ordered: empty(),
            rows: empty(),
            states: empty(),
            multipliers: empty(),
            inner: empty(),
        }
    }
}

/// Solves in place with the factors of all nodes.
pub(super) struct Solve<'a> {
    pub layout: &'a SystemLayout,
    pub structure: &'a Structure,
    pub nodes: &'a [NodeFactor],
    pub work: &'a mut SolveWorkspace,
    pub rhs: &'a mut [f64],
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { layout, structure, nodes, work, rhs } = self;
        for k in (0..nodes.len()).rev() {
            let step = NodeStep::new(layout, structure, nodes, k);
            step.backward(simd, work, rhs);
        }
        for k in 0..nodes.len() {
            let step = NodeStep::new(layout, structure, nodes, k);
            step.forward(simd, work, rhs);
        }
    }
}

/// A node with the defect that leads to the next one.
struct NodeStep<'a> {
    pattern: &'a NodePattern,
    node: &'a NodeFactor,
    at: &'a NodeOffsets,
    next: Option<(&'a NodeFactor, &'a NodeOffsets)>,
}

impl<'a> NodeStep<'a> {
    #[inline(always)]
    fn new(
        layout: &'a SystemLayout,
        structure: &'a Structure,
        nodes: &'a [NodeFactor],
        k: usize,
    ) -> Self {
        Self {
            pattern: structure.pattern(k),
            node: &nodes[k],
            at: &layout.nodes[k],
            next: nodes.get(k + 1).zip(layout.nodes.get(k + 1)),
        }
    }

    /// Reduces the node's right-hand side by all later unknowns and its own leading ones.
    #[inline(always)]
    fn backward<S: Simd>(&self, simd: S, work: &mut SolveWorkspace, rhs: &mut [f64]) {
        let (shape, leading) = (self.pattern.shape, &self.node.leading);
        let jacobian = &self.pattern.jacobian;
        let first = jacobian.inequality_rows(S::F64_LANES);
        reset(&mut work.rows, first + shape.inequalities);
        self.reduce_defect(simd, work, rhs);
        for (row, pivot) in self.node.inequalities.iter().enumerate() {
            let (slack, multiplier) = (self.at.slack + row, self.at.inequality + row);
            (_, work.rows[first + row]) = pivot.solve(rhs[slack], rhs[multiplier]);
        }
        self.load(rhs, &mut work.local);
        jacobian.subtract_transposed(simd, &self.node.jacobian, &work.rows, &mut work.local);
        self.store(&work.local, rhs);

        self.gather(rhs, &mut work.ordered);
        for k in 0..leading.eliminated {
            let term = (-work.ordered[k], k * leading.stride / S::F64_LANES);
            let out = vectors_mut::<S>(&mut work.ordered);
            add_rows(simd, out, vectors::<S>(&leading.rows), std::iter::once(term));
        }
        self.scatter(&work.ordered, rhs);
    }

    /// Solves for the node's leading unknowns, inequalities, defect multipliers and next states.
    #[inline(always)]
    fn forward<S: Simd>(&self, simd: S, work: &mut SolveWorkspace, rhs: &mut [f64]) {
        let shape = self.pattern.shape;
        self.gather(rhs, &mut work.ordered);
        substitute(simd, &self.node.leading, &mut work.ordered);
        self.scatter(&work.ordered, rhs);

        let jacobian = &self.pattern.jacobian;
        let first = jacobian.inequality_rows(S::F64_LANES);
        reset(&mut work.rows, first);
        work.rows[S::F64_LANES..][..shape.defects]
            .copy_from_slice(&rhs[self.at.defect..][..shape.defects]);
        let inequalities = self.at.inequality..self.at.inequality + shape.inequalities;
        work.rows.extend_from_slice(&rhs[inequalities]);
        self.load(rhs, &mut work.local);
        jacobian.subtract_product(simd, &self.node.jacobian, &work.local, &mut work.rows);
        for (row, pivot) in self.node.inequalities.iter().enumerate() {
            let (slack, multiplier) = (self.at.slack + row, self.at.inequality + row);
            (rhs[slack], rhs[multiplier]) = pivot.solve(rhs[slack], work.rows[first + row]);
        }
        self.expand_defect(simd, work, rhs);
    }

    /// Reads the unknowns that constraints see, as they stand in a row of the node's matrix.
    #[inline(always)]
    fn load(&self, rhs: &[f64], local: &mut AlignedVec) {
        let shape = self.pattern.shape;
        reset(local, self.pattern.stride);
        let (states, free) = rhs[self.at.variable..].split_at(shape.states);
        local[..shape.free].copy_from_slice(&free[..shape.free]);
        local[self.pattern.split..][..shape.states].copy_from_slice(states);
    }

    /// Writes back what [`Self::load`] reads.
    #[inline(always)]
    fn store(&self, local: &[f64], rhs: &mut [f64]) {
        let shape = self.pattern.shape;
        let (states, free) = rhs[self.at.variable..].split_at_mut(shape.states);
        free[..shape.free].copy_from_slice(&local[..shape.free]);
        states.copy_from_slice(&local[self.pattern.split..][..shape.states]);
    }

    /// Reads leading unknowns in elimination order, then the states.
    #[inline(always)]
    fn gather(&self, rhs: &[f64], ordered: &mut AlignedVec) {
        let (leading, states) = (&self.node.leading, self.pattern.shape.states);
        reset(ordered, leading.stride);
        for (value, &unknown) in ordered.iter_mut().zip(&leading.unknowns) {
            *value = rhs[unknown as usize];
        }
        ordered[leading.split..][..states].copy_from_slice(&rhs[self.at.variable..][..states]);
    }

    /// Writes back what [`Self::gather`] reads.
    #[inline(always)]
    fn scatter(&self, ordered: &[f64], rhs: &mut [f64]) {
        let (leading, states) = (&self.node.leading, self.pattern.shape.states);
        for (&value, &unknown) in ordered.iter().zip(&leading.unknowns) {
            rhs[unknown as usize] = value;
        }
        rhs[self.at.variable..][..states].copy_from_slice(&ordered[leading.split..][..states]);
    }

    /// Defect multipliers before the node's own unknowns are known, into `work.rows`; unknowns
    /// that the next node delayed are reduced by the next states.
    #[inline(always)]
    fn reduce_defect<S: Simd>(&self, simd: S, work: &mut SolveWorkspace, rhs: &mut [f64]) {
        let Some((next, next_at)) = self.next else { return };
        let defects = self.pattern.shape.defects;
        let width = defects.next_multiple_of(S::F64_LANES);
        reset(&mut work.multipliers, width);
        work.multipliers[..defects].copy_from_slice(&rhs[next_at.variable..][..defects]);
        reset(&mut work.states, width);
        for (i, &scale) in self.node.defect_scales.iter().enumerate() {
            let residual = scale * rhs[self.at.defect + i];
            rhs[self.at.defect + i] = residual;
            work.states[i] = residual;
        }
        subtract_product(simd, &next.value, defects, &work.states, &mut work.multipliers);
        self.cross_regularized(simd, work);
        work.rows[S::F64_LANES..][..defects].copy_from_slice(&work.multipliers[..defects]);

        let leading = &next.leading;
        for j in leading.eliminated..leading.size {
            let coupling = vectors::<S>(&leading.row(j)[leading.split..]);
            let states = vectors::<S>(&work.states);
            rhs[leading.unknowns[j] as usize] -= dot(simd, coupling, states);
        }
    }

    /// Defect multipliers and next states, the step taken from the node's unknowns in `work.rows`.
    #[inline(always)]
    fn expand_defect<S: Simd>(&self, simd: S, work: &mut SolveWorkspace, rhs: &mut [f64]) {
        let Some((next, next_at)) = self.next else { return };
        let defects = self.pattern.shape.defects;
        let width = defects.next_multiple_of(S::F64_LANES);
        reset(&mut work.multipliers, width);
        work.multipliers[..defects].copy_from_slice(&rhs[next_at.variable..][..defects]);
        reset(&mut work.states, width);
        work.states[..defects].copy_from_slice(&work.rows[S::F64_LANES..][..defects]);
        let leading = &next.leading;
        for j in leading.eliminated..leading.size {
            let value = rhs[leading.unknowns[j] as usize];
            let coupling = vectors::<S>(&leading.row(j)[leading.split..]);
            let out = vectors_mut::<S>(&mut work.multipliers);
            add_rows(simd, out, coupling, std::iter::once((-value, 0)));
        }
        subtract_product(simd, &next.value, defects, &work.states, &mut work.multipliers);
        self.cross_regularized(simd, work);
        rhs[next_at.variable..][..defects].copy_from_slice(&work.states[..defects]);
        for (i, &scale) in self.node.defect_scales.iter().enumerate() {
            rhs[self.at.defect + i] = scale * work.multipliers[i];
        }
    }

    #[inline(always)]
    fn cross_regularized<S: Simd>(&self, simd: S, work: &mut SolveWorkspace) {
        if let Some(regularization) = &self.node.regularization {
            let SolveWorkspace { inner, multipliers, states, .. } = work;
            regularization.solve(simd, inner, multipliers, states);
        }
    }
}

/// Back substitution: the eliminated unknowns from the delayed ones and the states.
#[inline(always)]
fn substitute<S: Simd>(simd: S, leading: &Elimination, local: &mut [f64]) {
    let pivots = &leading.inverse_pivots;
    let mut carried = 0.0;
    for k in 0..leading.eliminated {
        let value = local[k];
        local[k] = pivots[k] * value + carried;
        carried = 0.0;
        if let Some(&coupling) = leading.inverse_couplings.get(k)
            && coupling != 0.0
        {
            local[k] += coupling * local[k + 1];
            carried = coupling * value;
        }
    }
    for k in (0..leading.eliminated).rev() {
        local[k] -= dot(simd, vectors::<S>(leading.row(k)), vectors::<S>(local));
    }
}
