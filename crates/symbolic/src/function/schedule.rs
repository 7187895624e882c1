//! The order of evaluation.
//!
//! Depth first from the outputs: a value is computed just before it is first used, so few wait in
//! registers. Of an operation's operands the one with the longer computation below it goes first
//! (Sethi and Ullman's rule, exact for trees only). Operations that are not compiled to machine code
//! interrupt it, so they come in as few batches as their dependences allow.

use crate::graph::Node;
use crate::subgraph::{Position, Subgraph};

struct Schedule<'a> {
    graph: &'a Subgraph,
    /// By position: whether the outputs need it and it is not placed yet.
    waiting: Vec<bool>,
    /// By position: an estimate of the work below it.
    weight: Vec<u32>,
    order: Vec<Position>,
    stack: Vec<(Position, bool)>,
}

/// Every operation that `outputs` need, operands first; symbols and constants are not listed.
///
/// `interrupts` tells which operations to batch.
pub(super) fn schedule(
    graph: &Subgraph,
    outputs: &[Position],
    interrupts: impl Fn(Node) -> bool,
) -> Vec<Position> {
    let size = graph.len();
    let mut schedule = Schedule {
        graph,
        waiting: vec![false; size],
        weight: vec![0; size],
        order: Vec::with_capacity(size),
        stack: Vec::new(),
    };
    let mut level = vec![0_usize; size];
    let mut batches: Vec<Vec<Position>> = Vec::new();
    for id in graph.positions() {
        let node = graph.node(id);
        if matches!(node, Node::Constant(_) | Node::Symbol(_)) {
            continue;
        }
        schedule.waiting[id as usize] = true;
        let mut heaviest = 0;
        let mut ties = 0;
        let mut own_level = 0;
        for operand in node.operands() {
            let weight = schedule.weight[operand as usize];
            match weight.cmp(&heaviest) {
                std::cmp::Ordering::Greater => (heaviest, ties) = (weight, 0),
                std::cmp::Ordering::Equal => ties += 1,
                std::cmp::Ordering::Less => {}
            }
            own_level = own_level.max(level[operand as usize]);
        }
        schedule.weight[id as usize] = (heaviest + ties).max(1);
        if interrupts(node) {
            if batches.len() <= own_level {
                batches.resize_with(own_level + 1, Vec::new);
            }
            batches[own_level].push(id);
            own_level += 1;
        }
        level[id as usize] = own_level;
    }
    for batch in batches {
        for &id in &batch {
            for operand in graph.node(id).operands() {
                schedule.place(operand);
            }
        }
        for id in batch {
            schedule.place(id);
        }
    }
    for &output in outputs {
        schedule.place(output);
    }
    schedule.order
}

impl Schedule<'_> {
    /// Appends a node after everything it needs.
    fn place(&mut self, root: Position) {
        self.stack.push((root, false));
        while let Some((id, operands_placed)) = self.stack.pop() {
            if !self.waiting[id as usize] {
                continue;
            }
            if operands_placed {
                self.waiting[id as usize] = false;
                self.order.push(id);
                continue;
            }
            self.stack.push((id, true));
            let first = self.stack.len();
            let (graph, waiting) = (self.graph, &self.waiting);
            let operands = graph.node(id).operands().filter(|&id| waiting[id as usize]);
            self.stack.extend(operands.map(|operand| (operand, false)));
            // The top of the stack comes next.
            let weight = &self.weight;
            self.stack[first..].sort_by_key(|&(operand, _)| weight[operand as usize]);
        }
    }
}
