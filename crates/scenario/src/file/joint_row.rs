//! What a file says of the joints that move, wherever it says it.

use super::{Drive, JointType, System};

/// One joint of a row or of a body, with the names of the fields in which it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRow {
    /// The field that holds it, such as `links[2]` or `bodies[4].joint`, as its keys and indices.
    pub place: JointPlace,
    /// Name, where one is given or follows from the body's.
    pub name: Option<String>,
    /// Smallest joint angle, deg; none if there is no limit.
    pub angle_min_deg: Option<f64>,
    /// Largest joint angle, deg; none if there is no limit.
    pub angle_max_deg: Option<f64>,
    /// Largest joint rate in magnitude, deg/s; none where it is missing.
    pub rate_max_deg_s: Option<f64>,
    /// Largest joint acceleration in magnitude, deg/s²; none where it is missing.
    pub acceleration_max_deg_s2: Option<f64>,
    /// Largest joint jerk in magnitude, deg/s³; none if there is no limit.
    pub jerk_max_deg_s3: Option<f64>,
    /// Largest torque in magnitude, N m; none if there is no limit.
    pub torque_max_n_m: Option<f64>,
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

impl System {
    /// The joints that move, in the order of their coordinates.
    pub fn joints(&self) -> Vec<JointRow> {
        let rows = self.links.iter().enumerate().map(|(index, link)| JointRow {
            place: JointPlace::Link(index),
            name: link.name.clone(),
            angle_min_deg: link.angle_min_deg,
            angle_max_deg: link.angle_max_deg,
            rate_max_deg_s: Some(link.rate_max_deg_s),
            acceleration_max_deg_s2: Some(link.acceleration_max_deg_s2),
            jerk_max_deg_s3: link.jerk_max_deg_s3,
            torque_max_n_m: link.torque_max_n_m,
            drive: link.drive.clone(),
        });
        let bodies = self.bodies.iter().flatten().enumerate();
        let moving = bodies.filter(|(_, body)| body.joint.kind != JointType::Fixed);
        rows.chain(moving.map(|(index, body)| JointRow {
            place: JointPlace::Body(index),
            name: Some(body.joint.name_on(&body.name)),
            angle_min_deg: body.joint.angle_min_deg,
            angle_max_deg: body.joint.angle_max_deg,
            rate_max_deg_s: body.joint.rate_max_deg_s,
            acceleration_max_deg_s2: body.joint.acceleration_max_deg_s2,
            jerk_max_deg_s3: body.joint.jerk_max_deg_s3,
            torque_max_n_m: body.joint.torque_max_n_m,
            drive: body.joint.drive.clone(),
        }))
        .collect()
    }

    /// Takes over the limits of a joint.
    pub fn set_limits(&mut self, row: &JointRow) {
        match row.place {
            JointPlace::Link(index) => {
                let link = &mut self.links[index];
                link.angle_min_deg = row.angle_min_deg;
                link.angle_max_deg = row.angle_max_deg;
                link.rate_max_deg_s = row.rate_max_deg_s.unwrap_or(link.rate_max_deg_s);
            }
            JointPlace::Body(index) => {
                if let Some(body) = self.bodies.as_mut().and_then(|bodies| bodies.get_mut(index)) {
                    body.joint.angle_min_deg = row.angle_min_deg;
                    body.joint.angle_max_deg = row.angle_max_deg;
                    body.joint.rate_max_deg_s = row.rate_max_deg_s;
                }
            }
        }
    }
}
