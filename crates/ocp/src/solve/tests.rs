use num_dual::DualNum;
use righting_ipopt::{Factorization, LinearSolverError, PivotTolerances};

use super::*;
use crate::control_problem::ControlProblem;
use crate::grid::Grid;
use crate::initial_guess::InitialGuess;
use crate::stage_functions::StageFunctions;

const STEPS: usize = 30;

/// What goes wrong with a factorisation.
#[derive(Clone, Copy, Debug)]
enum Trouble {
    /// It is given up.
    Failed,
    /// Every matrix is called singular.
    Singular,
    /// The inertia is wrong, whatever Ipopt adds.
    WrongInertia,
    /// Solutions are not numbers.
    NotANumber,
    /// Solutions are solutions of something else.
    Noise,
}

/// The stage solver, sound for so many factorisations.
struct Failing {
    stage: StageKkt,
    sound: usize,
    is_sound: bool,
    trouble: Trouble,
}

impl righting_ipopt::LinearSolver for Failing {
    fn analyse(
        &mut self,
        order: usize,
        rows: &[i32],
        columns: &[i32],
    ) -> Result<(), LinearSolverError> {
        self.stage.analyse(order, rows, columns)
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        self.is_sound = self.sound > 0;
        self.sound = self.sound.saturating_sub(1);
        let outcome = self.stage.factor(values);
        match self.trouble {
            _ if self.is_sound => outcome,
            Trouble::Failed => Factorization::Failed,
            Trouble::Singular => Factorization::Singular,
            Trouble::WrongInertia => Factorization::Regular { negative_eigenvalues: 0 },
            Trouble::NotANumber | Trouble::Noise => outcome,
        }
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        self.stage.solve(right_hand_sides);
        match self.trouble {
            _ if self.is_sound => {}
            Trouble::NotANumber => right_hand_sides.fill(f64::NAN),
            Trouble::Noise => {
                for (i, value) in right_hand_sides.iter_mut().enumerate() {
                    *value += (i as f64).sin();
                }
            }
            _ => {}
        }
    }

    fn pivot_tolerances(&self) -> Option<PivotTolerances> {
        self.stage.pivot_tolerances()
    }

    fn set_pivot_tolerance(&mut self, tolerance: f64) {
        self.stage.set_pivot_tolerance(tolerance);
    }
}

/// A pendulum that swings up and is held there, with little torque.
fn pendulum() -> ControlProblem {
    ControlProblem::new(2, 1, |x, u| vec![x[1], u[0] - x[0].sin()])
        .running_cost(|_, u, _| u[0].powi(2))
        .control_bounds(ComponentBounds::symmetric(&[0.6]))
        .terminal_constraints(
            ComponentBounds::new(vec![std::f64::consts::PI, 0.0], vec![std::f64::consts::PI, 0.0]),
            |x| x.to_vec(),
        )
}

fn start(program: &MultipleShooting) -> righting_ipopt::Start {
    let guess = InitialGuess::constant(&[0.0, 0.0], 1, STEPS);
    program.ipopt_start(&OcpStart::Guess(guess)).unwrap()
}

/// The solution of a solver that fails, and how often iterations were counted from the start.
fn solved_in_trouble(
    functions: &StageFunctions,
    sound: usize,
    trouble: Trouble,
    linear_solver: LinearSolverChoice,
) -> (OcpSolution, usize) {
    let grid = Grid::new(10.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(functions, grid, &[0.0, 0.0]).unwrap();
    let stage = StageKkt::new(&program.stage_dims());
    let mut failing = Failing { stage, sound, is_sound: true, trouble };
    let settings = Settings { linear_solver, ..Settings::default() };
    let start = start(&program);
    let mut begun = 0;
    let solution = program
        .solve_in_stages(&start, &settings, &mut failing, &mut |iteration| {
            begun += usize::from(iteration.iteration == 0);
            Control::Continue
        })
        .unwrap();
    (solution, begun)
}

#[test]
fn mumps_takes_over_whatever_goes_wrong_and_whenever() {
    let functions = StageFunctions::compile(&pendulum()).unwrap();
    let grid = Grid::new(10.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.0]).unwrap();
    let mumps = Settings { linear_solver: LinearSolverChoice::Mumps, ..Settings::default() };
    let guess = OcpStart::Guess(InitialGuess::constant(&[0.0, 0.0], 1, STEPS));
    let expected = program.solve(&guess, &mumps, |_| Control::Continue).unwrap();
    assert_eq!(expected.status, Status::Solved);
    assert_eq!(expected.linear_solver, UsedLinearSolver::Mumps);
    use Trouble::*;
    for trouble in [Failed, Singular, WrongInertia, NotANumber, Noise] {
        for sound in [0, 2, 5] {
            let (alone, _) =
                solved_in_trouble(&functions, sound, trouble, LinearSolverChoice::Stage);
            assert!(!alone.status.is_success(), "{trouble:?} after {sound}: {}", alone.status);
            assert_eq!(alone.linear_solver, UsedLinearSolver::Stage);

            let (solution, begun) =
                solved_in_trouble(&functions, sound, trouble, LinearSolverChoice::Auto);
            assert_eq!(solution.status, Status::Solved, "{trouble:?} after {sound}");
            assert_eq!(solution.linear_solver, UsedLinearSolver::MumpsAfterStage);
            assert_eq!(solution.point.z, expected.point.z, "{trouble:?} after {sound}");
            assert_eq!(solution.history.len(), expected.history.len());
            assert!(begun <= 3);
        }
    }
}

