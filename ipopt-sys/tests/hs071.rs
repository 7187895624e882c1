//! Problem 71 of Hock and Schittkowski, *Test Examples for Nonlinear Programming Codes* (1981),
//! through the raw interface:
//!
//! ```text
//! min x₀x₃(x₀+x₁+x₂) + x₂   s.t.  x₀x₁x₂x₃ ≥ 25,  ‖x‖² = 40,  1 ≤ x ≤ 5
//! ```

use righting_ipopt_sys::*;
use std::ptr::{null_mut, slice_from_raw_parts, slice_from_raw_parts_mut};

const N: usize = 4;
const M: usize = 2;
const JACOBIAN: [(Index, Index); 8] =
    [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2), (1, 3)];
const HESSIAN: [(Index, Index); 10] =
    [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 0), (3, 1), (3, 2), (3, 3)];

/// What Ipopt hands back to every callback.
#[derive(Default)]
struct Calls {
    hessians: usize,
    iterations: Vec<(Index, Number)>,
}

unsafe fn point(x: *mut Number) -> [Number; N] {
    // SAFETY: Ipopt passes as many numbers as there are variables.
    unsafe { *x.cast() }
}

unsafe fn write<T: Copy>(target: *mut T, values: &[T]) -> Bool {
    // SAFETY: the caller passes an array of Ipopt's that has the length of `values`.
    unsafe { (*slice_from_raw_parts_mut(target, values.len())).copy_from_slice(values) };
    TRUE
}

unsafe extern "C" fn objective(
    n: Index,
    x: *mut Number,
    _: Bool,
    value: *mut Number,
    _: UserDataPtr,
) -> Bool {
    assert_eq!(n as usize, N);
    // SAFETY: as documented at `point` and `write`.
    unsafe {
        let x = point(x);
        write(value, &[x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]])
    }
}

unsafe extern "C" fn gradient(
    _: Index,
    x: *mut Number,
    _: Bool,
    gradient: *mut Number,
    _: UserDataPtr,
) -> Bool {
    // SAFETY: as documented at `point` and `write`.
    unsafe {
        let [x0, x1, x2, x3] = point(x);
        write(gradient, &[x3 * (2.0 * x0 + x1 + x2), x0 * x3, x0 * x3 + 1.0, x0 * (x0 + x1 + x2)])
    }
}

unsafe extern "C" fn constraints(
    _: Index,
    x: *mut Number,
    _: Bool,
    m: Index,
    g: *mut Number,
    _: UserDataPtr,
) -> Bool {
    assert_eq!(m as usize, M);
    // SAFETY: as documented at `point` and `write`.
    unsafe {
        let x = point(x);
        write(g, &[x.iter().product(), x.iter().map(|v| v * v).sum()])
    }
}

unsafe fn write_structure(rows: *mut Index, columns: *mut Index, of: &[(Index, Index)]) -> Bool {
    let (r, c): (Vec<Index>, Vec<Index>) = of.iter().copied().unzip();
    // SAFETY: both arrays have the length declared to `CreateIpoptProblem`.
    unsafe {
        write(rows, &r);
        write(columns, &c)
    }
}

unsafe extern "C" fn jacobian(
    _: Index,
    x: *mut Number,
    _: Bool,
    _: Index,
    count: Index,
    rows: *mut Index,
    columns: *mut Index,
    values: *mut Number,
    _: UserDataPtr,
) -> Bool {
    assert_eq!(count as usize, JACOBIAN.len());
    // SAFETY: as documented at `point`, `write` and `write_structure`.
    unsafe {
        if values.is_null() {
            return write_structure(rows, columns, &JACOBIAN);
        }
        let [a, b, c, d] = point(x);
        let products = [b * c * d, a * c * d, a * b * d, a * b * c];
        write(values, &[products, [2.0 * a, 2.0 * b, 2.0 * c, 2.0 * d]].concat())
    }
}

