use std::ffi::{c_int, c_void};

/// A floating-point number (`Number`).
pub type Number = f64;
/// An index into variables, constraints or non-zeros (`Index`).
pub type Index = c_int;
/// An integer (`Int`).
pub type Int = c_int;

/// A truth value: `int` up to Ipopt 3.13.
#[cfg(not(ipopt_bool))]
pub type Bool = c_int;
/// A truth value: C's `bool` from Ipopt 3.14 on.
#[cfg(ipopt_bool)]
pub type Bool = bool;

/// True, as a [`Bool`].
#[cfg(not(ipopt_bool))]
pub const TRUE: Bool = 1;
/// False, as a [`Bool`].
#[cfg(not(ipopt_bool))]
pub const FALSE: Bool = 0;
/// True, as a [`Bool`].
#[cfg(ipopt_bool)]
pub const TRUE: Bool = true;
/// False, as a [`Bool`].
#[cfg(ipopt_bool)]
pub const FALSE: Bool = false;

/// What `struct IpoptProblemInfo` is to a C program: nothing but an address.
#[repr(C)]
pub struct IpoptProblemInfo {
    _opaque: [u8; 0],
    _neither_send_nor_sync: std::marker::PhantomData<*mut u8>,
}

/// A problem made by `CreateIpoptProblem`.
pub type IpoptProblem = *mut IpoptProblemInfo;

/// The pointer that `IpoptSolve` hands to every callback.
pub type UserDataPtr = *mut c_void;

/// Objective at `x`, into `obj_value`. False: not defined here.
pub type Eval_F_CB = Option<
    unsafe extern "C" fn(
        n: Index,
        x: *mut Number,
        new_x: Bool,
        obj_value: *mut Number,
        user_data: UserDataPtr,
    ) -> Bool,
>;

/// Gradient of the objective at `x`, into the `n` numbers at `grad_f`.
pub type Eval_Grad_F_CB = Option<
    unsafe extern "C" fn(
        n: Index,
        x: *mut Number,
        new_x: Bool,
        grad_f: *mut Number,
        user_data: UserDataPtr,
    ) -> Bool,
>;

/// Constraints at `x`, into the `m` numbers at `g`.
pub type Eval_G_CB = Option<
    unsafe extern "C" fn(
        n: Index,
        x: *mut Number,
        new_x: Bool,
        m: Index,
        g: *mut Number,
        user_data: UserDataPtr,
    ) -> Bool,
>;

/// Constraint Jacobian. With null `values` (and `x`) the structure is asked for, into `iRow` and
/// `jCol`; otherwise these are null and the values are.
pub type Eval_Jac_G_CB = Option<
    unsafe extern "C" fn(
        n: Index,
        x: *mut Number,
        new_x: Bool,
        m: Index,
        nele_jac: Index,
        iRow: *mut Index,
        jCol: *mut Index,
        values: *mut Number,
        user_data: UserDataPtr,
    ) -> Bool,
>;

/// One triangle of the Hessian of `obj_factor · f + lambdaᵀ g`; structure and values are told
/// apart as in [`Eval_Jac_G_CB`].
pub type Eval_H_CB = Option<
    unsafe extern "C" fn(
        n: Index,
        x: *mut Number,
        new_x: Bool,
        obj_factor: Number,
        m: Index,
        lambda: *mut Number,
        new_lambda: Bool,
        nele_hess: Index,
        iRow: *mut Index,
        jCol: *mut Index,
        values: *mut Number,
        user_data: UserDataPtr,
    ) -> Bool,
>;

/// Called once an iteration; false stops the solve. `alg_mod` is an
/// [`AlgorithmMode`](crate::AlgorithmMode).
pub type Intermediate_CB = Option<
    unsafe extern "C" fn(
        alg_mod: Index,
        iter_count: Index,
        obj_value: Number,
        inf_pr: Number,
        inf_du: Number,
        mu: Number,
        d_norm: Number,
        regularization_size: Number,
        alpha_du: Number,
        alpha_pr: Number,
        ls_trials: Index,
        user_data: UserDataPtr,
    ) -> Bool,
>;
