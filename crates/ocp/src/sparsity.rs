//! Which entries of the optimality conditions' matrix can be nonzero: for pictures and for counting.

use righting_nlp::Problem;

use crate::multiple_shooting::MultipleShooting;

/// Places of the structural nonzeros of the KKT matrix
///
/// ```text
/// ⎡ ∇²L  ∇gᵀ ⎤   variables
/// ⎣ ∇g    0  ⎦   constraints
/// ```
///
/// in the order of [`DecisionLayout`](crate::DecisionLayout), lower triangle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KktSparsity {
    /// Number of variables.
    pub variables: usize,
    /// Number of constraints.
    pub constraints: usize,
    /// Row and column of each entry of the Hessian's lower triangle.
    pub hessian: Vec<(usize, usize)>,
    /// Row (a constraint, from zero) and column of each entry of the Jacobian.
    pub jacobian: Vec<(usize, usize)>,
}

impl MultipleShooting<'_> {
    /// The sparsity of the KKT matrix.
    pub fn kkt_sparsity(&self) -> KktSparsity {
        let places = |triplets: righting_nlp::TripletStructure| {
            let rows = triplets.rows.into_iter().map(|row| row as usize);
            rows.zip(triplets.columns.into_iter().map(|column| column as usize)).collect()
        };
        KktSparsity {
            variables: self.layout().variables(),
            constraints: self.layout().constraints(),
            hessian: places(self.hessian_structure()),
            jacobian: places(self.jacobian_structure()),
        }
    }
}
