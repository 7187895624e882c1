//! How far slews go: the largest angle that each combination of everything else allows.

use std::collections::{BTreeMap, HashMap};
use std::io::{self, Write};

use serde_json::Value;

use crate::case::CaseId;
use crate::cells::{cells_of, heads_of};
use crate::dimension::Column;
use crate::outcome::CaseStatus;
use crate::table::Table;

const ANGLE: &str = "maneuver.angle_deg";
const AXIS: &str = "maneuver.axis";

/// Every recorded slew of a sweep that varies their angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Slews {
    /// How many there are.
    pub recorded: usize,
    /// Of those, that succeeded.
    pub succeeded: usize,
    /// The slews to draw, in the order of the plan: all, or a sample if there are too many.
    pub points: Vec<SlewPoint>,
    /// What varies beside the angle.
    pub columns: Vec<Column>,
    /// One a combination of those, in the order of the plan.
    pub limits: Vec<SlewLimit>,
}

/// One recorded slew.
#[derive(Clone, Debug, PartialEq)]
pub struct SlewPoint {
    /// Which case.
    pub case_id: CaseId,
    /// The settings of the columns other than the angle.
    pub settings: Vec<Value>,
    /// Unit axis, body axes.
    pub axis: [f64; 3],
    /// Angle, deg.
    pub angle_deg: f64,
    /// Whether it does what was asked, verified.
    pub succeeded: bool,
    /// How it ended.
    pub status: CaseStatus,
    /// Norm of the vector part of the attitude error quaternion at the end; not finite without a result.
    pub attitude_error: f64,
    /// Value of the objective.
    pub objective: f64,
    /// The page of its plan, relative to the sweep's folder, where it is kept.
    pub plan_page: Option<String>,
}

/// How far one combination goes.
#[derive(Clone, Debug, PartialEq)]
pub struct SlewLimit {
    /// The settings of the columns other than the angle.
    pub settings: Vec<Value>,
    /// Unit axis, body axes.
    pub axis: [f64; 3],
    /// Number of recorded angles.
    pub tried: usize,
    /// Of those, that succeeded.
    pub succeeded: usize,
    /// The largest angle that succeeded, deg; 0 if none did.
    pub max_angle_deg: f64,
    /// The largest angle up to which every smaller one succeeded too, deg; 0 if there is none.
    pub all_up_to_deg: f64,
}

impl Slews {
    /// Whether slews about several axes are among what varies.
    pub fn has_axes(&self) -> bool {
        self.columns.iter().any(Self::is_axis)
    }

    /// Whether a column is the axis itself.
    pub fn is_axis(column: &Column) -> bool {
        column.field == AXIS
    }

    /// So many points a figure and a page can be opened with; a million are 200 MB of either.
    pub const MOST_POINTS: usize = 20_000;

    /// The slews of a table, with `most_points` of them to draw; none if no angle varies.
    ///
    /// Of more, a sample is kept that depends on nothing but their case ids. Failures are what one
    /// looks for: they get up to half of it, and more where successes leave room.
    pub fn of(table: &Table, most_points: usize) -> Option<Self> {
        let sweep = table.sweep();
        let columns = sweep.columns();
        let angle_at =
            columns.iter().position(|column| column.field == ANGLE && !column.relative)?;
        let axis_at = columns.iter().position(|column| column.field == AXIS);
        let base_axis = &sweep.base()["maneuver"]["axis"];
        let mut known: HashMap<String, usize> = HashMap::new();
        let mut limits: Vec<SlewLimit> = Vec::new();
        let mut tried: Vec<Vec<(f64, bool)>> = Vec::new();
        let [mut successes, mut failures] = [Sample::of(most_points), Sample::of(most_points)];
        for (index, row) in table.recorded() {
            let case = sweep.case(index);
            let (Some(angle_deg), Some(axis)) = (
                case.values[angle_at].as_f64(),
                unit(axis_at.map_or(base_axis, |at| &case.values[at])),
            ) else {
                continue;
            };
            let mut settings = case.values;
            settings.remove(angle_at);
            let point_settings = settings.clone();
            let limit =
                *known.entry(Value::from(settings.clone()).to_string()).or_insert_with(|| {
                    limits.push(SlewLimit::of(settings, axis));
                    tried.push(Vec::new());
                    limits.len() - 1
                });
            let succeeded = row.succeeded();
            tried[limit].push((angle_deg.abs(), succeeded));
            let sample = if succeeded { &mut successes } else { &mut failures };
            sample.offer(
                index,
                SlewPoint {
                    case_id: case.id,
                    settings: point_settings,
                    axis,
                    angle_deg,
                    succeeded,
                    status: row.status,
                    attitude_error: row.attitude_error,
                    objective: row.objective,
                    plan_page: None,
                },
            );
        }
        for (limit, angles) in limits.iter_mut().zip(tried) {
            limit.find(angles);
        }
        let others = columns.iter().enumerate().filter(|(i, _)| *i != angle_at);
        Some(Self {
            recorded: successes.offered + failures.offered,
            succeeded: successes.offered,
            points: Sample::join(successes, failures),
            columns: others.map(|(_, column)| column.clone()).collect(),
            limits,
        })
    }

