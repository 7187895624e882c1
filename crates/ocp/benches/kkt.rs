//! Factorisation and solution of augmented systems as the arm problems give them, by the number of
//! joints and by the number of steps, and the same recursion with plain dense blocks.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use nalgebra::DMatrix;
use righting_nlp::{Factorization, LinearSolver};
use righting_ocp::kkt::StageKkt;

#[path = "../tests/kkt_support/arm.rs"]
mod arm;
use arm::ArmSystem;

fn measure(criterion: &mut Criterion, name: &str, parameter: usize, system: &ArmSystem) {
    let mut group = criterion.benchmark_group(name);
    let mut solver = StageKkt::new(&system.dims);
    group.bench_function(BenchmarkId::new("analyse", parameter), |bencher| {
        bencher.iter(|| solver.recognise(system.order, &system.rows, &system.columns));
    });
    assert!(matches!(solver.factor(&system.values), Factorization::Regular { .. }));
    group.bench_function(BenchmarkId::new("factor", parameter), |bencher| {
        bencher.iter(|| solver.factor(black_box(&system.values)));
    });
    let rhs: Vec<f64> = (0..system.order).map(|i| (i as f64).sin()).collect();
    let mut solution = rhs.clone();
    group.bench_function(BenchmarkId::new("solve", parameter), |bencher| {
        bencher.iter(|| {
            solution.copy_from_slice(&rhs);
            solver.solve(black_box(&mut solution));
        });
    });
}

/// The Riccati recursion on dense matrices of a linear-algebra library, values in place already.
struct PlainBlocks {
    hessian: DMatrix<f64>,
    step: DMatrix<f64>,
    path: DMatrix<f64>,
    controls: usize,
}

impl PlainBlocks {
    fn new(joints: usize, path: usize) -> Self {
        let (states, controls) = (4 + 2 * joints, joints);
        let unknowns = states + controls;
        Self {
            hessian: DMatrix::from_fn(unknowns, unknowns, |i, j| {
                if i == j { 3.0 } else { 0.1 / (1 + i + j) as f64 }
            }),
            step: DMatrix::from_fn(states, unknowns, |i, j| {
                if i + controls == j { 1.0 } else { 0.05 / (1 + i + j) as f64 }
            }),
            path: DMatrix::from_fn(path, unknowns, |i, j| 0.1 / (1 + i + j) as f64),
            controls,
        }
    }

    fn factor(&self, steps: usize) -> Vec<DMatrix<f64>> {
        let (m, states) = (self.controls, self.step.nrows());
        let mut values = vec![self.hessian.view((m, m), (states, states)).into_owned()];
        for _ in 0..steps {
            let image = values.last().expect("the last node's") * &self.step;
            let mut matrix = self.hessian.clone();
            matrix.gemm_tr(1.0, &self.step, &image, 1.0);
            matrix.gemm_tr(1.0, &self.path, &self.path, 1.0);
            let pivot = matrix.view((0, 0), (m, m)).into_owned().cholesky().expect("convex");
            let cross = matrix.view((0, m), (m, states));
            let gain = pivot.solve(&cross);
            let mut value = matrix.view((m, m), (states, states)).into_owned();
            value.gemm_tr(-1.0, &cross.into_owned(), &gain, 1.0);
            values.push(value);
        }
        values
    }
}

fn joints(criterion: &mut Criterion) {
    for (joints, path) in [(2, 2), (4, 5), (7, 8), (10, 10), (14, 12), (20, 16)] {
        measure(criterion, "kkt_by_joints", joints, &ArmSystem::new(joints, path, 600));
        let plain = PlainBlocks::new(joints, path);
        let id = BenchmarkId::new("plain_blocks", joints);
        criterion.benchmark_group("kkt_by_joints").bench_function(id, |bencher| {
            bencher.iter(|| plain.factor(black_box(600)));
        });
    }
}

fn steps(criterion: &mut Criterion) {
    for steps in [50, 150, 600, 2400, 9600] {
        measure(criterion, "kkt_by_steps", steps, &ArmSystem::new(7, 8, steps));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = joints, steps
}
criterion_main!(benches);
