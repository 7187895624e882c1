//! Where instruments look, at the nodes and between them.
//!
//! Between two places a boresight goes no farther than the base turns, and the cone's axis, which may move, no
//! farther than its table says: φ together. So with the angles θ₀ and θ₁ from the axis there, the angle between
//! them is at least (θ₀ + θ₁ − φ)/2 and at most (θ₀ + θ₁ + φ)/2. Where that does not keep a boresight on its side
//! from node to node, the second integration is followed in parts so short that φ is no more than [`TURN_RAD`] in
//! each. What the report gives is the bound.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_results::trajectory::Trajectory;
use righting_scenario::file;

use crate::ledger::{Ledger, Worst};
use crate::model::State;
use crate::requirements::Requirements;
use crate::simulation::{Follower, Simulation, Span};

/// How far base and axis turn in a part of an interval that is followed, rad. The bound is off by half of that at
/// the most.
const TURN_RAD: f64 = 2e-4;
/// Parts of an interval at most.
const MOST_PARTS: usize = 10_000;
/// By how many times the larger rate at the ends of an interval, or of a part of one, the base turns in it at
/// most. The joints' rates are linear in time there, so the base's are nearly so.
const INTERVAL_MARGIN: f64 = 1.5;
const PART_MARGIN: f64 = 1.01;

/// An instrument's cone.
#[derive(Clone, Debug)]
pub(super) struct Cone {
    name: String,
    /// Where the instrument looks, body axes, of unit length.
    boresight: Vector3<f64>,
    /// Times and the cone's axis there, inertial axes, of unit length.
    axes: Vec<(f64, Vector3<f64>)>,
    /// No faster does the axis move, rad/s.
    axis_rate_rad_s: f64,
    half_angle_rad: f64,
    side: Side,
}

/// Where the boresight stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Outside,
    Inside,
}

impl Cone {
    /// Of a resolved scenario, which has a direction and a half-angle.
    pub fn new(pointing: &file::Pointing) -> Self {
        let (side, half_angle_deg) = match (pointing.keep_out_deg, pointing.keep_in_deg) {
            (Some(half_angle_deg), _) => (Side::Outside, half_angle_deg),
            (None, half_angle_deg) => (Side::Inside, half_angle_deg.unwrap_or(f64::NAN)),
        };
        let axes: Vec<(f64, Vector3<f64>)> = match &pointing.direction_table {
            Some(table) => {
                let rows = table.t_s.iter().zip(&table.vectors);
                rows.map(|(time_s, axis)| (*time_s, Vector3::from(*axis).normalize())).collect()
            }
            None => {
                let axis = Vector3::from(pointing.direction_inertial.unwrap_or_default());
                vec![(0.0, axis.normalize())]
            }
        };
        // The chord is gone along at constant speed: in its middle, at the distance √(1 − |c|²/4), the direction
        // turns fastest.
        let rates = axes.windows(2).map(|ends| {
            let chord = (ends[1].1 - ends[0].1).norm();
            chord / (1.0 - 0.25 * chord * chord).sqrt() / (ends[1].0 - ends[0].0)
        });
        Self {
            name: pointing.name.clone(),
            boresight: Vector3::from(pointing.boresight_body).normalize(),
            axis_rate_rad_s: rates.fold(0.0, f64::max),
            axes,
            half_angle_rad: half_angle_deg.to_radians(),
            side,
        }
    }

    /// The axis at a time: along the chord between two that are given.
    fn axis(&self, time_s: f64) -> Vector3<f64> {
        let around = self.axes.windows(2).find(|ends| time_s <= ends[1].0);
        match (around, self.axes.last()) {
            (Some(&[(start_s, start), (end_s, end)]), _) => {
                (start + (end - start) * ((time_s - start_s) / (end_s - start_s))).normalize()
            }
            (_, Some((_, last))) => *last,
            (_, None) => Vector3::repeat(f64::NAN),
        }
    }

    /// The angle between boresight and axis in an attitude at a time, rad: 2 atan(‖a − b‖/‖a + b‖) of unit
    /// vectors a and b (Kahan).
    fn angle_rad(&self, attitude: &Quaternion<f64>, time_s: f64) -> f64 {
        let looks = UnitQuaternion::from_quaternion(*attitude) * self.boresight;
        let axis = self.axis(time_s);
        2.0 * (looks - axis).norm().atan2((looks + axis).norm())
    }

