//! Random stage systems and a dense witness.
#![allow(dead_code)]

pub mod arm;

use nalgebra::{DMatrix, DVector};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use righting_ocp::kkt::{NodeDims, StageDims};

/// First index of each kind of unknown at each node, counted here independently of the solver.
#[derive(Debug, Clone)]
pub struct Offsets {
    pub state: Vec<usize>,
    pub control: Vec<usize>,
    pub slack: Vec<usize>,
    pub equality: Vec<usize>,
    pub defect: Vec<usize>,
    pub inequality: Vec<usize>,
    pub order: usize,
}

impl Offsets {
    pub fn new(nodes: &[NodeDims]) -> Self {
        let mut next = 0;
        let mut take = |count: usize| {
            next += count;
            next - count
        };
        let (mut state, mut control) = (vec![], vec![]);
        for node in nodes {
            state.push(take(node.states));
            control.push(take(node.controls));
        }
        let slack = nodes.iter().map(|node| take(node.inequalities)).collect();
        let (mut equality, mut defect) = (vec![], vec![]);
        for (k, node) in nodes.iter().enumerate() {
            equality.push(take(node.equalities));
            defect.push(take(nodes.get(k + 1).map_or(0, |next| next.states)));
        }
        let inequality = nodes.iter().map(|node| take(node.inequalities)).collect();
        Self { state, control, slack, equality, defect, inequality, order: next }
    }
}

/// An augmented system as triplets.
#[derive(Debug, Clone)]
pub struct System {
    pub dims: StageDims,
    pub offsets: Offsets,
    pub rows: Vec<i32>,
    pub columns: Vec<i32>,
    pub values: Vec<f64>,
}

/// How to draw a system.
#[derive(Debug, Clone, Copy)]
pub struct Recipe {
    /// Added to every diagonal of the Hessian; large makes the system convex.
    pub convexity: f64,
    /// Chance that a Jacobian entry is there.
    pub density: f64,
    /// Diagonal of the defect and equality rows, negated.
    pub delta_c: f64,
    /// Diagonal of the inequality rows, negated.
    pub delta_d: f64,
    /// Coefficients of next states are ±[1/2, 2] instead of 1, those of slacks likewise instead of −1.
    pub scaled_rows: bool,
    /// Chance that a slack's diagonal is negative.
    pub negative_slacks: f64,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            convexity: 4.0,
            density: 0.6,
            delta_c: 0.0,
            delta_d: 0.0,
            scaled_rows: false,
            negative_slacks: 0.0,
        }
    }
}

impl System {
    pub fn empty(dims: StageDims) -> Self {
        let offsets = Offsets::new(dims.nodes());
        Self { dims, offsets, rows: vec![], columns: vec![], values: vec![] }
    }

    pub fn push(&mut self, row: usize, column: usize, value: f64) {
        self.rows.push(row as i32);
        self.columns.push(column as i32);
        self.values.push(value);
    }

    /// A random system: lower triangle, with explicit diagonals in every multiplier row.
    pub fn random(nodes: Vec<NodeDims>, recipe: Recipe, random: &mut ChaCha8Rng) -> Self {
        let mut system = Self::empty(StageDims::new(nodes.clone()));
        let at = system.offsets.clone();
        let coefficient = |random: &mut ChaCha8Rng, plain: f64| {
            if recipe.scaled_rows {
                let size = random.random_range(0.5..2.0);
                plain * if random.random() { size } else { -size }
            } else {
                plain
            }
        };
        for (k, node) in nodes.iter().enumerate() {
            let own = at.state[k]..at.control[k] + node.controls;
            for i in own.clone() {
                for j in own.start..=i {
                    let shift = if i == j { recipe.convexity } else { 0.0 };
                    system.push(i, j, random.random_range(-1.0..1.0) + shift);
                }
            }
            let next_states = nodes.get(k + 1).map_or(0, |next| next.states);
            let jacobian =
                |first: usize, count: usize, random: &mut ChaCha8Rng, system: &mut Self| {
                    for row in first..first + count {
                        for column in own.clone() {
                            if random.random::<f64>() < recipe.density {
                                system.push(row, column, random.random_range(-1.0..1.0));
                            }
                        }
                    }
                };
            jacobian(at.defect[k], next_states, random, &mut system);
            jacobian(at.equality[k], node.equalities, random, &mut system);
            jacobian(at.inequality[k], node.inequalities, random, &mut system);
            for i in 0..next_states {
                let value = coefficient(random, 1.0);
                system.push(at.defect[k] + i, at.state[k + 1] + i, value);
                system.push(at.defect[k] + i, at.defect[k] + i, -recipe.delta_c);
            }
            for i in 0..node.equalities {
                system.push(at.equality[k] + i, at.equality[k] + i, -recipe.delta_c);
            }
            for i in 0..node.inequalities {
                let sign = if random.random::<f64>() < recipe.negative_slacks { -1.0 } else { 1.0 };
                let sigma = sign * 10_f64.powf(3.0 * random.random_range(-1.0..1.0));
                system.push(at.slack[k] + i, at.slack[k] + i, sigma);
                let value = coefficient(random, -1.0);
                system.push(at.inequality[k] + i, at.slack[k] + i, value);
                system.push(at.inequality[k] + i, at.inequality[k] + i, -recipe.delta_d);
            }
        }
        system
    }

