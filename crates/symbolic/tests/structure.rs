//! Sparsity patterns are exact, and derivatives of known matrices have their entries.

use num_dual::DualNum;
use righting_symbolic::{Expr, Function, Sparsity, hessian_lower, jacobian, trace};

#[test]
fn a_banded_jacobian_has_its_band_only() {
    trace(|| {
        let x = Expr::symbols("x", 8);
        let rows: Vec<Expr> = x.windows(3).map(|x| x[0] * x[1].sin() - x[2]).collect();
        let jacobian = jacobian(&rows, &x);
        let band = (0..6).flat_map(|row| (row..row + 3).map(move |col| (row, col)));
        assert_eq!(*jacobian.sparsity(), Sparsity::new(6, 8, band).unwrap());
        assert_eq!(jacobian.get(2, 4).and_then(Expr::as_constant), Some(-1.0));
        assert!(jacobian.get(2, 2).unwrap().is_same(x[3].sin()));
        assert!(jacobian.get(0, 5).is_none());
    });
}

/// Many outputs of one input, and one output of many inputs: the two sweeps.
#[test]
fn tall_and_wide_jacobians_agree_with_their_formulas() {
    trace(|| {
        let x = Expr::symbol("x");
        let powers: Vec<Expr> = (1..6).map(|n| x.powi(n)).collect();
        let tall = jacobian(&powers, &[x]);
        assert_eq!(*tall.sparsity(), Sparsity::dense(5, 1));
        assert_eq!(tall.values[0].as_constant(), Some(1.0));
        let y = Expr::symbols("y", 5);
        let product: Expr = y.iter().product();
        let wide = jacobian(&[product], &y);
        assert_eq!(*wide.sparsity(), Sparsity::dense(1, 5));
    });
}

#[test]
fn a_hessian_knows_what_is_linear_and_what_is_separable() {
    trace(|| {
        let x = Expr::symbols("x", 5);
        // Linear in x₃, without x₄, bilinear in (x₀, x₁), x₂ by itself.
        let scalar = x[0] * x[1] + x[2].cos() + x[3] * 5.0;
        let hessian = hessian_lower(scalar, &x);
        assert_eq!(hessian.sparsity().iter().collect::<Vec<_>>(), [(1, 0), (2, 2)]);
        assert_eq!(hessian.get(1, 0).and_then(Expr::as_constant), Some(1.0));
        assert!(hessian.get(2, 2).unwrap().is_same(-x[2].cos()));
    });
}

#[test]
fn the_hessian_of_a_quadratic_form_is_its_matrix() {
    let matrix = [[4.0, 1.0, -2.0], [1.0, 3.0, 0.5], [-2.0, 0.5, 9.0]];
    trace(|| {
        let x = Expr::symbols("x", 3);
        let form: Expr = (0..3)
            .flat_map(|row| (0..3).map(move |col| (row, col)))
            .map(|(row, col)| x[row] * x[col] * (0.5 * matrix[row][col]))
            .sum();
        for (row, col, value) in hessian_lower(form, &x).iter() {
            assert!(row >= col);
            assert_eq!(value.as_constant(), Some(matrix[row][col]));
        }
    });
}

#[test]
fn ports_carry_names_lengths_and_patterns() {
    let function = trace(|| {
        let x = Expr::symbols("x", 3);
        let values = [x[0] * x[1], x[1] + x[2]];
        Function::builder("ports")
            .input("x", &x)
            .input("unused", &Expr::symbols("u", 2))
            .output("values", &values)
            .output_sparse("jacobian", &jacobian(&values, &x))
            .output("nothing", &[])
            .build()
            .unwrap()
    });
    let names = |ports: &[righting_symbolic::Port]| {
        ports.iter().map(|port| (port.name().to_owned(), port.len())).collect::<Vec<_>>()
    };
    let expected = [("x", 3), ("unused", 2)].map(|(name, len)| (name.to_owned(), len));
    assert_eq!(names(function.input_ports()), expected);
    let expected = [("values", 2), ("jacobian", 4), ("nothing", 0)];
    assert_eq!(names(function.output_ports()), expected.map(|(name, len)| (name.to_owned(), len)));
    assert!(function.output_ports()[0].sparsity().is_none());
    let pattern = function.output_ports()[1].sparsity().unwrap();
    assert_eq!(pattern.iter().collect::<Vec<_>>(), [(0, 0), (0, 1), (1, 1), (1, 2)]);
}

#[test]
fn a_tape_can_be_read() {
    let function = trace(|| {
        let x = Expr::symbol("x");
        Function::builder("tape")
            .input("x", &[x])
            .output("y", &[x.sin() * x.cos() + 2.0, x])
            .build()
            .unwrap()
    });
    let tape = function.to_string();
    assert!(tape.contains("sin_cos in[0]") && tape.contains("out[1] = copy in[0]"), "{tape}");
    assert_eq!(function.instruction_count(), 4);
    assert_eq!(function.instruction_kinds().iter().map(|(_, count)| count).sum::<usize>(), 4);
    assert!(format!("{function:?}").contains("\"tape\""));
}
