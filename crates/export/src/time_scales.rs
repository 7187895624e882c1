//! Time scales, and ephemeris time as SPICE counts it.

use jiff::civil::{DateTime, date, datetime};
use righting_scenario::error::Mismatch;

use crate::ExportError;

/// TT − TAI, s.
const TT_LESS_TAI_S: f64 = 32.184;
/// TAI − GPS time, s.
const TAI_LESS_GPS_S: f64 = 19.0;

/// TAI − UTC, s, from the beginning of a day on (IERS Bulletin C; none announced after these).
const LEAP_SECONDS: [(i16, i8, f64); 28] = [
    (1972, 1, 10.0),
    (1972, 7, 11.0),
    (1973, 1, 12.0),
    (1974, 1, 13.0),
    (1975, 1, 14.0),
    (1976, 1, 15.0),
    (1977, 1, 16.0),
    (1978, 1, 17.0),
    (1979, 1, 18.0),
    (1980, 1, 19.0),
    (1981, 7, 20.0),
    (1982, 7, 21.0),
    (1983, 7, 22.0),
    (1985, 7, 23.0),
    (1988, 1, 24.0),
    (1990, 1, 25.0),
    (1991, 1, 26.0),
    (1992, 7, 27.0),
    (1993, 7, 28.0),
    (1994, 7, 29.0),
    (1996, 1, 30.0),
    (1997, 7, 31.0),
    (1999, 1, 32.0),
    (2006, 1, 33.0),
    (2009, 1, 34.0),
    (2012, 7, 35.0),
    (2015, 7, 36.0),
    (2017, 1, 37.0),
];

/// Ephemeris time of a moment, TDB seconds past 2000-01-01T12:00:00 TDB, with TDB − TT as SPICE's
/// leapseconds kernels have it.
///
/// # Errors
/// [`ExportError::Value`] for another time system than UTC, TAI, GPS, TT and TDB, and for UTC before
/// 1972.
pub(crate) fn ephemeris_time_s(moment: DateTime, time_system: &str) -> Result<f64, ExportError> {
    let reading_s = moment.duration_since(datetime(2000, 1, 1, 12, 0, 0, 0)).as_secs_f64();
    let tt_s = match time_system.trim().to_ascii_uppercase().as_str() {
        "TDB" => return Ok(reading_s),
        "TT" => reading_s,
        "TAI" => reading_s + TT_LESS_TAI_S,
        "GPS" => reading_s + TAI_LESS_GPS_S + TT_LESS_TAI_S,
        "UTC" => reading_s + tai_less_utc_s(moment)? + TT_LESS_TAI_S,
        _ => {
            let expected = "UTC, TAI, GPS, TT or TDB";
            let mismatch = Mismatch::new(format_args!("{time_system:?}"), expected);
            return Err(ExportError::Value { keyword: "time system", mismatch });
        }
    };
    let anomaly_rad = 6.239_996 + 1.990_968_71e-7 * tt_s;
    let eccentric_rad = anomaly_rad + 1.671e-2 * anomaly_rad.sin();
    Ok(tt_s + 1.657e-3 * eccentric_rad.sin())
}

fn tai_less_utc_s(moment: DateTime) -> Result<f64, ExportError> {
    let begun = |(year, month, _): &&(i16, i8, f64)| date(*year, *month, 1) <= moment.date();
    match LEAP_SECONDS.iter().rev().find(begun) {
        Some((.., seconds)) => Ok(*seconds),
        None => {
            let mismatch = Mismatch::new(moment, "1972-01-01 or later in UTC");
            Err(ExportError::Value { keyword: "epoch", mismatch })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of SPICE's `str2et` with the kernel naif0012.tls.
    #[test]
    fn ephemeris_times_are_those_of_spice() {
        let utc = |moment| ephemeris_time_s(moment, "utc").unwrap();
        assert!((utc(datetime(2000, 1, 1, 12, 0, 0, 0)) - 64.183_927_284_731_36).abs() < 1e-7);
        let tdb = ephemeris_time_s(datetime(2000, 1, 1, 12, 0, 0, 0), "TDB").unwrap();
        assert_eq!(tdb, 0.0);
        let gps = ephemeris_time_s(datetime(2027, 3, 1, 12, 0, 18, 0), "GPS").unwrap();
        assert!((gps - utc(datetime(2027, 3, 1, 12, 0, 0, 0))).abs() < 1e-6);
    }

    #[test]
    fn what_is_no_time_is_refused() {
        let early = ephemeris_time_s(datetime(1971, 12, 31, 0, 0, 0, 0), "UTC").unwrap_err();
        assert!(early.to_string().contains("expected 1972-01-01 or later"), "{early}");
        let odd = ephemeris_time_s(datetime(2000, 1, 1, 0, 0, 0, 0), "UT1").unwrap_err();
        assert_eq!(
            odd.to_string(),
            "time system: found \"UT1\", expected UTC, TAI, GPS, TT or TDB"
        );
    }
}
