//! Swings a pendulum up with a cart that may push with 20 N at most: from hanging at rest to
//! balanced at rest, 1 m further, in 2 s (Kelly, *SIAM Review* 59(4), 2017, appendix E).

use righting_ocp::*;

const CART_KG: f64 = 1.0;
const BOB_KG: f64 = 0.3;
const ROD_M: f64 = 0.5;
const GRAVITY_M_S2: f64 = 9.81;
const DURATION_S: f64 = 2.0;
const STEPS: usize = 100;

/// State: cart position (m), rod angle from hanging (rad), and their rates. Control: force (N).
fn cart_pole(x: &[Expr], u: &[Expr]) -> Vec<Expr> {
    let (sin, cos) = x[1].sin_cos();
    let inertia = sin * sin * BOB_KG + CART_KG;
    let swing = x[3] * x[3] * ROD_M * BOB_KG * sin;
    let cart = (swing + u[0] + cos * sin * (BOB_KG * GRAVITY_M_S2)) / inertia;
    let rod =
        -(swing * cos + u[0] * cos + sin * ((CART_KG + BOB_KG) * GRAVITY_M_S2)) / (inertia * ROD_M);
    vec![x[2], x[3], cart, rod]
}

fn main() -> Result<(), OcpError> {
    let goal = vec![1.0, std::f64::consts::PI, 0.0, 0.0];
    let step_s = DURATION_S / STEPS as f64;
    let problem = ControlProblem::new(4, 1, cart_pole)
        .running_cost(move |_, u, _| u[0] * u[0] * step_s)
        .terminal_constraints(ComponentBounds::new(goal.clone(), goal.clone()), |x| x.to_vec())
        .state_bounds(ComponentBounds::symmetric(&[
            2.0,
            f64::INFINITY,
            f64::INFINITY,
            f64::INFINITY,
        ]))
        .control_bounds(ComponentBounds::symmetric(&[20.0]));
    let functions = StageFunctions::compile(&problem)?;

    let start = [0.0; 4];
    let mut guess = InitialGuess::constant(&start, 1, STEPS);
    for node in 0..=STEPS {
        let progress = node as f64 / STEPS as f64;
        let row = guess.states.row_mut(node);
        row.iter_mut().zip(&goal).for_each(|(state, goal)| *state = progress * goal);
    }
    let mut program = MultipleShooting::new(&functions, Grid::new(DURATION_S, STEPS)?, &start)?;
    let solution =
        program.solve(&OcpStart::Guess(guess), &Settings::default(), |_| Control::Continue)?;

    println!("{:?}, effort {:.3} N² s", solution.status, solution.objective);
    for (node, state) in solution.states.rows().enumerate().step_by(10) {
        println!(
            "{:4.1} s  cart {:6.3} m  rod {:6.3} rad",
            node as f64 * step_s,
            state[0],
            state[1]
        );
    }
    Ok(())
}
