use crate::Declarations;
use crate::handle::Handle;
use crate::{Multipliers, Start};
use righting_ipopt_sys as sys;
use std::cell::Cell;
use std::ptr::null_mut;
use sys::{Index, IpoptProblem};

/// Where a solve is: point and multipliers of an iteration, of the problem as it was given.
#[derive(Debug, Clone, PartialEq)]
pub struct Iterate {
    /// The variables (n).
    pub x: Vec<f64>,
    /// g(x) (m).
    pub g: Vec<f64>,
    /// The multipliers.
    pub multipliers: Multipliers,
}

impl Iterate {
    /// A warm start from here.
    pub fn to_start(&self) -> Start {
        Start { x: self.x.clone(), multipliers: Some(self.multipliers.clone()) }
    }
}

/// By how much an iterate violates the conditions of optimality, of the problem as it was given.
#[derive(Debug, Clone, PartialEq)]
pub struct Violations {
    /// By how much each variable is below its bound (n).
    pub lower: Vec<f64>,
    /// By how much each variable is above its bound (n).
    pub upper: Vec<f64>,
    /// (x − x_L) z_L (n), with the bounds as Ipopt relaxed them.
    pub lower_complementarity: Vec<f64>,
    /// (x_U − x) z_U (n), with the bounds as Ipopt relaxed them.
    pub upper_complementarity: Vec<f64>,
    /// The gradient of the Lagrangian (n); none in the restoration phase, where Ipopt would have to
    /// evaluate the problem for it.
    pub lagrangian_gradient: Option<Vec<f64>>,
    /// By how much each constraint is outside of its bounds (m).
    pub constraints: Vec<f64>,
    /// The complementarity of each constraint (m).
    pub constraint_complementarity: Vec<f64>,
}

/// The iterate of the solve whose iteration callback this is called from.
///
/// None from anywhere else, and with Ipopt before 3.14. Where variables are fixed Ipopt evaluates
/// gradient and Jacobian for it.
pub fn current_iterate() -> Option<Iterate> {
    let Iterates { ipopt, problem, variables, constraints, .. } = CURRENT.get()?;
    let get = ipopt.GetIpoptCurrentIterate?;
    let zeros = |count: Index| vec![0.0; usize::try_from(count).unwrap_or(0)];
    let [mut x, mut lower, mut upper] = [(); 3].map(|()| zeros(variables));
    let [mut g, mut multipliers] = [(); 2].map(|()| zeros(constraints));
    // SAFETY: this thread is in the intermediate callback of `problem`, and the arrays have its
    // sizes.
    let found = unsafe {
        get(
            problem,
            sys::FALSE,
            variables,
            x.as_mut_ptr(),
            lower.as_mut_ptr(),
            upper.as_mut_ptr(),
            constraints,
            g.as_mut_ptr(),
            multipliers.as_mut_ptr(),
        )
    };
    let multipliers = Multipliers { constraints: multipliers, lower, upper };
    (found != sys::FALSE).then_some(Iterate { x, g, multipliers })
}

/// The violations of the iterate of the solve whose iteration callback this is called from.
///
/// None where [`current_iterate`] gives none.
pub fn current_violations() -> Option<Violations> {
    let Iterates { ipopt, problem, variables, constraints, restoration } = CURRENT.get()?;
    let get = ipopt.GetIpoptCurrentViolations?;
    let zeros = |count: Index| vec![0.0; usize::try_from(count).unwrap_or(0)];
    let [mut lower, mut upper, mut complementarity_l, mut complementarity_u, mut gradient] =
        [(); 5].map(|()| zeros(variables));
    let [mut violation, mut complementarity_g] = [(); 2].map(|()| zeros(constraints));
    let gradient_or_null = if restoration { null_mut() } else { gradient.as_mut_ptr() };
    // SAFETY: as in `current_iterate`; what may be null is skipped. (An evaluation that fails would
    // throw an exception through this frame.)
    let found = unsafe {
        get(
            problem,
            sys::FALSE,
            variables,
            lower.as_mut_ptr(),
            upper.as_mut_ptr(),
            complementarity_l.as_mut_ptr(),
            complementarity_u.as_mut_ptr(),
            gradient_or_null,
            constraints,
            violation.as_mut_ptr(),
            complementarity_g.as_mut_ptr(),
        )
    };
    (found != sys::FALSE).then_some(Violations {
        lower,
        upper,
        lower_complementarity: complementarity_l,
        upper_complementarity: complementarity_u,
        lagrangian_gradient: (!restoration).then_some(gradient),
        constraints: violation,
        constraint_complementarity: complementarity_g,
    })
}

/// Whom to ask for the current iterate, and its size.
#[derive(Clone, Copy)]
pub(crate) struct Iterates {
    ipopt: &'static sys::Api,
    problem: IpoptProblem,
    variables: Index,
    constraints: Index,
    restoration: bool,
}

thread_local! {
    /// Those of the solve whose iteration callback this thread is in.
    static CURRENT: Cell<Option<Iterates>> = const { Cell::new(None) };
}

impl Iterates {
    pub(crate) fn of(
        ipopt: &'static sys::Api,
        handle: &Handle,
        declarations: &Declarations,
    ) -> Self {
        // Both counts were found to fit when the declarations were checked.
        let index = |count: usize| count as Index;
        Self {
            ipopt,
            problem: handle.problem(),
            variables: index(declarations.variables),
            constraints: index(declarations.constraints),
            restoration: false,
        }
    }

    /// Runs the callback of an iteration; meanwhile the iterate can be asked for.
    pub(crate) fn within<T>(self, restoration: bool, body: impl FnOnce() -> T) -> T {
        struct Reset;
        impl Drop for Reset {
            fn drop(&mut self) {
                CURRENT.set(None);
            }
        }
        CURRENT.set(Some(Self { restoration, ..self }));
        let _reset = Reset;
        body()
    }
}
