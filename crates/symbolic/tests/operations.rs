//! Every operation's value, first and second derivative, three ways: by the graph's sweeps, by dual
//! numbers over expressions, and by num-dual on plain numbers.

use num_dual::{Dual2, Dual2_64, Dual64};
use righting_scalar::Scalar;
use righting_symbolic::{Expr, Function, Graph, gradient, hessian_lower, trace};

/// Values agree to a few roundings: the formulas differ, the functions do not.
fn assert_close(name: &str, x: f64, ours: f64, reference: f64) {
    let scale = reference.abs().max(1.0);
    assert!((ours - reference).abs() <= 1e-12 * scale, "{name}({x}): {ours} vs {reference}");
}

macro_rules! check {
    ($through_duals:expr; $($name:literal: $points:expr, $function:expr;)*) => {
        $({
            fn apply<T: Scalar>(x: T) -> T {
                let function: fn(T) -> T = $function;
                function(x)
            }
            check_one($name, &$points, apply, $through_duals.then_some(apply), apply);
        })*
    };
}

fn check_one(
    name: &str,
    points: &[f64],
    on_expressions: fn(Expr) -> Expr,
    on_duals_of_expressions: Option<fn(Dual2<Expr>) -> Dual2<Expr>>,
    on_duals: fn(Dual2_64) -> Dual2_64,
) {
    let function = trace(|| {
        let x = Expr::symbol("x");
        let y = on_expressions(x);
        let hessian = hessian_lower(y, &[x]).get(0, 0).unwrap_or(Expr::constant(0.0));
        let sweeps = [y, gradient(y, &[x])[0], hessian];
        let duals = on_duals_of_expressions.map_or(sweeps, |function| {
            let y = function(Dual2::from_re(x).derivative());
            [y.re, y.v1, y.v2]
        });
        Function::builder(name)
            .input("x", &[x])
            .output("sweeps", &sweeps)
            .output("duals", &duals)
            .build()
            .unwrap()
    });
    let mut workspace = function.workspace();
    for &x in points {
        let (mut sweeps, mut duals) = ([0.0; 3], [0.0; 3]);
        function.evaluate(&mut workspace, &[&[x]], &mut [&mut sweeps, &mut duals]);
        let reference = on_duals(Dual2::from_re(x).derivative());
        for (k, reference) in [reference.re, reference.v1, reference.v2].into_iter().enumerate() {
            assert_close(&format!("{name}, derivative {k} by sweeps"), x, sweeps[k], reference);
            assert_close(&format!("{name}, derivative {k} by duals"), x, duals[k], reference);
        }
    }
}

#[test]
fn every_operation_agrees_with_num_dual() {
    let any = [-2.3, -0.4, 0.7, 1.9];
    let positive = [0.2, 0.9, 3.7];
    let unit = [-0.8, -0.1, 0.6];
    check! {
        true;
        "neg": any, |x| -x;
        "sqrt": positive, |x| x.sqrt();
        "cbrt": positive, |x| x.cbrt();
        "exp": any, |x| x.exp();
        "exp2": any, |x| x.exp2();
        "exp_m1": any, |x| x.exp_m1();
        "ln": positive, |x| x.ln();
        "log": positive, |x| x.log(3.0);
        "log2": positive, |x| x.log2();
        "log10": positive, |x| x.log10();
        "ln_1p": positive, |x| x.ln_1p();
        "sin": any, |x| x.sin();
        "cos": any, |x| x.cos();
        "sin_cos": any, |x| { let (s, c) = x.sin_cos(); s * c };
        "tan": unit, |x| x.tan();
        "asin": unit, |x| x.asin();
        "acos": [-0.8, -0.3, 0.6], |x| x.acos();
        "atan": any, |x| x.atan();
        "sinh": any, |x| x.sinh();
        "cosh": any, |x| x.cosh();
        "tanh": any, |x| x.tanh();
        "asinh": any, |x| x.asinh();
        "acosh": [1.5, 2.0, 4.0], |x| x.acosh();
        "atanh": unit, |x| x.atanh();
        "recip": any, |x| x.recip();
        "powi": any, |x| x.powi(5) + x.powi(-3) + x.powi(0) + x.powi(1);
        "powf": positive, |x| x.powf(2.7) + x.powf(0.5) + x.powf(-1.5);
        "powd": positive, |x| (x.sqrt() + 1.0).powd(x.sin());
        "mul": any, |x| (x + 1.5) * (x - 0.5) * x.sin();
        "square": any, |x| x.sin() * x.sin();
        "div": any, |x| x.sin() / (x * x + 1.0) + T::from(2.0) / x + x / 3.0;
        "sub": any, |x| x * 2.0 - x.sin() - x.powi(2);
        "atan2": any, |x| x.sin().atan2(x + 3.0) + (x * 2.0).atan2(x.cos());
        "mul_add": any, |x| x.mul_add(x.sin(), x.cos());
        "select": any, |x| T::select_positive(x - 0.5, x.sin(), x.cos() * x);
        "minimum": any, |x| (x * x).minimum(x + 1.0);
        "maximum": any, |x| (x * x).maximum(x + 1.0);
        "clamped": any, |x| (x * x).clamped(T::from(0.3), T::from(1.0)) * x;
    }
}

