//! What Ipopt calls, and the way from there to the user's [`Problem`].

use crate::iterate::Iterates;
use crate::trap::Trap;
use crate::{Control, Declarations, EvaluationTiming, Iteration, Problem, Tally, TripletStructure};
use righting_ipopt_sys as sys;
use std::slice::{from_raw_parts, from_raw_parts_mut};
use std::time::Instant;
use sys::{Bool, Index, Number, UserDataPtr};

/// What the user data of a solve points to.
///
/// Callbacks borrow what they need of it and no more: from within the iteration callback Ipopt may be
/// asked for its iterate, and may evaluate the problem for the answer.
pub(crate) struct Session<'a, P: ?Sized, F> {
    pub(crate) problem: &'a mut P,
    pub(crate) on_iteration: F,
    pub(crate) iterates: Iterates,
    pub(crate) trap: &'a Trap,
    pub(crate) jacobian: &'a TripletStructure,
    pub(crate) hessian: &'a TripletStructure,
    pub(crate) timing: EvaluationTiming,
    pub(crate) last_iteration: Option<Iteration>,
}

/// How many entries of the Jacobian Ipopt is told of: it takes no constraints without any.
pub(crate) fn declared_jacobian_entries(declarations: &Declarations) -> usize {
    declarations.jacobian.len().max(usize::from(declarations.constraints > 0))
}

/// `CreateIpoptProblem` with the callbacks of a [`Session<P, F>`].
pub(crate) fn create<P, F>(ipopt: &sys::Api, declarations: &mut Declarations) -> sys::IpoptProblem
where
    P: Problem + ?Sized,
    F: FnMut(&Iteration) -> Control,
{
    // Every count was found to fit when the declarations were checked.
    let index = |count: usize| count as Index;
    let nonzeros = declared_jacobian_entries(declarations);
    // SAFETY: the arrays have the lengths given and Ipopt copies them.
    unsafe {
        (ipopt.CreateIpoptProblem)(
            index(declarations.variables),
            declarations.x_lower.as_mut_ptr(),
            declarations.x_upper.as_mut_ptr(),
            index(declarations.constraints),
            declarations.g_lower.as_mut_ptr(),
            declarations.g_upper.as_mut_ptr(),
            index(nonzeros),
            index(declarations.hessian.len()),
            0,
            Some(objective::<P, F>),
            Some(constraints::<P, F>),
            Some(gradient::<P, F>),
            Some(jacobian::<P, F>),
            Some(hessian::<P, F>),
        )
    }
}

/// Every evaluation goes through here: no panic gets past it, and its time is counted.
///
/// # Safety
/// `user_data` must point to a `Session<P, F>` whose problem nobody else uses until this returns.
unsafe fn evaluate<P, F>(
    user_data: UserDataPtr,
    tally: impl FnOnce(&mut EvaluationTiming) -> &mut Tally,
    body: impl FnOnce(&mut P) -> bool,
) -> Bool
where
    P: ?Sized,
{
    let session = user_data.cast::<Session<P, F>>();
    let start = Instant::now();
    // SAFETY: the caller's promise. Of the session only the problem is borrowed while `body` runs,
    // and only the tally afterwards; the iteration callback, which may be running, borrows neither.
    unsafe {
        let (trap, problem) = ((*session).trap, &mut *(*session).problem);
        let done = trap.run(|| body(problem)).unwrap_or(false);
        tally(&mut (*session).timing).add_since(start);
        if done { sys::TRUE } else { sys::FALSE }
    }
}

/// # Safety
/// `pointer` must be valid for `count` reads as long as the callback runs, or `count` be zero.
unsafe fn read<'a, T>(pointer: *const T, count: Index) -> &'a [T] {
    if count <= 0 || pointer.is_null() {
        return &[];
    }
    // SAFETY: the caller's promise.
    unsafe { from_raw_parts(pointer, count as usize) }
}

/// # Safety
/// As [`read`], for writing too, and nobody else uses the memory meanwhile.
unsafe fn write<'a, T>(pointer: *mut T, count: Index) -> &'a mut [T] {
    if count <= 0 || pointer.is_null() {
        return &mut [];
    }
    // SAFETY: the caller's promise.
    unsafe { from_raw_parts_mut(pointer, count as usize) }
}

fn are_finite(values: &[f64]) -> bool {
    // Without an early exit, so that it compiles to vector code.
    values.iter().fold(true, |finite, value| finite & value.is_finite())
}

unsafe extern "C" fn objective<P: Problem + ?Sized, F>(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    value: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes n numbers, room for one, and the user data of this solve.
    unsafe {
        let (x, value) = (read(x, n), write(value, 1));
        evaluate::<P, F>(
            user_data,
            |timing| &mut timing.objective,
            |problem| match problem.objective(x, new_x != sys::FALSE) {
                Ok(objective) => {
                    value[0] = objective;
                    objective.is_finite()
                }
                Err(_) => false,
            },
        )
    }
}