    /// The angle nearest to the wrong side, or farthest on it, that is possible between two places with these
    /// angles where the base turns by `turn_rad`, rad.
    fn bound_rad(&self, [first, second]: [f64; 2], turn_rad: f64) -> f64 {
        match self.side {
            Side::Outside => 0.5 * (first + second - turn_rad),
            Side::Inside => 0.5 * (first + second + turn_rad),
        }
    }

    fn is_kept(&self, angle_rad: f64) -> bool {
        match self.side {
            Side::Outside => angle_rad >= self.half_angle_rad,
            Side::Inside => angle_rad <= self.half_angle_rad,
        }
    }

    fn look(&self, angle_rad: f64, time_s: f64, worst: &mut Worst) {
        let time_s = Some(time_s);
        match self.side {
            Side::Outside => worst.at_least(angle_rad, self.half_angle_rad, None, time_s),
            Side::Inside => worst.at_most(angle_rad, self.half_angle_rad, None, time_s),
        }
    }
}

/// Every boresight stays on its side: two checks an instrument.
pub(super) fn check(
    asked: &Requirements,
    trajectory: &Trajectory,
    simulation: &Simulation,
    ledger: &mut Ledger,
) {
    let tolerances = &asked.tolerances;
    for cone in &asked.cones {
        let mut at_nodes = Worst::of_limit("pointing at nodes", "rad", tolerances.attitude_rad);
        for node in trajectory.nodes() {
            let angle_rad = cone.angle_rad(&State::of_node(node).attitude, node.time_s);
            cone.look(angle_rad, node.time_s, &mut at_nodes);
        }
        let tolerance_rad = tolerances.between_nodes.angle_rad;
        let mut between = Worst::of_limit("pointing between nodes", "rad", tolerance_rad);
        for (k, state) in simulation.nodes().enumerate() {
            let time_s = asked.horizon.time_s(k);
            cone.look(cone.angle_rad(&state.attitude, time_s), time_s, &mut between);
        }
        let mut follower = Follower::new(&asked.model, &asked.surroundings);
        let states = simulation.nodes().zip(simulation.nodes().skip(1));
        for (k, (interval, ends)) in trajectory.intervals().iter().zip(states).enumerate() {
            let start_s = asked.horizon.time_s(k);
            let duration_s = asked.horizon.time_s(k + 1) - start_s;
            let span = simulation.span(asked, k, interval);
            cone.look_within(ends, (span, duration_s), &mut follower, &mut between);
        }
        ledger.add_of(at_nodes, &cone.name);
        ledger.add_of(between, &cone.name);
    }
}

impl Cone {
    /// Looks at the angles within an interval, along the motion that `follower` follows there.
    fn look_within(
        &self,
        (start, end): (State<'_>, State<'_>),
        (span, duration_s): (Span<'_>, f64),
        follower: &mut Follower<'_>,
        worst: &mut Worst,
    ) {
        let start_s = span.start_s;
        let rate = start.angular_rate.norm().max(end.angular_rate.norm());
        let turn_rad = (INTERVAL_MARGIN * rate + self.axis_rate_rad_s) * duration_s;
        let ends = [(&start, start_s), (&end, start_s + duration_s)];
        let angles = ends.map(|(state, time_s)| self.angle_rad(&state.attitude, time_s));
        if self.is_kept(self.bound_rad(angles, turn_rad)) {
            return;
        }
        // A turn that is too large, or no number, is cut.
        let parts = ((turn_rad / TURN_RAD).ceil() as usize).clamp(1, MOST_PARTS);
        let part_s = duration_s / parts as f64;
        let mut x = start.to_vec();
        let (mut angle, mut rate) = (angles[0], start.angular_rate.norm());
        for part in 0..parts {
            let before_s = part as f64 * part_s;
            follower.advance(&mut x, span, before_s, part_s);
            let there = State::from_slice(&x);
            let time_s = start_s + (part + 1) as f64 * part_s;
            let next_angle = self.angle_rad(&there.attitude, time_s);
            let next_rate = there.angular_rate.norm();
            let turn_rad = (PART_MARGIN * rate.max(next_rate) + self.axis_rate_rad_s) * part_s;
            let bound_rad = self.bound_rad([angle, next_angle], turn_rad);
            self.look(bound_rad, start_s + (part as f64 + 0.5) * part_s, worst);
            (angle, rate) = (next_angle, next_rate);
        }
    }
}
