//! A function of realistic size: more values than any machine has registers.

#[path = "../examples/chain/model.rs"]
mod model;

use num_dual::{Dual64, HyperDual64};
use righting_symbolic::{Backend, Expr, Function, trace};

const JOINTS: usize = 7;
const STATES: usize = 4 + 2 * JOINTS;

/// A Weyl sequence in (−1, 1).
fn numbers(count: usize, seed: f64) -> Vec<f64> {
    (0..count).map(|i| 2.0 * (seed + 0.618_033_988_749_895 * i as f64).fract() - 1.0).collect()
}

fn chain() -> Function {
    trace(|| model::compile(&model::differentiate(JOINTS)).unwrap())
}

fn evaluate(function: &Function, points: usize) -> Vec<Vec<f64>> {
    let inputs: Vec<Vec<f64>> =
        function.input_ports().iter().map(|port| numbers(points * port.len(), 0.1)).collect();
    let inputs: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
    let ports = function.output_ports().iter();
    let mut outputs: Vec<Vec<f64>> = ports.map(|port| vec![0.0; points * port.len()]).collect();
    let mut slices: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
    function.evaluate_batch(&mut function.workspace(), points, &inputs, &mut slices);
    outputs
}

#[test]
fn every_backend_gives_the_same_bits() {
    let function = chain();
    let points = 50;
    let reference = evaluate(&function, points);
    assert!(reference.iter().flatten().all(|value| value.is_finite()));
    for backend in Backend::available() {
        let ours = evaluate(&function.with_backend(backend).unwrap(), points);
        for (ours, reference) in ours.iter().flatten().zip(reference.iter().flatten()) {
            assert_eq!(ours.to_bits(), reference.to_bits(), "{backend:?}");
        }
    }
}

#[test]
fn derivatives_agree_with_dual_numbers() {
    let function = chain();
    let outputs = evaluate(&function, 1);
    let (state, momentum, multipliers) = (numbers(STATES, 0.1), numbers(3, 0.1), numbers(4, 0.1));
    let (attitude, rest) = (0..4, (4..4 + JOINTS, 4 + JOINTS..STATES));

    let jacobian = function.output_ports()[1].sparsity().unwrap();
    let mut covered = 0;
    for col in 0..STATES {
        let x: Vec<Dual64> =
            (0..STATES).map(|k| Dual64::new(state[k], f64::from(u8::from(k == col)))).collect();
        let h: Vec<Dual64> = momentum.iter().map(|&h| Dual64::from(h)).collect();
        let rate =
            model::attitude_rate(&x[attitude.clone()], &x[rest.0.clone()], &x[rest.1.clone()], &h);
        for (row, rate) in rate.iter().enumerate() {
            assert!((outputs[0][row] - rate.re).abs() <= 1e-13 * rate.re.abs());
            let ours = jacobian.position(row, col).map_or(0.0, |k| outputs[1][k]);
            assert!((ours - rate.eps).abs() <= 1e-12 * (rate.eps.abs() + 1e-3));
            covered += usize::from(rate.eps != 0.0);
        }
    }
    assert!(covered <= jacobian.nonzeros() && jacobian.nonzeros() <= 4 * STATES);

    let hessian = function.output_ports()[2].sparsity().unwrap();
    for row in 0..STATES {
        for col in 0..=row {
            let unit = |k: usize, l: usize| f64::from(u8::from(k == l));
            let x: Vec<HyperDual64> = (0..STATES)
                .map(|k| HyperDual64::new(state[k], unit(k, row), unit(k, col), 0.0))
                .collect();
            let h: Vec<HyperDual64> = momentum.iter().map(|&h| HyperDual64::from(h)).collect();
            let rate = model::attitude_rate(
                &x[attitude.clone()],
                &x[rest.0.clone()],
                &x[rest.1.clone()],
                &h,
            );
            let reference: f64 =
                rate.iter().zip(&multipliers).map(|(rate, l)| rate.eps1eps2 * l).sum();
            let ours = hessian.position(row, col).map_or(0.0, |k| outputs[2][k]);
            assert!((ours - reference).abs() <= 1e-11 * (reference.abs() + 1e-3), "{row} {col}");
        }
    }
}

#[test]
fn the_jacobian_agrees_with_finite_differences() {
    let outputs = evaluate(&chain(), 1);
    let (state, momentum) = (numbers(STATES, 0.1), numbers(3, 0.1));
    let jacobian = chain().output_ports()[1].sparsity().cloned().unwrap();
    let rate =
        |x: &[f64]| model::attitude_rate(&x[..4], &x[4..4 + JOINTS], &x[4 + JOINTS..], &momentum);
    for col in 0..STATES {
        let step = 1e-5;
        let mut moved = [state.clone(), state.clone()];
        moved[0][col] += step;
        moved[1][col] -= step;
        let [ahead, behind] = moved.map(|x| rate(&x));
        for row in 0..4 {
            let reference = (ahead[row] - behind[row]) / (2.0 * step);
            let ours = jacobian.position(row, col).map_or(0.0, |k| outputs[1][k]);
            assert!((ours - reference).abs() <= 1e-8, "{row} {col}: {ours} vs {reference}");
        }
    }
}

#[test]
fn threads_share_a_function() {
    fn shared<T: Send + Sync>(_: &T) {}
    let function = chain();
    shared(&function);
    let reference = evaluate(&function, 20);
    std::thread::scope(|threads| {
        let evaluations: Vec<_> =
            (0..4).map(|_| threads.spawn(|| evaluate(&function.clone(), 20))).collect();
        for evaluation in evaluations {
            assert_eq!(evaluation.join().unwrap(), reference);
        }
    });
}

/// Operands far beyond the reach of short displacements.
#[test]
fn thousands_of_ports_and_live_values() {
    let count = 6000;
    let function = trace(|| {
        let x = Expr::symbols("x", count);
        // Every product waits for the last one.
        let products: Vec<Expr> = x.windows(2).map(|x| x[0] * x[1]).collect();
        let total: Expr = products.iter().copied().sum();
        let y: Vec<Expr> = products.iter().map(|&product| product - total).collect();
        Function::builder("wide").input("x", &x).output("y", &y).build().unwrap()
    });
    let reference = evaluate(&function, 9);
    let x = numbers(count, 0.1);
    let products: Vec<f64> = x.windows(2).map(|x| x[0] * x[1]).collect();
    let total: f64 = products.iter().sum();
    for (ours, product) in reference[0][..count - 1].iter().zip(&products) {
        assert_eq!(*ours, product - total);
    }
    for backend in Backend::available() {
        assert_eq!(evaluate(&function.with_backend(backend).unwrap(), 9), reference, "{backend:?}");
    }
}
