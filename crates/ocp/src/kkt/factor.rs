//! The backward sweep: eliminates node after node, the last first.

use pulp::{Simd, WithSimd};

use super::dims::Layout;
use super::elimination::{Breakdown, Elimination};
use super::lanes::{AlignedVec, add_lanes, add_rows, reset, zeros};
use super::node::{InequalityPivot, NodeFactor, Regularization};
use super::pattern::NodePattern;
use super::structure::Structure;

/// Scratch of the sweep.
#[derive(Debug)]
pub(super) struct Workspace {
    /// One node's values as [`super::pattern::Sections`] lays them out.
    assembly: AlignedVec,
    /// Factor of each constraint entry's row: that makes next states' coefficients one.
    row_factors: Vec<f64>,
    /// Leading rows of the node's matrix, all later nodes eliminated.
    matrix: AlignedVec,
    /// Pivot rows times D.
    scaled: AlignedVec,
    /// Magnitude of the terms of each leading diagonal.
    scales: Vec<f64>,
    /// Cost-to-go Hessian times the step's Jacobian, then weighted inequality rows.
    image: AlignedVec,
    /// One column of the image.
    column: AlignedVec,
    /// Next node's cost to go as this node sees it through regularised defects.
    value: AlignedVec,
    /// Unknowns delayed by the next node: their coupling to its states, and among themselves.
    delayed: Delayed,
}

#[derive(Debug)]
struct Delayed {
    count: usize,
    /// `count` rows over the next states.
    states: AlignedVec,
    /// `count` × `count`.
    corner: Vec<f64>,
}

impl Default for Workspace {
    fn default() -> Self {
        Self {
            assembly: zeros(0),
            row_factors: Vec::new(),
            matrix: zeros(0),
            scaled: zeros(0),
            scales: Vec::new(),
            image: zeros(0),
            column: zeros(0),
            value: zeros(0),
            delayed: Delayed { count: 0, states: zeros(0), corner: Vec::new() },
        }
    }
}

/// One factorisation; its outcome is the number of negative eigenvalues.
pub(super) struct Factor<'a> {
    pub layout: &'a Layout,
    pub structure: &'a Structure,
    pub nodes: &'a mut [NodeFactor],
    pub work: &'a mut Workspace,
    pub values: &'a [f64],
    /// Smallest pivot allowed beside the rest of its row.
    pub tolerance: f64,
}

impl WithSimd for Factor<'_> {
    type Output = Result<usize, Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { layout, structure, nodes, work, values, tolerance } = self;
        let mut negative = 0;
        for k in (0..nodes.len()).rev() {
            let pattern = structure.pattern(k);
            let (before, after) = nodes.split_at_mut(k + 1);
            let node = &mut before[k];
            work.assemble(structure, k, values);
            negative += work.eliminate_inequalities(pattern, node)?;
            work.scale_constraints(pattern, node)?;
            negative += pattern.shape.defects;
            let next = after.first();
            negative += work.cross_defect(simd, pattern, node, next, tolerance)?;
            let value = match (&node.regularization, next) {
                (None, Some(next)) => &next.value,
                _ => &work.value,
            };
            let delayed = work.delayed.count;
            let split = (pattern.shape.leading() + delayed).next_multiple_of(S::F64_LANES);
            let stride = split + pattern.state_stride;
            node.leading.shape(pattern.shape.leading() + delayed, split, stride);
            node.leading.unknowns.clear();
            let at = &layout.nodes[k];
            let first = if k == 0 { at.variable } else { at.control() };
            let own = (first..first + pattern.shape.free)
                .chain(at.equality..at.equality + pattern.shape.equalities);
            node.leading.unknowns.extend(own.map(|unknown| unknown as u32));
            if let Some(next) = next {
                let delayed = &next.leading.unknowns[next.leading.eliminated..];
                node.leading.unknowns.extend_from_slice(delayed);
            }

            image(simd, pattern, node, value, &mut work.image, &mut work.column);
            leading_rows(simd, pattern, node, &work.image, &work.assembly, &mut work.matrix);
            leading_scales(pattern, node, value, &work.assembly, &mut work.scales);
            if delayed > 0 {
                work.delayed.append(pattern, node, &mut work.matrix);
                let next = after.first().map(|next| &next.leading);
                work.scales
                    .extend(next.into_iter().flat_map(|next| &next.scales[next.eliminated..]));
            }
            if work.scaled.len() < work.matrix.len() {
                work.scaled.resize(work.matrix.len(), 0.0);
            }
            let plain = pattern.shape.equalities == 0 && delayed == 0;
            negative += eliminate(
                simd,
                &mut node.leading,
                plain,
                &work.matrix,
                &work.scales,
                &mut work.scaled,
                tolerance,
            )?;
            cost_to_go(simd, pattern, node, &work.image, &work.assembly, &work.scaled)?;
        }
        match nodes.first() {
            Some(first) if first.leading.delayed() > 0 => Err(Breakdown::Singular),
            _ => Ok(negative),
        }
    }
}

