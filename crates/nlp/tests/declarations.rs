//! What is refused before an optimizer sees it, and what is said then.

use righting_nlp::*;

const INF: f64 = f64::INFINITY;

/// Declares what it is told to, and is defined nowhere.
#[derive(Clone, Default)]
struct Declared {
    x_bounds: Vec<(f64, f64)>,
    g_bounds: Vec<(f64, f64)>,
    jacobian: TripletStructure,
    hessian: TripletStructure,
    scaling: Option<Scaling>,
}

impl Declared {
    /// Two variables without bounds and one constraint on the second.
    fn constrained() -> Self {
        Self {
            x_bounds: vec![(-INF, INF); 2],
            g_bounds: vec![(0.0, 1.0)],
            jacobian: triplets(&[(0, 1)]),
            hessian: triplets(&[(0, 0), (1, 1)]),
            scaling: None,
        }
    }
}

impl Problem for Declared {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: self.x_bounds.len(), constraints: self.g_bounds.len() }
    }
    fn bounds(&self, bounds: &mut Bounds) {
        for (i, (lower, upper)) in self.x_bounds.iter().enumerate() {
            (bounds.x_lower[i], bounds.x_upper[i]) = (*lower, *upper);
        }
        for (i, (lower, upper)) in self.g_bounds.iter().enumerate() {
            (bounds.g_lower[i], bounds.g_upper[i]) = (*lower, *upper);
        }
    }
    fn jacobian_structure(&self) -> TripletStructure {
        self.jacobian.clone()
    }
    fn hessian_structure(&self) -> TripletStructure {
        self.hessian.clone()
    }
    fn objective(&mut self, _: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Err(EvaluationError)
    }
    fn gradient(&mut self, _: &[f64], _: bool, _: &mut [f64]) -> Result<(), EvaluationError> {
        Err(EvaluationError)
    }
    fn hessian(
        &mut self,
        _: &[f64],
        _: bool,
        _: f64,
        _: &[f64],
        _: bool,
        _: &mut [f64],
    ) -> Result<(), EvaluationError> {
        Err(EvaluationError)
    }
    fn scaling(&self) -> Option<Scaling> {
        self.scaling.clone()
    }
}

fn triplets(entries: &[(i32, i32)]) -> TripletStructure {
    let (rows, columns) = entries.iter().copied().unzip();
    TripletStructure { rows, columns }
}

fn error(problem: &Declared) -> String {
    Declarations::of(problem).unwrap_err().to_string()
}

#[test]
fn what_is_well_declared_is_taken_as_it_is() {
    let declared = Declarations::of(&Declared::constrained()).unwrap();
    assert_eq!((declared.variables, declared.constraints), (2, 1));
    assert_eq!((declared.x_lower, declared.g_upper), (vec![-INF; 2], vec![1.0]));
    assert_eq!((declared.jacobian.rows, declared.jacobian.columns), (vec![0], vec![1]));
    assert_eq!(declared.hessian.len(), 2);
}

#[test]
fn no_variables() {
    assert_eq!(error(&Declared::default()), "found no variables, expected at least one");
}

#[test]
fn a_structure_outside_of_its_matrix() {
    let problem = Declared { jacobian: triplets(&[(0, 2)]), ..Declared::constrained() };
    assert_eq!(
        error(&problem),
        "Jacobian structure, entry 0: found (0, 2), expected an entry of a 1 × 2 matrix"
    );
    let problem = Declared { jacobian: triplets(&[(-1, 1)]), ..Declared::constrained() };
    assert!(error(&problem).contains("(-1, 1)"));
    let problem = Declared { g_bounds: vec![], ..Declared::constrained() };
    assert!(error(&problem).contains("expected an entry of a 0 × 2 matrix"));
    let problem = Declared { hessian: triplets(&[(0, 0), (2, 1)]), ..Declared::constrained() };
    assert_eq!(
        error(&problem),
        "Hessian structure, entry 1: found (2, 1), expected an entry of a 2 × 2 matrix"
    );
}

#[test]
fn a_structure_of_two_lengths() {
    let mut problem = Declared::constrained();
    problem.hessian.columns.pop();
    assert_eq!(
        error(&problem),
        "Hessian structure: found 2 row indices and 1 column indices, expected as many"
    );
}