    /// The same matrix with its triplets in random order, some transposed and some split in two.
    pub fn shuffled(&self, random: &mut ChaCha8Rng) -> Self {
        let mut triplets = vec![];
        for t in 0..self.rows.len() {
            let (mut row, mut column) = (self.rows[t], self.columns[t]);
            if random.random::<f64>() < 0.5 {
                std::mem::swap(&mut row, &mut column);
            }
            if random.random::<f64>() < 0.3 {
                let part = random.random_range(-1.0..1.0);
                triplets.push((column, row, part));
                triplets.push((row, column, self.values[t] - part));
            } else {
                triplets.push((row, column, self.values[t]));
            }
        }
        for i in (1..triplets.len()).rev() {
            triplets.swap(i, random.random_range(0..i + 1));
        }
        Self {
            dims: self.dims.clone(),
            offsets: self.offsets.clone(),
            rows: triplets.iter().map(|t| t.0).collect(),
            columns: triplets.iter().map(|t| t.1).collect(),
            values: triplets.iter().map(|t| t.2).collect(),
        }
    }

    pub fn dense(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.offsets.order, self.offsets.order);
        for ((&row, &column), &value) in self.rows.iter().zip(&self.columns).zip(&self.values) {
            let (row, column) = (row as usize, column as usize);
            matrix[(row, column)] += value;
            if row != column {
                matrix[(column, row)] += value;
            }
        }
        matrix
    }

    /// Matrix times vector, from the triplets.
    pub fn product(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; vector.len()];
        for ((&row, &column), &value) in self.rows.iter().zip(&self.columns).zip(&self.values) {
            let (row, column) = (row as usize, column as usize);
            product[row] += value * vector[column];
            if row != column {
                product[column] += value * vector[row];
            }
        }
        product
    }

    /// Negative eigenvalues, and the smallest eigenvalue's magnitude beside the largest's.
    pub fn inertia(&self) -> (usize, f64) {
        let eigenvalues = self.dense().symmetric_eigenvalues();
        let negative = eigenvalues.iter().filter(|&&value| value < 0.0).count();
        let smallest = eigenvalues.iter().fold(f64::INFINITY, |m, v| m.min(v.abs()));
        (negative, smallest / eigenvalues.amax().max(f64::MIN_POSITIVE))
    }

    /// Solution by dense LU.
    pub fn dense_solution(&self, rhs: &[f64]) -> Vec<f64> {
        let lu = self.dense().full_piv_lu();
        lu.solve(&DVector::from_column_slice(rhs)).expect("regular").iter().copied().collect()
    }
}

/// Largest magnitude.
pub fn norm(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// `‖Ax − b‖ / (‖A‖‖x‖ + ‖b‖)`, all in the maximum norm.
pub fn backward_error(system: &System, solution: &[f64], rhs: &[f64]) -> f64 {
    let product = system.product(solution);
    let residual: Vec<f64> = product.iter().zip(rhs).map(|(a, b)| a - b).collect();
    norm(&residual) / (norm(&system.values) * norm(solution) + norm(rhs)).max(f64::MIN_POSITIVE)
}

pub fn node(states: usize, controls: usize, equalities: usize, inequalities: usize) -> NodeDims {
    NodeDims { states, controls, equalities, inequalities }
}
