//! Numbers as people read them.

/// Three significant digits, in ASCII: what a terminal or a page shows can be pasted into a program.
pub fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        a if !a.is_finite() => "\u{2013}".to_owned(),
        a if !(1e-3..1e5).contains(&a) => format!("{value:.1e}"),
        a => {
            let decimals = (2.0 - a.log10().floor()).clamp(0.0, 5.0) as usize;
            let fixed = format!("{value:.decimals$}");
            match fixed.contains('.') {
                true => fixed.trim_end_matches('0').trim_end_matches('.').to_owned(),
                false => fixed,
            }
        }
    }
}

/// [`short`] as figures show it, with a true minus sign.
pub(crate) fn drawn(value: f64) -> String {
    short(value).replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_are_shown() {
        let shown = [17.2, 0.0, -0.03456, 1234.5, 11.0, 2.5e-9, f64::NAN].map(short);
        assert_eq!(shown, ["17.2", "0", "-0.0346", "1234", "11", "2.5e-9", "–"]);
        assert_eq!([-0.03456, 2.5e-9].map(drawn), ["−0.0346", "2.5e−9"]);
    }
}
