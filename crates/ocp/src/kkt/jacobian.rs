//! Sparsity and storage of a node's constraint Jacobian.
//!
//! Defects of a mechanical system mix rows that depend on nearly everything with rows of
//! integrators, which have two or three entries. Full rows are stored as they are. The entries of
//! sparse rows lie on a few diagonals, since neighbouring rows integrate neighbouring states:
//! those are stored by diagonals, so that whole vectors of them are multiplied at once. Inequality
//! rows are stored as the range of vectors that they reach into.

use pulp::Simd;

use super::lanes::{add_products, add_rows, dot, tile_rows, vectors, vectors_mut};
use super::shape::NodeShape;

/// Rows with more entries than this are full rows.
const SPARSE_ROW: usize = 4;

/// A stored row of the Jacobian, or the part of it that has entries.
#[derive(Debug, Clone, Copy)]
struct Segment {
    /// Constraint row: defects first, then inequalities.
    row: usize,
    /// First column and length, whole vectors.
    start: usize,
    length: usize,
    slot: usize,
}

impl Segment {
    /// Inner product with a row of the node's unknowns.
    // A function and not a closure: closures escape the instruction set of their caller.
    #[inline(always)]
    fn product<S: Simd>(&self, simd: S, stored: &[S::f64s], local: &[S::f64s]) -> f64 {
        let row = &stored[self.slot / S::F64_LANES..][..self.length / S::F64_LANES];
        dot(simd, row, &local[self.start / S::F64_LANES..])
    }
}

/// Entries of defect rows whose column and row differ by the same number.
#[derive(Debug, Clone, Copy)]
struct Diagonal {
    /// First column and length, whole vectors.
    start: usize,
    length: usize,
    /// Row of the first column: may lie before the first row where the vector has no entry.
    row: isize,
    slot: usize,
}

/// One entry of a column: where it is stored, and its row.
#[derive(Debug, Clone, Copy)]
pub(super) struct ColumnEntry {
    pub slot: u32,
    pub row: u32,
}

/// Where the entries of a node's constraint rows are stored; columns are those of a row of the
/// node's matrix.
#[derive(Debug, Clone)]
pub(super) struct JacobianPattern {
    defects: usize,
    stride: usize,
    /// Full defect rows; stored first, one after another.
    full: Vec<Segment>,
    inequalities: Vec<Segment>,
    diagonals: Vec<Diagonal>,
    /// Length of the storage.
    pub length: usize,
    /// Start of each column's entries; free leading unknowns, then states.
    starts: Vec<usize>,
    entries: Vec<ColumnEntry>,
    /// The stored rows and diagonals that have columns in each vector of a row.
    vectors: Vec<VectorEntries>,
}

/// What reaches into the columns of one vector; slots are those of its first column.
#[derive(Debug, Clone, Default)]
struct VectorEntries {
    /// Slot, and row of the image as its first vector.
    rows: Vec<(usize, usize)>,
    /// Slot and row.
    diagonals: Vec<(usize, isize)>,
}

