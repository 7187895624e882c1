//! How files say what belongs to a joint: the names of fields and their units.

use righting_multibody::JointKind;

/// Names of the fields of a joint's limits and state, and the factor from their units to SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointWords {
    /// The smallest coordinate.
    pub min: &'static str,
    /// The largest coordinate.
    pub max: &'static str,
    /// The largest rate in magnitude.
    pub rate_max: &'static str,
    /// The largest acceleration in magnitude.
    pub acceleration_max: &'static str,
    /// The largest jerk in magnitude.
    pub jerk_max: &'static str,
    /// The largest torque or force in magnitude.
    pub effort_max: &'static str,
    coordinates: &'static str,
    rates: &'static str,
    /// Unit of a coordinate.
    pub unit: &'static str,
    /// What the joints of the kind do.
    pub that: &'static str,
    is_angle: bool,
}

const TURNS: JointWords = JointWords {
    min: "angle_min_deg",
    max: "angle_max_deg",
    rate_max: "rate_max_deg_s",
    acceleration_max: "acceleration_max_deg_s2",
    jerk_max: "jerk_max_deg_s3",
    effort_max: "torque_max_n_m",
    coordinates: "joint_angles_deg",
    rates: "joint_rates_deg_s",
    unit: "deg",
    that: "turns",
    is_angle: true,
};

const SLIDES: JointWords = JointWords {
    min: "travel_min_m",
    max: "travel_max_m",
    rate_max: "speed_max_m_s",
    acceleration_max: "acceleration_max_m_s2",
    jerk_max: "jerk_max_m_s3",
    effort_max: "force_max_n",
    coordinates: "joint_travels_m",
    rates: "joint_speeds_m_s",
    unit: "m",
    that: "slides",
    is_angle: false,
};

impl JointWords {
    /// Of a kind of joints.
    pub fn of(kind: JointKind) -> &'static Self {
        match kind {
            JointKind::Revolute => &TURNS,
            JointKind::Prismatic => &SLIDES,
        }
    }

    /// The field with the coordinates of all joints of the kind, at the start and at the end.
    pub fn coordinates(&self) -> &'static str {
        self.coordinates
    }

    /// The field with their rates at the start.
    pub fn rates(&self) -> &'static str {
        self.rates
    }

    /// A coordinate, rate, acceleration or jerk of a file in SI units: deg become rad.
    pub fn to_si(&self, value: f64) -> f64 {
        if self.is_angle { value.to_radians() } else { value }
    }

    /// The same the other way.
    pub fn from_si(&self, value: f64) -> f64 {
        if self.is_angle { value.to_degrees() } else { value }
    }
}

/// Values of all joints in the order of their coordinates, from those of the joints that turn and of those
/// that slide; as many as both have.
pub fn in_joint_order<T: Clone>(kinds: &[JointKind], turning: &[T], sliding: &[T]) -> Vec<T> {
    let (mut turning, mut sliding) = (turning.iter(), sliding.iter());
    let next = |kind: &JointKind| match kind {
        JointKind::Revolute => turning.next().cloned(),
        JointKind::Prismatic => sliding.next().cloned(),
    };
    kinds.iter().map_while(next).collect()
}

/// Of values in the order of the joints' coordinates those of one kind.
pub fn of_kind<T: Clone>(kinds: &[JointKind], kind: JointKind, values: &[T]) -> Vec<T> {
    let listed = kinds.iter().zip(values).filter(|(of, _)| **of == kind);
    listed.map(|(_, value)| value.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_go_apart_and_together() {
        let kinds = [JointKind::Prismatic, JointKind::Revolute, JointKind::Prismatic];
        let values = in_joint_order(&kinds, &[1.0], &[2.0, 3.0]);
        assert_eq!(values, [2.0, 1.0, 3.0]);
        assert_eq!(of_kind(&kinds, JointKind::Revolute, &values), [1.0]);
        assert_eq!(of_kind(&kinds, JointKind::Prismatic, &values), [2.0, 3.0]);
    }
}
