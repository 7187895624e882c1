//! What goes wrong says so.

use std::panic::{AssertUnwindSafe, catch_unwind};

use num_dual::{Dual, DualNum};
use righting_scalar::Scalar;
use righting_symbolic::{Expr, Function, FunctionError, Graph, Sparsity, gradient, trace};

/// The message of a panic.
fn panic_message<R>(work: impl FnOnce() -> R) -> String {
    let payload = catch_unwind(AssertUnwindSafe(work)).err().expect("a panic");
    match payload.downcast::<String>() {
        Ok(message) => *message,
        Err(payload) => (*payload.downcast::<&str>().expect("a message")).to_owned(),
    }
}

#[test]
fn a_free_symbol_is_named() {
    let error = trace(|| {
        let [x, mass, length] = ["x", "mass", "length"].map(Expr::symbol);
        Function::builder("pendulum").input("x", &[x]).output("y", &[x * mass / length]).build()
    })
    .unwrap_err();
    let symbols = vec!["mass".to_owned(), "length".to_owned()];
    assert_eq!(error, FunctionError::FreeSymbols { function: "pendulum".to_owned(), symbols });
    assert!(error.to_string().contains("mass, length"), "{error}");
}

#[test]
fn ports_must_differ_in_name() {
    let error = trace(|| {
        let x = Expr::symbols("x", 2);
        Function::builder("f").input("x", &x[..1]).input("x", &x[1..]).output("y", &x).build()
    });
    assert!(matches!(error, Err(FunctionError::DuplicatePort { port, .. }) if port == "x"));
    let fine = trace(|| {
        let x = Expr::symbol("x");
        Function::builder("f").input("x", &[x]).output("x", &[x * x]).build()
    });
    assert!(fine.is_ok(), "an input and an output may share a name");
}

#[test]
fn inputs_must_be_distinct_symbols() {
    trace(|| {
        let x = Expr::symbols("x", 2);
        let build =
            |inputs: &[Expr]| Function::builder("f").input("x", inputs).build().unwrap_err();
        assert!(matches!(
            build(&[x[0], x[0] + x[1]]),
            FunctionError::InputNotSymbol { index: 1, .. }
        ));
        assert!(matches!(
            build(&[x[0], x[1], x[0]]),
            FunctionError::DuplicateInput { index: 2, symbol, .. } if symbol == "x[0]"
        ));
    });
}

#[test]
fn comparing_tells_what_to_use_instead() {
    trace(|| {
        let x = Expr::symbol("x");
        for message in [
            panic_message(|| x > Expr::constant(0.0)),
            panic_message(|| x < 1.0),
            panic_message(|| x == Expr::symbol("x")),
            panic_message(|| num_dual::DualStruct::re(&x)),
            panic_message(|| num_traits::Signed::is_negative(&x)),
            panic_message(|| num_traits::Signed::abs(&Dual::new(x, x))),
        ] {
            assert!(message.contains("select_positive"), "{message}");
        }
        assert!(Expr::constant(1.0) < Expr::constant(2.0));
        assert!(Expr::constant(1.0) == 1.0);
        assert!(x == x, "an expression equals itself");
        assert_eq!(x.partial_cmp(&x), Some(std::cmp::Ordering::Equal));
        assert!(Expr::constant(1.0).maximum(Expr::constant(2.0)) == 2.0);
    });
}

#[test]
fn expressions_stay_in_their_scope() {
    let no_scope = panic_message(|| Expr::constant(1.0));
    assert!(no_scope.contains("Graph::scope"), "{no_scope}");

    let _outer = Graph::scope();
    let x = Expr::symbol("x");
    let leaked = {
        let _inner = Graph::scope();
        let hidden = panic_message(|| x + 1.0);
        assert!(hidden.contains("outside the graph scope"), "{hidden}");
        Expr::symbol("y")
    };
    assert!(panic_message(|| gradient(leaked, &[x])).contains("outside the graph scope"));
    // The outer scope is whole again.
    assert_eq!((x - x).as_constant(), Some(0.0));
    let elsewhere = std::thread::scope(|threads| {
        threads.spawn(|| panic_message(|| trace(|| x.sin()))).join().unwrap()
    });
    assert!(elsewhere.contains("outside the graph scope"), "{elsewhere}");
}

#[test]
fn workspaces_and_slices_must_fit() {
    let square = |name: &str| {
        trace(|| {
            let x = Expr::symbol("x");
            Function::builder(name).input("x", &[x]).output("y", &[x * x]).build().unwrap()
        })
    };
    let (first, second) = (square("first"), square("second"));
    let mut workspace = first.workspace();
    let foreign = panic_message(|| second.evaluate_block(&mut workspace));
    assert!(foreign.contains("first") && foreign.contains("second"), "{foreign}");
    let short = panic_message(|| first.evaluate(&mut first.workspace(), &[&[]], &mut [&mut [0.0]]));
    assert!(short.contains("length of input x"), "{short}");
    let missing = panic_message(|| first.evaluate(&mut first.workspace(), &[&[1.0]], &mut []));
    assert!(missing.contains("number of outputs"), "{missing}");
}

#[test]
fn a_pattern_refuses_entries_outside() {
    assert!(Sparsity::new(2, 3, [(1, 2), (2, 0)]).is_none());
    let pattern = Sparsity::new(2, 3, [(1, 2), (0, 1), (1, 2)]).unwrap();
    assert_eq!(pattern.iter().collect::<Vec<_>>(), [(0, 1), (1, 2)]);
    assert_eq!((pattern.position(1, 2), pattern.position(0, 0)), (Some(1), None));
}
