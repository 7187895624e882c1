//! Recognises the stage structure in the triplets of an augmented system.

use std::collections::HashMap;

use super::dims::{Role, SystemLayout};
use super::gather::Gather;
use super::pattern::{BlockEntry, MissingCoupling, NodeBlock, NodePattern};
use super::shape::NodeShape;

/// Why a matrix is not the augmented system of the stage problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum KktStructureError {
    /// The order differs from what the dimensions give.
    #[error("the matrix has order {found}, the stage dimensions give {expected}")]
    Order {
        /// Order that the dimensions give.
        expected: usize,
        /// Order of the matrix.
        found: usize,
    },
    /// Row and column lists differ in length.
    #[error("{rows} row indices but {columns} column indices")]
    TripletLengths {
        /// Number of row indices.
        rows: usize,
        /// Number of column indices.
        columns: usize,
    },
    /// An entry where the stage structure has none, or an index out of range.
    #[error("entry ({row}, {column}) does not belong to the stage structure")]
    ForeignEntry {
        /// Row index, from 0.
        row: i32,
        /// Column index, from 0.
        column: i32,
    },
    /// A defect row does not contain the state that it determines.
    #[error("defect row {row} of step {step} lacks the state that it determines")]
    DefectWithoutState {
        /// Step of the defect.
        step: usize,
        /// Row within the defect.
        row: usize,
    },
    /// An inequality row does not contain its slack.
    #[error("inequality {row} of node {node} lacks its slack")]
    InequalityWithoutSlack {
        /// Node of the inequality.
        node: usize,
        /// Row within the node's inequalities.
        row: usize,
    },
    /// A node is too large for 16-bit indices.
    #[error("node {node} has too many unknowns")]
    NodeTooLarge {
        /// The node.
        node: usize,
    },
}

/// Where each node's values come from and go to.
#[derive(Debug, Clone)]
pub(super) struct Structure {
    pub patterns: Vec<NodePattern>,
    pub gathers: Vec<Gather>,
    pub nodes: Vec<NodeSource>,
    /// Sources of all nodes.
    pub sources: Vec<u32>,
    /// Triplets of the matrix.
    pub triplets: usize,
}

/// How one node's values are collected.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeSource {
    pub gather: usize,
    /// First of the node's sources.
    pub start: usize,
}

impl Structure {
    pub fn analyse(
        layout: &SystemLayout,
        order: usize,
        rows: &[i32],
        columns: &[i32],
        lanes: usize,
    ) -> Result<Self, KktStructureError> {
        if order != layout.order {
            return Err(KktStructureError::Order { expected: layout.order, found: order });
        }
        if rows.len() != columns.len() {
            let (rows, columns) = (rows.len(), columns.len());
            return Err(KktStructureError::TripletLengths { rows, columns });
        }
        let shapes = node_shapes(layout)?;
        let by_node = TripletsByNode::new(layout, shapes.len(), rows, columns)?;
        let mut structure = Self {
            patterns: Vec::new(),
            gathers: Vec::new(),
            nodes: Vec::with_capacity(shapes.len()),
            sources: Vec::with_capacity(rows.len()),
            triplets: rows.len(),
        };
        let mut known: HashMap<(NodeShape, Vec<BlockEntry>), usize> = HashMap::new();
        let mut last = 0;
        for (k, &shape) in shapes.iter().enumerate() {
            let (couplings, triplets) = by_node.node(k);
            let start = structure.sources.len();
            let gathers = &structure.gathers;
            // Mostly it is the previous node's; couplings alone do not tell a shape.
            let fitting = (last..gathers.len()).chain(0..last).find(|&gather| {
                structure.patterns[gathers[gather].pattern].shape == shape
                    && gathers[gather].try_sources(couplings, triplets, &mut structure.sources)
            });
            last = match fitting {
                Some(gather) => gather,
                None => {
                    let entries = entries(&shape, couplings, triplets, rows, columns)?;
                    let mut sorted: Vec<u32> = (0..entries.len() as u32).collect();
                    sorted.sort_by_key(|&number| entries[number as usize]);
                    let ordered = sorted.iter().map(|&number| entries[number as usize]).collect();
                    let key = (shape, ordered);
                    let pattern = match known.get(&key) {
                        Some(&pattern) => pattern,
                        None => {
                            let pattern = NodePattern::new(shape, &key.1, lanes)
                                .map_err(|missing| missing_at(k, missing))?;
                            structure.patterns.push(pattern);
                            known.insert(key, structure.patterns.len() - 1);
                            structure.patterns.len() - 1
                        }
                    };
                    let gather = Gather::new(
                        couplings.to_vec(),
                        &entries,
                        triplets,
                        &sorted,
                        &structure.patterns[pattern],
                        pattern,
                    );
                    gather.try_sources(couplings, triplets, &mut structure.sources);
                    structure.gathers.push(gather);
                    structure.gathers.len() - 1
                }
            };
            structure.nodes.push(NodeSource { gather: last, start });
        }
        Ok(structure)
    }

