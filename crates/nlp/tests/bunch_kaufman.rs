//! The dense factorisation on matrices of known inertia.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_nlp::*;

/// A number from −1 to 1.
fn signed(random: &mut ChaCha8Rng) -> f64 {
    random.random_range(-1.0..1.0)
}

/// Lower triangle of M D Mᵀ, whose inertia is that of D (Sylvester), M regular.
fn congruent(m: &[Vec<f64>], d: &[f64]) -> Vec<(i32, i32, f64)> {
    let entry = |i: usize, j: usize| (0..d.len()).map(|k| m[i][k] * d[k] * m[j][k]).sum();
    (0..d.len())
        .flat_map(|i| (0..=i).map(move |j| (i, j)))
        .map(|(i, j)| (i as i32, j as i32, entry(i, j)))
        .collect()
}

fn factored(n: usize, triplets: &[(i32, i32, f64)]) -> (BunchKaufman, Factorization) {
    let (rows, columns): (Vec<i32>, Vec<i32>) = triplets.iter().map(|t| (t.0, t.1)).unzip();
    let values: Vec<f64> = triplets.iter().map(|t| t.2).collect();
    let mut solver = BunchKaufman::default();
    solver.analyse(n, &rows, &columns).unwrap();
    let outcome = solver.factor(&values);
    (solver, outcome)
}

#[test]
fn inertia_and_solutions_of_random_matrices() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for n in 1..12 {
        for _ in 0..20 {
            // Dominant diagonals keep M regular.
            let m: Vec<Vec<f64>> = (0..n)
                .map(|i| {
                    (0..n)
                        .map(|j| signed(&mut random) + if i == j { n as f64 } else { 0.0 })
                        .collect()
                })
                .collect();
            let d: Vec<f64> = (0..n)
                .map(|_| {
                    let d = signed(&mut random);
                    d + 0.1 * d.signum()
                })
                .collect();
            let triplets = congruent(&m, &d);
            let (mut solver, outcome) = factored(n, &triplets);
            let negative_eigenvalues = d.iter().filter(|d| **d < 0.0).count();
            assert_eq!(outcome, Factorization::Regular { negative_eigenvalues }, "{d:?}");

            let expected: Vec<f64> = (0..n).map(|_| signed(&mut random)).collect();
            let mut x = vec![0.0; n];
            for &(i, j, value) in &triplets {
                let (i, j) = (i as usize, j as usize);
                x[i] += value * expected[j];
                if i != j {
                    x[j] += value * expected[i];
                }
            }
            solver.solve(&mut x);
            for (found, expected) in x.iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
            }
        }
    }
}

#[test]
fn zero_diagonals_take_pairs() {
    let (mut solver, outcome) = factored(2, &[(0, 0, 0.0), (1, 0, 2.0), (1, 1, 0.0)]);
    assert_eq!(outcome, Factorization::Regular { negative_eigenvalues: 1 });
    let mut x = [2.0, 4.0, -2.0, 6.0];
    solver.solve(&mut x);
    assert_eq!(x, [2.0, 1.0, 3.0, -1.0]);
}

#[test]
fn a_singular_matrix_is_one_and_what_is_no_matrix_fails() {
    let (mut solver, outcome) = factored(2, &[(0, 0, 1.0), (1, 0, 1.0), (1, 1, 1.0)]);
    assert_eq!(outcome, Factorization::Singular);
    let mut x = [1.0, 1.0];
    solver.solve(&mut x);
    assert!(x.iter().all(|x| x.is_nan()));
    assert_eq!(factored(1, &[(0, 0, f64::NAN)]).1, Factorization::Failed);
    assert_eq!(solver.factor(&[1.0]), Factorization::Failed);
    let refusal = BunchKaufman::default().analyse(2, &[0, 2], &[0, 1]).unwrap_err();
    assert!(refusal.to_string().contains("below 2"), "{refusal}");
}
