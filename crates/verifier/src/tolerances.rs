//! How far a plan may be off, measured by the maneuver: by the system's size and the duration.

/// The duration at which the tolerances of rates have the values given here, s.
const DURATION_S: f64 = 30.0;

/// Mismatches of a motion with its second integration.
const QUATERNION_NORM: f64 = 1e-5;
const ATTITUDE_RAD: f64 = 1e-4;
const ANGULAR_RATE_RAD_S: f64 = 1e-4;
/// In lengths of the system, and those in a unit of time.
const POSITION: f64 = 1e-4;
const VELOCITY: f64 = 1e-4;
const JOINT_RAD: f64 = 1e-6;
const TIME: f64 = 1e-9;

/// How far a node may be past a limit (rad, rad/s, rad/s², rad/s³, lengths of the system).
const AT_NODES: f64 = 1e-6;
/// How far the motion between nodes may be past a limit (rad, rad/s).
const BETWEEN_NODES: f64 = 1e-3;
/// The same of a clearance: a share of it, and of the system's size at the most.
const CLEARANCE_SHARE: f64 = 0.1;
const CLEARANCE: f64 = 1e-3;

/// Tolerances of everything that has a unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerances {
    pub time_s: f64,
    pub quaternion_norm: f64,
    pub attitude_rad: f64,
    pub angular_rate_rad_s: f64,
    pub position_m: f64,
    pub velocity_m_s: f64,
    pub joint_angle_rad: f64,
    pub joint_rate_rad_s: f64,
    pub at_nodes: LimitTolerances,
    pub between_nodes: LimitTolerances,
    size_m: f64,
}

/// What torques and rates of a maneuver are compared with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measures {
    /// The system's mass times the square of its size and of one over the duration.
    pub torque_n_m: f64,
    /// A thousandth of a turn through one radian in a thirtieth of the duration.
    pub rate_rad_s: f64,
}

impl Measures {
    /// Of a system of this size and mass in a maneuver of this duration.
    pub fn new(size_m: f64, mass_kg: f64, duration_s: f64) -> Self {
        Self {
            torque_n_m: mass_kg * (size_m / duration_s).powi(2),
            rate_rad_s: 1e-3 * DURATION_S / duration_s,
        }
    }
}

/// How far a limit may be passed. Of a joint that slides so many sizes of the system.
#[derive(Clone, Copy, Debug)]
pub(super) struct LimitTolerances {
    pub angle_rad: f64,
    pub rate_rad_s: f64,
    pub acceleration_rad_s2: f64,
    pub jerk_rad_s3: f64,
    pub distance_m: f64,
}

impl Tolerances {
    /// Of a system of this size that keeps this clearance, in a maneuver of this duration whose base turns
    /// at `spin_rad_s` to begin with.
    pub fn new(size_m: f64, clearance_m: f64, duration_s: f64, spin_rad_s: f64) -> Self {
        // Rates of a maneuver go with one over its duration. What turns by itself is off by so much more in
        // rate as it turns.
        let per_s = DURATION_S / duration_s;
        let base_per_s = per_s.max(spin_rad_s);
        let limits = |tolerance: f64, distance_m: f64| LimitTolerances {
            angle_rad: tolerance,
            rate_rad_s: tolerance * per_s,
            acceleration_rad_s2: tolerance * per_s.powi(2),
            jerk_rad_s3: tolerance * per_s.powi(3),
            distance_m,
        };
        let touching_m = AT_NODES * size_m;
        let cut_m = (CLEARANCE_SHARE * clearance_m).min(CLEARANCE * size_m).max(touching_m);
        Self {
            time_s: TIME * duration_s,
            quaternion_norm: QUATERNION_NORM,
            attitude_rad: ATTITUDE_RAD,
            angular_rate_rad_s: ANGULAR_RATE_RAD_S * base_per_s,
            position_m: POSITION * size_m,
            velocity_m_s: VELOCITY * size_m * base_per_s,
            joint_angle_rad: JOINT_RAD,
            joint_rate_rad_s: JOINT_RAD * per_s,
            at_nodes: limits(AT_NODES, touching_m),
            between_nodes: limits(BETWEEN_NODES, cut_m),
            size_m,
        }
    }

    /// A tolerance of joints that turn (rad, rad/s and on), and that of joints that slide (m, m/s and on).
    pub fn of_kinds(&self, tolerance: f64) -> [f64; 2] {
        [tolerance, tolerance * self.size_m]
    }

    /// How far each element of a state vector may be from the start that was asked for: as far as a joint
    /// angle, in its own unit.
    pub fn of_start(&self, slides: &[bool]) -> Vec<f64> {
        let of_joints = |tolerance: f64| {
            let of_kinds = self.of_kinds(tolerance);
            slides.iter().map(|slides| of_kinds[usize::from(*slides)]).collect::<Vec<_>>()
        };
        let share = self.joint_angle_rad / self.attitude_rad;
        let position_m = self.position_m * share;
        let velocity_m_s = self.velocity_m_s * share;
        let rate_rad_s = self.angular_rate_rad_s * share;
        [
            vec![position_m; 3],
            vec![self.joint_angle_rad; 4],
            vec![velocity_m_s; 3],
            vec![rate_rad_s; 3],
            of_joints(self.joint_angle_rad),
            of_joints(self.joint_rate_rad_s),
        ]
        .concat()
    }
}

/// What may be left of a rate at rest, deg/s, in a maneuver of this duration, s: of one of 30 s it is `deg_s`, and of others
/// as much less as they are longer.
pub fn at_rest_deg_s(deg_s: f64, duration_s: f64) -> f64 {
    deg_s * DURATION_S / duration_s
}