impl Workspace {
    /// Gathers a node's values.
    #[inline(always)]
    fn assemble(&mut self, structure: &Structure, k: usize, values: &[f64]) {
        let node = structure.nodes[k];
        let pattern = &structure.patterns[node.pattern];
        reset(&mut self.assembly, pattern.sections.end);
        let assembly = &mut self.assembly[..];
        let sources = &structure.sources[node.start..node.end];
        for (&destination, &source) in pattern.destinations.iter().zip(sources) {
            assembly[destination as usize] += values[source as usize];
        }
    }

    /// Eliminates slacks and inequality multipliers; returns their negative eigenvalues.
    #[inline(always)]
    fn eliminate_inequalities(
        &mut self,
        pattern: &NodePattern,
        node: &mut NodeFactor,
    ) -> Result<usize, Breakdown> {
        let sections = &pattern.sections;
        let mut negative = 0;
        for (row, pivot) in node.inequalities.iter_mut().enumerate() {
            let sigma = self.assembly[sections.slack_diagonals + row];
            let e = self.assembly[sections.slack_couplings + row];
            let delta = -self.assembly[sections.inequality_diagonals + row];
            let (inverse, count) = InequalityPivot::new(sigma, e, delta)?;
            *pivot = inverse;
            negative += count;
        }
        Ok(negative)
    }

    /// Scales defect rows by the reciprocal of the next state's coefficient, and turns
    /// `E x⁺ + J z` into the step `x⁺ = G z`.
    #[inline(always)]
    fn scale_constraints(
        &mut self,
        pattern: &NodePattern,
        node: &mut NodeFactor,
    ) -> Result<(), Breakdown> {
        let sections = &pattern.sections;
        self.row_factors.clear();
        for (row, scale) in node.defect_scales.iter_mut().enumerate() {
            *scale = 1.0 / self.assembly[sections.defect_couplings + row];
            if !(scale.is_finite() && *scale != 0.0) {
                return Err(Breakdown::Failed);
            }
            self.row_factors.push(-*scale);
        }
        self.row_factors.resize(pattern.shape.defects + pattern.shape.inequalities, 1.0);
        let entries = &self.assembly[sections.constraints..];
        for ((value, &entry), &row) in
            node.constraints.iter_mut().zip(entries).zip(&pattern.constraint_rows)
        {
            *value = entry * self.row_factors[usize::from(row)];
        }
        Ok(())
    }

    /// Eliminates next states and defect multipliers where that is not the plain substitution;
    /// returns the negative eigenvalues beyond one for each defect row.
    #[inline(always)]
    fn cross_defect<S: Simd>(
        &mut self,
        simd: S,
        pattern: &NodePattern,
        node: &mut NodeFactor,
        next: Option<&NodeFactor>,
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        let diagonals =
            &self.assembly[pattern.sections.defect_diagonals..][..pattern.shape.defects];
        let regularized = diagonals.iter().any(|&diagonal| diagonal != 0.0);
        self.delayed.count = 0;
        let Some(next) = next else {
            node.regularization = None;
            return Ok(0);
        };
        self.delayed.copy(&next.leading);
        if !regularized {
            node.regularization = None;
            return Ok(0);
        }
        let regularization = node.regularization.get_or_insert_default();
        regularization.roots.clear();
        for (&diagonal, &scale) in diagonals.iter().zip(&node.defect_scales) {
            if diagonal > 0.0 || diagonal.is_nan() {
                return Err(Breakdown::Failed);
            }
            regularization.roots.push((-diagonal).sqrt() * scale.abs());
        }
        self.regularize(simd, regularization, next, tolerance)
    }