impl JacobianPattern {
    /// From the entries `(row, column)`, sorted.
    pub fn new(
        shape: NodeShape,
        split: usize,
        stride: usize,
        entries: &[(usize, usize)],
        lanes: usize,
    ) -> Self {
        let rows = shape.defects + shape.inequalities;
        let row_entries = |row: usize| {
            let start = entries.partition_point(|&(other, _)| other < row);
            let end = entries.partition_point(|&(other, _)| other <= row);
            &entries[start..end]
        };
        let is_sparse = |row: usize| row_entries(row).len() <= SPARSE_ROW;
        let sparse: Vec<usize> = (0..shape.defects).filter(|&row| is_sparse(row)).collect();
        let mut diagonals =
            find_diagonals(sparse.iter().flat_map(|&row| row_entries(row).iter().copied()), lanes);
        let by_diagonals: usize = diagonals.iter().map(|diagonal| diagonal.length).sum();
        let mut full: Vec<usize> = (0..shape.defects).filter(|&row| !is_sparse(row)).collect();
        if by_diagonals > sparse.len() * stride {
            full = (0..shape.defects).collect();
            diagonals.clear();
        }

        let mut length = 0;
        let mut take = |count: usize| {
            length += count;
            length - count
        };
        let full = full
            .into_iter()
            .map(|row| Segment { row, start: 0, length: stride, slot: take(stride) })
            .collect();
        let inequalities = (shape.defects..rows)
            .map(|row| {
                let own = row_entries(row);
                let vector = |&(_, column): &(usize, usize)| column / lanes * lanes;
                let start = own.first().map_or(0, vector);
                let length = own.last().map_or(start, |last| vector(last) + lanes) - start;
                Segment { row, start, length, slot: take(length) }
            })
            .collect();
        for diagonal in &mut diagonals {
            diagonal.slot = take(diagonal.length);
        }
        let mut pattern = Self {
            defects: shape.defects,
            stride,
            full,
            inequalities,
            diagonals,
            length,
            starts: vec![0],
            entries: Vec::new(),
            vectors: Vec::new(),
        };
        pattern.vectors =
            (0..stride).step_by(lanes).map(|first| pattern.vector_entries(first, lanes)).collect();
        let mut by_column: Vec<(usize, usize)> =
            entries.iter().map(|&(row, column)| (column, row)).collect();
        by_column.sort_unstable();
        for column in (0..shape.free).chain(split..split + shape.states) {
            let start = by_column.partition_point(|&(other, _)| other < column);
            let end = by_column.partition_point(|&(other, _)| other <= column);
            for &(column, row) in &by_column[start..end] {
                let slot = pattern.slot(row, column) as u32;
                pattern.entries.push(ColumnEntry { slot, row: row as u32 });
            }
            pattern.starts.push(pattern.entries.len());
        }
        pattern
    }

    fn vector_entries(&self, first: usize, lanes: usize) -> VectorEntries {
        let vectors = self.stride / lanes;
        let width = self.defects.next_multiple_of(lanes);
        let mut entries = VectorEntries::default();
        for full in &self.full {
            entries.rows.push((full.slot + first, full.row * vectors));
        }
        for (i, row) in self.inequalities.iter().enumerate() {
            if (row.start..row.start + row.length).contains(&first) {
                entries.rows.push((row.slot + first - row.start, (width + i) * vectors));
            }
        }
        for diagonal in &self.diagonals {
            if (diagonal.start..diagonal.start + diagonal.length).contains(&first) {
                let offset = first - diagonal.start;
                entries.diagonals.push((diagonal.slot + offset, diagonal.row + offset as isize));
            }
        }
        entries
    }

    /// Where an entry is stored.
    pub fn slot(&self, row: usize, column: usize) -> usize {
        let stored = self.full.iter().chain(&self.inequalities);
        if let Some(segment) = stored.into_iter().find(|segment| segment.row == row) {
            return segment.slot + column - segment.start;
        }
        let diagonal = self.diagonals.iter().find(|diagonal| {
            (diagonal.start..diagonal.start + diagonal.length).contains(&column)
                && diagonal.row + (column - diagonal.start) as isize == row as isize
        });
        let diagonal = diagonal.expect("entries of rows that are not stored lie on diagonals");
        diagonal.slot + column - diagonal.start
    }

    /// Entries of a column by row; columns count free leading unknowns, then states.
    #[inline(always)]
    pub fn column(&self, column: usize) -> &[ColumnEntry] {
        &self.entries[self.starts[column]..self.starts[column + 1]]
    }

    /// Entries in defect rows, by rows within a column.
    pub fn is_defect(&self, entry: &ColumnEntry) -> bool {
        (entry.row as usize) < self.defects
    }

    /// Multiplies defect rows by `scales`.
    pub fn scale(&self, jacobian: &mut [f64], scales: &[f64]) {
        for segment in &self.full {
            let row = &mut jacobian[segment.slot..segment.slot + segment.length];
            row.iter_mut().for_each(|value| *value *= scales[segment.row]);
        }
        for diagonal in &self.diagonals {
            let values = &mut jacobian[diagonal.slot..diagonal.slot + diagonal.length];
            for (value, row) in values.iter_mut().zip(diagonal.row..) {
                // Beyond the rows there are no entries.
                let scale = usize::try_from(row).ok().and_then(|row| scales.get(row));
                *value *= scale.copied().unwrap_or(1.0);
            }
        }
    }

