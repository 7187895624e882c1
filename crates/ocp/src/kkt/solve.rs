//! Backward and forward sweep over a right-hand side.

use pulp::{Simd, WithSimd};

use super::dims::{Layout, NodeLayout};
use super::elimination::Elimination;
use super::lanes::{AlignedVec, add_rows, dot, reset, zeros};
use super::node::NodeFactor;
use super::pattern::NodePattern;
use super::structure::Structure;

/// Scratch of the sweeps.
#[derive(Debug)]
pub(super) struct SolveWorkspace {
    /// Unknowns of a node: leading, then states, padded like a leading row.
    local: AlignedVec,
    /// One number for each constraint row of a node.
    rows: Vec<f64>,
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
            rows: Vec::new(),
            states: empty(),
            multipliers: empty(),
            inner: empty(),
        }
    }
}

/// Solves in place with the factors of all nodes.
pub(super) struct Solve<'a> {
    pub layout: &'a Layout,
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
            let step = Step::new(layout, structure, nodes, k);
            step.backward(simd, work, rhs);
        }
        for k in 0..nodes.len() {
            let step = Step::new(layout, structure, nodes, k);
            step.forward(simd, work, rhs);
        }
    }
}

/// A node with the defect that leads to the next one.
struct Step<'a> {
    pattern: &'a NodePattern,
    node: &'a NodeFactor,
    at: &'a NodeLayout,
    /// First trailing state in the right-hand side.
    state: usize,
    next: Option<(&'a NodeFactor, &'a NodeLayout)>,
}

impl<'a> Step<'a> {
    #[inline(always)]
    fn new(
        layout: &'a Layout,
        structure: &'a Structure,
        nodes: &'a [NodeFactor],
        k: usize,
    ) -> Self {
        Self {
            pattern: structure.pattern(k),
            node: &nodes[k],
            at: &layout.nodes[k],
            state: layout.nodes[k].variable,
            next: nodes.get(k + 1).zip(layout.nodes.get(k + 1)),
        }
    }

    /// Reduces the node's right-hand side by all later unknowns and its own leading ones.
    #[inline(always)]
    fn backward<S: Simd>(&self, simd: S, work: &mut SolveWorkspace, rhs: &mut [f64]) {
        let (shape, leading) = (self.pattern.shape, &self.node.leading);
        work.rows.resize(shape.defects + shape.inequalities, 0.0);
        self.reduce_defect(simd, work, rhs);
        for (row, pivot) in self.node.inequalities.iter().enumerate() {
            let (slack, multiplier) = (self.at.slack + row, self.at.inequality + row);
            let (_, multiplier) = pivot.solve(rhs[slack], rhs[multiplier]);
            work.rows[shape.defects + row] = -multiplier;
        }

        for column in 0..shape.free + shape.states {
            let sum: f64 = self
                .pattern
                .column(column)
                .map(|t| {
                    let row = usize::from(self.pattern.constraint_rows[t]);
                    self.node.constraints[t] * work.rows[row]
                })
                .sum();
            rhs[self.unknown(column)] += sum;
        }

        reset(&mut work.local, leading.stride);
        gather(leading, rhs, &mut work.local);
        let states = leading.split..leading.split + shape.states;
        work.local[states.clone()].copy_from_slice(&rhs[self.state..][..shape.states]);
        for k in 0..leading.eliminated {
            let coefficient = -work.local[k];
            add_rows(simd, &mut work.local, std::iter::once((coefficient, leading.row(k))));
        }
        scatter(leading, &work.local, rhs);
        rhs[self.state..][..shape.states].copy_from_slice(&work.local[states]);
    }

    /// Solves for the node's leading unknowns, inequalities, defect multipliers and next states.
    #[inline(always)]
    fn forward<S: Simd>(&self, simd: S, work: &mut SolveWorkspace, rhs: &mut [f64]) {
        let (shape, leading) = (self.pattern.shape, &self.node.leading);
        reset(&mut work.local, leading.stride);
        gather(leading, rhs, &mut work.local);
        let states = leading.split..leading.split + shape.states;
        work.local[states].copy_from_slice(&rhs[self.state..][..shape.states]);
        substitute(simd, leading, &mut work.local);
        scatter(leading, &work.local, rhs);

        work.rows.clear();
        work.rows.resize(shape.defects + shape.inequalities, 0.0);
        for column in 0..shape.free + shape.states {
            let value = rhs[self.unknown(column)];
            for t in self.pattern.column(column) {
                let row = usize::from(self.pattern.constraint_rows[t]);
                work.rows[row] += self.node.constraints[t] * value;
            }
        }
        for (row, pivot) in self.node.inequalities.iter().enumerate() {
            let (slack, multiplier) = (self.at.slack + row, self.at.inequality + row);
            let residual = rhs[multiplier] - work.rows[shape.defects + row];
            (rhs[slack], rhs[multiplier]) = pivot.solve(rhs[slack], residual);
        }
        self.expand_defect(simd, work, rhs);
    }

