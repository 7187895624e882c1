//! The structure of one node, shared by all nodes that look alike.
//!
//! The unknowns of a node split into *leading* ones, which are eliminated at the node (controls,
//! equality multipliers, and at node 0 the states too), and *trailing* ones, its states, which
//! the previous node's defect determines. A row of the node's symmetric matrix holds the leading
//! columns, padded to whole SIMD vectors, then the state columns, padded likewise.

use super::jacobian::JacobianPattern;

/// Counts of one node's unknowns and constraint rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct NodeShape {
    /// Leading unknowns that the constraints see: controls (at node 0 the states before them).
    pub free: usize,
    pub equalities: usize,
    /// Trailing states: none at node 0.
    pub states: usize,
    pub defects: usize,
    pub inequalities: usize,
}

impl NodeShape {
    pub fn leading(&self) -> usize {
        self.free + self.equalities
    }
}

/// Where one value of the augmented matrix belongs in its node. The order of the variants and of
/// their indices is the order of the node's storage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Place {
    /// Upper triangle, leading row: a leading column.
    Leading { row: u16, column: u16 },
    /// Upper triangle, leading row: a state column.
    Cross { row: u16, column: u16 },
    /// Lower triangle of the state block.
    State { row: u16, column: u16 },
    /// Jacobian: defect rows, then inequality rows; free leading columns, then state columns.
    Constraint { row: u16, column: u16 },
    /// Coefficient of the next node's state in its defect row.
    DefectCoupling { row: u16 },
    /// Diagonal of a defect row: −δ_c.
    DefectDiagonal { row: u16 },
    /// Diagonal of a slack.
    SlackDiagonal { row: u16 },
    /// Coefficient of the slack in its inequality row.
    SlackCoupling { row: u16 },
    /// Diagonal of an inequality row: −δ_d.
    InequalityDiagonal { row: u16 },
}

/// Storage that a value goes to, and where in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Position {
    Assembly(usize),
    Jacobian(usize),
}

/// Structure of one node: shape, sparsity of its constraint rows, and where values go.
#[derive(Debug)]
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
    /// Builds the pattern from the sorted places of a node's values (repeats are summed there).
    pub fn new(shape: NodeShape, places: &[Place], lanes: usize) -> Result<Self, MissingCoupling> {
        let coupled = |place: Place| places.binary_search(&place).is_ok();
        if let Some(row) =
            (0..shape.defects).find(|&row| !coupled(Place::DefectCoupling { row: row as u16 }))
        {
            return Err(MissingCoupling::Defect(row));
        }
        if let Some(row) =
            (0..shape.inequalities).find(|&row| !coupled(Place::SlackCoupling { row: row as u16 }))
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

        let mut entries: Vec<(usize, usize)> = Vec::new();
        for &place in places {
            if let Place::Constraint { row, column } = place {
                let entry = (usize::from(row), local_column(shape, split, usize::from(column)));
                if entries.last() != Some(&entry) {
                    entries.push(entry);
                }
            }
        }
        let jacobian = JacobianPattern::new(shape, split, stride, &entries, lanes);
        Ok(Self { shape, split, stride, state_stride, jacobian, sections })
    }

    /// Where a value goes.
    pub fn position(&self, place: Place) -> Position {
        let sections = &self.sections;
        let (start, column) = match place {
            Place::Constraint { row, column } => {
                let column = local_column(self.shape, self.split, usize::from(column));
                return Position::Jacobian(self.jacobian.slot(usize::from(row), column));
            }
            Place::Leading { row, column } => (usize::from(row) * self.stride, column),
            Place::Cross { row, column } => (usize::from(row) * self.stride + self.split, column),
            Place::State { row, column } => {
                (sections.states + usize::from(row) * self.state_stride, column)
            }
            Place::DefectCoupling { row } => (sections.defect_couplings, row),
            Place::DefectDiagonal { row } => (sections.defect_diagonals, row),
            Place::SlackDiagonal { row } => (sections.slack_diagonals, row),
            Place::SlackCoupling { row } => (sections.slack_couplings, row),
            Place::InequalityDiagonal { row } => (sections.inequality_diagonals, row),
        };
        Position::Assembly(start + usize::from(column))
    }
}

/// Free leading unknowns stand at the front of a row, states behind the split.
fn local_column(shape: NodeShape, split: usize, i: usize) -> usize {
    if i < shape.free { i } else { split + i - shape.free }
}
