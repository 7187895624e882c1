//! Which masses a spacecraft has, from how its base turns while its joints move.
//!
//! The base's attitude follows from the joints' motion and the momentum through the masses. So an extended
//! Kalman filter on the attitude and on what the masses are off, as shares of them, says what both are:
//!
//! ```text
//! x = [φ, s],   q_BN = q̂_BN ⊗ exp(φ/2),   m_i = m̄_i (1 + s_i),   I_i = Ī_i (1 + s_i) (1 + s'_i)
//! ω = Ĩ(q, s)⁻¹ (C(q_BN)ᵀ h(t) − H̃(q, q̇, s)),   ṡ = 0,   measured: q_BN
//! ```
//!
//! (the multiplicative filter of Lefferts, Markley and Shuster, *Kalman Filtering for Spacecraft Attitude
//! Estimation*, 1982, with the motion of the joints in place of a gyroscope). Between two measurements the joints
//! move as the cubic has it that meets angles and rates of both, whatever they were told. The momentum at the
//! start is that of the measured rates with the masses as they are estimated; what it gains later is the plan's.
//!
//! One common factor of all masses changes no motion and is never found; nor does it matter.

use nalgebra::{DMatrix, Matrix3, Vector3};
use righting_multibody::{MassFactors, ModelError, Quaternion, State, System};
use righting_ocp::RungeKutta4;
use righting_results::Trajectory;
use righting_scenario::Scenario;

use crate::measured::Measured;

/// Standard deviation of what masses and inertias are off before anything is measured, as a share: that of
/// numbers drawn evenly within 10 %, or a little more.
const PRIOR: f64 = 0.06;
/// Masses are not believed to be off by more than so many prior deviations.
const MOST_DEVIATIONS: f64 = 4.0;
/// What moves the attitude beside the model, rad/√s.
const DRIFT: f64 = 1e-6;
/// The smallest noise of the attitude that is assumed, rad.
const LEAST_NOISE_RAD: f64 = 1e-6;
/// Difference of a share by which derivatives are taken.
const DIFFERENCE: f64 = 1e-4;
/// Longest step in which the motion between two measurements is followed, s, where the base turns by no more
/// than a few degrees a second.
const STEP_S: f64 = 0.25;
/// Most steps between two measurements.
const MOST_STEPS: usize = 200;

/// An estimate of masses, from measurement to measurement.
#[derive(Clone, Debug)]
pub struct MassEstimate {
    scenario: Scenario,
    /// Angular momentum along the plan beyond that at its start, inertial axes, N m s, with times, s.
    gained: Vec<(f64, Vector3<f64>)>,
    /// s: of every part its mass, then of every part its inertia.
    shares: Vec<f64>,
    /// Of [φ, s].
    covariance: DMatrix<f64>,
    noise_rad: f64,
    last: Last,
}

/// What was measured last; the attitude as estimated.
#[derive(Clone, Debug)]
struct Last {
    time_s: f64,
    attitude: Quaternion<f64>,
    joint_angles_rad: Vec<f64>,
    joint_rates_rad_s: Vec<f64>,
}

impl MassEstimate {
    /// Before anything is measured: the scenario's masses, where its plan starts. The standard deviation of the
    /// measured attitude about each axis is `noise_rad`.
    pub fn new(scenario: &Scenario, plan: &Trajectory, noise_rad: f64) -> Self {
        let model = &scenario.system().model;
        let of_node = |node: &righting_results::trajectory::Node| {
            model.inertial_angular_momentum(&node.state())
        };
        let at_start = of_node(plan.start());
        let gained = match scenario.acting_environment() {
            Some(_) => plan.nodes().iter().map(|n| (n.time_s, of_node(n) - at_start)).collect(),
            None => Vec::new(),
        };
        let shares = vec![0.0; 2 * model.massive_part_count()];
        let noise_rad = noise_rad.max(LEAST_NOISE_RAD);
        let variances = std::iter::repeat_n(noise_rad.powi(2), 3)
            .chain(shares.iter().map(|_| PRIOR.powi(2)))
            .collect::<Vec<f64>>();
        let start = plan.start();
        let last = Last {
            time_s: start.time_s,
            attitude: Quaternion::from_array(start.attitude),
            joint_angles_rad: start.joint_angles_rad.clone(),
            joint_rates_rad_s: start.joint_rates_rad_s.clone(),
        };
        Self {
            scenario: scenario.clone(),
            gained,
            covariance: DMatrix::from_diagonal(&variances.into()),
            shares,
            noise_rad,
            last,
        }
    }