unsafe extern "C" fn hessian(
    _: Index,
    x: *mut Number,
    _: Bool,
    factor: Number,
    _: Index,
    lambda: *mut Number,
    _: Bool,
    count: Index,
    rows: *mut Index,
    columns: *mut Index,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    assert_eq!(count as usize, HESSIAN.len());
    // SAFETY: as documented at `point`, `write` and `write_structure`; `user_data` is the `Calls`
    // of this solve.
    unsafe {
        if values.is_null() {
            return write_structure(rows, columns, &HESSIAN);
        }
        (*user_data.cast::<Calls>()).hessians += 1;
        let [a, b, c, d] = point(x);
        let l = &*slice_from_raw_parts(lambda, M);
        let (f, l0, l1) = (factor, l[0], 2.0 * l[1]);
        write(
            values,
            &[
                f * 2.0 * d + l1,
                f * d + l0 * c * d,
                l1,
                f * d + l0 * b * d,
                l0 * a * d,
                l1,
                f * (2.0 * a + b + c) + l0 * b * c,
                f * a + l0 * a * c,
                f * a + l0 * a * b,
                l1,
            ],
        )
    }
}

unsafe extern "C" fn iteration(
    mode: Index,
    count: Index,
    objective: Number,
    _: Number,
    _: Number,
    _: Number,
    _: Number,
    _: Number,
    _: Number,
    _: Number,
    _: Index,
    user_data: UserDataPtr,
) -> Bool {
    assert_eq!(AlgorithmMode(mode), AlgorithmMode::REGULAR);
    // SAFETY: `user_data` is the `Calls` of this solve.
    unsafe { (*user_data.cast::<Calls>()).iterations.push((count, objective)) };
    TRUE
}

#[test]
fn hs071_reaches_the_published_solution() {
    let (mut x_lower, mut x_upper) = ([1.0; N], [5.0; N]);
    let (mut g_lower, mut g_upper) = ([25.0, 40.0], [2e19, 40.0]);
    let mut x = [1.0, 5.0, 5.0, 1.0];
    let (mut g, mut lambda) = ([0.0; M], [0.0; M]);
    let (mut z_lower, mut z_upper) = ([0.0; N], [0.0; N]);
    let mut value = 0.0;
    let mut calls = Calls::default();

    let ipopt = api().expect("Ipopt is installed");
    // SAFETY: every array has the length that the interface documents, and outlives the call.
    let status = unsafe {
        let problem = (ipopt.CreateIpoptProblem)(
            N as Index,
            x_lower.as_mut_ptr(),
            x_upper.as_mut_ptr(),
            M as Index,
            g_lower.as_mut_ptr(),
            g_upper.as_mut_ptr(),
            JACOBIAN.len() as Index,
            HESSIAN.len() as Index,
            0,
            Some(objective),
            Some(constraints),
            Some(gradient),
            Some(jacobian),
            Some(hessian),
        );
        assert!(!problem.is_null());
        let set = |name: &std::ffi::CStr, value: &std::ffi::CStr| {
            (ipopt.AddIpoptStrOption)(problem, name.as_ptr().cast_mut(), value.as_ptr().cast_mut())
        };
        assert_eq!(set(c"option_file_name", c""), TRUE);
        assert_eq!(set(c"sb", c"yes"), TRUE);
        assert_eq!((ipopt.AddIpoptIntOption)(problem, c"print_level".as_ptr().cast_mut(), 0), TRUE);
        assert_eq!((ipopt.AddIpoptNumOption)(problem, c"tol".as_ptr().cast_mut(), 1e-9), TRUE);
        assert_eq!(
            (ipopt.AddIpoptNumOption)(problem, c"no_such_option".as_ptr().cast_mut(), 1.0),
            FALSE
        );
        assert_eq!((ipopt.SetIpoptProblemScaling)(problem, 1.0, null_mut(), null_mut()), TRUE);
        assert_eq!((ipopt.SetIntermediateCallback)(problem, Some(iteration)), TRUE);
        let status = (ipopt.IpoptSolve)(
            problem,
            x.as_mut_ptr(),
            g.as_mut_ptr(),
            &raw mut value,
            lambda.as_mut_ptr(),
            z_lower.as_mut_ptr(),
            z_upper.as_mut_ptr(),
            (&raw mut calls).cast(),
        );
        (ipopt.FreeIpoptProblem)(problem);
        status
    };

    assert_eq!(status, ApplicationReturnStatus::SOLVE_SUCCEEDED);
    let close = |found: &[f64], published: &[f64], tolerance: f64| {
        for (a, b) in found.iter().zip(published) {
            assert!((a - b).abs() < tolerance, "{found:?} is not {published:?}");
        }
    };
    close(&[value], &[17.014_017_3], 1e-6);
    close(&x, &[1.0, 4.742_999_4, 3.821_150_3, 1.379_408_2], 1e-6);
    close(&g, &[25.0, 40.0], 1e-6);
    close(&lambda, &[-0.552_293_66, 0.161_468_56], 1e-6);
    close(&z_lower, &[1.087_871_2, 0.0, 0.0, 0.0], 1e-6);
    close(&z_upper, &[0.0; N], 1e-6);
    assert!(calls.hessians > 3);
    let last = calls.iterations.last().unwrap();
    assert_eq!(last.0 as usize + 1, calls.iterations.len());
    close(&[last.1], &[value], 1e-9);
}

