//! Unknowns that the next node could not eliminate, on their way to this node.

use super::elimination::Elimination;
use super::lanes::{AlignedVec, reset, zeros};
use super::pattern::NodePattern;

/// How the unknowns delayed by the next node couple to its states and among themselves.
#[derive(Debug, Clone)]
pub(super) struct Delayed {
    pub count: usize,
    /// `count` padded rows over the next states.
    pub states: AlignedVec,
    /// `count` × `count`.
    pub corner: Vec<f64>,
    /// Leading rows with those of the delayed unknowns.
    extended: AlignedVec,
}

impl Default for Delayed {
    fn default() -> Self {
        Self { count: 0, states: zeros(0), corner: Vec::new(), extended: zeros(0) }
    }
}

impl Delayed {
    /// Takes over what the next node did not eliminate.
    pub fn copy(&mut self, leading: &Elimination) {
        self.count = leading.delayed();
        self.states.clear();
        self.corner.clear();
        for k in leading.eliminated..leading.size {
            let row = leading.row(k);
            self.states.extend_from_slice(&row[leading.split..]);
            self.corner.extend_from_slice(&row[leading.eliminated..leading.size]);
        }
    }

    /// Inserts the rows and columns of the delayed unknowns behind the leading ones of `matrix`:
    /// they couple to the next states, `x⁺ = c − J z`, so to this node's unknowns through the step.
    ///
    /// `leading` has the split and stride of the extended rows, `jacobian` are the node's values.
    pub fn append(
        &mut self,
        pattern: &NodePattern,
        leading: &Elimination,
        jacobian: &[f64],
        matrix: &mut AlignedVec,
    ) {
        let (split, stride) = (leading.split, leading.stride);
        let own = pattern.shape.leading();
        reset(&mut self.extended, (own + self.count) * stride);
        let extended = &mut self.extended;
        for i in 0..own {
            let (leading, states) =
                matrix[i * pattern.stride..(i + 1) * pattern.stride].split_at(pattern.split);
            let row = &mut extended[i * stride..(i + 1) * stride];
            row[..own].copy_from_slice(&leading[..own]);
            row[split..].copy_from_slice(states);
        }
        let width = self.states.len() / self.count.max(1);
        for (j, states) in self.states.chunks_exact(width.max(1)).enumerate() {
            for column in 0..pattern.shape.free + pattern.shape.states {
                let entries = pattern.jacobian.column(column).iter();
                let coupling: f64 = entries
                    .filter(|entry| pattern.jacobian.is_defect(entry))
                    .map(|entry| -jacobian[entry.slot as usize] * states[entry.row as usize])
                    .sum();
                match column.checked_sub(pattern.shape.free) {
                    None => extended[column * stride + own + j] = coupling,
                    Some(state) => extended[(own + j) * stride + split + state] = coupling,
                }
            }
            for i in j..self.count {
                extended[(own + j) * stride + own + i] = self.corner[j * self.count + i];
            }
        }
        std::mem::swap(matrix, &mut self.extended);
    }
}
