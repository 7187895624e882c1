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
#[derive(Debug)]
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
        let by_node = TripletsByNode::new(layout, &shapes, rows, columns)?;
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
            let (entries, triplets) = by_node.node(k);
            let start = structure.sources.len();
            let gathers = &structure.gathers;
            // Mostly it is the previous node's; entries alone do not tell a shape.
            let fitting = (last..gathers.len()).chain(0..last).find(|&gather| {
                structure.patterns[gathers[gather].pattern].shape == shape
                    && gathers[gather].try_sources(entries, triplets, &mut structure.sources)
            });
            last = match fitting {
                Some(gather) => gather,
                None => {
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
                        entries.to_vec(),
                        triplets,
                        &sorted,
                        &structure.patterns[pattern],
                        pattern,
                    );
                    gather.try_sources(entries, triplets, &mut structure.sources);
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

/// Places and indices of the triplets, node after node, in triplet order within a node.
struct TripletsByNode {
    starts: Vec<usize>,
    entries: Vec<BlockEntry>,
    triplets: Vec<u32>,
}

impl TripletsByNode {
    fn new(
        layout: &SystemLayout,
        shapes: &[NodeShape],
        rows: &[i32],
        columns: &[i32],
    ) -> Result<Self, KktStructureError> {
        let roles = layout.roles();
        let role_at = |index: i32| usize::try_from(index).ok().and_then(|i| roles.get(i).copied());
        let mut starts = vec![0_usize; shapes.len() + 1];
        for (&row, &column) in rows.iter().zip(columns) {
            let (Some(a), Some(b)) = (role_at(row), role_at(column)) else {
                return Err(KktStructureError::ForeignEntry { row, column });
            };
            starts[a.0.min(b.0) as usize + 1] += 1;
        }
        for k in 0..shapes.len() {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut entries = vec![BlockEntry::new(NodeBlock::Leading, 0, 0); rows.len()];
        let mut triplets = vec![0; rows.len()];
        for ((&row, &column), number) in rows.iter().zip(columns).zip(0..) {
            let (a, b) = (roles[row as usize], roles[column as usize]);
            let Some(entry) = locate(shapes, a, b) else {
                return Err(KktStructureError::ForeignEntry { row, column });
            };
            let position = &mut next[a.0.min(b.0) as usize];
            entries[*position] = entry;
            triplets[*position] = number;
            *position += 1;
        }
        Ok(Self { starts, entries, triplets })
    }

    fn node(&self, k: usize) -> (&[BlockEntry], &[u32]) {
        let range = self.starts[k]..self.starts[k + 1];
        (&self.entries[range.clone()], &self.triplets[range])
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

/// The entry between two unknowns, or nothing when the structure has none. It belongs to
/// the earlier of their nodes.
#[inline(always)]
fn locate(shapes: &[NodeShape], a: (u32, Role), b: (u32, Role)) -> Option<BlockEntry> {
    use Role::{Defect, Equality, Inequality, Slack, Variable};
    let ((node, first), (other, second)) = if rank(a.1) <= rank(b.1) { (a, b) } else { (b, a) };
    let shape = &shapes[node as usize];
    if let (Variable(i), Defect(row)) = (first, second)
        && node == other + 1
    {
        let determined = i == row && (i as usize) < shape.states;
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
