//! Random expression graphs: values and derivatives against num-dual on plain numbers, and every
//! backend, lane and batch against each other bit for bit.

use num_dual::{Dual64, HyperDual, HyperDual64};
use proptest::prelude::*;
use righting_scalar::Scalar;
use righting_symbolic::{Backend, Expr, Function, LANES, gradient, hessian_lower, jacobian, trace};

const INPUTS: usize = 4;

/// One operation on earlier values, chosen so that values stay moderate and derivatives exist.
#[derive(Copy, Clone, Debug)]
struct Step {
    operation: u8,
    operands: [usize; 3],
    constant: f64,
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let step = (0..22_u8, prop::array::uniform3(0..1000_usize), -2.0..2.0)
        .prop_map(|(operation, operands, constant)| Step { operation, operands, constant });
    prop::collection::vec(step, 1..120)
}

/// Runs the steps; the last values are the outputs.
fn run<T: Scalar>(steps: &[Step], inputs: &[T]) -> Vec<T> {
    let mut values = inputs.to_vec();
    let one = T::from(1.0);
    for step in steps {
        let [a, b, c] = step.operands.map(|operand| values[operand % values.len()]);
        // Brings any value back to moderate size.
        let tame = |x: T| x / (x * x + 1.0).sqrt();
        let value = match step.operation {
            0 | 1 => a + b,
            2 | 3 => a - b,
            4..=6 => tame(a) * b,
            7 => -a,
            8 => a * step.constant,
            9 => a + step.constant,
            10 => a / (b * b + 1.0),
            11 => (a * a + 0.5).sqrt(),
            12 => a.sin(),
            13 => a.cos(),
            14 => (tame(a)).exp(),
            15 => (a * a + 1.0).ln(),
            16 => a.atan2(b * b + 1.0),
            17 => T::select_positive(a - step.constant, b, c),
            18 => tame(a).minimum(tame(b)),
            19 => (tame(a) * 2.0).powi(3),
            20 => tame(a - b) * tame(a - b),
            _ => one - tame(a),
        };
        values.push(value);
    }
    values.split_off(values.len().saturating_sub(3))
}

fn compile(steps: &[Step]) -> Function {
    trace(|| {
        let x = Expr::symbols("x", INPUTS);
        let outputs = run(steps, &x);
        let sum = outputs.iter().copied().sum();
        let hessian = hessian_lower(sum, &x);
        let dense_hessian: Vec<Expr> = (0..INPUTS)
            .flat_map(|row| (0..INPUTS).map(move |col| (row.max(col), row.min(col))))
            .map(|(row, col)| hessian.get(row, col).unwrap_or(Expr::constant(0.0)))
            .collect();
        Function::builder("random")
            .input("x", &x)
            .output("values", &outputs)
            .output("gradient", &gradient(sum, &x))
            .output("hessian", &dense_hessian)
            .output("mixed_by_duals", &[mixed_by_duals(steps, &x)])
            .output_sparse("jacobian", &jacobian(&outputs, &x))
            .build()
            .unwrap()
    })
}

/// ∂²/∂x₁∂x₀ of the outputs' sum by hyper-dual numbers over expressions.
fn mixed_by_duals(steps: &[Step], x: &[Expr]) -> Expr {
    let (zero, one) = (Expr::constant(0.0), Expr::constant(1.0));
    let unit = |hit: bool| if hit { one } else { zero };
    let seeded = |k: usize| HyperDual::new(x[k], unit(k == 1), unit(k == 0), zero);
    let outputs = run(steps, &std::array::from_fn::<_, INPUTS, _>(seeded));
    outputs.into_iter().map(|output| output.eps1eps2).sum()
}

fn points() -> impl Strategy<Value = Vec<[f64; INPUTS]>> {
    prop::collection::vec(prop::array::uniform4(-3.0..3.0), 1..3 * LANES)
}