    /// Writes `slew_limits.csv`: one row a combination.
    ///
    /// # Errors
    /// Those of writing.
    pub fn write_csv(&self, writer: &mut dyn Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(io::BufWriter::new(writer));
        let mut heads: Vec<String> =
            self.columns.iter().flat_map(heads_of).map(|head| head.name).collect();
        heads.extend(["tried", "succeeded", "max_angle_deg", "all_up_to_deg"].map(str::to_owned));
        csv.write_record(&heads)?;
        for limit in &self.limits {
            let settings = self.columns.iter().zip(&limit.settings);
            let cells = settings.flat_map(|(column, setting)| cells_of(column, setting));
            let mut cells: Vec<String> = cells.map(|cell| cell.to_text()).collect();
            cells.extend([limit.tried, limit.succeeded].map(|count| count.to_string()));
            cells.extend([limit.max_angle_deg, limit.all_up_to_deg].map(|angle| angle.to_string()));
            csv.write_record(&cells)?;
        }
        csv.flush()
    }
}

impl SlewLimit {
    fn of(settings: Vec<Value>, axis: [f64; 3]) -> Self {
        Self { settings, axis, tried: 0, succeeded: 0, max_angle_deg: 0.0, all_up_to_deg: 0.0 }
    }

    /// From the angles that were tried, and whether they succeeded.
    fn find(&mut self, mut angles: Vec<(f64, bool)>) {
        angles.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        self.tried = angles.len();
        self.succeeded = angles.iter().filter(|(_, succeeded)| *succeeded).count();
        let reached = |(angle, _): &(f64, bool)| *angle;
        self.max_angle_deg = angles.iter().rfind(|(_, succeeded)| *succeeded).map_or(0.0, reached);
        self.all_up_to_deg =
            angles.iter().take_while(|(_, succeeded)| *succeeded).last().map_or(0.0, reached);
    }
}

/// The slews with the smallest case ids: these are hashes, so that no pattern of the plan shows
/// through, as it does with every n-th slew where n divides the number of angles.
struct Sample {
    most: usize,
    offered: usize,
    /// With their places in the plan.
    kept: BTreeMap<CaseId, (usize, SlewPoint)>,
}

impl Sample {
    fn of(most: usize) -> Self {
        Self { most, offered: 0, kept: BTreeMap::new() }
    }

    fn offer(&mut self, index: usize, slew: SlewPoint) {
        self.offered += 1;
        self.kept.insert(slew.case_id, (index, slew));
        if self.kept.len() > self.most {
            self.kept.pop_last();
        }
    }

    /// As many of both as there is room for, in the order of the plan.
    fn join(successes: Self, failures: Self) -> Vec<SlewPoint> {
        let most = successes.most;
        let failed = failures.kept.len().min((most / 2).max(most - successes.kept.len()));
        let successes = successes.kept.into_values().take(most - failed);
        let mut points: Vec<_> =
            failures.kept.into_values().take(failed).chain(successes).collect();
        points.sort_unstable_by_key(|(index, _)| *index);
        points.into_iter().map(|(_, slew)| slew).collect()
    }
}

fn unit(axis: &Value) -> Option<[f64; 3]> {
    let elements = axis.as_array()?;
    let [x, y, z] = elements.as_slice() else { return None };
    let axis = [x.as_f64()?, y.as_f64()?, z.as_f64()?];
    let norm = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    (norm > 0.0).then(|| axis.map(|x| x / norm))
}
