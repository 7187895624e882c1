use crate::options::to_pass;
use crate::{OptionValue, Options, Scaling, SolveError};
use righting_ipopt_sys as sys;
use std::ffi::{CString, c_void};
use std::ptr::null_mut;

/// Owns an `IpoptProblem`.
pub(crate) struct Handle {
    ipopt: &'static sys::Api,
    problem: sys::IpoptProblem,
}

/// The arrays that Ipopt reads the start from and writes the solution to.
pub(crate) struct Arrays<'a> {
    pub(crate) x: &'a mut [f64],
    pub(crate) g: &'a mut [f64],
    pub(crate) objective: &'a mut f64,
    pub(crate) constraints: &'a mut [f64],
    pub(crate) lower: &'a mut [f64],
    pub(crate) upper: &'a mut [f64],
}

impl Handle {
    /// Takes what `CreateIpoptProblem` returned.
    ///
    /// # Safety
    /// It must be null or a problem of this library that nobody else frees.
    pub(crate) unsafe fn own(
        ipopt: &'static sys::Api,
        problem: sys::IpoptProblem,
    ) -> Result<Self, SolveError> {
        if problem.is_null() { Err(SolveError::NotCreated) } else { Ok(Self { ipopt, problem }) }
    }

    pub(crate) fn problem(&self) -> sys::IpoptProblem {
        self.problem
    }

    /// Keeps Ipopt from reading a file, and from printing more than asked for.
    ///
    /// Ipopt learns its print level only when a solve begins, and complains to standard output
    /// about refused options before that. A solve without a start does nothing but that.
    pub(crate) fn quiet(&self, print_level: u32) -> Result<(), SolveError> {
        self.set("option_file_name", &OptionValue::Text(String::new()))?;
        self.set("sb", &OptionValue::Text("yes".to_owned()))?;
        self.set("print_level", &OptionValue::Integer(0))?;
        let null: *mut f64 = null_mut();
        // SAFETY: with a null start `IpoptSolve` returns before it uses anything but the options.
        unsafe {
            (self.ipopt.IpoptSolve)(self.problem, null, null, null, null, null, null, null_mut());
        }
        self.set("print_level", &OptionValue::Integer(print_level.try_into().unwrap_or(i32::MAX)))
    }

    pub(crate) fn set_all(&self, options: &Options) -> Result<(), SolveError> {
        to_pass(options).iter().try_for_each(|(name, value)| self.set(name, value))
    }

    pub(crate) fn set(&self, name: &str, value: &OptionValue) -> Result<(), SolveError> {
        let Self { ipopt, problem } = *self;
        let keyword = c_string(name)?;
        let keyword = keyword.as_ptr().cast_mut();
        // SAFETY: Ipopt copies the strings, which end with a zero, and does not write to them.
        let taken = unsafe {
            match value {
                OptionValue::Number(number) => (ipopt.AddIpoptNumOption)(problem, keyword, *number),
                OptionValue::Integer(integer) => {
                    (ipopt.AddIpoptIntOption)(problem, keyword, *integer)
                }
                OptionValue::Text(text) => {
                    let text = c_string(text)?;
                    (ipopt.AddIpoptStrOption)(problem, keyword, text.as_ptr().cast_mut())
                }
            }
        };
        if taken == sys::FALSE {
            return Err(SolveError::OptionRefused { name: name.to_owned(), value: value.clone() });
        }
        Ok(())
    }

    /// Sets the scaling, which must have been checked.
    pub(crate) fn set_scaling(&self, mut scaling: Scaling) -> Result<(), SolveError> {
        self.set("nlp_scaling_method", &OptionValue::Text("user-scaling".to_owned()))?;
        let pointer = |factors: &mut Option<Vec<f64>>| {
            factors.as_mut().map_or(null_mut(), |factors| factors.as_mut_ptr())
        };
        let (x, g) = (pointer(&mut scaling.x), pointer(&mut scaling.g));
        // SAFETY: the arrays have the lengths of the problem and are copied.
        unsafe { (self.ipopt.SetIpoptProblemScaling)(self.problem, scaling.objective, x, g) };
        Ok(())
    }

    pub(crate) fn set_iteration_callback(&self, callback: sys::Intermediate_CB) {
        // SAFETY: the handle is valid; whether the callback is, `solve` answers for.
        unsafe { (self.ipopt.SetIntermediateCallback)(self.problem, callback) };
    }

    /// Solves.
    ///
    /// # Safety
    /// The arrays have the lengths of the problem, and `user_data` is what its callbacks expect.
    pub(crate) unsafe fn solve(
        &self,
        arrays: Arrays,
        user_data: *mut c_void,
    ) -> sys::ApplicationReturnStatus {
        // SAFETY: the caller's promise.
        unsafe {
            (self.ipopt.IpoptSolve)(
                self.problem,
                arrays.x.as_mut_ptr(),
                arrays.g.as_mut_ptr(),
                arrays.objective,
                arrays.constraints.as_mut_ptr(),
                arrays.lower.as_mut_ptr(),
                arrays.upper.as_mut_ptr(),
                user_data,
            )
        }
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: the handle owns the problem.
        unsafe { (self.ipopt.FreeIpoptProblem)(self.problem) }
    }
}

fn c_string(text: &str) -> Result<CString, SolveError> {
    CString::new(text).map_err(|_| SolveError::ZeroByte { text: text.to_owned() })
}