    /// Rows of an image: the defects', as many as a padded state row is long, then the inequalities'.
    pub fn image_rows(&self, lanes: usize) -> usize {
        self.defects.next_multiple_of(lanes) + self.inequalities.len()
    }

    /// `P J` of the defect rows, then each inequality row times its weight, into rows of the
    /// node's matrix. `value` is the full P with a vector of zeros before and after; what `image`
    /// holds outside the vectors of inequality rows stays.
    #[inline(always)]
    pub fn image<S: Simd>(
        &self,
        simd: S,
        jacobian: &[f64],
        value: &[f64],
        weights: impl Iterator<Item = f64>,
        image: &mut [f64],
    ) {
        let lanes = S::F64_LANES;
        let width = self.defects.next_multiple_of(lanes);
        let stored = vectors::<S>(jacobian);
        let stride = self.stride / lanes;
        let (pulled, weighted) = vectors_mut::<S>(image).split_at_mut(width * stride);
        pulled.fill(simd.splat_f64s(0.0));
        let tile = tile_rows::<S>();
        for first in (0..self.defects).step_by(tile) {
            // P is symmetric: a column of it is a row.
            let column = |full: &Segment| lanes + full.row * width + first;
            let terms = self.full.iter().zip(0..).map(|(full, i)| (column(full), i * stride));
            let out = &mut pulled[first * stride..];
            add_products::<S, false>(simd, out, (stride, stride), value, stored, terms);
        }
        for diagonal in &self.diagonals {
            for v in 0..diagonal.length / lanes {
                let coefficient = stored[diagonal.slot / lanes + v];
                let from = lanes.wrapping_add_signed(diagonal.row) + v * lanes;
                let column = diagonal.start / lanes + v;
                for r in 0..self.defects {
                    let from = from + r * width;
                    let values = vectors::<S>(&value[from..from + lanes])[0];
                    let out = &mut pulled[r * stride + column];
                    *out = simd.mul_add_e_f64s(coefficient, values, *out);
                }
            }
        }
        let rows = weighted.chunks_exact_mut(stride.max(1));
        for ((segment, out), weight) in self.inequalities.iter().zip(rows).zip(weights) {
            let weight = simd.splat_f64s(weight);
            let row = &stored[segment.slot / lanes..][..segment.length / lanes];
            let out = &mut out[segment.start / lanes..][..row.len()];
            for (out, &value) in out.iter_mut().zip(row) {
                *out = simd.mul_f64s(weight, value);
            }
        }
    }

    /// Adds `Jᵀ image` to a tile of rows of the node's matrix: the rows of the columns from `first`
    /// on, as long as `length` vectors from vector `start` on.
    #[inline(always)]
    pub fn add_pulled<S: Simd>(
        &self,
        simd: S,
        jacobian: &[f64],
        image: &[f64],
        first: usize,
        (start, length): (usize, usize),
        (out, out_stride): (&mut [S::f64s], usize),
    ) {
        let lanes = S::F64_LANES;
        let image = vectors::<S>(image);
        let (entries, offset) = (&self.vectors[first / lanes], first % lanes);
        let terms = entries.rows.iter().map(|&(slot, row)| (slot + offset, row + start));
        add_products::<S, false>(simd, out, (length, out_stride), jacobian, image, terms);
        for &(slot, row) in &entries.diagonals {
            let coefficients = &jacobian[slot + offset..][..tile_rows::<S>()];
            for (r, &coefficient) in coefficients.iter().enumerate() {
                // Beyond the rows there is only padding.
                if coefficient != 0.0 {
                    let row = row.wrapping_add_unsigned(offset + r) as usize;
                    let from = row * self.stride / lanes + start;
                    let out = &mut out[r * out_stride..][..length];
                    add_rows(simd, out, image, std::iter::once((coefficient, from)));
                }
            }
        }
    }