#[test]
fn operations_in_which_dual_numbers_branch_agree_with_num_dual() {
    let any = [-2.3, -0.4, 0.7, 1.9];
    check! {
        false;
        "abs": any, |x| x.abs();
        "signum": any, |x| x.signum() * x;
        "sph_j0": any, |x| x.sph_j0();
        "sph_j1": any, |x| x.sph_j1();
        "sph_j2": any, |x| x.sph_j2();
    }
}

#[test]
fn remainder_differentiates_as_a_sawtooth() {
    let function = trace(|| {
        let x = Expr::symbols("x", 2);
        let y = x[0] % x[1];
        Function::builder("remainder")
            .input("x", &x)
            .output("y", &[y])
            .output("gradient", &gradient(y, &x))
            .build()
            .unwrap()
    });
    let mut workspace = function.workspace();
    let (mut y, mut slope) = ([0.0], [0.0; 2]);
    function.evaluate(&mut workspace, &[&[7.5, 2.0]], &mut [&mut y, &mut slope]);
    assert_eq!((y, slope), ([1.5], [1.0, -3.0]));
    function.evaluate(&mut workspace, &[&[-7.5, 2.0]], &mut [&mut y, &mut slope]);
    assert_eq!((y, slope), ([-1.5], [1.0, 3.0]));
}

#[test]
fn the_side_not_taken_spoils_no_derivative() {
    // At x = 0 and below, 1/x and √x are infinite or NaN together with their derivatives.
    fn guarded<T: Scalar>(x: T) -> T {
        let root = x.sqrt();
        let inner = T::select_positive(x - 4.0, root * x, root / x);
        T::select_positive(x, inner + root, x * 2.0) + T::select_positive(x - 9.0, x.ln(), x)
    }
    let function = trace(|| {
        let x = Expr::symbol("x");
        let y = guarded(x);
        let slope = gradient(y, &[x])[0];
        let curvature = hessian_lower(y, &[x]).get(0, 0).unwrap();
        Function::builder("guarded")
            .input("x", &[x])
            .output("y", &[y, slope, curvature])
            .build()
            .unwrap()
    });
    let mut workspace = function.workspace();
    for x in [-3.0, 0.0, 1.0, 5.0, 16.0] {
        let mut ours = [0.0; 3];
        function.evaluate(&mut workspace, &[&[x]], &mut [&mut ours]);
        let reference = guarded(Dual2_64::from_re(x).derivative());
        for (ours, reference) in ours.into_iter().zip([reference.re, reference.v1, reference.v2]) {
            assert_close("guarded", x, ours, reference);
        }
    }
}

/// A value that many branches use is differentiated once, whatever the number of branches.
#[test]
fn branches_that_share_a_value_share_its_adjoint() {
    fn branches<T: Scalar>(x: T, count: i32) -> T {
        let shared = (0..20).fold(x, |value, _| (value * value + 1.0).ln() + x.recip());
        (0..count).fold(T::from(0.0), |sum, k| {
            let taken = shared * T::from(f64::from(k));
            sum + T::select_positive(x - f64::from(k), taken, T::from(0.0))
        })
    }
    let nodes = |count| {
        trace(|| {
            let x = Expr::symbol("x");
            let value = branches(x, count);
            let before = Graph::node_count();
            gradient(value, &[x]);
            Graph::node_count() - before
        })
    };
    let (few, many) = (nodes(2), nodes(40));
    assert!(many <= few + 5 * 40, "{few} nodes for 2 branches, {many} for 40");

    let function = trace(|| {
        let x = Expr::symbol("x");
        let slope = gradient(branches(x, 5), &[x]);
        Function::builder("branches").input("x", &[x]).output("slope", &slope).build().unwrap()
    });
    for x in [-1.0, 0.0, 0.5, 2.5, 7.0] {
        let mut slope = [0.0];
        function.evaluate(&mut function.workspace(), &[&[x]], &mut [&mut slope]);
        let reference = branches(Dual64::new(x, 1.0), 5).eps;
        assert_close("branches", x, slope[0], reference);
    }
}
