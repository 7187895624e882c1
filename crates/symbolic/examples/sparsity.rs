//! The Jacobian of a chain of masses and springs: where it may be nonzero, and its values at many
//! points at once.
//!
//! `cargo run -p righting-symbolic --example sparsity`

use num_dual::DualNum;
use righting_symbolic::{Expr, Function, FunctionError, LANES, jacobian, trace};

const MASSES: usize = 6;

/// Acceleration of each mass of a chain between two walls, springs stiffening with their stretch.
fn accelerations(x: &[Expr]) -> Vec<Expr> {
    let position = |i: usize| match i {
        0 => Expr::constant(0.0),
        i if i > MASSES => Expr::constant((MASSES + 1) as f64),
        i => x[i - 1],
    };
    let force = |i: usize| {
        let stretch = position(i + 1) - position(i) - 1.0;
        stretch + stretch.powi(3)
    };
    (0..MASSES).map(|i| force(i + 1) - force(i)).collect()
}

fn main() -> Result<(), FunctionError> {
    let (sparsity, function) = trace(|| {
        let x = Expr::symbols("x", MASSES);
        let values = accelerations(&x);
        let derivative = jacobian(&values, &x);
        let function = Function::builder("chain")
            .input("x", &x)
            .output("accelerations", &values)
            .output_sparse("jacobian", &derivative)
            .build()?;
        Ok::<_, FunctionError>((derivative.sparsity().clone(), function))
    })?;

    println!("{} of {} entries may be nonzero:", sparsity.nonzeros(), MASSES * MASSES);
    for row in 0..MASSES {
        let is_entry = |column| sparsity.iter().any(|entry| entry == (row, column));
        let line: String =
            (0..MASSES).map(|column| if is_entry(column) { " x" } else { " ." }).collect();
        println!("{line}");
    }

    let mut workspace = function.workspace();
    // One point a lane: the chain stretched to the right, a little more from lane to lane.
    for (index, lanes) in workspace.input_mut(0).chunks_exact_mut(LANES).enumerate() {
        for (lane, value) in lanes.iter_mut().enumerate() {
            *value = (index + 1) as f64 * (1.0 + 0.02 * lane as f64);
        }
    }
    function.evaluate_block(&mut workspace);
    let first_entry = &workspace.output(1)[..LANES];
    println!("d a_0 / d x_0 at {LANES} points: {first_entry:.3?}");
    Ok(())
}