    /// Forms the cost to go behind regularised defects, `P̃ = P − P√Δ S⁻¹ √ΔP`; returns the
    /// negative eigenvalues of S.
    #[inline(always)]
    fn regularize<S: Simd>(
        &mut self,
        simd: S,
        regularization: &mut Regularization,
        next: &NodeFactor,
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        let states = regularization.roots.len();
        let width = states.next_multiple_of(S::F64_LANES);
        let delayed = self.delayed.count;
        let stride = 2 * width + delayed.next_multiple_of(S::F64_LANES);
        let elimination = &mut regularization.elimination;
        elimination.shape(states, width, stride);
        elimination.unknowns.clear();
        elimination.unknowns.extend(0..states as u32);
        reset(&mut self.matrix, states * stride);
        self.scales.clear();
        for (i, &root) in regularization.roots.iter().enumerate() {
            let row = &mut self.matrix[i * stride..(i + 1) * stride];
            let value = &next.value[i * width..(i + 1) * width];
            for (j, &other) in regularization.roots.iter().enumerate() {
                row[j] = root * value[j] * other;
                row[width + j] = root * value[j];
            }
            self.scales.push(1.0 + row[i].abs());
            row[i] += 1.0;
            for j in 0..delayed {
                row[2 * width + j] = root * self.delayed.states[j * width + i];
            }
        }
        if self.scaled.len() < self.matrix.len() {
            self.scaled.resize(self.matrix.len(), 0.0);
        }
        let negative = eliminate(
            simd,
            elimination,
            true,
            &self.matrix,
            &self.scales,
            &mut self.scaled,
            tolerance,
        )?;
        if elimination.delayed() > 0 {
            return Err(Breakdown::Singular);
        }

        self.value.clear();
        self.value.extend_from_slice(&next.value);
        let unit = |k: usize| &elimination.row(k)[width..2 * width];
        let scaled = &self.scaled;
        for (i, row) in self.value.chunks_exact_mut(width.max(1)).enumerate() {
            let terms = (0..states).map(|k| (-scaled[k * stride + width + i], unit(k)));
            add_rows(simd, row, terms);
        }
        mirror(&mut self.value, states, width);
        for j in 0..delayed {
            let coefficient = |k: usize| -scaled[k * stride + 2 * width + j];
            let row = &mut self.delayed.states[j * width..(j + 1) * width];
            add_rows(simd, row, (0..states).map(|k| (coefficient(k), unit(k))));
            for i in 0..delayed {
                self.delayed.corner[j * delayed + i] += (0..states)
                    .map(|k| coefficient(k) * elimination.row(k)[2 * width + i])
                    .sum::<f64>();
            }
        }
        Ok(negative)
    }
}

impl Delayed {
    /// Takes over what the next node did not eliminate.
    fn copy(&mut self, leading: &Elimination) {
        self.count = leading.delayed();
        self.states.clear();
        self.corner.clear();
        for k in leading.eliminated..leading.size {
            let row = leading.row(k);
            self.states.extend_from_slice(&row[leading.split..]);
            self.corner.extend_from_slice(&row[leading.eliminated..leading.size]);
        }
    }

    /// Adds the rows and columns of the delayed unknowns to the leading rows: they couple to the
    /// next states, so to this node's unknowns through the step.
    fn append(&self, pattern: &NodePattern, node: &NodeFactor, matrix: &mut AlignedVec) {
        let (split, stride) = (node.leading.split, node.leading.stride);
        let own = pattern.shape.leading();
        matrix.resize((own + self.count) * stride, 0.0);
        let width = self.states.len() / self.count;
        for (j, states) in self.states.chunks_exact(width.max(1)).enumerate() {
            for column in 0..pattern.shape.free + pattern.shape.states {
                let coupling: f64 = pattern
                    .defect_column(column)
                    .map(|t| node.constraints[t] * states[usize::from(pattern.constraint_rows[t])])
                    .sum();
                match column.checked_sub(pattern.shape.free) {
                    None => matrix[column * stride + own + j] = coupling,
                    Some(state) => matrix[(own + j) * stride + split + state] = coupling,
                }
            }
            for i in j..self.count {
                matrix[(own + j) * stride + own + i] = self.corner[j * self.count + i];
            }
        }
    }
}

/// Eliminates a leading block, in order if `plain` and positive definite; returns its negative eigenvalues.
#[inline(always)]
fn eliminate<S: Simd>(
    simd: S,
    leading: &mut Elimination,
    plain: bool,
    matrix: &[f64],
    scales: &[f64],
    scaled: &mut [f64],
    tolerance: f64,
) -> Result<usize, Breakdown> {
    if plain && leading.eliminate_definite(simd, matrix, scales, scaled, tolerance) {
        return Ok(0);
    }
    leading.eliminate_indefinite(matrix, scales, scaled, tolerance)
}

/// Image of the constraint Jacobian: `P̃ G`, then each inequality row times its weight.
#[inline(always)]
fn image<S: Simd>(
    simd: S,
    pattern: &NodePattern,
    node: &NodeFactor,
    value: &[f64],
    image: &mut AlignedVec,
    column: &mut AlignedVec,
) {
    let shape = pattern.shape;
    let (split, stride) = (node.leading.split, node.leading.stride);
    let width = shape.defects.next_multiple_of(S::F64_LANES);
    reset(image, (shape.defects + shape.inequalities) * stride);
    column.resize(width, 0.0);
    for i in 0..shape.free + shape.states {
        let at = if i < shape.free { i } else { split + i - shape.free };
        let terms = pattern.defect_column(i).map(|t| {
            let row = usize::from(pattern.constraint_rows[t]);
            (node.constraints[t], &value[row * width..(row + 1) * width])
        });
        column.fill(0.0);
        add_rows(simd, column, terms);
        for (row, &value) in image.chunks_exact_mut(stride.max(1)).zip(&column[..shape.defects]) {
            row[at] = value;
        }
        for t in pattern.inequality_column(i) {
            let row = usize::from(pattern.constraint_rows[t]);
            let weight = node.inequalities[row - shape.defects].weight;
            image[row * stride + at] = weight * node.constraints[t];
        }
    }
}

