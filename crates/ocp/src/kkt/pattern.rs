//! The structure of one node, shared by all nodes that look alike.
//!
//! The unknowns of a node split into *leading* ones, which are eliminated at the node (controls,
//! equality multipliers, and at node 0 the states too), and *trailing* ones, its states, which
//! the previous node's defect determines. A row of the node's symmetric matrix holds the leading
//! columns, padded to whole SIMD vectors, then the state columns, padded likewise.

use super::jacobian::JacobianPattern;
use super::shape::NodeShape;

/// Part of a node's matrix, in the order of the node's storage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u16)]
pub(super) enum NodeBlock {
    /// Upper triangle, leading row: leading columns.
    Leading,
    /// Upper triangle, leading row: state columns.
    Cross,
    /// Lower triangle of the state block.
    State,
    /// Jacobian: defect rows, then inequality rows; free leading columns, then state columns.
    Jacobian,
    /// Coefficients of the next node's states in their defect rows.
    DefectCoupling,
    /// Diagonal of the defect rows: −δ_c.
    DefectDiagonal,
    /// Diagonal of the slacks.
    SlackDiagonal,
    /// Coefficients of the slacks in their inequality rows.
    SlackCoupling,
    /// Diagonal of the inequality rows: −δ_d.
    InequalityDiagonal,
}

/// Where one value of the augmented matrix belongs in its node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct BlockEntry {
    pub block: NodeBlock,
    pub row: u16,
    /// Zero in blocks that are diagonal.
    pub column: u16,
}

impl BlockEntry {
    /// An entry whose indices fit, which the node's shape has been checked for.
    #[inline(always)]
    pub fn new(block: NodeBlock, row: usize, column: usize) -> Self {
        Self { block, row: row as u16, column: column as u16 }
    }
}

/// Storage that a value goes to, and where in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Position {
    Assembly(usize),
    Jacobian(usize),
}

/// Structure of one node: shape, sparsity of its constraint rows, and where values go.
#[derive(Debug, Clone)]
pub(super) struct NodePattern {
    pub shape: NodeShape,
    /// First state column in a row of the node's matrix.
    pub split: usize,
    /// Length of a leading row.
    pub stride: usize,
    /// Length of a state row.
    pub state_stride: usize,
    pub jacobian: JacobianPattern,
    pub sections: Sections,
}

/// Offsets into a node's assembly buffer, which begins with the leading rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sections {
    pub states: usize,
    pub defect_couplings: usize,
    pub defect_diagonals: usize,
    pub slack_diagonals: usize,
    pub slack_couplings: usize,
    pub inequality_diagonals: usize,
    pub end: usize,
}

/// A coefficient that the structure cannot do without is absent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MissingCoupling {
    Defect(usize),
    Slack(usize),
}

impl NodePattern {
    /// Builds the pattern from the sorted entries of a node's values (repeats are summed there).
    pub fn new(
        shape: NodeShape,
        entries: &[BlockEntry],
        lanes: usize,
    ) -> Result<Self, MissingCoupling> {
        let coupled = |block: NodeBlock, row: usize| {
            entries.binary_search(&BlockEntry::new(block, row, 0)).is_ok()
        };
        if let Some(row) = (0..shape.defects).find(|&row| !coupled(NodeBlock::DefectCoupling, row))
        {
            return Err(MissingCoupling::Defect(row));
        }
        if let Some(row) =
            (0..shape.inequalities).find(|&row| !coupled(NodeBlock::SlackCoupling, row))
        {
            return Err(MissingCoupling::Slack(row));
        }

        let split = shape.leading().next_multiple_of(lanes);
        let state_stride = shape.states.next_multiple_of(lanes);
        let stride = split + state_stride;
        let mut end = shape.leading() * stride;
        let mut section = |length: usize| {
            let start = end;
            end += length;
            start
        };
        let mut sections = Sections {
            states: section(shape.states * state_stride),
            defect_couplings: section(shape.defects),
            defect_diagonals: section(shape.defects),
            slack_diagonals: section(shape.inequalities),
            slack_couplings: section(shape.inequalities),
            inequality_diagonals: section(shape.inequalities),
            end: 0,
        };
        sections.end = end;

        let mut jacobian_entries: Vec<(usize, usize)> = Vec::new();
        for place in entries.iter().filter(|entry| entry.block == NodeBlock::Jacobian) {
            let column = local_column(shape, split, usize::from(place.column));
            let entry = (usize::from(place.row), column);
            if jacobian_entries.last() != Some(&entry) {
                jacobian_entries.push(entry);
            }
        }
        let jacobian = JacobianPattern::new(shape, split, stride, &jacobian_entries, lanes);
        Ok(Self { shape, split, stride, state_stride, jacobian, sections })
    }

    /// Where a value goes.
    pub fn position(&self, entry: BlockEntry) -> Position {
        let sections = &self.sections;
        let (row, column) = (usize::from(entry.row), usize::from(entry.column));
        Position::Assembly(match entry.block {
            NodeBlock::Jacobian => {
                let column = local_column(self.shape, self.split, column);
                return Position::Jacobian(self.jacobian.slot(row, column));
            }
            NodeBlock::Leading => row * self.stride + column,
            NodeBlock::Cross => row * self.stride + self.split + column,
            NodeBlock::State => sections.states + row * self.state_stride + column,
            NodeBlock::DefectCoupling => sections.defect_couplings + row,
            NodeBlock::DefectDiagonal => sections.defect_diagonals + row,
            NodeBlock::SlackDiagonal => sections.slack_diagonals + row,
            NodeBlock::SlackCoupling => sections.slack_couplings + row,
            NodeBlock::InequalityDiagonal => sections.inequality_diagonals + row,
        })
    }
}

/// Free leading unknowns stand at the front of a row, states behind the split.
fn local_column(shape: NodeShape, split: usize, i: usize) -> usize {
    if i < shape.free { i } else { split + i - shape.free }
}
