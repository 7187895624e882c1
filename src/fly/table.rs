//! `flights.csv`: one row a flight.

use std::time::Duration;

use righting_flight::{End, Flight, Log};

const HEAD: &str = "flight,final_error_deg,final_rate_deg_s,final_joint_rate_deg_s,open_loop_error_deg,\
                    open_loop_rate_deg_s,replans,missed_replans,slowest_replan_ms,lost_measurements\n";

/// The table of flights; what there is not, and what is no number, is an empty cell.
pub fn csv(flights: &[Flight]) -> String {
    let mut text = String::from(HEAD);
    for Flight { number, open_loop, flown, log } in flights {
        let Log { replans, missed, lost } = log;
        let open_loop = |value: fn(&End) -> f64| cell(open_loop.as_ref().map(value));
        let row = [
            number.to_string(),
            cell(Some(flown.error_rad.to_degrees())),
            cell(Some(flown.rate_rad_s.to_degrees())),
            cell(Some(flown.joint_rate_rad_s.to_degrees())),
            open_loop(|end| end.error_rad.to_degrees()),
            open_loop(|end| end.rate_rad_s.to_degrees()),
            replans.len().to_string(),
            missed.to_string(),
            cell(replans.iter().max().map(|time: &Duration| 1e3 * time.as_secs_f64())),
            lost.to_string(),
        ];
        text += &row.join(",");
        text.push('\n');
    }
    text
}

fn cell(value: Option<f64>) -> String {
    value.filter(|value| value.is_finite()).map_or_else(String::new, |value| value.to_string())
}
