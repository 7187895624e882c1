//! Gradients, Jacobians and Hessians as expressions.

use std::cmp::Reverse;

use crate::adjoint::adjoints;
use crate::expr::Expr;
use crate::graph::{Arena, NodeId};
use crate::sparsity::SparseMatrix;
use crate::subgraph::{Position, Subgraph};
use crate::tangent::ForwardSweep;

/// ∂output/∂inputs by one reverse sweep; entry i belongs to `inputs[i]`. The cost is a small multiple
/// of the output's own, however many inputs there are.
///
/// An input may also be an inner expression: the derivative is then with respect to that node's
/// value, everything below it as it is.
///
/// # Panics
/// If a handle is used outside its graph scope.
pub fn gradient(output: Expr, inputs: &[Expr]) -> Vec<Expr> {
    Arena::with(|arena| {
        let output = output.id_in(arena);
        let inputs = ids(arena, inputs);
        let zero = arena.constant(0.0);
        let derivatives = adjoints(arena, output, &inputs);
        derivatives.into_iter().map(|d| Expr::from_id(arena, d.unwrap_or(zero))).collect()
    })
}

/// ∂outputs/∂inputs, rows by output and columns by input, structural zeros dropped. Forward or
/// reverse sweeps, whichever visits fewer nodes.
///
/// # Panics
/// If a handle is used outside its graph scope.
pub fn jacobian(outputs: &[Expr], inputs: &[Expr]) -> SparseMatrix {
    Arena::with(|arena| {
        let outputs = ids(arena, outputs);
        let inputs = ids(arena, inputs);
        let graph = Subgraph::below(arena, &outputs);
        let reach = Reach::new(&graph, &outputs, &inputs);
        let forward: usize = reach.dependents.iter().sum();
        let reverse: usize = reach.active_dependences.iter().sum();
        let entries = if forward <= reverse {
            forward_entries(arena, &graph, &outputs, &inputs)
        } else {
            reverse_entries(arena, &outputs, &inputs)
        };
        matrix(arena, outputs.len(), inputs.len(), entries)
    })
}

/// The lower triangle (diagonal included) of the Hessian of `scalar`, by forward sweeps over its
/// reverse gradient.
///
/// By symmetry one sweep serves a row and a column, so the inputs that most of the gradient depends
/// on go first and leave the least to the others.
///
/// # Panics
/// If a handle is used outside its graph scope.
pub fn hessian_lower(scalar: Expr, inputs: &[Expr]) -> SparseMatrix {
    Arena::with(|arena| {
        let scalar = scalar.id_in(arena);
        let inputs = ids(arena, inputs);
        let zero = arena.constant(0.0);
        let gradient: Vec<NodeId> = adjoints(arena, scalar, &inputs)
            .into_iter()
            .map(|derivative| derivative.unwrap_or(zero))
            .collect();
        let graph = Subgraph::below(arena, &gradient);
        let reach = Reach::new(&graph, &gradient, &inputs);
        let rows = positions(&graph, &gradient);

        let mut remaining: Vec<usize> = (0..inputs.len()).collect();
        remaining.sort_by_key(|&input| Reverse(reach.dependents[input]));
        let mut sweep = ForwardSweep::new(&graph);
        let mut entries = Vec::new();
        for (done, &col) in remaining.iter().enumerate() {
            let Some(input) = graph.position(inputs[col]) else { continue };
            let outputs: Vec<Position> = remaining[done..].iter().map(|&row| rows[row]).collect();
            let derivatives = sweep.run(arena, input, &outputs);
            for (&row, derivative) in remaining[done..].iter().zip(derivatives) {
                entries.extend(derivative.map(|value| (row.max(col), row.min(col), value)));
            }
        }
        matrix(arena, inputs.len(), inputs.len(), entries)
    })
}

/// Row, column and value.
type Entry = (usize, usize, NodeId);

fn ids(arena: &Arena, expressions: &[Expr]) -> Vec<NodeId> {
    expressions.iter().map(|e| e.id_in(arena)).collect()
}

fn positions(graph: &Subgraph, outputs: &[NodeId]) -> Vec<Position> {
    let position = |&id: &NodeId| graph.position(id).expect("an output of its own subgraph");
    outputs.iter().map(position).collect()
}

fn matrix(arena: &Arena, rows: usize, cols: usize, entries: Vec<Entry>) -> SparseMatrix {
    let entries = entries
        .into_iter()
        .map(|(row, col, value)| (row, col, Expr::from_id(arena, value)))
        .collect();
    SparseMatrix::from_entries(rows, cols, entries)
}

fn forward_entries(
    arena: &mut Arena,
    graph: &Subgraph,
    outputs: &[NodeId],
    inputs: &[NodeId],
) -> Vec<Entry> {
    let outputs = positions(graph, outputs);
    let mut sweep = ForwardSweep::new(graph);
    let mut entries = Vec::new();
    for (col, &input) in inputs.iter().enumerate() {
        let Some(input) = graph.position(input) else { continue };
        for (row, value) in sweep.run(arena, input, &outputs).into_iter().enumerate() {
            entries.extend(value.map(|value| (row, col, value)));
        }
    }
    entries
}

fn reverse_entries(arena: &mut Arena, outputs: &[NodeId], inputs: &[NodeId]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (row, &output) in outputs.iter().enumerate() {
        for (col, value) in adjoints(arena, output, inputs).into_iter().enumerate() {
            entries.extend(value.map(|value| (row, col, value)));
        }
    }
    entries
}

/// How many nodes the sweeps visit.
struct Reach {
    /// For each input, the number of nodes that depend on it: a forward sweep's.
    dependents: Vec<usize>,
    /// For each output, the number of nodes that it needs and that depend on any input: a reverse
    /// sweep's.
    active_dependences: Vec<usize>,
}

impl Reach {
    fn new(graph: &Subgraph, outputs: &[NodeId], inputs: &[NodeId]) -> Self {
        let mut dependents = vec![0; inputs.len()];
        let mut active = vec![false; graph.len()];
        for (inputs, counts) in inputs.chunks(64).zip(dependents.chunks_mut(64)) {
            let mut masks = seeds(graph, inputs);
            for position in graph.positions() {
                let below = graph.node(position).operands().map(|operand| masks[operand as usize]);
                let mask = below.fold(masks[position as usize], |mask, below| mask | below);
                masks[position as usize] = mask;
                active[position as usize] |= mask != 0;
                count_bits(mask, counts);
            }
        }
        let mut active_dependences = vec![0; outputs.len()];
        for (outputs, counts) in outputs.chunks(64).zip(active_dependences.chunks_mut(64)) {
            let mut masks = seeds(graph, outputs);
            for position in graph.positions().rev() {
                let mask = masks[position as usize];
                for operand in graph.node(position).operands() {
                    masks[operand as usize] |= mask;
                }
                if active[position as usize] {
                    count_bits(mask, counts);
                }
            }
        }
        Reach { dependents, active_dependences }
    }
}

/// By position: a bit for each of up to 64 nodes, set at that node.
fn seeds(graph: &Subgraph, nodes: &[NodeId]) -> Vec<u64> {
    let mut masks = vec![0; graph.len()];
    for (bit, &node) in nodes.iter().enumerate() {
        if let Some(position) = graph.position(node) {
            masks[position as usize] |= 1 << bit;
        }
    }
    masks
}

fn count_bits(mut mask: u64, counts: &mut [usize]) {
    while mask != 0 {
        counts[mask.trailing_zeros() as usize] += 1;
        mask &= mask - 1;
    }
}
