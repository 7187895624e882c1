//! Gradients, Jacobians and Hessians as expressions.

use crate::adjoint::adjoints;
use crate::expr::Expr;
use crate::graph::{Arena, NodeId};
use crate::sparsity::SparseMatrix;
use crate::tangent::{ForwardSweep, reachable};

/// ∂output/∂inputs by one reverse sweep; entry i belongs to `inputs[i]`. The cost is a small multiple
/// of the output's own, however many inputs there are.
///
/// An input may also be an inner expression: the derivative is then with respect to that node’s value,
/// everything below it as it is.
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
        let entries = if forward_is_cheaper(arena, &outputs, &inputs) {
            forward_entries(arena, &outputs, &inputs, |_, _| true)
        } else {
            reverse_entries(arena, &outputs, &inputs)
        };
        matrix(arena, outputs.len(), inputs.len(), entries)
    })
}

/// The lower triangle (diagonal included) of the Hessian of `scalar`, by forward sweeps over its
/// reverse gradient.
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
        let entries = forward_entries(arena, &gradient, &inputs, |row, col| row >= col);
        matrix(arena, inputs.len(), inputs.len(), entries)
    })
}

type Entry = (usize, usize, NodeId);

fn ids(arena: &Arena, expressions: &[Expr]) -> Vec<NodeId> {
    expressions.iter().map(|e| e.id_in(arena)).collect()
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
    outputs: &[NodeId],
    inputs: &[NodeId],
    wanted: impl Fn(usize, usize) -> bool,
) -> Vec<Entry> {
    let mut sweep = ForwardSweep::new(arena, outputs);
    let mut entries = Vec::new();
    for (col, &input) in inputs.iter().enumerate() {
        sweep.run(arena, input);
        for (row, &output) in outputs.iter().enumerate() {
            if wanted(row, col)
                && let Some(value) = sweep.tangent(output)
            {
                entries.push((row, col, value));
            }
        }
    }
    entries
}

fn reverse_entries(arena: &mut Arena, outputs: &[NodeId], inputs: &[NodeId]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (row, &output) in outputs.iter().enumerate() {
        for (col, value) in adjoints(arena, output, inputs).into_iter().enumerate() {
            if let Some(value) = value {
                entries.push((row, col, value));
            }
        }
    }
    entries
}

/// Compares the nodes visited: by forward sweeps those below each input, by reverse sweeps those
/// above each output that depend on an input.
fn forward_is_cheaper(arena: &Arena, outputs: &[NodeId], inputs: &[NodeId]) -> bool {
    let order = reachable(arena, outputs);
    let Some(&last) = order.last() else { return true };
    let mut reach = vec![false; last as usize + 1];
    let mut forward = 0;
    for &input in inputs {
        reach.fill(false);
        for &id in &order {
            let depends =
                id == input || arena.node(id).operands().any(|operand| reach[operand as usize]);
            reach[id as usize] = depends;
            forward += usize::from(depends);
        }
    }
    let mut active = vec![false; last as usize + 1];
    for &id in &order {
        active[id as usize] = inputs.contains(&id)
            || arena.node(id).operands().any(|operand| active[operand as usize]);
    }
    let mut reverse = 0;
    for &output in outputs {
        let above = reachable(arena, &[output]);
        reverse += above.iter().filter(|&&id| active[id as usize]).count();
    }
    forward <= reverse
}
