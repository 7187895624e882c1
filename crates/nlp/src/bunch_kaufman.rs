use crate::{Factorization, LinearSolver, LinearSolverError};

/// A dense LDLᵀ with the pivoting of Bunch & Kaufman (*Mathematics of Computation* 31,
/// 1977): P A Pᵀ = L D Lᵀ with 1×1 and
/// 2×2 blocks in D, whose inertia is that of A.
///
/// For small systems, and as a witness for other solvers: it costs n³/3 operations and keeps n²
/// numbers, whatever the structure.
#[derive(Debug, Clone, Default)]
pub struct BunchKaufman {
    order: usize,
    rows: Vec<i32>,
    columns: Vec<i32>,
    /// Row-major; below the blocks of D, L.
    factor: Vec<f64>,
    /// `permutation[i]` is the original index of row i.
    permutation: Vec<usize>,
    /// First row and width of each block of D.
    blocks: Vec<(usize, usize)>,
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

    /// The row of the largest entry of a column from row k on, one row left out, and its size.
    fn largest_in(&self, column: usize, k: usize, skip: usize) -> (usize, f64) {
        (k..self.order)
            .filter(|&i| i != skip)
            .map(|i| (i, self.at(i, column).abs()))
            .fold((k, 0.0), |best, next| if next.1 > best.1 { next } else { best })
    }

    /// Brings the pivot of step k into place; returns the width of its block.
    fn pivot(&mut self, k: usize) -> usize {
        // Least growth of the entries over both kinds of pivot.
        let alpha = (1.0 + 17.0_f64.sqrt()) / 8.0;
        let (r, lambda) = self.largest_in(k, k, k);
        let diagonal = self.at(k, k).abs();
        if lambda == 0.0 || diagonal >= alpha * lambda {
            return 1;
        }
        let (_, sigma) = self.largest_in(r, k, r);
        if diagonal * sigma >= alpha * lambda * lambda {
            return 1;
        }
        if self.at(r, r).abs() >= alpha * sigma {
            self.swap(k, r);
            return 1;
        }
        self.swap(k + 1, r);
        2
    }

    /// The columns of L of the block at k, and what it leaves of the rest.
    fn eliminate(&mut self, k: usize, width: usize) {
        let n = self.order;
        for i in k + width..n {
            let mut l = [0.0; 2];
            l[..width].copy_from_slice(&self.factor[i * n + k..][..width]);
            self.solve_block(k, &mut l[..width]);
            for j in k + width..n {
                let update: f64 = (0..width).map(|b| l[b] * self.at(k + b, j)).sum();
                self.factor[i * n + j] -= update;
            }
            self.factor[i * n + k..][..width].copy_from_slice(&l[..width]);
        }
    }

    /// Solves with the block of D at k.
    fn solve_block(&self, k: usize, v: &mut [f64]) {
        match v {
            [a] => *a /= self.at(k, k),
            [a, b] => {
                let (p, q, r) = (self.at(k, k), self.at(k + 1, k), self.at(k + 1, k + 1));
                let determinant = p * r - q * q;
                (*a, *b) = ((r * *a - q * *b) / determinant, (p * *b - q * *a) / determinant);
            }
            _ => unreachable!("a block has one or two rows"),
        }
    }
}

impl LinearSolver for BunchKaufman {
    fn analyse(
        &mut self,
        order: usize,
        rows: &[i32],
        columns: &[i32],
    ) -> Result<(), LinearSolverError> {
        let inside = |index: &i32| usize::try_from(*index).is_ok_and(|index| index < order);
        if rows.len() != columns.len() || !rows.iter().chain(columns).all(inside) {
            return Err(LinearSolverError::new(format!(
                "found {} rows and {} columns, expected as many, all below {order}",
                rows.len(),
                columns.len()
            )));
        }
        (self.order, self.rows, self.columns) = (order, rows.to_vec(), columns.to_vec());
        Ok(())
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        let n = self.order;
        self.blocks.clear();
        if values.len() != self.rows.len() || !values.iter().all(|value| value.is_finite()) {
            return Factorization::Failed;
        }
        self.factor = vec![0.0; n * n];
        self.permutation = (0..n).collect();
        for ((&i, &j), value) in self.rows.iter().zip(&self.columns).zip(values) {
            self.factor[i as usize * n + j as usize] += value;
            if i != j {
                self.factor[j as usize * n + i as usize] += value;
            }
        }
        let mut negative_eigenvalues = 0;
        let mut k = 0;
        while k < n {
            let width = self.pivot(k);
            match (width, self.at(k, k)) {
                // A pair is chosen only where its determinant is negative.
                (2, _) => negative_eigenvalues += 1,
                (_, 0.0) => return Factorization::Singular,
                (_, pivot) => negative_eigenvalues += usize::from(pivot < 0.0),
            }
            self.eliminate(k, width);
            self.blocks.push((k, width));
            k += width;
        }
        Factorization::Regular { negative_eigenvalues }
    }

    /// Solves; the result is not a number when the last factorisation was not regular.
    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        let n = self.order;
        if self.blocks.iter().map(|(_, width)| width).sum::<usize>() < n {
            return right_hand_sides.fill(f64::NAN);
        }
        for column in right_hand_sides.chunks_exact_mut(n.max(1)) {
            let mut x: Vec<f64> = self.permutation.iter().map(|&i| column[i]).collect();
            for &(k, width) in &self.blocks {
                for i in k + width..n {
                    x[i] -= (k..k + width).map(|j| self.at(i, j) * x[j]).sum::<f64>();
                }
            }
            for &(k, width) in &self.blocks {
                self.solve_block(k, &mut x[k..k + width]);
            }
            for &(k, width) in self.blocks.iter().rev() {
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