#[test]
fn an_entry_in_the_upper_triangle() {
    let problem = Declared { hessian: triplets(&[(0, 0), (0, 1)]), ..Declared::constrained() };
    assert_eq!(
        error(&problem),
        "Hessian structure, entry 1: found (0, 1), expected the lower triangle"
    );
}

#[test]
fn bounds_that_nothing_lies_between() {
    let variable = |lower, upper| {
        error(&Declared { x_bounds: vec![(lower, upper); 2], ..Declared::constrained() })
    };
    let expect = |message: String, found: &str| {
        let rest = ", expected lower ≤ upper, and a finite number between them";
        assert_eq!(message, format!("{found}{rest}"));
    };
    expect(variable(1.0, -1.0), "bounds of variable 0: found [1, -1]");
    expect(variable(f64::NAN, 1.0), "bounds of variable 0: found [NaN, 1]");
    expect(variable(0.0, f64::NAN), "bounds of variable 0: found [0, NaN]");
    expect(variable(INF, INF), "bounds of variable 0: found [inf, inf]");
    expect(variable(-INF, -INF), "bounds of variable 0: found [-inf, -inf]");
    let problem = Declared { g_bounds: vec![(0.0, 1.0), (3.0, 2.0)], ..Declared::constrained() };
    expect(error(&problem), "bounds of constraint 1: found [3, 2]");
}

#[test]
fn scaling_that_does_not_fit() {
    let message = |scaling| error(&Declared { scaling: Some(scaling), ..Declared::constrained() });
    assert_eq!(
        message(Scaling { objective: 0.0, x: None, g: None }),
        "objective scaling, entry 0: found 0, expected a finite number other than zero"
    );
    assert_eq!(
        message(Scaling { objective: 1.0, x: Some(vec![1.0, -1.0]), g: None }),
        "variable scaling, entry 1: found -1, expected a finite positive number"
    );
    assert_eq!(
        message(Scaling { objective: 1.0, x: None, g: Some(vec![]) }),
        "constraint scaling: found 0 entries, expected 1"
    );
}

#[test]
fn starts_that_do_not_fit() {
    let declared = Declarations::of(&Declared::constrained()).unwrap();
    let message = |start: Start| declared.check_start(&start).unwrap_err().to_string();
    assert_eq!(message(Start::at(vec![1.0; 3])), "start: found 3 entries, expected 2");
    assert_eq!(
        message(Start::at(vec![1.0, f64::NAN])),
        "start, entry 1: found NaN, expected a finite number"
    );
    assert_eq!(
        message(Start::at(vec![-INF, 1.0])),
        "start, entry 0: found -inf, expected a finite number"
    );
    let fitting =
        || Multipliers { constraints: vec![0.0; 1], lower: vec![0.0; 2], upper: vec![0.0; 2] };
    let warm = |multipliers| Start { x: vec![1.0; 2], multipliers: Some(multipliers) };
    declared.check_start(&warm(fitting())).unwrap();
    assert_eq!(
        message(warm(Multipliers { constraints: vec![], ..fitting() })),
        "constraint multipliers: found 0 entries, expected 1"
    );
    assert_eq!(
        message(warm(Multipliers { upper: vec![INF; 2], ..fitting() })),
        "upper bound multipliers, entry 0: found inf, expected a finite number"
    );
}

#[test]
fn a_problem_with_constraints_is_defined_nowhere_without_their_methods() {
    let mut problem = Declared::constrained();
    assert_eq!(problem.constraints(&[0.0; 2], true, &mut [0.0]), Err(EvaluationError));
    assert_eq!(problem.jacobian(&[0.0; 2], false, &mut [0.0]), Err(EvaluationError));
    assert_eq!(problem.constraints(&[0.0; 2], true, &mut []), Ok(()));
    assert_eq!(problem.jacobian(&[0.0; 2], false, &mut []), Ok(()));
}

#[test]
fn violations_are_the_largest_and_unknown_where_a_value_is() {
    let problem = Declared { x_bounds: vec![(0.0, 1.0); 2], ..Declared::constrained() };
    let declared = Declarations::of(&problem).unwrap();
    assert_eq!(declared.violation(&[0.5, 1.5], &[-2.0]), 2.0);
    assert_eq!(declared.violation(&[0.5, 1.0], &[1.0]), 0.0);
    assert!(declared.violation(&[0.5, 1.0], &[f64::NAN]).is_nan());
}
