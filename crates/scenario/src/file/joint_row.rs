//! What a file says of the joints that move, wherever it says it.

use righting_multibody::JointKind;

use super::{Drive, Joint, JointWords, System};

/// One joint of a row or of a body, with the names of the fields in which it stands. Numbers are in the
/// file's units: deg and N m, or of a joint that slides m and N.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRow {
    /// The field that holds it, such as `links[2]` or `bodies[4].joint`, as its keys and indices.
    pub place: JointPlace,
    /// Name, where one is given or follows from the body's.
    pub name: Option<String>,
    /// What its coordinate is.
    pub kind: JointKind,
    /// Smallest coordinate, deg or m; none if there is no limit.
    pub min: Option<f64>,
    /// Largest coordinate, deg or m; none if there is no limit.
    pub max: Option<f64>,
    /// Largest rate in magnitude, deg/s or m/s; none where it is missing.
    pub rate_max: Option<f64>,
    /// Largest acceleration in magnitude, deg/s² or m/s²; none where it is missing.
    pub acceleration_max: Option<f64>,
    /// Largest jerk in magnitude, deg/s³ or m/s³; none if there is no limit.
    pub jerk_max: Option<f64>,
    /// Largest torque or force in magnitude, N m or N; none if there is no limit.
    pub effort_max: Option<f64>,
    /// Friction, rotor, gear and motor; none for a drive that adds nothing.
    pub drive: Option<Drive>,
}

/// Where a joint stands in a system file, by its place in the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointPlace {
    /// In a row of `links`.
    Link(usize),
    /// In the `joint` of a body of `bodies`.
    Body(usize),
}

impl JointRow {
    /// The names of its fields, and their units.
    pub fn words(&self) -> &'static JointWords {
        JointWords::of(self.kind)
    }

    /// Of a body; none of a fixed one.
    fn of_body(index: usize, name: String, joint: &Joint) -> Option<Self> {
        let kind = joint.kind.joint_kind()?;
        let limits = match kind {
            JointKind::Revolute => [
                joint.angle_min_deg,
                joint.angle_max_deg,
                joint.rate_max_deg_s,
                joint.acceleration_max_deg_s2,
                joint.jerk_max_deg_s3,
                joint.torque_max_n_m,
            ],
            JointKind::Prismatic => [
                joint.travel_min_m,
                joint.travel_max_m,
                joint.speed_max_m_s,
                joint.acceleration_max_m_s2,
                joint.jerk_max_m_s3,
                joint.force_max_n,
            ],
        };
        let [min, max, rate_max, acceleration_max, jerk_max, effort_max] = limits;
        Some(Self {
            place: JointPlace::Body(index),
            name: Some(name),
            kind,
            min,
            max,
            rate_max,
            acceleration_max,
            jerk_max,
            effort_max,
            drive: joint.drive.clone(),
        })
    }
}

impl System {
    /// The joints that move, in the order of their coordinates.
    pub fn joints(&self) -> Vec<JointRow> {
        let rows = self.links.iter().enumerate().map(|(index, link)| JointRow {
            place: JointPlace::Link(index),
            name: link.name.clone(),
            kind: JointKind::Revolute,
            min: link.angle_min_deg,
            max: link.angle_max_deg,
            rate_max: Some(link.rate_max_deg_s),
            acceleration_max: Some(link.acceleration_max_deg_s2),
            jerk_max: link.jerk_max_deg_s3,
            effort_max: link.torque_max_n_m,
            drive: link.drive.clone(),
        });
        let bodies = self.bodies.iter().flatten().enumerate();
        let moving = bodies.filter_map(|(index, body)| {
            JointRow::of_body(index, body.joint.name_on(&body.name), &body.joint)
        });
        rows.chain(moving).collect()
    }

    /// What the coordinate of each joint that moves is.
    pub fn joint_kinds(&self) -> Vec<JointKind> {
        let bodies = self.bodies.iter().flatten();
        let bodies = bodies.filter_map(|body| body.joint.kind.joint_kind());
        self.links.iter().map(|_| JointKind::Revolute).chain(bodies).collect()
    }

    /// Takes over the range and the largest rate of a joint.
    pub fn set_limits(&mut self, row: &JointRow) {
        match row.place {
            JointPlace::Link(index) => {
                let link = &mut self.links[index];
                link.angle_min_deg = row.min;
                link.angle_max_deg = row.max;
                link.rate_max_deg_s = row.rate_max.unwrap_or(link.rate_max_deg_s);
            }
            JointPlace::Body(index) => {
                let body = self.bodies.as_mut().and_then(|bodies| bodies.get_mut(index));
                let Some(joint) = body.map(|body| &mut body.joint) else { return };
                let (min, max, rate_max) = match row.kind {
                    JointKind::Revolute => (
                        &mut joint.angle_min_deg,
                        &mut joint.angle_max_deg,
                        &mut joint.rate_max_deg_s,
                    ),
                    JointKind::Prismatic => {
                        (&mut joint.travel_min_m, &mut joint.travel_max_m, &mut joint.speed_max_m_s)
                    }
                };
                (*min, *max, *rate_max) = (row.min, row.max, row.rate_max);
            }
        }
    }
}
