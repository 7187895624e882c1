use crate::callbacks::{self, Session};
use crate::handle::{Arrays, Handle};
use crate::iterate::Iterates;
use crate::options::validate;
use crate::slot::{self, Report};
use crate::status::{brings_functions, status};
use crate::trap::Trap;
use crate::{
    Control, Declarations, EvaluationTiming, Iteration, LinearSolver, Multipliers, NlpSolution,
    OptionValue, Options, PivotTolerances, Problem, SolveError, Start, Status, Timing,
};
use righting_ipopt_sys as sys;
use std::cell::Cell;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Solves with MUMPS.
///
/// `on_iteration` is called in every iteration and may end the solve. Waits while another thread
/// solves with MUMPS.
///
/// # Errors
/// When there is no Ipopt, or the problem, the options or the start are not usable. However a solve
/// ends that was begun is a [`Status`].
///
/// # Panics
/// When `problem` or `on_iteration` does.
pub fn solve<P: Problem + ?Sized>(
    problem: &mut P,
    options: &Options,
    start: &Start,
    on_iteration: impl FnMut(&Iteration) -> Control,
) -> Result<NlpSolution, SolveError> {
    Solve { problem, options, start }.run(Engine::Mumps, on_iteration)
}

/// Solves with the linear solver given; otherwise as [`solve`], but waits for nobody.
///
/// # Errors
/// As [`solve`], and [`SolveError::NoLinearSolverSlot`] where Ipopt cannot be given one,
/// [`SolveError::LinearSolver`] when the solver refuses the system.
///
/// # Panics
/// When `problem`, `linear_solver` or `on_iteration` does.
pub fn solve_with<P: Problem + ?Sized, S: LinearSolver>(
    problem: &mut P,
    options: &Options,
    start: &Start,
    linear_solver: &mut S,
    on_iteration: impl FnMut(&Iteration) -> Control,
) -> Result<NlpSolution, SolveError> {
    Solve { problem, options, start }.run(Engine::Slot(linear_solver), on_iteration)
}

struct Solve<'a, P: ?Sized> {
    problem: &'a mut P,
    options: &'a Options,
    start: &'a Start,
}

enum Engine<'a> {
    Mumps,
    Slot(&'a mut dyn LinearSolver),
}

impl<P: Problem + ?Sized> Solve<'_, P> {
    fn run<F>(self, engine: Engine, on_iteration: F) -> Result<NlpSolution, SolveError>
    where
        F: FnMut(&Iteration) -> Control,
    {
        let _this_thread = Busy::enter()?;
        validate(self.options)?;
        let mut declarations = Declarations::of(self.problem)?;
        declarations.check_start(self.start)?;

        let ipopt = sys::api()?;
        let mut point = Iterate::of(self.start, &declarations);
        let trap = Trap::default();
        let (status, report, last_iteration, timing) = {
            // Outlives the handle: freeing it frees what MUMPS holds.
            let _mumps = engine.lock();
            let clock = Instant::now();
            let created = callbacks::create::<P, F>(ipopt, &mut declarations);
            // SAFETY: it was created just now.
            let handle = unsafe { Handle::own(ipopt, created)? };
            self.configure(&handle, &engine, &declarations)?;
            handle.set_iteration_callback(Some(callbacks::iteration::<P, F>));

            let mut session = Session {
                problem: &mut *self.problem,
                on_iteration,
                iterates: Iterates::of(ipopt, &handle, &declarations),
                trap: &trap,
                jacobian: &declarations.jacobian,
                hessian: &declarations.hessian,
                timing: EvaluationTiming::default(),
                last_iteration: None,
            };
            let user_data = (&raw mut session).cast();
            // SAFETY: the point has the sizes that were declared; the handle was created with the
            // callbacks of `Session<P, F>`, and the session is not touched before they are done.
            let mut run = || status(unsafe { handle.solve(point.arrays(), user_data) });
            let (status, report) = match engine {
                Engine::Mumps => (run(), None),
                Engine::Slot(solver) => {
                    let (status, report) = slot::with_solver(solver, &trap, run);
                    (status, Some(report))
                }
            };
            let timing = Timing {
                total: clock.elapsed(),
                evaluation: session.timing,
                linear_solver: report.as_ref().map(|report| report.timing),
            };
            (status, report.unwrap_or_default(), session.last_iteration, timing)
        };
        trap.release();

        let status = judge(status, report)?;
        if !brings_functions(status) {
            point.evaluate(self.problem);
        }
        Ok(point.into_solution(status, last_iteration, timing, &declarations))
    }

    fn configure(
        &self,
        handle: &Handle,
        engine: &Engine,
        declarations: &Declarations,
    ) -> Result<(), SolveError> {
        let text = |value: &str| OptionValue::Text(value.to_owned());
        handle.quiet(self.options.print_level)?;
        handle.set_all(self.options)?;
        match engine {
            Engine::Mumps => handle.set("linear_solver", &text("mumps"))?,
            Engine::Slot(solver) => {
                let hsllib = slot::install()?;
                handle.set("linear_solver", &text("ma57"))?;
                if let Some(hsllib) = hsllib {
                    handle.set("hsllib", &text(hsllib))?;
                }
                handle.set("linear_system_scaling", &text("none"))?;
                // Equal tolerances tell Ipopt that there is nothing to raise.
                let PivotTolerances { initial, largest } = solver
                    .pivot_tolerances()
                    .unwrap_or(PivotTolerances { initial: 1e-8, largest: 1e-8 });
                handle.set("ma57_pivtol", &OptionValue::Number(initial))?;
                handle.set("ma57_pivtolmax", &OptionValue::Number(largest))?;
            }
        }
        if self.start.multipliers.is_some() {
            handle.set("warm_start_init_point", &text("yes"))?;
        }
        declarations.scaling.clone().map_or(Ok(()), |scaling| handle.set_scaling(scaling))
    }
}