unsafe extern "C" fn gradient<P: Problem + ?Sized, F>(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes n numbers, room for as many, and the user data of this solve.
    unsafe {
        let (x, values) = (read(x, n), write(values, n));
        evaluate::<P, F>(
            user_data,
            |timing| &mut timing.gradient,
            |problem| {
                problem.gradient(x, new_x != sys::FALSE, values).is_ok() && are_finite(values)
            },
        )
    }
}

unsafe extern "C" fn constraints<P: Problem + ?Sized, F>(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    m: Index,
    g: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes n numbers, room for m, and the user data of this solve.
    unsafe {
        let (x, g) = (read(x, n), write(g, m));
        evaluate::<P, F>(
            user_data,
            |timing| &mut timing.constraints,
            |problem| problem.constraints(x, new_x != sys::FALSE, g).is_ok() && are_finite(g),
        )
    }
}

unsafe extern "C" fn jacobian<P: Problem + ?Sized, F>(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    _m: Index,
    count: Index,
    rows: *mut Index,
    columns: *mut Index,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes n numbers or none, room for `count` indices or values, and the user
    // data of this solve.
    unsafe {
        let structure = (*user_data.cast::<Session<P, F>>()).jacobian;
        if values.is_null() {
            return give_structure(structure, write(rows, count), write(columns, count));
        }
        let (x, values) = (read(x, n), write(values, count));
        evaluate::<P, F>(
            user_data,
            |timing| &mut timing.jacobian,
            |problem| {
                let (own, padding) = values.split_at_mut(structure.len());
                padding.fill(0.0);
                problem.jacobian(x, new_x != sys::FALSE, own).is_ok() && are_finite(own)
            },
        )
    }
}

unsafe extern "C" fn hessian<P: Problem + ?Sized, F>(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    factor: Number,
    m: Index,
    multipliers: *mut Number,
    new_multipliers: Bool,
    count: Index,
    rows: *mut Index,
    columns: *mut Index,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes n numbers or none, m multipliers, room for `count` indices or values,
    // and the user data of this solve.
    unsafe {
        if values.is_null() {
            let structure = (*user_data.cast::<Session<P, F>>()).hessian;
            return give_structure(structure, write(rows, count), write(columns, count));
        }
        let (x, multipliers) = (read(x, n), read(multipliers, m));
        let (new_x, new_multipliers) = (new_x != sys::FALSE, new_multipliers != sys::FALSE);
        let values = write(values, count);
        evaluate::<P, F>(
            user_data,
            |timing| &mut timing.hessian,
            |problem| {
                problem.hessian(x, new_x, factor, multipliers, new_multipliers, values).is_ok()
                    && are_finite(values)
            },
        )
    }
}

fn give_structure(structure: &TripletStructure, rows: &mut [Index], columns: &mut [Index]) -> Bool {
    let count = structure.len();
    rows[..count].copy_from_slice(&structure.rows);
    columns[..count].copy_from_slice(&structure.columns);
    // The one entry of a Jacobian that has none.
    rows[count..].fill(0);
    columns[count..].fill(0);
    sys::TRUE
}

pub(crate) unsafe extern "C" fn iteration<P, F>(
    mode: Index,
    count: Index,
    objective: Number,
    primal_infeasibility: Number,
    dual_infeasibility: Number,
    mu: Number,
    step_norm: Number,
    regularization: Number,
    alpha_dual: Number,
    alpha_primal: Number,
    trials: Index,
    user_data: UserDataPtr,
) -> Bool
where
    P: ?Sized,
    F: FnMut(&Iteration) -> Control,
{
    let iteration = Iteration {
        iteration: usize::try_from(count).unwrap_or(0),
        restoration: sys::AlgorithmMode(mode) == sys::AlgorithmMode::RESTORATION_PHASE,
        objective,
        primal_infeasibility,
        dual_infeasibility,
        mu,
        step_norm,
        regularization,
        alpha_primal,
        alpha_dual,
        line_search_trials: usize::try_from(trials).unwrap_or(0),
    };
    let session = user_data.cast::<Session<P, F>>();
    let start = Instant::now();
    // SAFETY: Ipopt passes the user data of this solve. While the callback runs only the callback
    // itself is borrowed, so that the problem may be evaluated meanwhile.
    unsafe {
        (*session).last_iteration = Some(iteration);
        let (trap, iterates) = ((*session).trap, (*session).iterates);
        let on_iteration = &mut (*session).on_iteration;
        let restoration = iteration.restoration;
        let outcome = trap.run(|| iterates.within(restoration, || on_iteration(&iteration)));
        (*session).timing.iteration.add_since(start);
        if outcome == Some(Control::Continue) { sys::TRUE } else { sys::FALSE }
    }
}