/// All outputs, port after port, for each point.
fn evaluate_singly(function: &Function, points: &[[f64; INPUTS]]) -> Vec<Vec<f64>> {
    let mut workspace = function.workspace();
    let lengths: Vec<usize> = function.output_ports().iter().map(|port| port.len()).collect();
    let one = |point: &[f64; INPUTS]| {
        let mut outputs: Vec<Vec<f64>> = lengths.iter().map(|&len| vec![0.0; len]).collect();
        let mut slices: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
        function.evaluate(&mut workspace, &[point], &mut slices);
        outputs.concat()
    };
    points.iter().map(one).collect()
}

fn evaluate_batch(function: &Function, points: &[[f64; INPUTS]]) -> Vec<Vec<f64>> {
    let mut workspace = function.workspace();
    let ports = function.output_ports();
    let mut outputs: Vec<Vec<f64>> =
        ports.iter().map(|port| vec![0.0; port.len() * points.len()]).collect();
    let mut slices: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
    function.evaluate_batch(&mut workspace, points.len(), &[points.as_flattened()], &mut slices);
    let of_point = |p: usize| {
        let parts = ports.iter().zip(&outputs);
        parts.flat_map(|(port, values)| values[p * port.len()..][..port.len()].to_vec()).collect()
    };
    (0..points.len()).map(of_point).collect()
}

fn bits(values: &[Vec<f64>]) -> Vec<Vec<u64>> {
    let bits = |x: f64| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
    values.iter().map(|point| point.iter().map(|&x| bits(x)).collect()).collect()
}

fn close(ours: f64, reference: f64, scale: f64) -> bool {
    (ours - reference).abs() <= 1e-11 * (scale + reference.abs())
}

proptest! {
    #[test]
    fn every_backend_lane_and_batch_gives_the_same_bits(steps in steps(), points in points()) {
        let function = compile(&steps);
        let reference = bits(&evaluate_singly(&function, &points));
        for backend in Backend::available() {
            let function = function.with_backend(backend).unwrap();
            prop_assert_eq!(&bits(&evaluate_singly(&function, &points)), &reference, "{:?}", backend);
            prop_assert_eq!(&bits(&evaluate_batch(&function, &points)), &reference, "{:?}", backend);
        }
    }

    #[test]
    fn values_and_derivatives_agree_with_num_dual(steps in steps(), points in points()) {
        let function = compile(&steps);
        let outputs = run(&steps, &points[0]).len();
        for (point, ours) in points.iter().zip(evaluate_batch(&function, &points)) {
            let values = run(&steps, point);
            let scale = values.iter().fold(1.0, |sum: f64, value| sum + value.abs());
            for (ours, value) in ours.iter().zip(&values) {
                prop_assert!(close(*ours, *value, scale), "value {} vs {}", ours, value);
            }
            for i in 0..INPUTS {
                let seeded = |k: usize| Dual64::new(point[k], f64::from(u8::from(k == i)));
                let duals = run(&steps, &std::array::from_fn::<_, INPUTS, _>(seeded));
                let reference: f64 = duals.iter().map(|dual| dual.eps).sum();
                let derivative = ours[outputs + i];
                prop_assert!(close(derivative, reference, 10.0 * scale), "d/dx{}: {} vs {}", i, derivative, reference);
                for j in 0..=i {
                    let seeded = |k: usize| {
                        let unit = |l: usize| f64::from(u8::from(k == l));
                        HyperDual64::new(point[k], unit(i), unit(j), 0.0)
                    };
                    let duals = run(&steps, &std::array::from_fn::<_, INPUTS, _>(seeded));
                    let reference: f64 = duals.iter().map(|dual| dual.eps1eps2).sum();
                    let derivative = ours[outputs + INPUTS + i * INPUTS + j];
                    prop_assert!(close(derivative, reference, 1e3 * scale), "d2/dx{}dx{}: {} vs {}", i, j, derivative, reference);
                    if (i, j) == (1, 0) {
                        let by_duals = ours[outputs + INPUTS + INPUTS * INPUTS];
                        prop_assert!(close(by_duals, reference, 1e3 * scale), "by duals: {} vs {}", by_duals, reference);
                    }
                }
            }
        }
    }
}