    /// Unknown of a constraint column.
    #[inline(always)]
    fn unknown(&self, column: usize) -> usize {
        let shape = self.pattern.shape;
        match column.checked_sub(shape.free) {
            None => self.state + shape.states + column,
            Some(state) => self.state + state,
        }
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
        subtract_product(simd, &next.value, &work.states, &mut work.multipliers);
        self.regularize(simd, work);
        work.rows[..defects].copy_from_slice(&work.multipliers[..defects]);

        let leading = &next.leading;
        for j in leading.eliminated..leading.size {
            let coupling = &leading.row(j)[leading.split..];
            rhs[leading.unknowns[j] as usize] -= dot(simd, coupling, &work.states);
        }
    }

    /// Defect multipliers and next states, the step's image of the node's unknowns in `work.rows`.
    #[inline(always)]
    fn expand_defect<S: Simd>(&self, simd: S, work: &mut SolveWorkspace, rhs: &mut [f64]) {
        let Some((next, next_at)) = self.next else { return };
        let defects = self.pattern.shape.defects;
        let width = defects.next_multiple_of(S::F64_LANES);
        reset(&mut work.multipliers, width);
        work.multipliers[..defects].copy_from_slice(&rhs[next_at.variable..][..defects]);
        reset(&mut work.states, width);
        for i in 0..defects {
            work.states[i] = rhs[self.at.defect + i] + work.rows[i];
        }
        let leading = &next.leading;
        for j in leading.eliminated..leading.size {
            let value = rhs[leading.unknowns[j] as usize];
            let coupling = &leading.row(j)[leading.split..];
            add_rows(simd, &mut work.multipliers, std::iter::once((-value, coupling)));
        }
        subtract_product(simd, &next.value, &work.states, &mut work.multipliers);
        self.regularize(simd, work);
        rhs[next_at.variable..][..defects].copy_from_slice(&work.states[..defects]);
        for (i, &scale) in self.node.defect_scales.iter().enumerate() {
            rhs[self.at.defect + i] = scale * work.multipliers[i];
        }
    }

    /// With regularised defects: multipliers `y ← (I + PΔ)⁻¹ y` and states `x ← x + Δ y`.
    #[inline(always)]
    fn regularize<S: Simd>(&self, simd: S, work: &mut SolveWorkspace) {
        let Some(regularization) = &self.node.regularization else { return };
        let elimination = &regularization.elimination;
        let width = elimination.split;
        reset(&mut work.inner, width);
        for (k, &unknown) in elimination.unknowns.iter().enumerate() {
            let i = unknown as usize;
            work.inner[k] = regularization.roots[i] * work.multipliers[i];
        }
        for k in 0..elimination.eliminated {
            let coefficient = -work.inner[k];
            let (own, trailing) = elimination.row(k).split_at(width);
            add_rows(simd, &mut work.inner, std::iter::once((coefficient, own)));
            let trailing = &trailing[..width];
            add_rows(simd, &mut work.multipliers, std::iter::once((coefficient, trailing)));
        }
        for (i, root) in regularization.roots.iter().enumerate() {
            work.states[i] += root * root * work.multipliers[i];
        }
    }
}

/// Reads the leading unknowns in elimination order.
#[inline(always)]
fn gather(leading: &Elimination, rhs: &[f64], local: &mut [f64]) {
    for (value, &unknown) in local.iter_mut().zip(&leading.unknowns) {
        *value = rhs[unknown as usize];
    }
}

#[inline(always)]
fn scatter(leading: &Elimination, local: &[f64], rhs: &mut [f64]) {
    for (&value, &unknown) in local.iter().zip(&leading.unknowns) {
        rhs[unknown as usize] = value;
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
        local[k] -= dot(simd, leading.row(k), local);
    }
}

/// `out ← out − matrix · vector` for a symmetric matrix with rows as long as `out`.
#[inline(always)]
fn subtract_product<S: Simd>(simd: S, matrix: &[f64], vector: &[f64], out: &mut [f64]) {
    let width = out.len();
    let terms = matrix.chunks_exact(width.max(1)).zip(vector).map(|(row, &value)| (-value, row));
    add_rows(simd, out, terms);
}
