//! What a scenario says of all joints, in the order of their coordinates.

use righting_multibody::JointKind;

use super::{End, Initial, JointWords, in_joint_order, of_kind};

impl Initial {
    /// Coordinates of the joints of these kinds at the start, rad or m; as many as are given.
    pub fn joint_coordinates(&self, kinds: &[JointKind]) -> Vec<f64> {
        to_si(kinds, &in_joint_order(kinds, &self.joint_angles_deg, &self.joint_travels_m))
    }

    /// Their rates, rad/s or m/s; those not given are zero.
    pub fn joint_rates(&self, kinds: &[JointKind]) -> Vec<f64> {
        to_si(kinds, &self.rates_in_joint_order(kinds))
    }

    /// Their rates in the file's units, deg/s or m/s; those not given are zero.
    pub(crate) fn rates_in_joint_order(&self, kinds: &[JointKind]) -> Vec<f64> {
        let given =
            |rates: &Option<Vec<f64>>| rates.clone().unwrap_or_else(|| vec![0.0; kinds.len()]);
        in_joint_order(kinds, &given(&self.joint_rates_deg_s), &given(&self.joint_speeds_m_s))
    }

    /// Starts from other coordinates (rad or m), the joints at rest.
    pub fn set_resting_joints(&mut self, kinds: &[JointKind], coordinates: &[f64]) {
        let of = |kind| {
            let words = JointWords::of(kind);
            let values = of_kind(kinds, kind, coordinates);
            values.into_iter().map(|value| words.from_si(value)).collect()
        };
        self.joint_angles_deg = of(JointKind::Revolute);
        self.joint_travels_m = of(JointKind::Prismatic);
        self.joint_rates_deg_s = None;
        self.joint_speeds_m_s = None;
    }
}

impl End {
    /// Coordinates in which the joints of these kinds shall end, rad or m; none where a joint is free.
    pub fn joint_coordinates(&self, kinds: &[JointKind]) -> Vec<Option<f64>> {
        let given = |values: &Option<Vec<Option<f64>>>| {
            values.clone().unwrap_or_else(|| vec![None; kinds.len()])
        };
        let ends =
            in_joint_order(kinds, &given(&self.joint_angles_deg), &given(&self.joint_travels_m));
        let si = |(kind, end): (&JointKind, Option<f64>)| {
            end.map(|end| JointWords::of(*kind).to_si(end))
        };
        kinds.iter().zip(ends).map(si).collect()
    }

    /// Lets every joint end where it will.
    pub fn free_joints(&mut self) {
        self.joint_angles_deg = None;
        self.joint_travels_m = None;
    }
}

fn to_si(kinds: &[JointKind], values: &[f64]) -> Vec<f64> {
    kinds.iter().zip(values).map(|(kind, &value)| JointWords::of(*kind).to_si(value)).collect()
}
