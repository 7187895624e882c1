//! What the records of a folder become, from records that were made up.

use std::path::Path;

use righting_sweep::{
    CaseStatus, Flown, Outcome, Record, RunFacts, Slews, Summary, Sweep, SweepFolder, Table,
    Trouble,
};

/// Three axes, two angles.
const SWEEP: &str = r#"{ "name": "made up", "scenario": "../../scenarios/slew_2dof.json",
    "vary": [ { "field": "maneuver.axis", "fibonacci": 3 },
              { "field": "maneuver.angle_deg", "name": "angle", "values": [10, 20] } ] }"#;

fn record(sweep: &Sweep, index: usize, outcome: Outcome) -> Record {
    let run = RunFacts { solve_s: 0.5, attempts: 1 };
    Record { case_id: sweep.case(index).id, outcome, run }
}

fn success(objective: f64) -> Outcome {
    Outcome {
        status: CaseStatus::Flown(Flown::Flown),
        verified: true,
        attitude_error: 1e-5,
        final_rate_deg_s: 0.0,
        joint_rate_deg_s: 0.0,
        objective,
        iterations: 7,
        reason: None,
    }
}

/// A folder with records of five of the six cases, one of them twice, in two files.
fn folder() -> (tempfile::TempDir, SweepFolder) {
    let place = tempfile::tempdir().unwrap();
    let folder = SweepFolder::at(place.path());
    let sweep = Sweep::parse(SWEEP, Path::new("made_up.json")).unwrap();
    folder.plan(&sweep, "0").unwrap();
    let mut journal = folder.journal("2/2".parse().unwrap()).unwrap();
    for index in [4, 2, 0] {
        journal.append(&record(&sweep, index, success(index as f64))).unwrap();
    }
    let mut journal = folder.journal("1/2".parse().unwrap()).unwrap();
    let crashed = Outcome::of_trouble(Trouble::Crashed, "signal 9, \"killed\"");
    journal.append(&record(&sweep, 0, crashed.clone())).unwrap();
    journal.append(&record(&sweep, 3, crashed)).unwrap();
    journal.append(&record(&sweep, 1, success(1.0))).unwrap();
    (place, folder)
}

#[test]
fn rows_stand_in_the_order_of_the_plan_and_a_success_beats_a_crash() {
    let (_place, folder) = folder();
    let table = Table::read(&folder).unwrap();
    let succeeded: Vec<Option<bool>> =
        table.rows().iter().map(|row| row.map(|row| row.succeeded())).collect();
    let [yes, no] = [Some(true), Some(false)];
    assert_eq!(succeeded, [yes, yes, yes, no, yes, None]);
    let mut csv = Vec::new();
    table.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 1 + 5);
    assert!(lines[0].starts_with("case_id,maneuver.axis_x,maneuver.axis_y,maneuver.axis_z,angle,"));
    assert!(
        lines[4].ends_with(",20,crashed,false,,,,,0,\"signal 9, \"\"killed\"\"\",0.5,1"),
        "{csv}"
    );
}

#[test]
fn failures_and_limits_are_summed_up() {
    let (_place, folder) = folder();
    let table = Table::read(&folder).unwrap();
    let slews = Slews::of(&table).unwrap();
    let limits: Vec<(usize, f64, f64)> =
        slews.limits.iter().map(|l| (l.tried, l.max_angle_deg, l.all_up_to_deg)).collect();
    assert_eq!(limits, [(2, 20.0, 20.0), (2, 10.0, 10.0), (1, 10.0, 10.0)]);
    let summary = Summary::of(&table, Some(&slews));
    assert_eq!((summary.cases, summary.recorded, summary.succeeded), (6, 5, 4));
    assert_eq!(summary.failures.len(), 1);
    assert_eq!(summary.failures[0].cause, "crashed: signal 9, \"killed\"");
    assert_eq!(summary.failures[0].case_ids, [table.sweep().case(3).id]);
    assert_eq!(summary.total_solve_s, 2.5);
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_has_what_csv_has() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    let (place, folder) = folder();
    let table = Table::read(&folder).unwrap();
    let path = place.path().join("results.parquet");
    table.write_parquet(&mut std::fs::File::create(&path).unwrap()).unwrap();
    let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
    let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    let mut csv = Vec::new();
    table.write_csv(&mut csv).unwrap();
    let mut csv = csv::Reader::from_reader(csv.as_slice());
    let heads = csv.headers().unwrap().clone();
    let lines: Vec<csv::StringRecord> = csv.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), lines.len());
    for (row, line) in rows.iter().zip(&lines) {
        for (i, (name, value)) in row.get_column_iter().enumerate() {
            assert_eq!(*name, heads[i]);
            let text = match value {
                Field::Str(text) => text.clone(),
                other => other.to_string(),
            };
            match (text.as_str(), line[i].parse::<f64>()) {
                ("null", _) => assert_eq!(&line[i], "", "{name}"),
                (_, Ok(number)) if i > 0 => assert_eq!(text.parse::<f64>().unwrap(), number),
                _ => assert_eq!(text, line[i], "{name}"),
            }
        }
    }
}
