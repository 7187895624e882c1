//! The reverse sweep: all first derivatives of one scalar.
//!
//! A branch that is not taken must not reach the derivatives, but its partials may be infinite
//! there, and 0·∞ is not zero. So an adjoint that has passed a branch keeps the condition as a
//! *guard* beside it: products are formed with the bare value, and the guard becomes a selection
//! only where the adjoint joins others that hold without it.

use std::collections::BTreeMap;

use crate::graph::{Arena, Node, NodeId};
use crate::op::Binary;
use crate::tangent::reachable;

const NONE: u32 = u32::MAX;

/// Index into [`ReverseSweep::guards`].
type GuardId = u32;

/// One taken side of a branch, inside an outer guard.
#[derive(Copy, Clone, PartialEq)]
struct Guard {
    outer: GuardId,
    condition: NodeId,
    positive: bool,
}

struct ReverseSweep<'a> {
    arena: &'a mut Arena,
    /// By node: the unguarded adjoint, [`NONE`] if zero.
    plain: Vec<NodeId>,
    /// By node: adjoints that hold under a guard only.
    guarded: BTreeMap<NodeId, Vec<(GuardId, NodeId)>>,
    guards: Vec<Guard>,
    /// By node: whether it depends on any of the inputs.
    active: Vec<bool>,
}

/// The derivatives of `output` with respect to each input; `None` where structurally zero.
pub(crate) fn adjoints(
    arena: &mut Arena,
    output: NodeId,
    inputs: &[NodeId],
) -> Vec<Option<NodeId>> {
    let size = output as usize + 1;
    let mut active = vec![false; size];
    for &input in inputs {
        if let Some(flag) = active.get_mut(input as usize) {
            *flag = true;
        }
    }
    let order = reachable(arena, &[output]);
    for &id in &order {
        if arena.node(id).operands().any(|operand| active[operand as usize]) {
            active[id as usize] = true;
        }
    }
    let one = arena.constant(1.0);
    let mut sweep = ReverseSweep {
        arena,
        plain: vec![NONE; size],
        guarded: BTreeMap::new(),
        guards: Vec::new(),
        active,
    };
    sweep.add(output, NONE, one);
    for &id in order.iter().rev() {
        if sweep.active[id as usize] {
            sweep.visit(id);
        }
    }
    inputs.iter().map(|&input| sweep.total(input)).collect()
}