unsafe extern "C" fn defaults(_: *mut f64, _: *mut hsl::ipfint) {}

#[test]
fn a_program_can_be_ma57() {
    let slot = hsl::ma57_slot().expect("this Ipopt has one");
    assert_eq!(slot.hsllib.is_none(), HAS_HSL_LOADER);
    // SAFETY: no solve runs in this process with `ma57`, so the functions are never called; they
    // are unset again.
    unsafe {
        (slot.set)(None, None, None, None, Some(defaults));
        (slot.set)(None, None, None, None, None);
    }
    // It is the same at every call, and in every thread.
    let again = std::thread::spawn(|| hsl::ma57_slot().unwrap()).join().unwrap();
    assert!(std::ptr::eq(slot, again));
}

#[cfg(ipopt_hsl_loader)]
#[test]
fn ma57_is_available_only_with_all_five_functions() {
    let loader = hsl::hsl_loader().expect("this Ipopt has one");
    // SAFETY: as in the test above.
    unsafe {
        (loader.LSL_setMA57)(None, None, None, None, Some(defaults));
        assert_eq!((loader.LSL_isMA57available)(), 0);
        (loader.LSL_setMA57)(None, None, None, None, None);
    }
}

#[cfg(not(ipopt_hsl_loader))]
#[test]
fn the_library_in_memory_passes_every_call_on() {
    use std::ffi::c_int;
    type Defaults = unsafe extern "C" fn(*mut f64, *mut c_int);
    unsafe extern "C" fn mark(cntl: *mut f64, icntl: *mut hsl::ipfint) {
        // SAFETY: the test passes one of each.
        unsafe { (*cntl, *icntl) = (0.5, 7) };
    }
    let slot = hsl::ma57_slot().expect("this Ipopt has one");
    let name = slot.hsllib.as_ref().expect("a name for Ipopt's option");
    // SAFETY: the file is the library that the slot has open already, and its routine has the type
    // of the one that it passes the call on to.
    let (cntl, icntl) = unsafe {
        // As Ipopt opens it.
        let library = libloading::Library::new(name).expect("it opens again");
        let routine = library.get::<Defaults>("ma57id_").expect("Fortran's name of MA57ID");
        (slot.set)(None, None, None, None, Some(mark));
        let (mut cntl, mut icntl) = (0.0, 0);
        routine(&raw mut cntl, &raw mut icntl);
        (slot.set)(None, None, None, None, None);
        (cntl, icntl)
    };
    assert_eq!((cntl, icntl), (0.5, 7));
}
