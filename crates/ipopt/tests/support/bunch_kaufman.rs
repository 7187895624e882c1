//! Dense LDLᵀ with the pivoting of Bunch & Kaufman, *Mathematics of Computation* 31 (1977): slow,
//! short, and exact about inertia.

use righting_ipopt::{Factorization, LinearSolver, LinearSolverError};

/// P A Pᵀ = L D Lᵀ with 1×1 and 2×2 blocks in D.
#[derive(Default)]
pub struct BunchKaufman {
    order: usize,
    rows: Vec<i32>,
    columns: Vec<i32>,
    /// Row-major; below the blocks of D, L.
    factor: Vec<f64>,
    /// `permutation[i]` is the original index of row i.
    permutation: Vec<usize>,
    /// Whether a 2×2 block of D begins at i.
    is_pair: Vec<bool>,
    pub analyses: usize,
    pub factorizations: usize,
}

impl BunchKaufman {
    fn at(&self, i: usize, j: usize) -> f64 {
        self.factor[i * self.order + j]
    }

    fn swap(&mut self, i: usize, j: usize) {
        let n = self.order;
        for k in 0..n {
            self.factor.swap(i * n + k, j * n + k);
        }
        for k in 0..n {
            self.factor.swap(k * n + i, k * n + j);
        }
        self.permutation.swap(i, j);
    }

    /// Chooses the pivot for step k; whether it is a pair.
    fn pivot(&mut self, k: usize) -> bool {
        let n = self.order;
        let alpha = (1.0 + 17.0_f64.sqrt()) / 8.0;
        let largest = |this: &Self, column: usize, skip: usize| {
            (k..n)
                .filter(|&i| i != skip)
                .map(|i| (i, this.at(i, column).abs()))
                .fold((k, 0.0), |best, next| if next.1 > best.1 { next } else { best })
        };
        let (r, lambda) = largest(self, k, k);
        if lambda == 0.0 || self.at(k, k).abs() >= alpha * lambda {
            return false;
        }
        let (_, sigma) = largest(self, r, r);
        if self.at(k, k).abs() * sigma >= alpha * lambda * lambda {
            return false;
        }
        if self.at(r, r).abs() >= alpha * sigma {
            self.swap(k, r);
            return false;
        }
        self.swap(k + 1, r);
        true
    }

    /// The columns of L of the block at k, and what it leaves of the rest.
    fn eliminate(&mut self, k: usize, width: usize) {
        let n = self.order;
        for i in k + width..n {
            let row: Vec<f64> = (k..k + width).map(|j| self.at(i, j)).collect();
            let l = self.solve_block(k, width, &row);
            for j in k + width..n {
                let update: f64 = (0..width).map(|b| l[b] * self.at(k + b, j)).sum();
                self.factor[i * n + j] -= update;
            }
            self.factor[i * n + k..i * n + k + width].copy_from_slice(&l);
        }
    }

    fn solve_block(&self, k: usize, width: usize, v: &[f64]) -> Vec<f64> {
        if width == 1 {
            return vec![v[0] / self.at(k, k)];
        }
        let (a, b, c) = (self.at(k, k), self.at(k + 1, k), self.at(k + 1, k + 1));
        let determinant = a * c - b * b;
        vec![(c * v[0] - b * v[1]) / determinant, (a * v[1] - b * v[0]) / determinant]
    }
}

impl LinearSolver for BunchKaufman {
    fn analyse(
        &mut self,
        order: usize,
        rows: &[i32],
        columns: &[i32],
    ) -> Result<(), LinearSolverError> {
        assert_eq!(rows.len(), columns.len());
        let inside = |index: &i32| (0..order as i32).contains(index);
        assert!(rows.iter().all(inside) && columns.iter().all(inside));
        (self.order, self.rows, self.columns) = (order, rows.to_vec(), columns.to_vec());
        self.analyses += 1;
        Ok(())
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        self.factorizations += 1;
        let n = self.order;
        self.factor = vec![0.0; n * n];
        self.permutation = (0..n).collect();
        self.is_pair = vec![false; n];
        for ((&i, &j), value) in self.rows.iter().zip(&self.columns).zip(values) {
            self.factor[i as usize * n + j as usize] += value;
            if i != j {
                self.factor[j as usize * n + i as usize] += value;
            }
        }
        let mut negative_eigenvalues = 0;
        let mut k = 0;
        while k < n {
            self.is_pair[k] = self.pivot(k);
            let width = if self.is_pair[k] { 2 } else { 1 };
            if width == 2 {
                negative_eigenvalues += 1;
            } else if self.at(k, k) == 0.0 {
                return Factorization::Singular;
            } else if self.at(k, k) < 0.0 {
                negative_eigenvalues += 1;
            }
            self.eliminate(k, width);
            k += width;
        }
        Factorization::Regular { negative_eigenvalues }
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        let n = self.order;
        for column in right_hand_sides.chunks_exact_mut(n) {
            let mut x: Vec<f64> = self.permutation.iter().map(|&i| column[i]).collect();
            let blocks: Vec<(usize, usize)> = (0..n)
                .filter(|&k| k == 0 || !self.is_pair[k - 1])
                .map(|k| (k, if self.is_pair[k] { 2 } else { 1 }))
                .collect();
            for &(k, width) in &blocks {
                for i in k + width..n {
                    x[i] -= (k..k + width).map(|j| self.at(i, j) * x[j]).sum::<f64>();
                }
            }
            for &(k, width) in &blocks {
                let block = self.solve_block(k, width, &x[k..k + width]);
                x[k..k + width].copy_from_slice(&block);
            }
            for &(k, width) in blocks.iter().rev() {
                for j in k..k + width {
                    x[j] -= (k + width..n).map(|i| self.at(i, j) * x[i]).sum::<f64>();
                }
            }
            for (i, value) in self.permutation.iter().zip(x) {
                column[*i] = value;
            }
        }
    }
}
