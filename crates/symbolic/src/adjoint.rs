//! The reverse sweep: all first derivatives of one scalar.
//!
//! A branch that is not taken must not reach the derivatives, but its partials may be infinite
//! there, and 0·∞ is not zero. So an adjoint that has passed a branch keeps the condition as a
//! *guard* beside it: products are formed with the bare value, and the guard becomes a selection
//! only where the adjoint joins others that hold without it.

use std::collections::BTreeMap;

use crate::graph::{Arena, Node, NodeId};
use crate::op::Binary;
use crate::subgraph::{Position, Subgraph};

const NONE: u32 = u32::MAX;

/// Index into [`ReverseSweep::guards`].
type GuardId = u32;

/// One taken side of a branch, inside an outer guard.
#[derive(Copy, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Guard {
    outer: GuardId,
    condition: NodeId,
    positive: bool,
}

struct ReverseSweep<'a> {
    arena: &'a mut Arena,
    graph: &'a Subgraph,
    /// By position: the unguarded adjoint, [`NONE`] if zero.
    plain: Vec<NodeId>,
    /// Adjoints that hold under a guard only.
    guarded: BTreeMap<Position, Vec<(GuardId, NodeId)>>,
    guards: Vec<Guard>,
    guard_ids: BTreeMap<Guard, GuardId>,
    /// By position: whether it depends on any of the inputs.
    active: Vec<bool>,
}

/// The derivatives of `output` with respect to each input; `None` where structurally zero.
pub(crate) fn adjoints(
    arena: &mut Arena,
    output: NodeId,
    inputs: &[NodeId],
) -> Vec<Option<NodeId>> {
    let graph = Subgraph::below(arena, &[output]);
    let inputs: Vec<_> = inputs.iter().map(|&input| graph.position(input)).collect();
    let mut is_input = vec![false; graph.len()];
    for &input in inputs.iter().flatten() {
        is_input[input as usize] = true;
    }
    let mut active = is_input.clone();
    for position in graph.positions() {
        if graph.node(position).operands().any(|operand| active[operand as usize]) {
            active[position as usize] = true;
        }
    }
    let one = arena.constant(1.0);
    let mut sweep = ReverseSweep {
        arena,
        graph: &graph,
        plain: vec![NONE; graph.len()],
        guarded: BTreeMap::new(),
        guards: Vec::new(),
        guard_ids: BTreeMap::new(),
        active,
    };
    let mut totals = vec![None; graph.len()];
    for position in graph.positions().rev() {
        if graph.id(position) == output {
            sweep.add(position, NONE, one);
        }
        if !sweep.active[position as usize] {
            continue;
        }
        if let Some((guard, adjoint)) = sweep.collect(position) {
            if is_input[position as usize] {
                let total = sweep.selected(guard, adjoint);
                totals[position as usize] =
                    Some(total).filter(|&total| sweep.arena.constant_value(total) != Some(0.0));
            }
            sweep.propagate(position, guard, adjoint);
        }
    }
    inputs.into_iter().map(|input| totals[input? as usize]).collect()
}

impl ReverseSweep<'_> {
    fn add(&mut self, position: Position, guard: GuardId, value: NodeId) {
        if !self.active[position as usize] || self.arena.constant_value(value) == Some(0.0) {
            return;
        }
        if guard == NONE {
            let known = self.plain[position as usize];
            self.plain[position as usize] =
                if known == NONE { value } else { self.arena.add(known, value) };
            return;
        }
        let entries = self.guarded.entry(position).or_default();
        match entries.iter_mut().find(|(known, _)| *known == guard) {
            Some((_, sum)) => *sum = self.arena.add(*sum, value),
            None => entries.push((guard, value)),
        }
    }

    fn guard(&mut self, guard: Guard) -> GuardId {
        *self.guard_ids.entry(guard).or_insert_with(|| {
            self.guards.push(guard);
            self.guards.len() as GuardId - 1
        })
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

    /// The adjoint of a node whose users are all done. It is unguarded if the node is used without
    /// condition; several guards become one that holds where any of them does.
    fn collect(&mut self, position: Position) -> Option<(GuardId, NodeId)> {
        let plain = self.plain[position as usize];
        let unguarded = (plain != NONE).then_some((NONE, plain));
        let Some(mut entries) = self.guarded.remove(&position) else { return unguarded };
        self.join_opposite_sides(&mut entries);
        entries.splice(..0, unguarded);
        if entries.len() <= 1 {
            return entries.pop();
        }
        let always = entries.iter().any(|&(guard, _)| guard == NONE);
        let (zero, one) = (self.arena.constant(0.0), self.arena.constant(1.0));
        let (mut sum, mut any) = (zero, zero);
        for (guard, value) in entries {
            let value = self.selected(guard, value);
            sum = self.arena.add(sum, value);
            let held = self.selected(guard, one);
            any = self.arena.select(held, one, any);
        }
        let any = Guard { outer: NONE, condition: any, positive: true };
        Some((if always { NONE } else { self.guard(any) }, sum))
    }

    fn propagate(&mut self, position: Position, guard: GuardId, adjoint: NodeId) {
        let graph = self.graph;
        let id = graph.id(position);
        match graph.node(position) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Unary(op, x) => {
                let partial = self.arena.unary_partial(op, graph.id(x), id);
                let value = self.arena.mul(adjoint, partial);
                self.add(x, guard, value);
            }
            Node::Binary(Binary::Mul, a, b) if a == b => {
                let twice = self.arena.scaled(2.0, graph.id(a));
                let value = self.arena.mul(adjoint, twice);
                self.add(a, guard, value);
            }
            Node::Binary(Binary::Div, a, b) => {
                let reciprocal = self.arena.recip(graph.id(b));
                let by_a = self.arena.mul(adjoint, reciprocal);
                self.add(a, guard, by_a);
                if self.active[b as usize] {
                    let by_b = self.arena.mul(by_a, id);
                    let by_b = self.arena.neg(by_b);
                    self.add(b, guard, by_b);
                }
            }
            Node::Binary(op, a, b) => {
                let (by_a, by_b) = self.arena.binary_partials(op, graph.id(a), graph.id(b), id);
                for (operand, partial) in [(a, by_a), (b, by_b)] {
                    if self.active[operand as usize] {
                        let value = self.arena.mul(adjoint, partial);
                        self.add(operand, guard, value);
                    }
                }
            }
            Node::Select(condition, x, y) => {
                let condition = graph.id(condition);
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