    /// Takes in what is measured at a time, s. What is not finite, or no later than the last, is passed over.
    ///
    /// # Errors
    /// [`ModelError`] where the masses so far are none that a system can have.
    ///
    /// # Panics
    /// There is not one joint value a joint.
    pub fn observe(&mut self, time_s: f64, measured: &Measured<'_>) -> Result<(), ModelError> {
        if !measured.is_finite() || time_s <= self.last.time_s {
            return Ok(());
        }
        let seconds = time_s - self.last.time_s;
        let predicted = self.turned(&self.shares, time_s, measured)?;
        let transition = self.transition(&predicted, time_s, measured)?;
        let mut covariance = &transition * &self.covariance * transition.transpose();
        for axis in 0..3 {
            covariance[(axis, axis)] += DRIFT.powi(2) * seconds;
        }

        // H = [1 0].
        let seen = covariance.fixed_view::<3, 3>(0, 0)
            + Matrix3::from_diagonal_element(self.noise_rad.powi(2));
        let Some(factor) = seen.cholesky() else { return Ok(()) };
        let gain = covariance.columns(0, 3) * factor.inverse();
        let residual = turn_between(&predicted, &measured.attitude.normalized());
        let correction = &gain * residual;
        let attitude =
            turned_by(&predicted, &Vector3::from_iterator(correction.iter().take(3).copied()));
        let most = MOST_DEVIATIONS * PRIOR;
        for (share, correction) in self.shares.iter_mut().zip(correction.iter().skip(3)) {
            *share = (*share + correction).clamp(-most, most);
        }
        let rows = covariance.rows(0, 3).into_owned();
        covariance -= &gain * rows;
        self.covariance = (&covariance + covariance.transpose()) * 0.5;
        self.last = Last {
            time_s,
            attitude,
            joint_angles_rad: measured.joint_angles_rad.to_vec(),
            joint_rates_rad_s: measured.joint_rates_rad_s.to_vec(),
        };
        Ok(())
    }

    /// The attitude at the last measurement, from all of them.
    pub fn attitude(&self) -> Quaternion<f64> {
        self.last.attitude
    }

    /// What the masses of the parts are multiplied by, those of the base, of links or bodies, and of a payload.
    pub fn factors(&self) -> Vec<MassFactors> {
        factors(&self.shares)
    }

    /// The scenario with the masses as they are estimated.
    ///
    /// # Errors
    /// [`ModelError`] where they are none that a system can have.
    pub fn scenario(&self) -> Result<Scenario, ModelError> {
        let model = self.scenario.system().model.with_masses_multiplied(&self.factors())?;
        Ok(self.scenario.clone().with_model(model))
    }

    /// ∂[φ, s] / ∂[φ, s] from the last measurement to this one.
    fn transition(
        &self,
        predicted: &Quaternion<f64>,
        time_s: f64,
        measured: &Measured<'_>,
    ) -> Result<DMatrix<f64>, ModelError> {
        let dimension = 3 + self.shares.len();
        let mut transition = DMatrix::identity(dimension, dimension);
        // An attitude error stays as it is in inertial axes: all but what it changes in the momentum's body axes.
        let turn = predicted.conjugate().product(&self.last.attitude).rotation_matrix();
        transition.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
        for share in 0..self.shares.len() {
            let mut shares = self.shares.clone();
            shares[share] += DIFFERENCE;
            let attitude = self.turned(&shares, time_s, measured)?;
            let column = turn_between(predicted, &attitude) / DIFFERENCE;
            transition.fixed_view_mut::<3, 1>(0, 3 + share).copy_from(&column);
        }
        Ok(transition)
    }