#[test]
fn both_optimizers_go_the_same_way() {
    let functions = StageFunctions::compile(&pendulum()).unwrap();
    let grid = Grid::new(10.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.0]).unwrap();
    let start = OcpStart::Guess(InitialGuess::constant(&[0.0, 0.0], 1, STEPS));
    let mut solved = |optimizer| {
        let ipopt = Options { fast_step_computation: true, ..Options::default() };
        let settings = Settings { ipopt, optimizer, ..Settings::default() };
        program.solve(&start, &settings, |_| Control::Continue).unwrap()
    };
    let (own, ipopt) = (solved(Optimizer::Interior), solved(Optimizer::Ipopt));
    assert_eq!(own.optimizer, Optimizer::Interior);
    assert_eq!(ipopt.optimizer, Optimizer::Ipopt);
    assert_eq!((own.status, own.iterations()), (ipopt.status, ipopt.iterations()));
    assert!(own.iterations() > 10);
    for (own, ipopt) in own.history.iter().zip(&ipopt.history) {
        let difference = (own.objective - ipopt.objective).abs();
        assert!(difference <= 1e-7 * ipopt.objective.abs().max(1e-2), "{own:?} is not {ipopt:?}");
        assert_eq!(own.line_search_trials, ipopt.line_search_trials, "{own:?} is not {ipopt:?}");
    }
    let differences = own.point.z.iter().zip(&ipopt.point.z).map(|(a, b)| (a - b).abs());
    assert!(differences.fold(0.0, f64::max) < 1e-6);
}

#[test]
fn an_attempt_that_is_given_up_is_kept_with_its_reason() {
    let functions = StageFunctions::compile(&pendulum()).unwrap();
    let grid = Grid::new(10.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.0]).unwrap();
    let start = OcpStart::Guess(InitialGuess::constant(&[0.0, 0.0], 1, STEPS));
    let ipopt = Options { max_cpu_time: 100.0, ..Options::default() };
    let settings = Settings { ipopt, optimizer: Optimizer::Interior, ..Settings::default() };
    let solution = program.solve(&start, &settings, |_| Control::Continue).unwrap();
    assert_eq!((solution.status, solution.optimizer), (Status::Solved, Optimizer::Ipopt));
    let [given_up, delivered] = &solution.attempts[..] else { panic!("{:?}", solution.attempts) };
    assert_eq!((given_up.steps, given_up.optimizer), (STEPS, Optimizer::Interior));
    assert_eq!(given_up.end, AttemptEnd::GivenUp("a time limit is not supported".to_owned()));
    assert_eq!(delivered.end, AttemptEnd::Status(Status::Solved));
    assert_eq!(
        (delivered.optimizer, delivered.iterations),
        (Optimizer::Ipopt, solution.iterations())
    );

    let mut failing = Failing {
        stage: StageKkt::new(&program.stage_dims()),
        sound: 3,
        is_sound: true,
        trouble: Trouble::Singular,
    };
    let settings = Settings { ipopt: Options::default(), ..settings };
    let start = program.ipopt_start(&start).unwrap();
    let solution = program
        .solve_in_stages(&start, &settings, &mut failing, &mut |_| Control::Continue)
        .unwrap();
    assert_eq!(solution.linear_solver, UsedLinearSolver::MumpsAfterStage);
    let ends: Vec<_> = solution.attempts.iter().map(|a| (a.optimizer, a.linear_solver)).collect();
    let (stage, mumps) = (UsedLinearSolver::Stage, UsedLinearSolver::Mumps);
    let by_stage = [(Optimizer::Interior, stage), (Optimizer::Ipopt, stage)];
    assert_eq!(ends, [&by_stage[..], &[(Optimizer::Ipopt, mumps)]].concat());
    assert!(matches!(solution.attempts[0].end, AttemptEnd::GivenUp(_)), "{:?}", solution.attempts);
    assert!(solution.attempts[0].iterations > 0);
}
