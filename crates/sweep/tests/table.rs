//! What the records of a folder become, from records that were made up.

use std::collections::HashSet;
use std::path::Path;

use righting_sweep::{
    CaseStatus, ColumnCells, Flown, Outcome, Record, RunFacts, Shard, Slews, Summary, Sweep,
    SweepFolder, Table, Trouble,
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
fn columns_hold_what_the_csv_says() {
    let (_place, folder) = folder();
    let table = Table::read(&folder).unwrap();
    let columns = table.columns();
    let mut csv = Vec::new();
    table.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let heads: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    assert_eq!(columns.iter().map(|column| &*column.name).collect::<Vec<_>>(), heads);
    let cells = |name: &str| &columns.iter().find(|column| column.name == name).unwrap().cells;
    let [yes, no] = [true, false];
    assert_eq!(cells("verified"), &ColumnCells::Flag(vec![yes, yes, yes, no, yes]));
    assert_eq!(cells("angle"), &ColumnCells::Number(vec![10.0, 20.0, 10.0, 20.0, 10.0]));
    assert_eq!(cells("attempts"), &ColumnCells::Whole(vec![1; 5]));
    let ColumnCells::Text(reasons) = cells("reason") else { panic!("texts") };
    assert_eq!(reasons[3].as_deref(), Some("signal 9, \"killed\""));
    assert!(reasons[0].is_none());
}

#[test]
fn records_of_other_draws_are_of_no_case() {
    let drawn = |seed: u64| {
        let uniform = format!(r#"{{ "low": 0.9, "high": 1.1, "count": 3, "seed": {seed} }}"#);
        let vary = format!(
            r#"{{ "field": "horizon.duration_s", "relative": true, "uniform": {uniform} }}"#
        );
        let scenario = "../../scenarios/slew_2dof.json";
        let text =
            format!(r#"{{ "name": "drawn", "scenario": "{scenario}", "vary": [ {vary} ] }}"#);
        Sweep::parse(&text, Path::new("drawn.json")).unwrap()
    };
    let place = tempfile::tempdir().unwrap();
    let folder = SweepFolder::at(place.path());
    let sweep = drawn(1);
    folder.plan(&sweep, "0").unwrap();
    let mut journal = folder.journal(Shard::WHOLE).unwrap();
    journal.append(&record(&drawn(2), 0, success(9.0))).unwrap();
    journal.append(&record(&sweep, 1, success(1.0))).unwrap();
    let table = Table::read(&folder).unwrap();
    let recorded: Vec<bool> = table.rows().iter().map(Option::is_some).collect();
    assert_eq!((recorded, table.strangers), (vec![false, true, false], 1));
    let done = folder.done(Shard::WHOLE).unwrap();
    assert!(done.contains(&sweep.case(1).id) && !done.contains(&sweep.case(0).id));
}

#[test]
fn failures_and_limits_are_summed_up() {
    let (_place, folder) = folder();
    let table = Table::read(&folder).unwrap();
    let slews = Slews::of(&table, Slews::MOST_POINTS).unwrap();
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

/// The slews of 30 axes and 20 angles, of which `succeeds` says by angle which do; up to `most` to draw.
fn slews(most: usize, succeeds: fn(usize) -> bool) -> Slews {
    let place = tempfile::tempdir().unwrap();
    let folder = SweepFolder::at(place.path());
    let text = SWEEP
        .replace("\"fibonacci\": 3", "\"fibonacci\": 30")
        .replace("[10, 20]", &format!("{:?}", (1..=20).collect::<Vec<u32>>()));
    let sweep = Sweep::parse(&text, Path::new("made_up.json")).unwrap();
    folder.plan(&sweep, "0").unwrap();
    let mut journal = folder.journal(Shard::WHOLE).unwrap();
    for index in (0..sweep.len()).rev() {
        let outcome = Outcome { verified: succeeds(index % 20), ..success(index as f64) };
        journal.append(&record(&sweep, index, outcome)).unwrap();
    }
    Slews::of(&Table::read(&folder).unwrap(), most).unwrap()
}

#[test]
fn of_many_slews_a_sample_is_drawn_and_all_are_counted() {
    let first_fails = |angle: usize| angle > 0;
    let all = slews(600, first_fails);
    assert_eq!((all.recorded, all.succeeded, all.points.len()), (600, 570, 600));
    let some = slews(200, first_fails);
    assert_eq!((some.recorded, some.succeeded, &some.limits), (600, 570, &all.limits));
    let drawn = |slews: &Slews| {
        let won = slews.points.iter().filter(|slew| slew.succeeded).count();
        (won, slews.points.len() - won)
    };
    assert_eq!(drawn(&some), (170, 30));
    let angles: HashSet<u64> = some.points.iter().map(|slew| slew.angle_deg as u64).collect();
    assert_eq!(angles.len(), 20, "a sample has every angle");
    let mut rest = all.points.iter();
    assert!(some.points.iter().all(|slew| rest.any(|other| other == slew)), "in the plan's order");
    // Where most fail, successes are shown as well; and where few succeed, more failures.
    assert_eq!(drawn(&slews(100, |angle| angle % 2 == 0)), (50, 50));
    assert_eq!(drawn(&slews(100, |angle| angle == 0)), (30, 70));
    assert_eq!(drawn(&slews(0, first_fails)), (0, 0));
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
