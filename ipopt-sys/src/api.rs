//! The functions of Ipopt's C interface, as a table: where they are is known only once the library is
//! open.

use crate::functions::functions;
use crate::library::{self, LoadError};
use crate::{
    ApplicationReturnStatus, Bool, Eval_F_CB, Eval_G_CB, Eval_Grad_F_CB, Eval_H_CB, Eval_Jac_G_CB,
    Index, Int, Intermediate_CB, IpoptProblem, Number, UserDataPtr,
};
use std::ffi::{c_char, c_int};
use std::sync::OnceLock;

functions! {
    /// The functions of `IpStdCInterface.h`, by their names there.
    pub struct Api;

    /// Makes a problem of `n ≥ 1` variables and `m ≥ 0` constraints; the bounds are copied. Null
    /// when an argument is refused, among others `m > 0` with `nele_jac = 0`. Indices count from
    /// zero with `index_style` 0, from one with 1. Pass all callbacks, also without constraints.
    fn CreateIpoptProblem(
        n: Index,
        x_L: *mut Number,
        x_U: *mut Number,
        m: Index,
        g_L: *mut Number,
        g_U: *mut Number,
        nele_jac: Index,
        nele_hess: Index,
        index_style: Index,
        eval_f: Eval_F_CB,
        eval_g: Eval_G_CB,
        eval_grad_f: Eval_Grad_F_CB,
        eval_jac_g: Eval_Jac_G_CB,
        eval_h: Eval_H_CB,
    ) -> IpoptProblem;

    /// Frees a problem.
    fn FreeIpoptProblem(ipopt_problem: IpoptProblem);

    /// Sets a string option; false when its name or value is refused.
    fn AddIpoptStrOption(
        ipopt_problem: IpoptProblem,
        keyword: *mut c_char,
        val: *mut c_char,
    ) -> Bool;

    /// Sets a floating-point option; false when its name or value is refused.
    fn AddIpoptNumOption(
        ipopt_problem: IpoptProblem,
        keyword: *mut c_char,
        val: Number,
    ) -> Bool;

    /// Sets an integer option; false when its name or value is refused.
    fn AddIpoptIntOption(ipopt_problem: IpoptProblem, keyword: *mut c_char, val: Int) -> Bool;

    /// Sends the log, up to `print_level`, also to a file.
    fn OpenIpoptOutputFile(
        ipopt_problem: IpoptProblem,
        file_name: *mut c_char,
        print_level: Int,
    ) -> Bool;

    /// Scaling for `nlp_scaling_method = user-scaling`; a null array means no scaling.
    fn SetIpoptProblemScaling(
        ipopt_problem: IpoptProblem,
        obj_scaling: Number,
        x_scaling: *mut Number,
        g_scaling: *mut Number,
    ) -> Bool;

    /// Sets, or with `None` unsets, the callback of each iteration.
    fn SetIntermediateCallback(
        ipopt_problem: IpoptProblem,
        intermediate_cb: Intermediate_CB,
    ) -> Bool;

    /// Solves from `x` and, in a warm start, from the multipliers; all are overwritten with the
    /// result. Every array but `x` may be null.
    fn IpoptSolve(
        ipopt_problem: IpoptProblem,
        x: *mut Number,
        g: *mut Number,
        obj_val: *mut Number,
        mult_g: *mut Number,
        mult_x_L: *mut Number,
        mult_x_U: *mut Number,
        user_data: UserDataPtr,
    ) -> ApplicationReturnStatus;

    optional

    /// The current iterate, of the problem as it was given or as Ipopt scaled it; from within the
    /// intermediate callback only. Arrays may be null: `n` numbers at `x`, `z_L` and `z_U`, `m` at
    /// `g` and `lambda`. False when there is none. Ipopt 3.14 has it.
    fn GetIpoptCurrentIterate(
        ipopt_problem: IpoptProblem,
        scaled: Bool,
        n: Index,
        x: *mut Number,
        z_L: *mut Number,
        z_U: *mut Number,
        m: Index,
        g: *mut Number,
        lambda: *mut Number,
    ) -> Bool;

    /// By how much the current iterate violates bounds, complementarity, stationarity and
    /// constraints; as `GetIpoptCurrentIterate`, but it may call the objective's callback.
    fn GetIpoptCurrentViolations(
        ipopt_problem: IpoptProblem,
        scaled: Bool,
        n: Index,
        x_L_violation: *mut Number,
        x_U_violation: *mut Number,
        compl_x_L: *mut Number,
        compl_x_U: *mut Number,
        grad_lag_x: *mut Number,
        m: Index,
        nlp_constraint_violation: *mut Number,
        compl_g: *mut Number,
    ) -> Bool;

    /// The version of the library. Later releases of Ipopt 3.14 have it, 3.14.17 does not.
    fn GetIpoptVersion(major: *mut c_int, minor: *mut c_int, release: *mut c_int);
}

/// Ipopt's functions; the first call opens the library unless it is linked.
///
/// # Errors
/// [`LoadError`], the same at every call: it is tried once.
pub fn api() -> Result<&'static Api, LoadError> {
    API.get_or_init(resolve).as_ref().map_err(Clone::clone)
}

/// Ipopt's functions, if [`api`] has been asked for them before.
pub fn api_in_use() -> Option<&'static Api> {
    API.get()?.as_ref().ok()
}

static API: OnceLock<Result<Api, LoadError>> = OnceLock::new();

fn resolve() -> Result<Api, LoadError> {
    let library = library::library()?;
    // SAFETY: `tests/abi.rs` holds the declarations against the headers of the version that this
    // crate is built for, and below it is made sure that the library speaks that interface.
    let api = unsafe { Api::resolve(library) }?;
    if api.GetIpoptCurrentIterate.is_some() == cfg!(ipopt_bool) {
        Ok(api)
    } else {
        Err(LoadError::OtherInterface { library: library::NAME })
    }
}
