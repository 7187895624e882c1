//! The system that a linear solver gets is the one that its documentation describes.

mod support;

use righting_ipopt::*;
use support::quadratic::Projection;

/// Keeps the first matrix and stops there.
#[derive(Default)]
struct Recording {
    order: usize,
    triplets: Vec<(usize, usize)>,
    matrices: Vec<Vec<f64>>,
}

impl LinearSolver for Recording {
    fn analyse(&mut self, n: usize, r: &[i32], c: &[i32]) -> Result<(), LinearSolverError> {
        self.order = n;
        self.triplets = r.iter().zip(c).map(|(&r, &c)| (r as usize, c as usize)).collect();
        Ok(())
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        self.matrices.push(values.to_vec());
        Factorization::Regular { negative_eigenvalues: 4 }
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        right_hand_sides.fill(0.0);
    }
}

impl Recording {
    /// A dense copy; entries of the structure that are zero count as well.
    fn dense(&self, values: &[f64]) -> Vec<Vec<Option<f64>>> {
        let mut dense = vec![vec![None; self.order]; self.order];
        for (&(i, j), value) in self.triplets.iter().zip(values) {
            *dense[i][j].get_or_insert(0.0) += value;
        }
        dense
    }
}

#[test]
fn blocks_follow_the_documented_order() {
    // Four variables of which the third is fixed; equalities and inequalities alternate.
    let infinity = f64::INFINITY;
    let free = (-infinity, infinity);
    let mut problem = Projection::of(&[1.0, 2.0, 3.0, 4.0])
        .within(&[(0.0, infinity), free, (5.0, 5.0), free])
        .subject_to(&[(0, 11.0), (1, 12.0)], (-infinity, 100.0))
        .subject_to(&[(1, 13.0), (3, 14.0)], (1.0, 1.0))
        .subject_to(&[(0, 15.0), (2, 16.0)], (-50.0, 200.0))
        .subject_to(&[(0, 17.0), (3, 18.0)], (2.0, 2.0));
    let mut recording = Recording::default();
    let options =
        Options { nlp_scaling: NlpScaling::None, max_iterations: 1, ..Options::default() };
    let start = Start::at(vec![1.0; 4]);
    solve_with(&mut problem, &options, &start, &mut recording, |_| Control::Continue).unwrap();

    // x: three free variables, s: two inequalities, y_c: two equations, y_d: two inequalities.
    assert_eq!(recording.order, 3 + 2 + 2 + 2);
    let (s, c, d) = (3, 5, 7);
    // The least-squares estimate of the multipliers comes first, with an identity for W.
    assert!(recording.matrices.len() >= 2);
    let system = recording.dense(recording.matrices.last().unwrap());
    for i in 0..recording.order {
        assert!(system[i][i].is_some(), "diagonal {i} is part of the structure");
        assert!(system[i][i + 1..].iter().all(Option::is_none), "upper triangle of row {i}");
    }
    let first = recording.dense(&recording.matrices[0]);
    assert!((0..c).all(|i| first[i][i] == Some(1.0)));
    let entry = |i: usize, j: usize| system[i][j].unwrap_or(0.0);
    let block = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
        rows.map(|i| columns.clone().map(|j| entry(i, j)).collect::<Vec<_>>()).collect::<Vec<_>>()
    };
    // The Hessian, and the barrier term of the one variable that has a bound.
    assert!(entry(0, 0) > 2.0);
    assert_eq!((entry(1, 1), entry(2, 2)), (2.0, 2.0));
    assert!(entry(3, 3) > 0.0 && entry(4, 4) > 0.0);
    assert_eq!(block(s..c, 0..s), [[0.0; 3]; 2]);
    assert_eq!(block(c..d, 0..s), [[0.0, 13.0, 14.0], [17.0, 0.0, 18.0]]);
    assert_eq!(block(c..d, s..c), [[0.0; 2]; 2]);
    assert_eq!(block(d..9, 0..s), [[11.0, 12.0, 0.0], [15.0, 0.0, 0.0]]);
    assert_eq!(block(d..9, s..c), [[-1.0, 0.0], [0.0, -1.0]]);
    assert_eq!(block(d..9, c..d), [[0.0; 2]; 2]);
    assert!((c..9).all(|i| entry(i, i) <= 0.0));
}