impl ReverseSweep<'_> {
    fn add(&mut self, id: NodeId, guard: GuardId, value: NodeId) {
        if !self.active[id as usize] || self.arena.constant_value(value) == Some(0.0) {
            return;
        }
        if guard == NONE {
            let known = self.plain[id as usize];
            self.plain[id as usize] =
                if known == NONE { value } else { self.arena.add(known, value) };
            return;
        }
        let entries = self.guarded.entry(id).or_default();
        match entries.iter_mut().find(|(known, _)| *known == guard) {
            Some((_, sum)) => *sum = self.arena.add(*sum, value),
            None => entries.push((guard, value)),
        }
    }

    fn guard(&mut self, guard: Guard) -> GuardId {
        let known = self.guards.iter().position(|&other| other == guard);
        known.unwrap_or_else(|| {
            self.guards.push(guard);
            self.guards.len() - 1
        }) as GuardId
    }

    /// The value where all of the guard's branches are taken, else zero.
    fn selected(&mut self, mut guard: GuardId, mut value: NodeId) -> NodeId {
        let zero = self.arena.constant(0.0);
        while guard != NONE {
            let Guard { outer, condition, positive } = self.guards[guard as usize];
            let (x, y) = if positive { (value, zero) } else { (zero, value) };
            value = self.arena.select(condition, x, y);
            guard = outer;
        }
        value
    }

    /// Joins the two sides of one branch: together they hold wherever the outer guard does.
    fn join_opposite_sides(&mut self, entries: &mut Vec<(GuardId, NodeId)>) {
        let opposite = |sweep: &Self, a: GuardId, b: GuardId| {
            if a == NONE || b == NONE {
                return false;
            }
            let (a, b) = (sweep.guards[a as usize], sweep.guards[b as usize]);
            a == Guard { positive: !b.positive, ..b }
        };
        while let Some((i, j)) = (0..entries.len())
            .flat_map(|j| (0..j).map(move |i| (i, j)))
            .find(|&(i, j)| opposite(self, entries[i].0, entries[j].0))
        {
            let (_, second) = entries.swap_remove(j);
            let (guard, first) = entries.swap_remove(i);
            let Guard { outer, condition, positive } = self.guards[guard as usize];
            let (x, y) = if positive { (first, second) } else { (second, first) };
            let joined = self.arena.select(condition, x, y);
            match entries.iter_mut().find(|(known, _)| *known == outer) {
                Some((_, sum)) => *sum = self.arena.add(*sum, joined),
                None => entries.push((outer, joined)),
            }
        }
    }

    /// All adjoints of a finished node with their guards; a single unguarded one where the node is
    /// used without condition.
    fn collect(&mut self, id: NodeId) -> Vec<(GuardId, NodeId)> {
        let plain = self.plain[id as usize];
        let mut entries = self.guarded.remove(&id).unwrap_or_default();
        self.join_opposite_sides(&mut entries);
        if plain != NONE {
            entries.insert(0, (NONE, plain));
        }
        if entries.iter().any(|&(guard, _)| guard == NONE) {
            let mut sum = None;
            for (guard, value) in entries {
                let value = self.selected(guard, value);
                sum = Some(sum.map_or(value, |sum| self.arena.add(sum, value)));
            }
            return sum.map(|sum| (NONE, sum)).into_iter().collect();
        }
        entries
    }

    fn total(&mut self, id: NodeId) -> Option<NodeId> {
        if id as usize >= self.plain.len() {
            return None;
        }
        let plain = self.plain[id as usize];
        let mut sum = (plain != NONE).then_some(plain);
        for (guard, value) in self.guarded.get(&id).cloned().unwrap_or_default() {
            let value = self.selected(guard, value);
            sum = Some(sum.map_or(value, |sum| self.arena.add(sum, value)));
        }
        sum.filter(|&sum| self.arena.constant_value(sum) != Some(0.0))
    }

    fn visit(&mut self, id: NodeId) {
        let node = self.arena.node(id);
        if matches!(node, Node::Constant(_) | Node::Symbol(_)) {
            return;
        }
        if self.guarded.contains_key(&id) {
            for (guard, adjoint) in self.collect(id) {
                self.propagate(id, node, guard, adjoint);
            }
        } else if self.plain[id as usize] != NONE {
            self.propagate(id, node, NONE, self.plain[id as usize]);
        }
    }

    fn propagate(&mut self, id: NodeId, node: Node, guard: GuardId, adjoint: NodeId) {
        match node {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Unary(op, x) => {
                let partial = self.arena.unary_partial(op, x, id);
                let value = self.arena.mul(adjoint, partial);
                self.add(x, guard, value);
            }
            Node::Binary(Binary::Mul, a, b) if a == b => {
                let twice = self.arena.scaled(2.0, a);
                let value = self.arena.mul(adjoint, twice);
                self.add(a, guard, value);
            }
            Node::Binary(Binary::Div, a, b) => {
                let reciprocal = self.arena.recip(b);
                let by_a = self.arena.mul(adjoint, reciprocal);
                self.add(a, guard, by_a);
                if self.active[b as usize] {
                    let by_b = self.arena.mul(by_a, id);
                    let by_b = self.arena.neg(by_b);
                    self.add(b, guard, by_b);
                }
            }
            Node::Binary(op, a, b) => {
                let (by_a, by_b) = self.arena.binary_partials(op, a, b, id);
                for (operand, partial) in [(a, by_a), (b, by_b)] {
                    if self.active[operand as usize] {
                        let value = self.arena.mul(adjoint, partial);
                        self.add(operand, guard, value);
                    }
                }
            }
            Node::Select(condition, x, y) => {
                for (operand, positive) in [(x, true), (y, false)] {
                    if self.active[operand as usize] {
                        let inner = self.guard(Guard { outer: guard, condition, positive });
                        self.add(operand, inner, adjoint);
                    }
                }
            }
        }
    }
}
