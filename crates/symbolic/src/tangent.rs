//! Forward sweeps: directional derivatives along the graph.

use crate::graph::{Arena, Node, NodeId};
use crate::op::Binary;

/// No tangent: the derivative is structurally zero.
const ZERO: NodeId = NodeId::MAX;

/// The part of the graph below some outputs, swept once for each direction.
pub(crate) struct ForwardSweep {
    /// Every node the outputs need, operands first.
    order: Vec<NodeId>,
    /// By node; [`ZERO`] outside the current direction's reach.
    tangents: Vec<NodeId>,
}

impl ForwardSweep {
    pub(crate) fn new(arena: &Arena, outputs: &[NodeId]) -> Self {
        let size = outputs.iter().map(|&id| id as usize + 1).max().unwrap_or(0);
        let order = reachable(arena, outputs);
        ForwardSweep { order, tangents: vec![ZERO; size] }
    }

    /// Differentiates every node with respect to `input`; read the result with [`Self::tangent`].
    pub(crate) fn run(&mut self, arena: &mut Arena, input: NodeId) {
        for &id in &self.order {
            self.tangents[id as usize] = if id == input {
                arena.constant(1.0)
            } else {
                tangent(arena, id, &self.tangents).unwrap_or(ZERO)
            };
        }
    }

    /// The derivative of an output in the last direction run; `None` if structurally zero.
    pub(crate) fn tangent(&self, output: NodeId) -> Option<NodeId> {
        known(&self.tangents, output)
    }
}

/// All nodes that `outputs` depend on, themselves included, operands first.
pub(crate) fn reachable(arena: &Arena, outputs: &[NodeId]) -> Vec<NodeId> {
    let size = outputs.iter().map(|&id| id as usize + 1).max().unwrap_or(0);
    let mut needed = vec![false; size];
    for &output in outputs {
        needed[output as usize] = true;
    }
    for id in (0..size).rev() {
        if needed[id] {
            for operand in arena.node(id as NodeId).operands() {
                needed[operand as usize] = true;
            }
        }
    }
    (0..size as NodeId).filter(|&id| needed[id as usize]).collect()
}

fn known(tangents: &[NodeId], id: NodeId) -> Option<NodeId> {
    Some(tangents[id as usize]).filter(|&tangent| tangent != ZERO)
}

fn tangent(arena: &mut Arena, id: NodeId, tangents: &[NodeId]) -> Option<NodeId> {
    let of = |operand| known(tangents, operand);
    let result = match arena.node(id) {
        Node::Constant(_) | Node::Symbol(_) => return None,
        Node::Unary(op, x) => {
            let dx = of(x)?;
            let partial = arena.unary_partial(op, x, id);
            arena.mul(dx, partial)
        }
        Node::Binary(Binary::Mul, a, b) if a == b => {
            let da = of(a)?;
            let twice = arena.scaled(2.0, a);
            arena.mul(da, twice)
        }
        Node::Binary(op, a, b) => match (of(a), of(b)) {
            (None, None) => return None,
            (Some(da), Some(db)) if op == Binary::Sub => arena.sub(da, db),
            (Some(da), Some(db)) if op == Binary::Div => {
                let reciprocal = arena.recip(b);
                let change = arena.mul(id, db);
                let numerator = arena.sub(da, change);
                arena.mul(numerator, reciprocal)
            }
            (da, db) => {
                let (by_a, by_b) = arena.binary_partials(op, a, b, id);
                let first = da.map(|da| arena.mul(da, by_a));
                let second = db.map(|db| arena.mul(db, by_b));
                match (first, second) {
                    (Some(first), Some(second)) => arena.add(first, second),
                    (Some(only), None) | (None, Some(only)) => only,
                    (None, None) => return None,
                }
            }
        },
        Node::Select(condition, x, y) => {
            let (dx, dy) = (of(x), of(y));
            if dx.is_none() && dy.is_none() {
                return None;
            }
            let zero = arena.constant(0.0);
            arena.select(condition, dx.unwrap_or(zero), dy.unwrap_or(zero))
        }
    };
    (arena.constant_value(result) != Some(0.0)).then_some(result)
}
