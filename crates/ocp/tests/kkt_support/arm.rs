//! Augmented systems with the structure and the triplet order of the arm problems.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_ocp::kkt::StageDims;

/// An augmented system shaped like the reduced problem of an arm: attitude (4 dense rows), joint
/// angles and rates (double integrators), one control a joint, `path` clearances of the angles.
pub struct ArmSystem {
    pub dims: StageDims,
    pub order: usize,
    pub rows: Vec<i32>,
    pub columns: Vec<i32>,
    pub values: Vec<f64>,
}

impl ArmSystem {
    pub fn new(joints: usize, path: usize, steps: usize) -> Self {
        let (states, step) = (4 + 2 * joints, 0.05);
        let dims = StageDims::uniform(states, joints, path, steps);
        let node = states + joints;
        let control = |k: usize| k * node;
        let state = |k: usize| k * node - states;
        let slack = steps * node;
        let defect = slack + steps * path;
        let inequality = defect + steps * states;
        let order = inequality + steps * path;
        let mut system = Self { dims, order, rows: vec![], columns: vec![], values: vec![] };
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut noise = || random.random_range(-1.0..1.0);
        // Hessian of the Lagrangian, by rows of the lower triangle.
        for k in 0..=steps {
            let first = if k == 0 { control(0) } else { state(k) };
            let end = if k == steps { first + states } else { control(k) + joints };
            for i in first..end {
                for j in first..=i {
                    system.push(i, j, 0.01 * noise());
                }
            }
        }
        // Barrier terms and regularisation, then slacks.
        (0..slack).for_each(|i| system.push(i, i, 2.0 + noise()));
        (0..steps * path).for_each(|i| system.push(slack + i, slack + i, 2.0 + noise()));
        // Defects.
        for k in 0..steps {
            for row in 0..states {
                let at = defect + k * states + row;
                let mut entry = |column: usize, value: f64| {
                    if k > 0 {
                        system.push(at, state(k) + column, value);
                    } else if column >= states {
                        system.push(at, column - states, value);
                    }
                };
                if row < 4 {
                    (0..node).for_each(|column| {
                        let identity = if column == row { -1.0 } else { 0.0 };
                        entry(column, identity + 0.05 * noise());
                    });
                } else if row < 4 + joints {
                    entry(row, -1.0);
                    entry(row + joints, -step);
                    entry(row + 2 * joints, -0.5 * step * step);
                } else {
                    entry(row, -1.0);
                    entry(row + joints, -step);
                }
                system.push(at, state(k + 1) + row, 1.0);
            }
        }
        (defect..inequality).for_each(|i| system.push(i, i, 0.0));
        // Inequalities.
        for k in 1..=steps {
            for row in 0..path {
                let index = (k - 1) * path + row;
                (0..joints).for_each(|joint| {
                    system.push(inequality + index, state(k) + 4 + joint, noise());
                });
                system.push(inequality + index, slack + index, -1.0);
            }
        }
        (inequality..order).for_each(|i| system.push(i, i, 0.0));
        system
    }

    fn push(&mut self, row: usize, column: usize, value: f64) {
        self.rows.push(row as i32);
        self.columns.push(column as i32);
        self.values.push(value);
    }
}
