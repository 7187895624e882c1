//! The stage factorisation against dense eigenvalues and dense LU on random systems.

mod kkt_support;

use kkt_support::arm::ArmSystem;
use kkt_support::{Recipe, System, backward_error, node, norm};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_nlp::{Factorization, LinearSolver};
use righting_ocp::kkt::{NodeDims, StageDims, StageKkt};

/// Factorises and solves; inertia must be exact, the solution accurate. Returns the negative eigenvalues.
#[track_caller]
fn check(system: &System, mut solver: StageKkt, random: &mut ChaCha8Rng) -> usize {
    let order = system.offsets.order;
    solver.analyse(order, &system.rows, &system.columns).unwrap();
    let (negative_eigenvalues, smallest) = system.inertia();
    assert!(smallest > 1e-13, "the test system itself is nearly singular: {smallest:e}");
    assert_eq!(solver.factor(&system.values), Factorization::Regular { negative_eigenvalues });
    for _ in 0..2 {
        let rhs: Vec<f64> = (0..order).map(|_| random.random_range(-1.0..1.0)).collect();
        let mut solution = rhs.clone();
        solver.solve(&mut solution);
        let error = backward_error(system, &solution, &rhs);
        assert!(error < 1e-7, "backward error {error:e}");
        // One step of refinement, which Ipopt always takes, must reach rounding error.
        let product = system.product(&solution);
        let mut correction: Vec<f64> = rhs.iter().zip(&product).map(|(b, a)| b - a).collect();
        solver.solve(&mut correction);
        let refined: Vec<f64> = solution.iter().zip(&correction).map(|(x, d)| x + d).collect();
        let error = backward_error(system, &refined, &rhs);
        assert!(error < 1e-14, "backward error after refinement {error:e}");
        let witness = system.dense_solution(&rhs);
        let difference: Vec<f64> = refined.iter().zip(&witness).map(|(a, b)| a - b).collect();
        assert!(norm(&difference) <= 1e-12 / smallest * norm(&witness));
    }
    negative_eigenvalues
}

#[track_caller]
fn check_all(system: &System, random: &mut ChaCha8Rng) -> usize {
    let negative = check(system, StageKkt::new(&system.dims), random);
    check(system, StageKkt::scalar(&system.dims), random);
    let shuffled = system.shuffled(random);
    check(&shuffled, StageKkt::new(&system.dims), random);
    negative
}

fn uniform(states: usize, controls: usize, path: usize, steps: usize) -> Vec<NodeDims> {
    StageDims::uniform(states, controls, path, steps).nodes().to_vec()
}

fn constraints(nodes: &[NodeDims]) -> usize {
    nodes.iter().map(|n| n.equalities + n.inequalities).sum::<usize>()
        + nodes.iter().skip(1).map(|n| n.states).sum::<usize>()
}

#[test]
fn convex_systems_have_one_negative_eigenvalue_a_constraint() {
    let random = &mut ChaCha8Rng::seed_from_u64(1);
    for (states, controls, path, steps) in
        [(3, 2, 0, 4), (8, 2, 5, 3), (18, 7, 8, 2), (5, 1, 3, 6), (9, 8, 1, 2), (17, 9, 2, 2)]
    {
        let nodes = uniform(states, controls, path, steps);
        let recipe = Recipe { convexity: 8.0, ..Recipe::default() };
        let system = System::random(nodes.clone(), recipe, random);
        assert_eq!(check_all(&system, random), constraints(&nodes));
    }
}

/// Rows of integrators are stored by diagonals, the attitude's in full.
#[test]
fn arms_mix_integrators_with_full_rows() {
    let random = &mut ChaCha8Rng::seed_from_u64(10);
    for (joints, path) in [(2, 2), (4, 0), (7, 8)] {
        let arm = ArmSystem::new(joints, path, 3);
        let mut system = System::empty(arm.dims);
        (system.rows, system.columns, system.values) = (arm.rows, arm.columns, arm.values);
        assert_eq!(check_all(&system, random), constraints(system.dims.nodes()));
    }
}