impl Engine<'_> {
    fn lock(&self) -> Option<MutexGuard<'static, ()>> {
        static MUMPS: Mutex<()> = Mutex::new(());
        match self {
            // There is no state behind the lock that a panic could have left half-changed.
            Self::Mumps => Some(MUMPS.lock().unwrap_or_else(PoisonError::into_inner)),
            Self::Slot(_) => None,
        }
    }
}

/// Ipopt has no code for a linear solver that fails: what it returns depends on how far it came.
fn judge(status: Status, report: Report) -> Result<Status, SolveError> {
    match report {
        Report { refusal: Some(refusal), .. } => Err(SolveError::LinearSolver(refusal)),
        Report { failed: true, .. } if !status.is_success() => Ok(Status::LinearSolverFailed),
        _ => Ok(status),
    }
}

/// The start, that becomes the solution.
struct Iterate {
    x: Vec<f64>,
    objective: f64,
    g: Vec<f64>,
    multipliers: Multipliers,
}

impl Iterate {
    fn of(start: &Start, declarations: &Declarations) -> Self {
        Self {
            x: start.x.clone(),
            objective: f64::NAN,
            g: vec![f64::NAN; declarations.constraints],
            multipliers: start.multipliers.clone().unwrap_or_else(|| Multipliers {
                constraints: vec![0.0; declarations.constraints],
                lower: vec![0.0; declarations.variables],
                upper: vec![0.0; declarations.variables],
            }),
        }
    }

    fn arrays(&mut self) -> Arrays<'_> {
        Arrays {
            x: &mut self.x,
            g: &mut self.g,
            objective: &mut self.objective,
            constraints: &mut self.multipliers.constraints,
            lower: &mut self.multipliers.lower,
            upper: &mut self.multipliers.upper,
        }
    }

    fn evaluate<P: Problem + ?Sized>(&mut self, problem: &mut P) {
        self.objective = problem.objective(&self.x, true).unwrap_or(f64::NAN);
        if problem.constraints(&self.x, false, &mut self.g).is_err() {
            self.g.fill(f64::NAN);
        }
    }

    fn into_solution(
        self,
        status: Status,
        last_iteration: Option<Iteration>,
        timing: Timing,
        declarations: &Declarations,
    ) -> NlpSolution {
        NlpSolution {
            status,
            constraint_violation: declarations.violation(&self.x, &self.g),
            x: self.x,
            objective: self.objective,
            g: self.g,
            multipliers: self.multipliers,
            iterations: last_iteration.map_or(0, |last| last.iteration),
            reduced_hessian: None,
            last_iteration,
            timing,
        }
    }
}

/// Marks that this thread is in a solve: neither MUMPS nor the slot can be entered twice.
struct Busy;

thread_local! {
    static BUSY: Cell<bool> = const { Cell::new(false) };
}

impl Busy {
    fn enter() -> Result<Self, SolveError> {
        if BUSY.replace(true) { Err(SolveError::Nested) } else { Ok(Self) }
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        BUSY.set(false);
    }
}