/// Leading rows of `W + Gᵀ P̃ G + JᵀΣJ`, upper triangle.
#[inline(always)]
fn leading_rows<S: Simd>(
    simd: S,
    pattern: &NodePattern,
    node: &NodeFactor,
    image: &[f64],
    assembly: &[f64],
    matrix: &mut AlignedVec,
) {
    let shape = pattern.shape;
    let (split, stride) = (node.leading.split, node.leading.stride);
    reset(matrix, shape.leading() * stride);
    for i in 0..shape.leading() {
        let row = &mut matrix[i * stride..(i + 1) * stride];
        let own = &assembly[i * pattern.stride..(i + 1) * pattern.stride];
        row[..pattern.split].copy_from_slice(&own[..pattern.split]);
        row[split..].copy_from_slice(&own[pattern.split..]);
        if i < shape.free {
            let start = i / S::F64_LANES * S::F64_LANES;
            let terms = pattern.column(i).map(|t| {
                let row = usize::from(pattern.constraint_rows[t]);
                (node.constraints[t], &image[row * stride + start..(row + 1) * stride])
            });
            add_rows(simd, &mut row[start..], terms);
        }
    }
}

/// Magnitude of the terms that each leading diagonal is summed from (a bound when P̃ is
/// semidefinite: |P_rs| ≤ max(P_rr, P_ss)).
#[inline(always)]
fn leading_scales(
    pattern: &NodePattern,
    node: &NodeFactor,
    value: &[f64],
    assembly: &[f64],
    scales: &mut Vec<f64>,
) {
    let shape = pattern.shape;
    let width = value.len().checked_div(shape.defects).unwrap_or(0);
    scales.clear();
    for i in 0..shape.leading() {
        let mut scale = assembly[i * pattern.stride + i].abs();
        if i < shape.free {
            let entries = pattern.defect_column(i);
            let count = entries.len() as f64;
            for t in entries {
                let row = usize::from(pattern.constraint_rows[t]);
                let weight = value[row * width + row].abs();
                scale += count * weight * node.constraints[t] * node.constraints[t];
            }
            for t in pattern.inequality_column(i) {
                let row = usize::from(pattern.constraint_rows[t]) - shape.defects;
                let weight = node.inequalities[row].weight.abs();
                scale += weight * node.constraints[t] * node.constraints[t];
            }
        }
        scales.push(scale);
    }
}

/// Hessian of the cost to go in the node's states: `W + Gᵀ P̃ G + JᵀΣJ − Rᵀ D R`.
#[inline(always)]
fn cost_to_go<S: Simd>(
    simd: S,
    pattern: &NodePattern,
    node: &mut NodeFactor,
    image: &[f64],
    assembly: &[f64],
    scaled: &[f64],
) -> Result<(), Breakdown> {
    let shape = pattern.shape;
    let (split, stride, width) = (node.leading.split, node.leading.stride, pattern.state_stride);
    let mut sum = simd.splat_f64s(0.0);
    for i in 0..shape.states {
        let start = i / S::F64_LANES * S::F64_LANES;
        let row = &mut node.value[i * width + start..(i + 1) * width];
        row.copy_from_slice(
            &assembly[pattern.sections.states + i * width + start..][..width - start],
        );
        let pulled = pattern.column(shape.free + i).map(|t| {
            let row = usize::from(pattern.constraint_rows[t]);
            (node.constraints[t], &image[row * stride + split + start..(row + 1) * stride])
        });
        add_rows(simd, row, pulled);
        let leading = &node.leading;
        let eliminated = (0..leading.eliminated)
            .map(|k| (-scaled[k * stride + split + i], &leading.row(k)[split + start..]));
        add_rows(simd, row, eliminated);
        sum = add_lanes(simd, sum, row);
    }
    mirror(&mut node.value, shape.states, width);
    if simd.reduce_sum_f64s(sum).is_finite() { Ok(()) } else { Err(Breakdown::Failed) }
}

/// Copies the upper triangle to the lower one.
#[inline(always)]
fn mirror(matrix: &mut [f64], size: usize, stride: usize) {
    for i in 1..size {
        let (above, row) = matrix.split_at_mut(i * stride);
        for (value, above) in row[..i].iter_mut().zip(above.chunks_exact(stride)) {
            *value = above[i];
        }
    }
}
