//! Tracing, compiling and evaluating the derivatives of a 7-joint chain.

#[path = "../examples/chain/model.rs"]
mod model;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use righting_symbolic::{Backend, Graph, LANES, trace};

const JOINTS: usize = 7;

fn preparation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("chain_preparation");
    group.bench_function("trace_and_differentiate", |bencher| {
        bencher.iter(|| trace(|| model::differentiate(JOINTS).hessian.values.len()));
    });
    let _scope = Graph::scope();
    let derivatives = model::differentiate(JOINTS);
    group.bench_function("compile", |bencher| bencher.iter(|| model::compile(&derivatives)));
    group.finish();
}

fn evaluation(criterion: &mut Criterion) {
    let function =
        trace(|| model::compile(&model::differentiate(JOINTS))).expect("a valid function");
    let mut group = criterion.benchmark_group("chain_block");
    group.throughput(Throughput::Elements(LANES as u64));
    for backend in Backend::available() {
        let function = function.with_backend(backend).expect("it is available");
        let mut workspace = function.workspace();
        for port in 0..function.input_ports().len() {
            for (i, value) in workspace.input_mut(port).iter_mut().enumerate() {
                *value = 0.3 + 0.01 * ((i * 7919) % 101) as f64;
            }
        }
        let id = BenchmarkId::from_parameter(format!("{backend:?}"));
        group
            .bench_function(id, |bencher| bencher.iter(|| function.evaluate_block(&mut workspace)));
    }
    group.finish();
}

criterion_group!(benches, preparation, evaluation);
criterion_main!(benches);
