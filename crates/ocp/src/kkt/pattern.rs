//! The structure of one node, shared by all nodes that look alike.
//!
//! The unknowns of a node split into *leading* ones, which are eliminated at the node (controls,
//! equality multipliers, and at node 0 the states too), and *trailing* ones, its states, which
//! the previous node's defect determines. A row of the node's symmetric matrix holds the leading
//! columns, padded to whole SIMD vectors, then the state columns, padded likewise.

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

/// Where one value of the augmented matrix belongs in its node. The order of the variants is the
/// order of the node's storage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Place {
    /// Upper triangle, leading row: a leading column.
    Leading { row: u16, column: u16 },
    /// Upper triangle, leading row: a state column.
    Cross { row: u16, column: u16 },
    /// Upper triangle of the state block.
    State { row: u16, column: u16 },
    /// Jacobian of the defect (rows first) and the inequalities, by column: free leading unknowns, then states.
    Constraint { column: u16, row: u16 },
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
    /// Start of each column's entries in `constraint_rows`; free leading unknowns, then states.
    pub column_starts: Vec<u32>,
    /// Row of each entry: defect rows first, then inequalities.
    pub constraint_rows: Vec<u16>,
    /// End of each column's defect entries (inequality entries follow to the column's end).
    pub defect_ends: Vec<u32>,
    /// Assembly position of each value, in the order of the node's sources.
    pub destinations: Vec<u32>,
    pub sections: Sections,
}

/// Offsets into a node's assembly buffer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sections {
    pub states: usize,
    pub constraints: usize,
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
        let pad = |length: usize| length.next_multiple_of(lanes);
        let split = pad(shape.leading());
        let state_stride = pad(shape.states);
        let stride = split + state_stride;

        let columns = shape.free + shape.states;
        let mut column_starts = vec![0; columns + 1];
        let mut defect_ends = vec![0; columns];
        let mut constraint_rows = Vec::new();
        let mut next_column = 0;
        let mut previous = None;
        for &place in places {
            let Place::Constraint { column, row } = place else { continue };
            if previous == Some(place) {
                continue;
            }
            previous = Some(place);
            while next_column <= usize::from(column) {
                column_starts[next_column] = constraint_rows.len() as u32;
                defect_ends[next_column] = constraint_rows.len() as u32;
                next_column += 1;
            }
            constraint_rows.push(row);
            if usize::from(row) < shape.defects {
                defect_ends[usize::from(column)] = constraint_rows.len() as u32;
            }
        }
        let entries = constraint_rows.len();
        column_starts[next_column..].fill(entries as u32);
        defect_ends[next_column.min(columns)..].fill(entries as u32);

        let mut end = shape.leading() * stride;
        let mut section = |length: usize| {
            let start = end;
            end += length;
            start
        };
        let mut sections = Sections {
            states: section(shape.states * state_stride),
            constraints: section(pad(entries)),
            defect_couplings: section(shape.defects),
            defect_diagonals: section(shape.defects),
            slack_diagonals: section(shape.inequalities),
            slack_couplings: section(shape.inequalities),
            inequality_diagonals: section(shape.inequalities),
            end: 0,
        };
        sections.end = end;

        let mut defect_coupled = vec![false; shape.defects];
        let mut slack_coupled = vec![false; shape.inequalities];
        let mut entry = sections.constraints;
        let mut previous = None;
        let destinations = places
            .iter()
            .map(|&place| {
                let at = |section: usize, row: u16| section + usize::from(row);
                let position = match place {
                    Place::Leading { row, column } => {
                        usize::from(row) * stride + usize::from(column)
                    }
                    Place::Cross { row, column } => {
                        usize::from(row) * stride + split + usize::from(column)
                    }
                    Place::State { row, column } => {
                        sections.states + usize::from(row) * state_stride + usize::from(column)
                    }
                    Place::Constraint { .. } => {
                        if previous.is_some() && previous != Some(place) {
                            entry += 1;
                        }
                        previous = Some(place);
                        entry
                    }
                    Place::DefectCoupling { row } => {
                        defect_coupled[usize::from(row)] = true;
                        at(sections.defect_couplings, row)
                    }
                    Place::DefectDiagonal { row } => at(sections.defect_diagonals, row),
                    Place::SlackDiagonal { row } => at(sections.slack_diagonals, row),
                    Place::SlackCoupling { row } => {
                        slack_coupled[usize::from(row)] = true;
                        at(sections.slack_couplings, row)
                    }
                    Place::InequalityDiagonal { row } => at(sections.inequality_diagonals, row),
                };
                position as u32
            })
            .collect();
        if let Some(row) = defect_coupled.iter().position(|&coupled| !coupled) {
            return Err(MissingCoupling::Defect(row));
        }
        if let Some(row) = slack_coupled.iter().position(|&coupled| !coupled) {
            return Err(MissingCoupling::Slack(row));
        }
        Ok(Self {
            shape,
            split,
            stride,
            state_stride,
            column_starts,
            constraint_rows,
            defect_ends,
            destinations,
            sections,
        })
    }

    /// Entries of the constraint Jacobian.
    pub fn entries(&self) -> usize {
        self.constraint_rows.len()
    }

    /// Entries of one column, the defect rows' first.
    pub fn column(&self, column: usize) -> std::ops::Range<usize> {
        self.column_starts[column] as usize..self.column_starts[column + 1] as usize
    }

    /// Entries of one column in defect rows.
    pub fn defect_column(&self, column: usize) -> std::ops::Range<usize> {
        self.column_starts[column] as usize..self.defect_ends[column] as usize
    }

    /// Entries of one column in inequality rows.
    pub fn inequality_column(&self, column: usize) -> std::ops::Range<usize> {
        self.defect_ends[column] as usize..self.column_starts[column + 1] as usize
    }
}