/// With more than one eigenvalue too many the solver may stop, and says one too many.
#[test]
fn stopping_at_excess_reports_every_excess() {
    let random = &mut ChaCha8Rng::seed_from_u64(11);
    let mut excesses = 0;
    for round in 0..60 {
        let mut nodes = uniform(
            random.random_range(1..=6),
            random.random_range(1..=4),
            random.random_range(0..3),
            5,
        );
        nodes[5].equalities = random.random_range(0..2);
        let convexity = [0.0, 1.0, 2.0, 6.0][round % 4];
        let recipe = Recipe { convexity, density: 0.9, ..Recipe::default() };
        let system = System::random(nodes.clone(), recipe, random);
        let (negative, _) = system.inertia();
        let least = constraints(&nodes);
        assert!(negative >= least);
        let mut solver = StageKkt::new(&system.dims).stop_at_excess();
        solver.analyse(system.offsets.order, &system.rows, &system.columns).unwrap();
        let negative_eigenvalues = negative.min(least + 1);
        assert_eq!(solver.factor(&system.values), Factorization::Regular { negative_eigenvalues });
        let mut rhs = vec![1.0; system.offsets.order];
        solver.solve(&mut rhs);
        assert_eq!(rhs.iter().all(|value| value.is_finite()), negative == least);
        excesses += usize::from(negative > least);
    }
    assert!((15..=45).contains(&excesses), "{excesses} of 60 systems have the wrong inertia");
}

#[test]
fn indefinite_systems_are_counted_exactly() {
    let random = &mut ChaCha8Rng::seed_from_u64(2);
    let mut wrong_inertia = 0;
    for round in 0..60 {
        let nodes = uniform(
            random.random_range(1..=6),
            random.random_range(1..=4),
            random.random_range(0..4),
            random.random_range(1..=5),
        );
        let recipe = Recipe {
            convexity: [0.0, 0.5, 1.0, -1.0][round % 4],
            density: 0.3 + 0.7 * random.random::<f64>(),
            scaled_rows: round % 3 == 0,
            negative_slacks: if round % 5 == 0 { 0.5 } else { 0.0 },
            delta_d: if round % 7 == 0 { 0.3 } else { 0.0 },
            ..Recipe::default()
        };
        let system = System::random(nodes.clone(), recipe, random);
        wrong_inertia += usize::from(check_all(&system, random) != constraints(&nodes));
    }
    assert!(wrong_inertia > 20, "only {wrong_inertia} systems were indefinite in the null space");
}

#[test]
fn regularised_constraints_are_exact() {
    let random = &mut ChaCha8Rng::seed_from_u64(3);
    for round in 0..40 {
        let nodes: Vec<NodeDims> = uniform(
            random.random_range(1..=9),
            random.random_range(0..4),
            random.random_range(0..4),
            random.random_range(1..=5),
        )
        .into_iter()
        .map(|n| NodeDims { equalities: random.random_range(0..2), ..n })
        .collect();
        let delta = [1e-8, 1e-4, 0.3, 5.0][round % 4];
        let recipe = Recipe {
            convexity: if round % 3 == 0 { 4.0 } else { 0.0 },
            delta_c: delta,
            delta_d: delta,
            scaled_rows: round % 2 == 0,
            ..Recipe::default()
        };
        let system = System::random(nodes, recipe, random);
        check_all(&system, random);
    }
}

#[test]
fn nodes_may_differ() {
    let random = &mut ChaCha8Rng::seed_from_u64(4);
    let nodes = vec![
        node(2, 1, 1, 2),
        node(4, 3, 0, 1),
        node(1, 0, 0, 0),
        node(0, 2, 0, 3),
        node(3, 2, 1, 0),
        node(12, 0, 0, 2),
        node(2, 9, 2, 4),
    ];
    for convexity in [8.0, 0.0] {
        let recipe = Recipe { convexity, density: 0.9, ..Recipe::default() };
        let system = System::random(nodes.clone(), recipe, random);
        check_all(&system, random);
    }
}

#[test]
fn degenerate_sizes() {
    let random = &mut ChaCha8Rng::seed_from_u64(5);
    for nodes in [
        uniform(3, 2, 1, 1),
        uniform(3, 0, 2, 3),
        uniform(0, 2, 2, 3),
        uniform(3, 1, 0, 0),
        vec![node(0, 0, 0, 0)],
        vec![node(0, 0, 0, 0), node(2, 0, 0, 0)],
        vec![node(3, 0, 1, 1)],
    ] {
        let system = System::random(nodes, Recipe { density: 1.0, ..Recipe::default() }, random);
        if system.offsets.order > 0 {
            check_all(&system, random);
        }
    }
    let mut empty = StageKkt::new(&StageDims::new(vec![]));
    empty.analyse(0, &[], &[]).unwrap();
    assert_eq!(empty.factor(&[]), Factorization::Regular { negative_eigenvalues: 0 });
    empty.solve(&mut []);
}

