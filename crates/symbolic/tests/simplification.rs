//! Construction: one handle for one expression, and the algebra that needs no evaluation.

use num_dual::DualNum;
use num_traits::{One, Signed, Zero};
use righting_scalar::Scalar;
use righting_symbolic::{Expr, Graph, gradient, trace};

fn assert_same(left: Expr, right: Expr) {
    assert!(left.is_same(right), "{left} is not {right}");
}

#[test]
fn the_same_expression_is_the_same_handle() {
    trace(|| {
        let [x, y] = ["x", "y"].map(Expr::symbol);
        assert_same(x * y + x.sin(), x.sin() + y * x);
        assert_same((x + y).sqrt(), (y + x).sqrt());
        assert!(!(x - y).is_same(y - x));
        assert!(!Expr::symbol("x").is_same(x), "two symbols of one name are two symbols");
        let count = Graph::node_count();
        let _again = x * y + x.sin();
        assert_eq!(Graph::node_count(), count, "nothing new");
    });
}

#[test]
fn neutral_and_absorbing_elements_vanish() {
    trace(|| {
        let x = Expr::symbol("x");
        let (zero, one) = (Expr::zero(), Expr::one());
        for same in [x + zero, zero + x, x - 0.0, x * one, one * x, x / one, -(-x), x.powi(1)] {
            assert_same(same, x);
        }
        for nothing in [x * zero, zero * x, x - x, zero / x, x + -x] {
            assert_eq!(nothing.as_constant(), Some(0.0));
        }
        for unity in [x / x, x.powi(0), x.powf(0.0)] {
            assert_eq!(unity.as_constant(), Some(1.0));
        }
        assert!(zero.is_zero() && one.is_one() && !x.is_zero() && !x.is_one());
    });
}

#[test]
fn signs_move_outward_and_are_absorbed() {
    trace(|| {
        let [x, y] = ["x", "y"].map(Expr::symbol);
        assert_same(x + -y, x - y);
        assert_same(-x + y, y - x);
        assert_same(x - -y, x + y);
        assert_same(-x * y, -(x * y));
        assert_same(-x * -y, x * y);
        assert_same(x * -1.0, -x);
        assert_same(-x / y, -(x / y));
        assert_same((-x) * 3.0, x * -3.0);
        assert_same((-x).sin(), -x.sin());
        assert_same((-x).cos(), x.cos());
        assert_same((-x).abs(), x.abs());
        let difference = x - y;
        assert_same(y - x, -difference);
    });
}

#[test]
fn constants_gather() {
    trace(|| {
        let x = Expr::symbol("x");
        assert_same((x * 2.0) * 3.0, x * 6.0);
        assert_same(x + x, x * 2.0);
        assert_same(x / 4.0, x * 0.25);
        assert!(!(x / 3.0).is_same(x * (1.0 / 3.0)), "only where it rounds alike");
        assert_eq!((Expr::constant(2.0).sqrt() * 3.0).as_constant(), Some(2.0_f64.sqrt() * 3.0));
        assert_same(Expr::select_positive(Expr::constant(1.0), x, -x), x);
        assert_same(Expr::select_positive(Expr::constant(f64::NAN), x, -x), -x);
        assert_same(Expr::select_positive(x, x, x), x);
    });
}

#[test]
fn powers_become_products() {
    trace(|| {
        let x = Expr::symbol("x");
        assert_same(x.powi(2), x * x);
        assert_same(x.powf(2.0), x * x);
        assert_same(x.powi(-1), x.recip());
        assert_same(x.powf(0.5), x.sqrt());
    });
}

#[test]
fn derivatives_are_simple_too() {
    trace(|| {
        let [x, y] = ["x", "y"].map(Expr::symbol);
        let derivatives = gradient(x * y - y * 3.0, &[x, y]);
        assert_same(derivatives[0], y);
        assert_same(derivatives[1], x - 3.0);
        // With respect to an inner expression: a node like any other.
        let inner = x * y;
        assert_same(gradient(inner.sin() * 2.0, &[inner])[0], inner.cos() * 2.0);
        let branch = Expr::select_positive(y, inner * x, x);
        let expected = Expr::select_positive(y, x, Expr::zero());
        assert_same(gradient(branch, &[inner])[0], expected);
    });
}

#[test]
fn formulas_print() {
    trace(|| {
        let [x, y] = ["x", "y"].map(Expr::symbol);
        assert_eq!((x * y + 2.0).to_string(), "((x * y) + 2)");
        assert_eq!(
            Expr::select_positive(x, y, -y.sin()).to_string(),
            "select_positive(x, y, -(sin(y)))"
        );
        assert_eq!(x.symbol_name().as_deref(), Some("x"));
        let deep = (0..100).fold(x, |sum, _| (sum + y).sin());
        assert!(deep.to_string().contains('…'));
    });
}
