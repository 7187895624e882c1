//! Which options Ipopt is told, and which it takes from nobody but this crate.

use crate::{OptionValue, Options, SolveError};

/// Options that this crate sets by itself, and why.
const RESERVED: [(&str, &str); 9] = [
    ("option_file_name", "no file may change a solve"),
    ("sb", "Ipopt's banner belongs into no output"),
    ("linear_solver", "`solve` and `solve_with` choose it"),
    ("hsllib", "`solve_with` makes the library"),
    ("linear_system_scaling", "it needs a solver that is not part of Ipopt"),
    ("ma57_pivtol", "`LinearSolver::pivot_tolerances` gives it"),
    ("ma57_pivtolmax", "`LinearSolver::pivot_tolerances` gives it"),
    ("warm_start_init_point", "`Start::multipliers` makes it a warm start"),
    ("skip_finalize_solution_call", "the solution would be lost"),
];

/// Options that are passed on even at their default: Ipopt 3.14 has another one, or Ipopt takes the
/// value of `bound_push` or `bound_frac` unless this one is set.
const ALWAYS_PASSED: [&str; 8] = [
    "max_cpu_time",
    "honor_original_bounds",
    "slack_bound_push",
    "slack_bound_frac",
    "warm_start_bound_push",
    "warm_start_bound_frac",
    "warm_start_slack_bound_push",
    "warm_start_slack_bound_frac",
];

/// Checks every field against its range, and that the extra options are free.
pub(crate) fn validate(options: &Options) -> Result<(), SolveError> {
    options.validate()?;
    options.extra.iter().try_for_each(|(name, _)| match owner(name) {
        Some(owner) => Err(SolveError::OptionTaken { name: name.clone(), owner }),
        None => Ok(()),
    })
}

/// Who sets this option, if not its user by name.
fn owner(name: &str) -> Option<String> {
    let reserved = RESERVED.iter().find(|(reserved, _)| *reserved == name);
    reserved
        .map(|(_, reason)| (*reason).to_owned())
        .or_else(|| Options::field_of(name).map(|field| format!("it is the field `{field}`")))
}

/// Names and values of what has to be passed on, extra options last: only what differs from its
/// default, since Ipopt takes some options as a wish only when they are set.
pub(crate) fn to_pass(options: &Options) -> Vec<(&str, OptionValue)> {
    let defaults = Options::default().named_values();
    let named = options.named_values().into_iter().zip(defaults);
    let extra = options.extra.iter().map(|(name, value)| (name.as_str(), value.clone()));
    named
        .filter(|(option, default)| option != default || ALWAYS_PASSED.contains(&option.0))
        .map(|(option, _)| option)
        .chain(extra)
        .collect()
}

#[cfg(test)]
mod tests;
