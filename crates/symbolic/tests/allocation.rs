//! Evaluation allocates nothing, on any backend.

mod counting;

use counting::allocations;
use num_dual::DualNum;
use righting_symbolic::{Backend, Expr, Function, gradient, hessian_lower, trace};

fn oscillators() -> Function {
    trace(|| {
        let x = Expr::symbols("x", 12);
        let energy: Expr =
            x.windows(2).map(|pair| (pair[0] - pair[1]).cos() + (pair[0] * pair[1]).exp()).sum();
        Function::builder("oscillators")
            .input("x", &x)
            .output("gradient", &gradient(energy, &x))
            .output_sparse("hessian", &hessian_lower(energy, &x))
            .build()
            .unwrap()
    })
}

#[test]
fn evaluation_allocates_nothing() {
    let function = oscillators();
    let points = 21;
    let x: Vec<f64> = (0..12 * points).map(|i| 0.01 * i as f64).collect();
    let lengths: Vec<usize> = function.output_ports().iter().map(|port| port.len()).collect();
    let mut gradient = vec![0.0; lengths[0] * points];
    let mut hessian = vec![0.0; lengths[1] * points];
    for backend in Backend::available() {
        let function = function.with_backend(backend).unwrap();
        let mut workspace = function.workspace();
        let before = allocations();
        workspace.input_mut(0).fill(0.3);
        function.evaluate_block(&mut workspace);
        let block_sum: f64 = workspace.output(1).iter().sum();
        function.evaluate(
            &mut workspace,
            &[&x[..12]],
            &mut [&mut gradient[..lengths[0]], &mut hessian[..lengths[1]]],
        );
        function.evaluate_batch(&mut workspace, points, &[&x], &mut [&mut gradient, &mut hessian]);
        let after = allocations();
        assert_eq!(after - before, 0, "{backend:?}");
        assert!(block_sum.is_finite() && gradient.iter().all(|x| x.is_finite()));
    }
}