    /// The attitude at a time, followed from the last measurement with masses off by `shares`.
    fn turned(
        &self,
        shares: &[f64],
        time_s: f64,
        measured: &Measured<'_>,
    ) -> Result<Quaternion<f64>, ModelError> {
        let model = self.scenario.system().model.with_masses_multiplied(&factors(shares))?;
        let at_start = self.momentum_at_start(&model);
        let seconds = time_s - self.last.time_s;
        let steps = ((seconds / STEP_S).ceil() as usize).clamp(1, MOST_STEPS);
        let step_s = seconds / steps as f64;
        // The attitude, and the time since the last measurement.
        let mut x = [&self.last.attitude.to_array()[..], &[0.0]].concat();
        let mut point = x.clone();
        let mut method = RungeKutta4::new(x.len());
        for _ in 0..steps {
            let next = method.step(step_s, &x, |stage| {
                stage.write_point(&mut point);
                let (attitude, after_s) = (attitude_of(&point), point[4]);
                let (angles, rates) = self.joints_after(after_s, seconds, measured);
                let momentum = at_start + self.gained_at(self.last.time_s + after_s);
                let momentum = attitude.to_body(&momentum);
                let rate = model.reduced_angular_rate(&angles, &rates, &momentum);
                let turning = attitude.rate(&rate).to_array();
                stage.set_rates(&[&turning[..], &[1.0]].concat());
            });
            x.copy_from_slice(next);
        }
        Ok(attitude_of(&x).normalized())
    }

    /// The momentum at the start in inertial axes, N m s.
    fn momentum_at_start(&self, model: &System) -> Vector3<f64> {
        let initial = self.scenario.initial();
        let state: State<f64> = initial.state();
        let State { attitude, angular_rate, joint_angles, joint_rates, .. } = state;
        attitude.to_inertial(&model.angular_momentum(&angular_rate, &joint_angles, &joint_rates))
    }

    /// What the momentum has gained along the plan.
    fn gained_at(&self, time_s: f64) -> Vector3<f64> {
        let after = self.gained.partition_point(|(node_s, _)| *node_s <= time_s);
        match (after.checked_sub(1).map(|before| self.gained[before]), self.gained.get(after)) {
            (Some((from_s, from)), Some((to_s, to))) => {
                from + (to - from) * ((time_s - from_s) / (to_s - from_s))
            }
            (Some((_, last)), None) => last,
            (None, _) => Vector3::zeros(),
        }
    }

    /// Joint angles and rates so long after the last measurement, which is `seconds` before this one.
    fn joints_after(
        &self,
        after_s: f64,
        seconds: f64,
        measured: &Measured<'_>,
    ) -> (Vec<f64>, Vec<f64>) {
        let share = after_s / seconds;
        let joints = 0..self.last.joint_angles_rad.len();
        joints
            .map(|joint| {
                let [from, to] =
                    [self.last.joint_angles_rad[joint], measured.joint_angles_rad[joint]];
                let rates = [self.last.joint_rates_rad_s[joint], measured.joint_rates_rad_s[joint]];
                hermite([from, to], rates.map(|rate| rate * seconds), share)
            })
            .map(|(angle, rate)| (angle, rate / seconds))
            .unzip()
    }
}

/// The factors of shares: of every part its mass, then of every part its inertia.
fn factors(shares: &[f64]) -> Vec<MassFactors> {
    let (masses, inertias) = shares.split_at(shares.len() / 2);
    masses
        .iter()
        .zip(inertias)
        .map(|(mass, inertia)| MassFactors {
            mass: 1.0 + mass,
            inertia: (1.0 + mass) * (1.0 + inertia),
        })
        .collect()
}

/// The cubic over 0…1 of given values and slopes at its ends: its value and slope.
fn hermite([from, to]: [f64; 2], [slope_from, slope_to]: [f64; 2], at: f64) -> (f64, f64) {
    let way = to - from;
    let (second, third) =
        (3.0 * way - 2.0 * slope_from - slope_to, slope_from + slope_to - 2.0 * way);
    let value = from + at * (slope_from + at * (second + at * third));
    (value, slope_from + at * (2.0 * second + at * 3.0 * third))
}

fn attitude_of(x: &[f64]) -> Quaternion<f64> {
    Quaternion::new(x[0], x[1], x[2], x[3])
}

/// The small rotation vector in body axes that leads from one attitude to another; either sign of both.
fn turn_between(from: &Quaternion<f64>, to: &Quaternion<f64>) -> Vector3<f64> {
    let [scalar, x, y, z] = from.conjugate().product(to).to_array();
    // An error of a unit quaternion is half an angle.
    Vector3::new(x, y, z) * (2.0 * scalar.signum())
}

/// The attitude turned by a small rotation vector in body axes.
fn turned_by(attitude: &Quaternion<f64>, turn: &Vector3<f64>) -> Quaternion<f64> {
    let angle = turn.norm();
    if angle == 0.0 {
        return *attitude;
    }
    attitude.product(&Quaternion::from_axis_angle(&(turn / angle), angle)).normalized()
}
