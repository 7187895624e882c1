//! What must hold before an optimizer may see a problem: Ipopt checks little of this itself.

use crate::{
    Bounds, Dimensions, MatrixName, Multipliers, NlpError, Problem, Scaling, Start,
    TripletStructure, VectorName,
};

/// A problem's declarations, checked: what a solver may rely on.
#[derive(Debug, Clone)]
pub struct Declarations {
    /// n
    pub variables: usize,
    /// m
    pub constraints: usize,
    /// Least values of the variables (n).
    pub x_lower: Vec<f64>,
    /// Greatest values of the variables (n), none below the least.
    pub x_upper: Vec<f64>,
    /// Least values of the constraints (m).
    pub g_lower: Vec<f64>,
    /// Greatest values of the constraints (m), none below the least.
    pub g_upper: Vec<f64>,
    /// Where ∂g/∂x may be nonzero, within m rows and n columns.
    pub jacobian: TripletStructure,
    /// Where the Lagrangian's Hessian may be nonzero, within the lower triangle.
    pub hessian: TripletStructure,
    /// The problem's own scaling.
    pub scaling: Option<Scaling>,
}

impl Declarations {
    /// Asks the problem and checks its answers.
    ///
    /// # Errors
    /// [`NlpError`] for what an optimizer would refuse, or read beyond.
    pub fn of<P: Problem + ?Sized>(problem: &P) -> Result<Self, NlpError> {
        let Dimensions { variables, constraints } = problem.dimensions();
        if variables == 0 {
            return Err(NlpError::NoVariables);
        }
        check_count("variables", variables)?;
        check_count("constraints", constraints)?;

        let mut declarations = Self {
            variables,
            constraints,
            x_lower: vec![f64::NEG_INFINITY; variables],
            x_upper: vec![f64::INFINITY; variables],
            g_lower: vec![f64::NEG_INFINITY; constraints],
            g_upper: vec![f64::INFINITY; constraints],
            jacobian: problem.jacobian_structure(),
            hessian: problem.hessian_structure(),
            scaling: problem.scaling(),
        };
        problem.bounds(&mut Bounds {
            x_lower: &mut declarations.x_lower,
            x_upper: &mut declarations.x_upper,
            g_lower: &mut declarations.g_lower,
            g_upper: &mut declarations.g_upper,
        });
        declarations.check()?;
        Ok(declarations)
    }

    fn check(&self) -> Result<(), NlpError> {
        check_bounds(VectorName::Variable, &self.x_lower, &self.x_upper)?;
        check_bounds(VectorName::Constraint, &self.g_lower, &self.g_upper)?;
        check_structure(MatrixName::Jacobian, &self.jacobian, self.constraints, self.variables)?;
        check_structure(MatrixName::Hessian, &self.hessian, self.variables, self.variables)?;
        check_lower_triangle(&self.hessian)?;
        if let Some(Scaling { objective, x, g }) = &self.scaling {
            check_factor(*objective)?;
            if let Some(x) = x {
                check_factors(VectorName::VariableScaling, x, self.variables)?;
            }
            if let Some(g) = g {
                check_factors(VectorName::ConstraintScaling, g, self.constraints)?;
            }
        }
        Ok(())
    }

    /// Checks that a start fits the problem, and is made of finite numbers.
    ///
    /// # Errors
    /// [`NlpError`] where it does not.
    pub fn check_start(&self, start: &Start) -> Result<(), NlpError> {
        check_finite(VectorName::Start, &start.x, self.variables)?;
        if let Some(Multipliers { constraints, lower, upper }) = &start.multipliers {
            check_finite(VectorName::ConstraintMultipliers, constraints, self.constraints)?;
            check_finite(VectorName::LowerMultipliers, lower, self.variables)?;
            check_finite(VectorName::UpperMultipliers, upper, self.variables)?;
        }
        Ok(())
    }

    /// Whether both bounds of a constraint are one.
    pub fn is_equality(&self, row: usize) -> bool {
        self.g_lower[row] == self.g_upper[row]
    }

