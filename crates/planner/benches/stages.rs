//! Jacobian and Hessian of all stages, N = 600: the derivatives of one Ipopt iteration.

#[allow(dead_code, reason = "each benchmark uses its own part")]
#[path = "../examples/costs/chain.rs"]
mod chain;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use righting_ipopt::Problem;
use righting_ocp::{Grid, MultipleShooting, StageFunctions};
use righting_planner::FormulatedManeuver;
use righting_scenario::Scenario;

const MANEUVERS: [&str; 5] =
    ["slew_2dof", "slew_4dof", "slew_canadarm2_table", "slew_canadarm2", "slew_4dof_full"];

fn evaluation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stages");
    for name in MANEUVERS {
        let scenario = Scenario::read(&chain::shipped(name)).expect("it is shipped");
        let maneuver = FormulatedManeuver::new(&scenario);
        let functions = StageFunctions::compile(&maneuver.problem).expect("a sound problem");
        let horizon = scenario.horizon();
        let grid = Grid::new(horizon.duration_s, horizon.steps).expect("a sound grid");
        let mut program =
            MultipleShooting::new(&functions, grid, &maneuver.initial).expect("it fits");
        let layout = program.layout();
        // A little off the initial state, where nothing is zero.
        let mut x = vec![0.0; layout.variables()];
        for step in 0..horizon.steps {
            x[layout.control(step)].fill(1e-3);
            x[layout.state(step + 1)].copy_from_slice(&program.initial_state(&[]));
        }
        for (i, value) in x.iter_mut().enumerate() {
            *value += 0.01 * (i as f64).sin();
        }
        let multipliers = vec![0.5; layout.constraints()];
        let mut jacobian = vec![0.0; program.jacobian_structure().len()];
        let mut hessian = vec![0.0; program.hessian_structure().len()];
        group.throughput(Throughput::Elements(horizon.steps as u64));
        group.bench_function(BenchmarkId::new("jacobian", name), |bencher| {
            bencher.iter(|| program.jacobian(black_box(&x), true, &mut jacobian));
        });
        // The Hessian builds on what the Jacobian left behind, as in an iteration.
        program.jacobian(&x, true, &mut jacobian).expect("defined here");
        group.bench_function(BenchmarkId::new("hessian", name), |bencher| {
            bencher.iter(|| {
                program.hessian(black_box(&x), false, 1.0, &multipliers, true, &mut hessian)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, evaluation);
criterion_main!(benches);
