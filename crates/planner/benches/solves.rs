//! Whole plans, tracing and guessing included, for arms of two to twenty joints, N = 600.

#[allow(dead_code, reason = "each benchmark uses its own part")]
#[path = "../examples/costs/chain.rs"]
mod chain;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use righting_ocp::Control;
use righting_planner::Planner;

fn plans(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("plan");
    group.sample_size(10);
    for joints in chain::JOINTS {
        let scenario = chain::chain(joints).expect("a sound chain");
        group.bench_function(BenchmarkId::from_parameter(joints), |bencher| {
            bencher.iter(|| {
                Planner::new()
                    .plan(&scenario, &mut |_| Control::Continue)
                    .map(|plan| plan.solution.status)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, plans);
criterion_main!(benches);
