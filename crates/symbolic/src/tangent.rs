//! Forward sweeps: directional derivatives along the graph.

use crate::graph::{Arena, Node, NodeId};
use crate::op::Binary;
use crate::subgraph::{Position, Subgraph};

/// No tangent: the derivative is structurally zero.
const ZERO: NodeId = NodeId::MAX;

/// The part of the graph below some outputs, swept once for each direction.
pub(crate) struct ForwardSweep<'a> {
    graph: &'a Subgraph,
    /// By position; [`ZERO`] outside the current direction's reach.
    tangents: Vec<NodeId>,
    needed: Vec<bool>,
}

impl<'a> ForwardSweep<'a> {
    pub(crate) fn new(graph: &'a Subgraph) -> Self {
        let size = graph.len();
        ForwardSweep { graph, tangents: vec![ZERO; size], needed: vec![false; size] }
    }

    /// ∂output/∂input of each output; `None` where structurally zero.
    pub(crate) fn run(
        &mut self,
        arena: &mut Arena,
        input: Position,
        outputs: &[Position],
    ) -> Vec<Option<NodeId>> {
        self.needed.fill(false);
        for &output in outputs {
            self.needed[output as usize] = true;
        }
        for position in self.graph.positions().rev() {
            if self.needed[position as usize] {
                for operand in self.graph.node(position).operands() {
                    self.needed[operand as usize] = true;
                }
            }
        }
        for position in self.graph.positions() {
            let tangent = if position == input {
                Some(arena.constant(1.0))
            } else if self.needed[position as usize] {
                self.tangent(arena, position)
            } else {
                None
            };
            self.tangents[position as usize] = tangent.unwrap_or(ZERO);
        }
        outputs.iter().map(|&output| self.known(output)).collect()
    }

    fn known(&self, position: Position) -> Option<NodeId> {
        Some(self.tangents[position as usize]).filter(|&tangent| tangent != ZERO)
    }

    fn tangent(&self, arena: &mut Arena, position: Position) -> Option<NodeId> {
        let id = self.graph.id(position);
        let result = match self.graph.node(position) {
            Node::Constant(_) | Node::Symbol(_) => return None,
            Node::Unary(op, x) => {
                let dx = self.known(x)?;
                let partial = arena.unary_partial(op, self.graph.id(x), id);
                arena.mul(dx, partial)
            }
            Node::Binary(Binary::Mul, a, b) if a == b => {
                let da = self.known(a)?;
                let twice = arena.scaled(2.0, self.graph.id(a));
                arena.mul(da, twice)
            }
            Node::Binary(op, a, b) => {
                let (da, db) = (self.known(a), self.known(b));
                binary_tangent(arena, op, [self.graph.id(a), self.graph.id(b), id], da, db)?
            }
            Node::Select(condition, x, y) => {
                let (dx, dy) = (self.known(x), self.known(y));
                if dx.is_none() && dy.is_none() {
                    return None;
                }
                let zero = arena.constant(0.0);
                let condition = self.graph.id(condition);
                arena.select(condition, dx.unwrap_or(zero), dy.unwrap_or(zero))
            }
        };
        (arena.constant_value(result) != Some(0.0)).then_some(result)
    }
}

/// The tangent of z = op(a, b) from those of a and b.
fn binary_tangent(
    arena: &mut Arena,
    op: Binary,
    [a, b, z]: [NodeId; 3],
    da: Option<NodeId>,
    db: Option<NodeId>,
) -> Option<NodeId> {
    match (da, db) {
        (None, None) => None,
        (Some(da), Some(db)) if op == Binary::Sub => Some(arena.sub(da, db)),
        (Some(da), Some(db)) if op == Binary::Div => {
            let reciprocal = arena.recip(b);
            let change = arena.mul(z, db);
            let numerator = arena.sub(da, change);
            Some(arena.mul(numerator, reciprocal))
        }
        (da, db) => {
            let (by_a, by_b) = arena.binary_partials(op, a, b, z);
            let first = da.map(|da| arena.mul(da, by_a));
            let second = db.map(|db| arena.mul(db, by_b));
            match (first, second) {
                (Some(first), Some(second)) => Some(arena.add(first, second)),
                (only, None) | (None, only) => only,
            }
        }
    }
}
