use super::*;
use crate::MuStrategy;
use crate::handle::Handle;
use righting_ipopt_sys as sys;
use std::collections::HashMap;
use std::ptr::null_mut;

/// Ipopt's own account of its options: name, then what stands before, in and after the brackets.
fn documentation() -> HashMap<String, [String; 3]> {
    unsafe extern "C" fn f(
        _: sys::Index,
        _: *mut f64,
        _: sys::Bool,
        _: *mut f64,
        _: sys::UserDataPtr,
    ) -> sys::Bool {
        sys::FALSE
    }
    unsafe extern "C" fn g(
        _: sys::Index,
        _: *mut f64,
        _: sys::Bool,
        _: sys::Index,
        _: *mut f64,
        _: sys::UserDataPtr,
    ) -> sys::Bool {
        sys::FALSE
    }

    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("options.txt");
    let text = |value: &str| OptionValue::Text(value.to_owned());
    let (mut lower, mut upper) = ([0.0], [1.0]);
    let null: *mut f64 = null_mut();
    let ipopt = sys::api().unwrap();
    // SAFETY: one variable and its bounds; the solve ends before it calls anything, because it has
    // no start.
    unsafe {
        let problem = (ipopt.CreateIpoptProblem)(
            1,
            lower.as_mut_ptr(),
            upper.as_mut_ptr(),
            0,
            null,
            null,
            0,
            0,
            0,
            Some(f),
            Some(g),
            Some(f),
            None,
            None,
        );
        let handle = Handle::own(ipopt, problem).unwrap();
        handle.quiet(0).unwrap();
        handle.set("print_options_documentation", &text("yes")).unwrap();
        if !sys::HAS_HSL_LOADER {
            handle.set("print_advanced_options", &text("yes")).unwrap();
        }
        handle.set("output_file", &text(file.to_str().unwrap())).unwrap();
        handle.set("file_print_level", &OptionValue::Integer(5)).unwrap();
        (ipopt.IpoptSolve)(problem, null, null, null, null, null, null, null_mut());
    }
    parse(&std::fs::read_to_string(file).unwrap())
}

/// Reads `tol   0 < ( 1e-08) < +inf` and `mu_strategy ("monotone")`.
fn parse(text: &str) -> HashMap<String, [String; 3]> {
    let option = |line: &str| {
        let (before, rest) = line.split_once('(')?;
        let (default, after) = rest.split_once(')')?;
        let (name, before) = before.split_once(' ')?;
        let [before, default, after] = [before, default, after].map(|part| part.trim().to_owned());
        Some((name.to_owned(), [before, default.trim_matches('"').to_owned(), after]))
    };
    text.lines().filter(|line| line.starts_with(char::is_alphabetic)).filter_map(option).collect()
}

#[test]
fn defaults_are_those_of_ipopt() {
    let documentation = documentation();
    assert!(documentation.len() > 100);
    for (name, value) in Options::default().named_values() {
        if !sys::HAS_HSL_LOADER && ALWAYS_PASSED.contains(&name) {
            continue;
        }
        let [_, printed, _] = &documentation[name];
        match value {
            // Ipopt prints six digits.
            OptionValue::Number(value) => {
                let printed: f64 = printed.parse().unwrap();
                assert!((printed - value).abs() <= 1e-5 * value.abs(), "{name}: {printed}");
            }
            other => assert_eq!(*printed, other.to_string(), "{name}"),
        }
    }
}

#[test]
fn ranges_are_those_of_ipopt() {
    let documentation = documentation();
    for (name, range) in Options::ranges() {
        let [before, _, after] = &documentation[name];
        let bound = |text: &str, infinite: f64| match text.trim_matches([' ', '<', '=']) {
            "-inf" | "+inf" => infinite,
            number => number.parse().unwrap(),
        };
        let (lower, upper) = (bound(before, f64::NEG_INFINITY), bound(after, f64::INFINITY));
        assert_eq!(range.lower, lower, "{name}");
        // What counts is bounded by the integers here, and by nothing in Ipopt's account.
        if range.upper != f64::from(i32::MAX) {
            assert_eq!(range.upper, upper, "{name}");
        }
        assert_eq!(range.lower_belongs, before.contains("<="), "{name}");
        assert_eq!(range.upper_belongs && upper.is_finite(), after.contains("<="), "{name}");
    }
}

#[test]
fn extra_options_must_be_free() {
    let message = |name: &str| {
        let extra = vec![(name.to_owned(), OptionValue::Number(1.0))];
        validate(&Options { extra, ..Options::default() }).unwrap_err().to_string()
    };
    assert_eq!(message("tol"), "Ipopt's option `tol` is not free: it is the field `tolerance`");
    assert_eq!(
        message("linear_solver"),
        "Ipopt's option `linear_solver` is not free: `solve` and `solve_with` choose it"
    );
}

#[test]
fn only_what_differs_from_its_default_is_passed_on() {
    let text = |value: &str| OptionValue::Text(value.to_owned());
    let default = Options::default();
    let always: Vec<&str> = to_pass(&default).into_iter().map(|(name, _)| name).collect();
    assert_eq!(always, ALWAYS_PASSED);
    let options = Options {
        tolerance: 1e-10,
        mu_strategy: MuStrategy::Adaptive,
        max_soc: 0,
        honor_original_bounds: false,
        extra: vec![("recalc_y".to_owned(), OptionValue::Text("yes".to_owned()))],
        ..Options::default()
    };
    let expected = [
        ("tol", OptionValue::Number(1e-10)),
        ("honor_original_bounds", text("no")),
        ("mu_strategy", text("adaptive")),
        ("max_soc", OptionValue::Integer(0)),
        ("recalc_y", text("yes")),
    ];
    let mut passed = to_pass(&options);
    passed.retain(|option| !to_pass(&default).contains(option));
    assert_eq!(passed, expected);
}
