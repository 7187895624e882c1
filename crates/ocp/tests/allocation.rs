//! The program's functions allocate nothing once they have run.

#[path = "../../symbolic/tests/counting/mod.rs"]
mod counting;

use counting::allocations;
use num_dual::DualNum;
use righting_nlp::Problem;
use righting_ocp::*;

#[test]
fn an_iteration_allocates_nothing() {
    let problem = ControlProblem::new(3, 1, |x, u| vec![x[1], u[0] - x[0].sin(), x[0] * x[2]])
        .running_cost(|x, u, _| u[0] * u[0] + x[2] * x[2])
        .terminal_cost(|x| x[0].powi(2))
        .path_constraints(ComponentBounds::new(vec![-1.0], vec![1.0]), |x| vec![x[0] * x[1]])
        .stage_constraints(ComponentBounds::new(vec![-9.0], vec![9.0]), |x, u, h| {
            vec![x[0] + h * x[1] + u[0]]
        })
        .terminal_constraints(ComponentBounds::new(vec![0.0], vec![0.0]), |x| vec![x[1] - x[2]]);
    let functions = StageFunctions::compile(&problem).unwrap();
    let grid = Grid::new(2.0, 50).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.1, 0.2, 0.3]).unwrap();
    let layout = program.layout();
    let mut z = vec![0.1; layout.variables()];
    let multipliers = vec![0.5; layout.constraints()];
    let (mut gradient, mut g) = (z.clone(), multipliers.clone());
    let mut jacobian = vec![0.0; program.jacobian_structure().len()];
    let mut hessian = vec![0.0; program.hessian_structure().len()];
    let mut before = 0;
    for iteration in 0..3 {
        if iteration == 1 {
            before = allocations();
        }
        z[0] += 0.01;
        program.objective(&z, true).unwrap();
        program.gradient(&z, false, &mut gradient).unwrap();
        program.constraints(&z, false, &mut g).unwrap();
        program.jacobian(&z, false, &mut jacobian).unwrap();
        program.hessian(&z, false, 1.0, &multipliers, true, &mut hessian).unwrap();
    }
    assert_eq!(allocations(), before);
    assert!(before > 0);
}
