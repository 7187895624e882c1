//! The part of the graph that some outputs need, renumbered.

use crate::graph::{Arena, Node, NodeId};

/// Position of a node in a [`Subgraph`].
pub(crate) type Position = u32;

/// The nodes that some outputs depend on, themselves included, operands first.
pub(crate) struct Subgraph {
    ids: Vec<NodeId>,
    /// With positions instead of ids as operands.
    nodes: Vec<Node>,
    members: Members,
}

impl Subgraph {
    pub(crate) fn below(arena: &Arena, outputs: &[NodeId]) -> Self {
        let members = Members::below(arena, outputs);
        let ids: Vec<NodeId> = members.iter().collect();
        let nodes = ids
            .iter()
            .map(|&id| arena.node(id).map_operands(|operand| members.rank(operand)))
            .collect();
        Subgraph { ids, nodes, members }
    }

    pub(crate) fn len(&self) -> usize {
        self.ids.len()
    }

    /// The node in the arena.
    pub(crate) fn id(&self, position: Position) -> NodeId {
        self.ids[position as usize]
    }

    /// The node with positions as operands.
    pub(crate) fn node(&self, position: Position) -> Node {
        self.nodes[position as usize]
    }

    /// Every position, operands first.
    pub(crate) fn positions(&self) -> impl DoubleEndedIterator<Item = Position> + use<> {
        0..self.len() as Position
    }

    pub(crate) fn position(&self, id: NodeId) -> Option<Position> {
        self.members.contains(id).then(|| self.members.rank(id))
    }
}

/// A set of node ids with their ranks.
struct Members {
    words: Vec<u64>,
    /// Number of members below each word.
    ranks: Vec<u32>,
}

impl Members {
    fn below(arena: &Arena, outputs: &[NodeId]) -> Self {
        let size = outputs.iter().map(|&id| id as usize + 1).max().unwrap_or(0);
        let mut words = vec![0_u64; size.div_ceil(64)];
        for &id in outputs {
            words[id as usize / 64] |= 1 << (id % 64);
        }
        // Operands precede their users, so one pass downwards meets every member.
        for index in (0..words.len()).rev() {
            let mut pending = words[index];
            while pending != 0 {
                let bit = 63 - pending.leading_zeros();
                for operand in arena.node(index as NodeId * 64 + bit).operands() {
                    words[operand as usize / 64] |= 1 << (operand % 64);
                }
                pending = words[index] & ((1 << bit) - 1);
            }
        }
        let mut count = 0;
        let ranks = words
            .iter()
            .map(|word| {
                let below = count;
                count += word.count_ones();
                below
            })
            .collect();
        Members { words, ranks }
    }

    fn contains(&self, id: NodeId) -> bool {
        self.words.get(id as usize / 64).is_some_and(|word| word >> (id % 64) & 1 == 1)
    }

    /// The number of members below one of them.
    fn rank(&self, id: NodeId) -> Position {
        let index = id as usize / 64;
        let below = self.words[index] & ((1 << (id % 64)) - 1);
        self.ranks[index] + below.count_ones()
    }

    fn iter(&self) -> impl Iterator<Item = NodeId> {
        self.words.iter().enumerate().flat_map(|(index, &word)| {
            let mut pending = word;
            std::iter::from_fn(move || {
                let bit = (pending != 0).then(|| pending.trailing_zeros())?;
                pending &= pending - 1;
                Some(index as NodeId * 64 + bit)
            })
        })
    }
}
