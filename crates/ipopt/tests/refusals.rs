//! What is refused before Ipopt sees it, and what is said then.

mod support;

use righting_ipopt::*;
use support::hock_schittkowski::*;
use support::quadratic::Projection;

const INF: f64 = f64::INFINITY;

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
fn no_variables() {
    assert_eq!(error(&mut Projection::of(&[]), at(&[])), "the problem has no variables");
}

#[test]
fn a_start_of_the_wrong_size() {
    assert_eq!(
        error(&mut Dense(Hs071), at(&[1.0; 3])),
        "3 entries of the start where the problem needs 4"
    );
}

#[test]
fn a_start_that_is_no_number() {
    assert_eq!(
        error(&mut Dense(Hs071), at(&[1.0, f64::NAN, 1.0, 1.0])),
        "entry 1 of the start is NaN; a finite number is allowed"
    );
    assert_eq!(
        error(&mut Dense(Hs071), at(&[1.0, 1.0, 1.0, -INF])),
        "entry 3 of the start is -inf; a finite number is allowed"
    );
}

#[test]
fn multipliers_that_do_not_fit() {
    let fitting =
        || Multipliers { constraints: vec![0.0; 2], lower: vec![0.0; 4], upper: vec![0.0; 4] };
    let start = |multipliers| Start { x: vec![1.0; 4], multipliers: Some(multipliers) };
    assert_eq!(
        error(&mut Dense(Hs071), start(Multipliers { constraints: vec![], ..fitting() })),
        "0 entries of the constraint multipliers where the problem needs 2"
    );
    assert_eq!(
        error(&mut Dense(Hs071), start(Multipliers { upper: vec![INF; 4], ..fitting() })),
        "entry 0 of the upper bound multipliers is inf; a finite number is allowed"
    );
}

#[test]
fn a_structure_outside_of_its_matrix() {
    let constrained = || Projection::of(&[0.0, 0.0]).subject_to(&[(1, 1.0)], (0.0, 1.0));

    let mut problem = constrained();
    problem.jacobian.columns[0] = 2;
    assert_eq!(
        error(&mut problem, at(&[0.0; 2])),
        "entry 0 of the Jacobian structure, at (0, 2), is outside of the 1 × 2 matrix"
    );

    let mut problem = constrained();
    problem.jacobian.rows[0] = -1;
    assert!(error(&mut problem, at(&[0.0; 2])).contains("(-1, 1)"));

    let mut problem = Projection::of(&[0.0, 0.0]);
    problem.jacobian = TripletStructure { rows: vec![0], columns: vec![0] };
    assert!(error(&mut problem, at(&[0.0; 2])).contains("outside of the 0 × 2 matrix"));

    let mut problem = constrained();
    problem.hessian.rows[1] = 2;
    assert_eq!(
        error(&mut problem, at(&[0.0; 2])),
        "entry 1 of the Hessian structure, at (2, 1), is outside of the 2 × 2 matrix"
    );
}

#[test]
fn a_structure_of_two_lengths() {
    let mut problem = Projection::of(&[0.0, 0.0]);
    problem.hessian.columns.pop();
    assert_eq!(
        error(&mut problem, at(&[0.0; 2])),
        "the Hessian structure has 2 row indices but 1 column indices"
    );
}

#[test]
fn an_entry_in_the_upper_triangle() {
    let mut problem = Projection::of(&[0.0, 0.0]);
    problem.hessian = TripletStructure { rows: vec![0, 0], columns: vec![0, 1] };
    assert_eq!(
        error(&mut problem, at(&[0.0; 2])),
        "entry 1 of the Hessian structure, at (0, 1), is in the upper triangle"
    );
}

#[test]
fn bounds_that_nothing_lies_between() {
    let variable =
        |lower, upper| error(&mut Projection::of(&[0.0]).within(&[(lower, upper)]), at(&[0.0]));
    assert_eq!(variable(1.0, -1.0), "variable 0 cannot lie between 1 and -1");
    assert_eq!(variable(f64::NAN, 1.0), "variable 0 cannot lie between NaN and 1");
    assert_eq!(variable(0.0, f64::NAN), "variable 0 cannot lie between 0 and NaN");
    assert_eq!(variable(INF, INF), "variable 0 cannot lie between inf and inf");
    assert_eq!(variable(-INF, -INF), "variable 0 cannot lie between -inf and -inf");

    let mut problem = Projection::of(&[0.0])
        .subject_to(&[(0, 1.0)], (0.0, 1.0))
        .subject_to(&[(0, 1.0)], (3.0, 2.0));
    assert_eq!(error(&mut problem, at(&[0.0])), "constraint 1 cannot lie between 3 and 2");
}

#[test]
fn scaling_that_does_not_fit() {
    let message = |scaling| {
        let mut problem = Projection::of(&[0.0]).subject_to(&[(0, 1.0)], (0.0, 1.0));
        problem.scaling = Some(scaling);
        error(&mut problem, at(&[0.0]))
    };
    assert_eq!(
        message(Scaling { objective: 0.0, x: None, g: None }),
        "entry 0 of the objective scaling is 0; a finite number other than zero is allowed"
    );
    assert_eq!(
        message(Scaling { objective: 1.0, x: Some(vec![-1.0]), g: None }),
        "entry 0 of the variable scaling is -1; a finite positive number is allowed"
    );
    assert_eq!(
        message(Scaling { objective: 1.0, x: None, g: Some(vec![]) }),
        "0 entries of the constraint scaling where the problem needs 1"
    );
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

#[cfg(not(ipopt_ma57_slot))]
#[test]
fn a_linear_solver_for_an_ipopt_that_takes_none() {
    let mut own = support::bunch_kaufman::BunchKaufman::default();
    let go_on = |_: &Iteration| Control::Continue;
    let outcome =
        solve_with(&mut Dense(Hs006), &Options::default(), &at(Hs006::START), &mut own, go_on);
    assert!(matches!(outcome, Err(SolveError::NoLinearSolverSlot)));
}