    /// The inequalities, each of which has a slack, in order.
    pub fn inequalities(&self) -> impl Iterator<Item = usize> {
        (0..self.constraints).filter(|&row| !self.is_equality(row))
    }

    /// By how much a point leaves its bounds at most; NaN if that is not known.
    pub fn violation(&self, x: &[f64], g: &[f64]) -> f64 {
        let variables = x.iter().zip(&self.x_lower).zip(&self.x_upper);
        let constraints = g.iter().zip(&self.g_lower).zip(&self.g_upper);
        variables.chain(constraints).fold(0.0, |worst: f64, ((value, lower), upper)| {
            let violation = (lower - value).max(value - upper);
            if value.is_nan() || worst.is_nan() { f64::NAN } else { worst.max(violation) }
        })
    }
}

fn check_count(what: &'static str, count: usize) -> Result<i32, NlpError> {
    i32::try_from(count).map_err(|_| NlpError::TooMany { what, count })
}

fn check_bounds(vector: VectorName, lower: &[f64], upper: &[f64]) -> Result<(), NlpError> {
    let possible = |lower: f64, upper: f64| {
        lower <= upper && lower != f64::INFINITY && upper != f64::NEG_INFINITY
    };
    let found = lower.iter().zip(upper).position(|(lower, upper)| !possible(*lower, *upper));
    match found {
        Some(index) => Err(NlpError::ImpossibleBounds {
            vector,
            index,
            lower: lower[index],
            upper: upper[index],
        }),
        None => Ok(()),
    }
}

fn check_structure(
    matrix: MatrixName,
    structure: &TripletStructure,
    height: usize,
    width: usize,
) -> Result<(), NlpError> {
    let TripletStructure { rows, columns } = structure;
    if rows.len() != columns.len() {
        let (rows, columns) = (rows.len(), columns.len());
        return Err(NlpError::UnevenStructure { matrix, rows, columns });
    }
    check_count("entries of a matrix", rows.len())?;
    let inside = |index: i32, length: usize| usize::try_from(index).is_ok_and(|i| i < length);
    for (entry, (&row, &column)) in rows.iter().zip(columns).enumerate() {
        if !inside(row, height) || !inside(column, width) {
            return Err(NlpError::EntryOutOfRange { matrix, entry, row, column, height, width });
        }
    }
    Ok(())
}

fn check_lower_triangle(hessian: &TripletStructure) -> Result<(), NlpError> {
    for (entry, (&row, &column)) in hessian.rows.iter().zip(&hessian.columns).enumerate() {
        if column > row {
            return Err(NlpError::UpperTriangle { entry, row, column });
        }
    }
    Ok(())
}

fn check_factor(objective: f64) -> Result<(), NlpError> {
    if objective.is_finite() && objective != 0.0 {
        return Ok(());
    }
    Err(NlpError::BadNumber {
        vector: VectorName::ObjectiveScaling,
        index: 0,
        value: objective,
        expected: "a finite number other than zero",
    })
}

fn check_factors(vector: VectorName, values: &[f64], length: usize) -> Result<(), NlpError> {
    let expected = "a finite positive number";
    check_entries(vector, values, length, expected, |value| value.is_finite() && value > 0.0)
}

fn check_finite(vector: VectorName, values: &[f64], length: usize) -> Result<(), NlpError> {
    check_entries(vector, values, length, "a finite number", f64::is_finite)
}

fn check_entries(
    vector: VectorName,
    values: &[f64],
    length: usize,
    expected: &'static str,
    good: impl Fn(f64) -> bool,
) -> Result<(), NlpError> {
    if values.len() != length {
        return Err(NlpError::WrongLength { vector, expected: length, found: values.len() });
    }
    match values.iter().position(|value| !good(*value)) {
        Some(index) => Err(NlpError::BadNumber { vector, index, value: values[index], expected }),
        None => Ok(()),
    }
}
