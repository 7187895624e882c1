//! Options: one field each, with Ipopt's name, range and default in one place.

mod range;
mod value;

pub use range::OptionRange;
use range::OptionRange as Range;
use value::Field;
pub use value::{
    FixedVariables, Hessian, MuStrategy, MultiplierInitialization, NlpScaling, OptionValue,
};

use crate::NlpError;

macro_rules! options {
    ($($(#[doc = $doc:literal])+
       $field:ident: $type:ty = $default:expr, $name:literal $(, $range:expr)?;)*) => {
        /// How to solve: the options of Ipopt's reference that this project knows by name. Each
        /// field gives its default and its name there.
        ///
        /// Tolerances apply to the scaled problem unless they say otherwise.
        #[derive(Debug, Clone, PartialEq)]
        pub struct Options {
            $(
                $(#[doc = $doc])+
                #[doc = concat!("\n\nDefault `", stringify!($default), "`; Ipopt's `", $name, "`.")]
                pub $field: $type,
            )*
            /// How much the optimizer prints to standard output, up to 12.
            ///
            /// Default `0`, nothing; Ipopt's `print_level`.
            pub print_level: u32,
            /// Every other option of Ipopt, by its name there.
            ///
            /// Default none.
            pub extra: Vec<(String, OptionValue)>,
        }

        impl Default for Options {
            fn default() -> Self {
                Self { $($field: $default,)* print_level: 0, extra: Vec::new() }
            }
        }

        impl Options {
            /// Checks every field against its range. What is in [`Options::extra`] only the
            /// optimizer can tell.
            ///
            /// # Errors
            /// [`NlpError::OptionOutOfRange`] of the first field that is outside.
            pub fn validate(&self) -> Result<(), NlpError> {
                $($($range.check(stringify!($field), self.$field.into())?;)?)*
                Range::between(0.0, 12.0).check("print_level", self.print_level.into())
            }

            /// Ipopt's name and the value of every field but [`Options::print_level`] and
            /// [`Options::extra`].
            pub fn named_values(&self) -> Vec<(&'static str, OptionValue)> {
                vec![$(($name, self.$field.value()),)*]
            }

            /// Ipopt's name and the range of every field that has one.
            pub fn ranges() -> Vec<(&'static str, OptionRange)> {
                vec![$($(($name, $range),)?)*]
            }

            /// The field that has this name in Ipopt's reference.
            pub fn field_of(name: &str) -> Option<&'static str> {
                match name {
                    $($name => Some(stringify!($field)),)*
                    "print_level" => Some("print_level"),
                    _ => None,
                }
            }
        }
    };
}

options! {
    /// Relative tolerance of the optimality error, at which the problem counts as solved.
    tolerance: f64 = 1e-8, "tol", Range::above(0.0);
    /// How many iterations to make at most.
    max_iterations: u32 = 3000, "max_iter", Range::count(0.0);
    /// How many seconds of processor time, of the whole process, to spend at most.
    max_cpu_time: f64 = 1e6, "max_cpu_time", Range::above(0.0);
    /// Absolute tolerance of the dual infeasibility, unscaled.
    dual_inf_tol: f64 = 1.0, "dual_inf_tol", Range::above(0.0);
    /// Absolute tolerance of the constraint violation, unscaled.
    constr_viol_tol: f64 = 1e-4, "constr_viol_tol", Range::above(0.0);
    /// Absolute tolerance of the complementarity, unscaled.
    compl_inf_tol: f64 = 1e-4, "compl_inf_tol", Range::above(0.0);
    /// Relative tolerance of the optimality error of an acceptable point.
    acceptable_tol: f64 = 1e-6, "acceptable_tol", Range::above(0.0);
    /// How many acceptable iterations in a row end the solve; with zero none do.
    acceptable_iter: u32 = 15, "acceptable_iter", Range::count(0.0);
    /// Dual infeasibility of an acceptable point, unscaled.
    acceptable_dual_inf_tol: f64 = 1e10, "acceptable_dual_inf_tol", Range::above(0.0);
    /// Constraint violation of an acceptable point, unscaled.
    acceptable_constr_viol_tol: f64 = 0.01, "acceptable_constr_viol_tol", Range::above(0.0);
    /// Complementarity of an acceptable point, unscaled.
    acceptable_compl_inf_tol: f64 = 0.01, "acceptable_compl_inf_tol", Range::above(0.0);
    /// By how much the objective may still change, relatively, at an acceptable point.
    acceptable_obj_change_tol: f64 = 1e20, "acceptable_obj_change_tol", Range::at_least(0.0);
    /// The size of a variable at which the iterates count as diverging.
    diverging_iterates_tol: f64 = 1e20, "diverging_iterates_tol", Range::above(0.0);

    /// How objective and constraints are scaled, if the problem brings no
    /// [`Scaling`](crate::Scaling).
    nlp_scaling: NlpScaling = NlpScaling::GradientBased, "nlp_scaling_method";
    /// The greatest gradient that gradient-based scaling leaves at the start.
    nlp_scaling_max_gradient: f64 = 100.0, "nlp_scaling_max_gradient", Range::above(0.0);
    /// The least factor that gradient-based scaling uses.
    nlp_scaling_min_value: f64 = 1e-8, "nlp_scaling_min_value", Range::at_least(0.0);
    /// A factor of the objective on top of every other scaling; negative maximises.
    obj_scaling_factor: f64 = 1.0, "obj_scaling_factor", Range::any();
    /// What becomes of variables with equal bounds.
    fixed_variables: FixedVariables = FixedVariables::MakeParameter, "fixed_variable_treatment";
    /// By how much, relatively, bounds are relaxed before the solve.
    bound_relax_factor: f64 = 1e-8, "bound_relax_factor", Range::at_least(0.0);
    /// Whether the solution is put back within the bounds that were relaxed.
    honor_original_bounds: bool = true, "honor_original_bounds";
    /// Whether the Hessian is the problem's own.
    hessian: Hessian = Hessian::Exact, "hessian_approximation";

    /// How far inside of its bounds, absolutely, a variable starts.
    bound_push: f64 = 0.01, "bound_push", Range::above(0.0);
    /// How far inside of its bounds, as a fraction of their distance, a variable starts.
    bound_frac: f64 = 0.01, "bound_frac", Range::above(0.0).up_to(0.5);
    /// How far inside of its bounds, absolutely, a slack starts.
    slack_bound_push: f64 = 0.01, "slack_bound_push", Range::above(0.0);
    /// How far inside of its bounds, as a fraction of their distance, a slack starts.
    slack_bound_frac: f64 = 0.01, "slack_bound_frac", Range::above(0.0).up_to(0.5);
    /// The greatest constraint multipliers that the least-squares estimate at a cold start may
    /// give; beyond it they start at zero.
    constr_mult_init_max: f64 = 1e3, "constr_mult_init_max", Range::at_least(0.0);
    /// What bound multipliers start from.
    bound_mult_init_method: MultiplierInitialization =
        MultiplierInitialization::Constant, "bound_mult_init_method";
    /// The constant that they start from.
    bound_mult_init_val: f64 = 1.0, "bound_mult_init_val", Range::above(0.0);

    /// [`Options::bound_push`] of a warm start.
    warm_start_bound_push: f64 = 1e-3, "warm_start_bound_push", Range::above(0.0);
    /// [`Options::bound_frac`] of a warm start.
    warm_start_bound_frac: f64 = 1e-3, "warm_start_bound_frac", Range::above(0.0).up_to(0.5);
    /// [`Options::slack_bound_push`] of a warm start.
    warm_start_slack_bound_push: f64 = 1e-3, "warm_start_slack_bound_push", Range::above(0.0);
    /// [`Options::slack_bound_frac`] of a warm start.
    warm_start_slack_bound_frac: f64 =
        1e-3, "warm_start_slack_bound_frac", Range::above(0.0).up_to(0.5);
    /// The least bound multiplier of a warm start.
    warm_start_mult_bound_push: f64 = 1e-3, "warm_start_mult_bound_push", Range::above(0.0);
    /// The greatest size of a multiplier of a warm start.
    warm_start_mult_init_max: f64 = 1e6, "warm_start_mult_init_max", Range::any();

    /// How the barrier parameter goes down.
    mu_strategy: MuStrategy = MuStrategy::Monotone, "mu_strategy";
    /// The barrier parameter to start from, if it goes down monotonically.
    mu_init: f64 = 0.1, "mu_init", Range::above(0.0);
    /// The greatest barrier parameter of the adaptive strategy.
    mu_max: f64 = 1e5, "mu_max", Range::above(0.0);
    /// The least barrier parameter of the adaptive strategy.
    mu_min: f64 = 1e-11, "mu_min", Range::above(0.0);
    /// The complementarity to converge to; zero for the solution of the problem.
    mu_target: f64 = 0.0, "mu_target", Range::at_least(0.0);
    /// A barrier problem is solved once its error is below this times μ.
    barrier_tol_factor: f64 = 10.0, "barrier_tol_factor", Range::above(0.0);
    /// The next μ is this times μ …
    mu_linear_decrease_factor: f64 =
        0.2, "mu_linear_decrease_factor", Range::above(0.0).below(1.0);
    /// … or μ to this power, whichever is smaller.
    mu_superlinear_decrease_power: f64 =
        1.5, "mu_superlinear_decrease_power", Range::above(1.0).below(2.0);

    /// How many second-order corrections to try for a step.
    max_soc: u32 = 4, "max_soc", Range::count(0.0);
    /// After so many shortened steps in a row the watchdog takes full ones for a while, whatever
    /// they do to objective and constraints; with zero it never does.
    watchdog_shortened_iter_trigger: u32 =
        10, "watchdog_shortened_iter_trigger", Range::count(0.0);
    /// How many steps the watchdog takes before it goes back to where it began.
    watchdog_trial_iter_max: u32 = 3, "watchdog_trial_iter_max", Range::count(1.0);
    /// A step that has been shortened so many times is taken, whatever it does to objective and
    /// constraints; none if negative.
    accept_after_max_steps: i32 = -1, "accept_after_max_steps", Range::count(-1.0);
    /// Whether infeasibility is expected, which is then found out sooner.
    expect_infeasible: bool = false, "expect_infeasible_problem";
    /// Whether the first iteration is already one of the restoration phase.
    start_with_resto: bool = false, "start_with_resto";

    /// Whether the linear solver's steps are taken as they are, without a look at their residuals
    /// and without iterative refinement.
    fast_step_computation: bool = false, "fast_step_computation";
    /// How many steps of iterative refinement to make at least.
    min_refinement_steps: u32 = 1, "min_refinement_steps", Range::count(0.0);
    /// How many steps of iterative refinement to make at most.
    max_refinement_steps: u32 = 10, "max_refinement_steps", Range::count(0.0);
    /// Refinement ends at this relative residual.
    residual_ratio_max: f64 = 1e-10, "residual_ratio_max", Range::above(0.0);
    /// A system whose relative residual stays above this counts as singular.
    residual_ratio_singular: f64 = 1e-5, "residual_ratio_singular", Range::above(0.0);
    /// Refinement has failed when a step leaves more than this of the residual.
    residual_improvement_factor: f64 =
        0.999_999_999, "residual_improvement_factor", Range::above(0.0);
    /// The first regularisation of the Hessian to try.
    first_hessian_perturbation: f64 = 1e-4, "first_hessian_perturbation", Range::above(0.0);
    /// The least regularisation of the Hessian.
    min_hessian_perturbation: f64 = 1e-20, "min_hessian_perturbation", Range::at_least(0.0);
    /// The regularisation of the Hessian at which to give up.
    max_hessian_perturbation: f64 = 1e20, "max_hessian_perturbation", Range::above(0.0);
    /// The regularisation of the constraints of a singular system, times μ to the power ¼.
    jacobian_regularization_value: f64 =
        1e-8, "jacobian_regularization_value", Range::at_least(0.0);
}

impl Options {
    /// The barrier parameter that a solve ends with, where nothing is scaled: Ipopt's `mu_min` by default.
    pub fn last_barrier_parameter(&self) -> f64 {
        self.tolerance / (self.barrier_tol_factor + 1.0)
    }
}
