//! Ranges of the options, and what is said of a value outside.

use righting_nlp::*;

#[test]
fn the_field_out_of_range_is_named() {
    let message = |options: Options| options.validate().unwrap_err().to_string();
    assert_eq!(
        message(Options { tolerance: 0.0, ..Options::default() }),
        "option `tolerance`: found 0, expected more than 0.0"
    );
    assert_eq!(
        message(Options { bound_frac: 0.6, ..Options::default() }),
        "option `bound_frac`: found 0.6, expected more than 0.0, at most 0.5"
    );
    assert_eq!(
        message(Options { mu_linear_decrease_factor: f64::NAN, ..Options::default() }),
        "option `mu_linear_decrease_factor`: found NaN, expected more than 0.0, less than 1.0"
    );
    assert_eq!(
        message(Options { max_iterations: u32::MAX, ..Options::default() }),
        "option `max_iterations`: found 4294967295, expected at least 0.0, at most 2147483647.0"
    );
    assert_eq!(
        message(Options { print_level: 13, ..Options::default() }),
        "option `print_level`: found 13, expected at least 0.0, at most 12.0"
    );
}

#[test]
fn the_defaults_are_within_their_ranges() {
    Options::default().validate().unwrap();
    let names: Vec<&str> =
        Options::default().named_values().into_iter().map(|(name, _)| name).collect();
    for (name, range) in Options::ranges() {
        assert!(names.contains(&name), "{name}");
        assert!(range.lower < range.upper, "{name}: {range}");
    }
}

#[test]
fn a_field_is_found_by_its_name_in_ipopts_reference() {
    assert_eq!(Options::field_of("tol"), Some("tolerance"));
    assert_eq!(Options::field_of("print_level"), Some("print_level"));
    assert_eq!(Options::field_of("tolerance"), None);
    let fields = Options::default().named_values().into_iter().map(|(name, _)| name);
    assert!(fields.into_iter().all(|name| Options::field_of(name).is_some()));
}
