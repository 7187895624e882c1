use std::ops::Range;

use crate::Declarations;

/// The augmented system of a primal–dual barrier method, in the triplets of a
/// [`LinearSolver`](crate::LinearSolver) (Wächter & Biegler, *Mathematical Programming* 106, 2006,
/// eqs. 11 and 13, with the slacks kept; Nocedal & Wright, *Numerical Optimization*, 2nd ed.,
/// eq. 19.12):
///
/// ```text
/// ⎡ W + D_x         J_cᵀ   J_dᵀ ⎤       x    variables
/// ⎢         D_s            −I   ⎥       s    one slack for each inequality constraint
/// ⎢ J_c            −D_c         ⎥       y_c  equality constraints
/// ⎣ J_d     −I            −D_d  ⎦       y_d  inequality constraints
/// ```
///
/// each kind of unknown in the order of the problem. The values stand in the order
///
/// ```text
/// [ W | D_x, D_s | J | −1 of each slack | −D_c, −D_d ]
/// ```
///
/// so that a problem's derivatives are evaluated where they are needed.
#[derive(Debug, Clone)]
pub struct AugmentedSystem {
    variables: usize,
    slacks: usize,
    constraints: usize,
    rows: Vec<i32>,
    columns: Vec<i32>,
    values: Vec<f64>,
    hessian: Range<usize>,
    diagonal: Range<usize>,
    jacobian: Range<usize>,
    constraint_diagonal: Range<usize>,
    multipliers: Vec<usize>,
}

impl AugmentedSystem {
    /// The system of a problem, all zero but for the −1 of each slack.
    pub fn new(declared: &Declarations) -> Self {
        let Declarations { variables, constraints, jacobian, hessian, .. } = declared;
        let slacks = declared.inequalities().count();
        let (primals, multipliers) = (variables + slacks, multiplier_unknowns(declared));
        let (mut rows, mut columns) = (hessian.rows.clone(), hessian.columns.clone());
        let of_hessian = 0..rows.len();
        rows.extend((0..primals).map(|i| i as i32));
        columns.extend((0..primals).map(|i| i as i32));
        let diagonal = of_hessian.end..rows.len();
        rows.extend(jacobian.rows.iter().map(|&row| multipliers[row as usize] as i32));
        columns.extend(&jacobian.columns);
        let of_jacobian = diagonal.end..rows.len();
        for (slack, row) in declared.inequalities().enumerate() {
            rows.push(multipliers[row] as i32);
            columns.push((variables + slack) as i32);
        }
        let constraint_diagonal = rows.len()..rows.len() + constraints;
        rows.extend((primals..primals + constraints).map(|i| i as i32));
        columns.extend((primals..primals + constraints).map(|i| i as i32));

        let mut values = vec![0.0; rows.len()];
        values[of_jacobian.end..constraint_diagonal.start].fill(-1.0);
        Self {
            variables: *variables,
            slacks,
            constraints: *constraints,
            rows,
            columns,
            values,
            hessian: of_hessian,
            diagonal,
            jacobian: of_jacobian,
            constraint_diagonal,
            multipliers,
        }
    }

    /// The number of unknowns.
    pub fn order(&self) -> usize {
        self.primals() + self.constraints
    }

    /// The number of variables.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// The number of variables and slacks, which come first among the unknowns.
    pub fn primals(&self) -> usize {
        self.variables + self.slacks
    }

    /// The number of constraints: that of the matrix's negative eigenvalues where the reduced
    /// Hessian is positive definite and J has full rank (Gould, *Mathematical Programming* 32,
    /// 1985).
    pub fn constraints(&self) -> usize {
        self.constraints
    }

    /// Row of each triplet.
    pub fn rows(&self) -> &[i32] {
        &self.rows
    }

    /// Column of each triplet.
    pub fn columns(&self) -> &[i32] {
        &self.columns
    }

    /// Value of each triplet.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The unknown that is each constraint's multiplier (m).
    pub fn multipliers(&self) -> &[usize] {
        &self.multipliers
    }

    /// The values of W, in the order of the problem's Hessian structure.
    pub fn hessian_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.hessian.clone()]
    }

    /// D_x and D_s.
    pub fn diagonal_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.diagonal.clone()]
    }

    /// The values of J, in the order of the problem's Jacobian structure.
    pub fn jacobian(&self) -> &[f64] {
        &self.values[self.jacobian.clone()]
    }

    /// The values of J, to be changed.
    pub fn jacobian_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.jacobian.clone()]
    }

    /// −D_c and −D_d.
    pub fn constraint_diagonal_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.constraint_diagonal.clone()]
    }

    /// dᵀ (W + D) d for a direction d of variables and slacks.
    pub fn primal_curvature(&self, direction: &[f64]) -> f64 {
        let primal = 0..self.diagonal.end;
        let entries = self.rows[primal.clone()].iter().zip(&self.columns).zip(&self.values);
        let term = |((&row, &column), value): ((&i32, &i32), &f64)| {
            let once = value * direction[row as usize] * direction[column as usize];
            if row == column { once } else { 2.0 * once }
        };
        entries.map(term).sum()
    }
}

/// The unknown of each constraint's multiplier: after variables and slacks, equalities first.
fn multiplier_unknowns(declared: &Declarations) -> Vec<usize> {
    let slacks = declared.inequalities().count();
    let mut next = [declared.variables + slacks, declared.variables + declared.constraints];
    let unknown = |row| {
        let next = &mut next[usize::from(!declared.is_equality(row))];
        *next += 1;
        *next - 1
    };
    (0..declared.constraints).map(unknown).collect()
}