/// Terminal equalities have no pivot of their own at the last node: they wait for controls of
/// earlier nodes.
#[test]
fn terminal_equalities_wait_for_earlier_controls() {
    let random = &mut ChaCha8Rng::seed_from_u64(6);
    for (states, controls, steps) in [(4, 2, 3), (6, 1, 8), (9, 4, 4)] {
        let mut nodes = uniform(states, controls, 1, steps);
        nodes[steps].equalities = states;
        for convexity in [6.0, 0.0] {
            let recipe = Recipe { convexity, density: 0.9, ..Recipe::default() };
            let system = System::random(nodes.clone(), recipe, random);
            let negative = check_all(&system, random);
            assert!(convexity == 0.0 || negative == constraints(&nodes));
        }
    }
}

/// Controls without any cost and, at the last step, without any effect on one: regular all the same
/// when an earlier state couples to them.
#[test]
fn controls_without_cost_wait_for_earlier_states() {
    let random = &mut ChaCha8Rng::seed_from_u64(7);
    for _ in 0..10 {
        let nodes = uniform(3, 2, 0, 4);
        let mut system = System::random(nodes.clone(), Recipe::default(), random);
        let at = system.offsets.clone();
        for t in 0..system.rows.len() {
            let (row, column) = (system.rows[t] as usize, system.columns[t] as usize);
            let control = |i: usize| (at.control[3]..at.control[3] + 2).contains(&i);
            if (control(row) && control(column)) || (row >= at.defect[3] && control(column)) {
                system.values[t] = 0.0;
            }
        }
        let negative = check_all(&system, random);
        assert_eq!(negative, constraints(&nodes) + 2);
    }
}

#[test]
fn singular_systems_are_reported() {
    let random = &mut ChaCha8Rng::seed_from_u64(8);
    let nodes = uniform(4, 2, 1, 3);
    let zero_where = |system: &mut System, condition: &dyn Fn(usize, usize) -> bool| {
        for t in 0..system.rows.len() {
            if condition(system.rows[t] as usize, system.columns[t] as usize) {
                system.values[t] = 0.0;
            }
        }
    };
    let outcome = |system: &System| {
        let mut solver = StageKkt::new(&system.dims);
        solver.analyse(system.offsets.order, &system.rows, &system.columns).unwrap();
        solver.factor(&system.values)
    };

    // A control that nothing depends on.
    for step in 0..3 {
        let mut system = System::random(nodes.clone(), Recipe::default(), random);
        let control = system.offsets.control[step];
        zero_where(&mut system, &|row, column| row == control || column == control);
        assert_eq!(outcome(&system), Factorization::Singular);
    }

    // Two controls that do the same, at no cost.
    for step in 0..3 {
        let mut system = System::random(nodes.clone(), Recipe::default(), random);
        let dense = system.dense();
        let (one, other) = (system.offsets.control[step], system.offsets.control[step] + 1);
        system = System::empty(system.dims);
        for i in 0..dense.nrows() {
            for j in 0..=i {
                let source = |index: usize| if index == other { one } else { index };
                let value = dense[(source(i), source(j))];
                if value != 0.0 {
                    system.push(i, j, value);
                }
            }
        }
        assert_eq!(outcome(&system), Factorization::Singular);
    }

    // A slack without curvature whose row has no regularisation and no variables is regular, but
    // two equal terminal equalities are not.
    let mut nodes = uniform(4, 2, 0, 4);
    nodes[4].equalities = 2;
    let recipe = Recipe { density: 1.0, ..Recipe::default() };
    let mut system = System::random(nodes, recipe, random);
    let (one, other) = (system.offsets.equality[4], system.offsets.equality[4] + 1);
    for state in system.offsets.state[4]..system.offsets.state[4] + 4 {
        let find = |row: usize, system: &System| {
            (0..system.rows.len())
                .find(|&t| system.rows[t] as usize == row && system.columns[t] as usize == state)
                .unwrap()
        };
        let (from, to) = (find(one, &system), find(other, &system));
        system.values[to] = system.values[from];
    }
    assert_eq!(outcome(&system), Factorization::Singular);
}

#[test]
fn values_that_are_not_finite_fail() {
    let random = &mut ChaCha8Rng::seed_from_u64(9);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for round in 0..40 {
            let system = System::random(uniform(3, 2, 1, 3), Recipe::default(), random);
            let mut solver = StageKkt::new(&system.dims);
            solver.analyse(system.offsets.order, &system.rows, &system.columns).unwrap();
            let mut values = system.values.clone();
            let place = random.random_range(0..values.len());
            values[place] = bad;
            let outcome = solver.factor(&values);
            assert_eq!(outcome, Factorization::Failed, "{bad} at {place} in round {round}");
            // The solver is as good as new afterwards.
            assert!(matches!(solver.factor(&system.values), Factorization::Regular { .. }));
        }
    }
}
