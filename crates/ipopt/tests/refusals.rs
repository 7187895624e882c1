//! What is refused before Ipopt sees it, and what is said then.

mod support;

use righting_ipopt::*;
use support::hock_schittkowski::*;
use support::quadratic::Projection;

fn error(problem: &mut impl Problem, start: Start) -> String {
    error_with(problem, &Options::default(), start)
}

fn error_with(problem: &mut impl Problem, options: &Options, start: Start) -> String {
    solve(problem, options, &start, |_| Control::Continue).unwrap_err().to_string()
}

fn at(x: &[f64]) -> Start {
    Start::at(x.to_vec())
}

#[test]
fn declarations_options_and_starts_that_no_optimizer_can_use() {
    assert_eq!(
        error(&mut Projection::of(&[]), at(&[])),
        "found no variables, expected at least one"
    );
    assert_eq!(error(&mut Dense(Hs071), at(&[1.0; 3])), "start: found 3 entries, expected 4");
    let mut problem = Projection::of(&[0.0, 0.0]);
    problem.hessian.rows[1] = 2;
    assert_eq!(
        error(&mut problem, at(&[0.0; 2])),
        "Hessian structure, entry 1: found (2, 1), expected an entry of a 2 × 2 matrix"
    );
    let options = Options { tolerance: 0.0, ..Options::default() };
    let message = error_with(&mut Dense(Hs071), &options, at(Hs071::START));
    assert!(message.contains("`tolerance`"), "{message}");
}

#[test]
fn options_that_ipopt_does_not_take() {
    let message = |name: &str, value: OptionValue| {
        let options = Options { extra: vec![(name.to_owned(), value)], ..Options::default() };
        error_with(&mut Dense(Hs071), &options, at(Hs071::START))
    };
    let text = |value: &str| OptionValue::Text(value.to_owned());
    assert_eq!(
        message("no_such_option", OptionValue::Number(1.0)),
        "Ipopt refuses the option `no_such_option` = 1.0"
    );
    assert_eq!(message("recalc_y", text("maybe")), "Ipopt refuses the option `recalc_y` = maybe");
    assert_eq!(
        message("recalc_y", OptionValue::Integer(1)),
        "Ipopt refuses the option `recalc_y` = 1"
    );
    assert_eq!(
        message("kappa_d", OptionValue::Number(-1.0)),
        "Ipopt refuses the option `kappa_d` = -1.0"
    );
    assert_eq!(message("a\0b", text("")), "option name or value \"a\\0b\" has a zero byte");
}

#[test]
fn options_that_contradict_each_other_are_a_status() {
    let extra = vec![
        ("mehrotra_algorithm".to_owned(), OptionValue::Text("yes".to_owned())),
        ("adaptive_mu_globalization".to_owned(), OptionValue::Text("kkt-error".to_owned())),
    ];
    let options = Options { extra, ..Options::default() };
    let solution = support::solve_from(&mut Dense(Hs071), Hs071::START, &options);
    assert_eq!(solution.status, Status::InvalidOption);
    assert_eq!(solution.x, Hs071::START);
    assert_eq!(solution.objective, Hs071::objective(Hs071::START));
}

#[test]
fn a_solve_within_a_solve() {
    let mut inner = None;
    let start = at(Hs071::START);
    let solution = solve(&mut Dense(Hs071), &Options::default(), &start, |_| {
        let go_on = |_: &Iteration| Control::Continue;
        inner = Some(solve(&mut Dense(Hs006), &Options::default(), &at(Hs006::START), go_on));
        Control::Stop
    });
    assert_eq!(solution.unwrap().status, Status::UserStop);
    assert!(matches!(inner, Some(Err(SolveError::Nested))));
    // And it is over afterwards.
    support::solve_from(&mut Dense(Hs006), Hs006::START, &Options::default());
}