    /// `out ← out − Jᵀ rows`. `rows` holds the defect rows, padded, with a vector of zeros before
    /// and after, then the inequality rows.
    #[inline(always)]
    pub fn subtract_transposed<S: Simd>(
        &self,
        simd: S,
        jacobian: &[f64],
        rows: &[f64],
        out: &mut [f64],
    ) {
        let lanes = S::F64_LANES;
        let stored = vectors::<S>(jacobian);
        let out = vectors_mut::<S>(out);
        let length = self.stride / lanes;
        let terms =
            self.full.iter().zip(0..).map(|(full, i)| (-rows[lanes + full.row], i * length));
        add_rows(simd, &mut out[..length], stored, terms);
        for diagonal in &self.diagonals {
            let from = lanes.wrapping_add_signed(diagonal.row);
            let values = vectors::<S>(&rows[from..from + diagonal.length]);
            let coefficients = &stored[diagonal.slot / lanes..][..values.len()];
            let out = &mut out[diagonal.start / lanes..][..values.len()];
            for ((out, &value), &coefficient) in out.iter_mut().zip(values).zip(coefficients) {
                *out = simd.negate_mul_add_e_f64s(coefficient, value, *out);
            }
        }
        let weights = &rows[self.inequality_rows(lanes)..];
        for (segment, &weight) in self.inequalities.iter().zip(weights) {
            let part = &mut out[segment.start / lanes..(segment.start + segment.length) / lanes];
            add_rows(simd, part, stored, std::iter::once((-weight, segment.slot / lanes)));
        }
    }

    /// `rows ← rows − J local`, with `rows` as in [`Self::subtract_transposed`].
    #[inline(always)]
    pub fn subtract_product<S: Simd>(
        &self,
        simd: S,
        jacobian: &[f64],
        local: &[f64],
        rows: &mut [f64],
    ) {
        let lanes = S::F64_LANES;
        let stored = vectors::<S>(jacobian);
        let local = vectors::<S>(local);
        for diagonal in &self.diagonals {
            let from = lanes.wrapping_add_signed(diagonal.row);
            let out = vectors_mut::<S>(&mut rows[from..from + diagonal.length]);
            let coefficients = &stored[diagonal.slot / lanes..][..out.len()];
            let values = &local[diagonal.start / lanes..][..out.len()];
            for ((out, &value), &coefficient) in out.iter_mut().zip(values).zip(coefficients) {
                *out = simd.negate_mul_add_e_f64s(coefficient, value, *out);
            }
        }
        for segment in &self.full {
            rows[lanes + segment.row] -= segment.product(simd, stored, local);
        }
        let first = self.inequality_rows(lanes);
        for (segment, row) in self.inequalities.iter().zip(&mut rows[first..]) {
            *row -= segment.product(simd, stored, local);
        }
    }

    /// First inequality in a vector of constraint rows.
    #[inline(always)]
    pub fn inequality_rows(&self, lanes: usize) -> usize {
        self.defects.next_multiple_of(lanes) + 2 * lanes
    }
}

/// Groups entries `(row, column)` by `column − row`, without bridging empty vectors.
fn find_diagonals(entries: impl Iterator<Item = (usize, usize)>, lanes: usize) -> Vec<Diagonal> {
    let mut by_offset: Vec<(isize, usize)> =
        entries.map(|(row, column)| (column as isize - row as isize, column)).collect();
    by_offset.sort_unstable();
    let mut diagonals: Vec<Diagonal> = Vec::new();
    let mut last = None;
    for (offset, column) in by_offset {
        let start = column / lanes * lanes;
        match diagonals.last_mut() {
            Some(diagonal) if last == Some(offset) && start <= diagonal.start + diagonal.length => {
                diagonal.length = start + lanes - diagonal.start;
            }
            _ => diagonals.push(Diagonal {
                start,
                length: lanes,
                row: start as isize - offset,
                slot: 0,
            }),
        }
        last = Some(offset);
    }
    diagonals
}