    pub fn gather(&self, node: usize) -> &Gather {
        &self.gathers[self.nodes[node].gather]
    }

    pub fn pattern(&self, node: usize) -> &NodePattern {
        &self.patterns[self.gather(node).pattern]
    }
}

/// Between which two unknowns a triplet is: the role of its row and that of its column within their nodes, and
/// how far apart those are, in one number. Nodes of the same shape with the same couplings have the same entries.
pub(super) type Coupling = u64;

/// Of an unknown: its node, and its role as a number.
type Unknown = (u32, u32);

/// Values of a role that a number holds: nodes are smaller (`node_shapes`).
const INDEX_BITS: u32 = 16;
/// The same for a role.
const ROLE_BITS: u32 = 20;

/// How far the nodes of a coupling are apart.
const SAME_NODE: u64 = 0;
const ROW_NEXT: u64 = 1;
const COLUMN_NEXT: u64 = 2;
/// Farther than any entry of the structure.
const BEYOND: u64 = 3;

fn role_number(role: Role) -> u32 {
    let (Role::Variable(index)
    | Role::Slack(index)
    | Role::Equality(index)
    | Role::Defect(index)
    | Role::Inequality(index)) = role;
    u32::from(rank(role)) << INDEX_BITS | index
}

fn role_of(number: u32) -> Role {
    let index = number & ((1 << INDEX_BITS) - 1);
    match number >> INDEX_BITS {
        0 => Role::Variable(index),
        1 => Role::Slack(index),
        2 => Role::Equality(index),
        3 => Role::Defect(index),
        _ => Role::Inequality(index),
    }
}

#[inline(always)]
fn coupling_of((node, row): Unknown, (other, column): Unknown) -> Coupling {
    let reach = match (node.wrapping_sub(other), other.wrapping_sub(node)) {
        (0, _) => SAME_NODE,
        (1, _) => ROW_NEXT,
        (_, 1) => COLUMN_NEXT,
        _ => BEYOND,
    };
    reach << (2 * ROLE_BITS) | u64::from(row) << ROLE_BITS | u64::from(column)
}

/// Where a coupling is in its node, the earlier of the two; nothing when the structure has no such entry.
fn entry_of(coupling: Coupling, shape: &NodeShape) -> Option<BlockEntry> {
    let role = |shift: u32| role_of((coupling >> shift) as u32 & ((1 << ROLE_BITS) - 1));
    let (row, column) = (role(ROLE_BITS), role(0));
    let (row_node, column_node) = match coupling >> (2 * ROLE_BITS) {
        SAME_NODE => (0, 0),
        ROW_NEXT => (1, 0),
        COLUMN_NEXT => (0, 1),
        _ => return None,
    };
    locate(shape, (row_node, row), (column_node, column))
}

/// Where a node's triplets are in it.
fn entries(
    shape: &NodeShape,
    couplings: &[Coupling],
    triplets: &[u32],
    rows: &[i32],
    columns: &[i32],
) -> Result<Vec<BlockEntry>, KktStructureError> {
    let entry = |(&coupling, &triplet): (&Coupling, &u32)| {
        let (row, column) = (rows[triplet as usize], columns[triplet as usize]);
        entry_of(coupling, shape).ok_or(KktStructureError::ForeignEntry { row, column })
    };
    couplings.iter().zip(triplets).map(entry).collect()
}

/// Couplings and indices of the triplets, node after node, in triplet order within a node.
struct TripletsByNode {
    starts: Vec<usize>,
    couplings: Vec<Coupling>,
    triplets: Vec<u32>,
}

