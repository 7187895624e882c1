//! How far slews go: the largest angle that each combination of everything else allows.

use std::collections::HashMap;
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
    /// The slews, in the order of the plan.
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
    /// Which of the [`Slews::limits`] it counts for.
    pub limit: usize,
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
    /// The slews of a table; none if no angle varies.
    pub fn of(table: &Table) -> Option<Self> {
        let sweep = table.sweep();
        let columns = sweep.columns();
        let angle_at =
            columns.iter().position(|column| column.field == ANGLE && !column.relative)?;
        let axis_at = columns.iter().position(|column| column.field == AXIS);
        let base_axis = &sweep.base()["maneuver"]["axis"];
        let mut known: HashMap<String, usize> = HashMap::new();
        let mut slews = Self { points: Vec::new(), columns: Vec::new(), limits: Vec::new() };
        let others = columns.iter().enumerate().filter(|(i, _)| *i != angle_at);
        slews.columns = others.map(|(_, column)| column.clone()).collect();
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
            let limit =
                *known.entry(Value::from(settings.clone()).to_string()).or_insert_with(|| {
                    slews.limits.push(SlewLimit {
                        settings,
                        axis,
                        tried: 0,
                        succeeded: 0,
                        max_angle_deg: 0.0,
                        all_up_to_deg: 0.0,
                    });
                    slews.limits.len() - 1
                });
            slews.points.push(SlewPoint {
                case_id: case.id,
                axis,
                angle_deg,
                succeeded: row.succeeded(),
                status: row.status,
                attitude_error: row.attitude_error,
                objective: row.objective,
                limit,
            });
        }
        slews.find_limits();
        Some(slews)
    }

    fn find_limits(&mut self) {
        let mut angles: Vec<Vec<(f64, bool)>> = self.limits.iter().map(|_| Vec::new()).collect();
        for slew in &self.points {
            angles[slew.limit].push((slew.angle_deg.abs(), slew.succeeded));
        }
        for (limit, mut angles) in self.limits.iter_mut().zip(angles) {
            angles.sort_by(|(a, _), (b, _)| a.total_cmp(b));
            limit.tried = angles.len();
            limit.succeeded = angles.iter().filter(|(_, succeeded)| *succeeded).count();
            let reached = |(angle, _): &(f64, bool)| *angle;
            limit.max_angle_deg =
                angles.iter().rfind(|(_, succeeded)| *succeeded).map_or(0.0, reached);
            limit.all_up_to_deg =
                angles.iter().take_while(|(_, succeeded)| *succeeded).last().map_or(0.0, reached);
        }
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

fn unit(axis: &Value) -> Option<[f64; 3]> {
    let elements = axis.as_array()?;
    let [x, y, z] = elements.as_slice() else { return None };
    let axis = [x.as_f64()?, y.as_f64()?, z.as_f64()?];
    let norm = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    (norm > 0.0).then(|| axis.map(|x| x / norm))
}