impl TripletsByNode {
    fn new(
        layout: &SystemLayout,
        nodes: usize,
        rows: &[i32],
        columns: &[i32],
    ) -> Result<Self, KktStructureError> {
        let unknowns: Vec<Unknown> =
            layout.roles().into_iter().map(|(node, role)| (node, role_number(role))).collect();
        let unknown = |index: i32| unknowns.get(usize::try_from(index).ok()?).copied();
        let mut starts = vec![0_usize; nodes + 1];
        for (&row, &column) in rows.iter().zip(columns) {
            let (Some(a), Some(b)) = (unknown(row), unknown(column)) else {
                return Err(KktStructureError::ForeignEntry { row, column });
            };
            starts[a.0.min(b.0) as usize + 1] += 1;
        }
        for k in 0..nodes {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut couplings = vec![0; rows.len()];
        let mut triplets = vec![0; rows.len()];
        for ((&row, &column), number) in rows.iter().zip(columns).zip(0..) {
            let (a, b) = (unknowns[row as usize], unknowns[column as usize]);
            let position = &mut next[a.0.min(b.0) as usize];
            couplings[*position] = coupling_of(a, b);
            triplets[*position] = number;
            *position += 1;
        }
        Ok(Self { starts, couplings, triplets })
    }

    fn node(&self, k: usize) -> (&[Coupling], &[u32]) {
        let range = self.starts[k]..self.starts[k + 1];
        (&self.couplings[range.clone()], &self.triplets[range])
    }
}

fn missing_at(k: usize, missing: MissingCoupling) -> KktStructureError {
    match missing {
        MissingCoupling::Defect(row) => KktStructureError::DefectWithoutState { step: k, row },
        MissingCoupling::Slack(row) => KktStructureError::InequalityWithoutSlack { node: k, row },
    }
}

fn node_shapes(layout: &SystemLayout) -> Result<Vec<NodeShape>, KktStructureError> {
    let shapes = layout.nodes.iter().enumerate().map(|(k, node)| {
        let dims = node.dims;
        let (free, states) =
            if k == 0 { (dims.states + dims.controls, 0) } else { (dims.controls, dims.states) };
        let shape = NodeShape {
            free,
            equalities: dims.equalities,
            states,
            defects: node.defects,
            inequalities: dims.inequalities,
        };
        let largest = (shape.leading() + states).max(shape.defects + shape.inequalities);
        if largest > usize::from(u16::MAX) {
            return Err(KktStructureError::NodeTooLarge { node: k });
        }
        Ok(shape)
    });
    shapes.collect()
}

/// The entry between two unknowns of a node and the next, or nothing when the structure has none. Nodes count
/// from the earlier one, whose shape it is.
fn locate(shape: &NodeShape, a: (u32, Role), b: (u32, Role)) -> Option<BlockEntry> {
    use Role::{Defect, Equality, Inequality, Slack, Variable};
    let ((node, first), (other, second)) = if rank(a.1) <= rank(b.1) { (a, b) } else { (b, a) };
    if let (Variable(i), Defect(row)) = (first, second)
        && node == other + 1
    {
        let determined = i == row && (i as usize) < shape.defects;
        return determined.then_some(BlockEntry::new(NodeBlock::DefectCoupling, row as usize, 0));
    }
    if node != other {
        return None;
    }
    // A variable is a state of the trailing block or a leading unknown; the Jacobian's columns
    // list the leading ones first.
    let is_state = |i: u32| (i as usize) < shape.states;
    let leading = |i: u32| i as usize - shape.states;
    let column = |i: u32| if is_state(i) { shape.free + i as usize } else { leading(i) };
    let multiplier = |row: u32| shape.free + row as usize;
    let diagonal =
        |i: u32, j: u32, block| (i == j).then_some(BlockEntry::new(block, i as usize, 0));
    match (first, second) {
        (Variable(i), Variable(j)) => {
            let (low, high) = (i.min(j), i.max(j));
            Some(match (is_state(low), is_state(high)) {
                (true, true) => BlockEntry::new(NodeBlock::State, high as usize, low as usize),
                (true, false) => BlockEntry::new(NodeBlock::Cross, leading(high), low as usize),
                _ => BlockEntry::new(NodeBlock::Leading, leading(low), leading(high)),
            })
        }
        (Variable(i), Equality(row)) => Some(match is_state(i) {
            true => BlockEntry::new(NodeBlock::Cross, multiplier(row), i as usize),
            false => BlockEntry::new(NodeBlock::Leading, leading(i), multiplier(row)),
        }),
        (Equality(i), Equality(j)) => {
            (i == j).then_some(BlockEntry::new(NodeBlock::Leading, multiplier(i), multiplier(i)))
        }
        (Variable(i), Defect(row)) => {
            Some(BlockEntry::new(NodeBlock::Jacobian, row as usize, column(i)))
        }
        (Variable(i), Inequality(row)) => {
            Some(BlockEntry::new(NodeBlock::Jacobian, shape.defects + row as usize, column(i)))
        }
        (Defect(i), Defect(j)) => diagonal(i, j, NodeBlock::DefectDiagonal),
        (Slack(i), Slack(j)) => diagonal(i, j, NodeBlock::SlackDiagonal),
        (Slack(i), Inequality(j)) => diagonal(i, j, NodeBlock::SlackCoupling),
        (Inequality(i), Inequality(j)) => diagonal(i, j, NodeBlock::InequalityDiagonal),
        _ => None,
    }
}

#[inline(always)]
fn rank(role: Role) -> u8 {
    match role {
        Role::Variable(_) => 0,
        Role::Slack(_) => 1,
        Role::Equality(_) => 2,
        Role::Defect(_) => 3,
        Role::Inequality(_) => 4,
    }
}
