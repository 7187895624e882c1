use std::sync::Arc;

use nalgebra::Vector3;
use righting_multibody::{External, Quaternion, State, System};
use righting_scalar::Scalar;
use righting_scenario::environment::Environment;
use righting_scenario::file::Formulation;
use righting_scenario::initial::Initial;
use righting_scenario::scenario::Scenario;

use super::loads::Moment;
use super::{Cones, Wheels};

/// The states of the optimal control problem.
///
/// ```text
/// full     [r, q_BN, ṙ, ω, q, q̇]     13 + 2j
/// reduced  [q_BN, q, q̇]               4 + 2j;  ω = Ĩ⁻¹ (Cᵀ h₀ − H̃ − Σ h a), r and ṙ from the fixed CM
/// ```
///
/// The control is q̈. Where a joint's jerk is limited, q̈ are j more states and the control is the jerk.
///
/// The momenta of the wheels that work follow, as shares of the most that each stores; their rates, which the torques
/// decide, are controls after those of the joints. Failed wheels keep what they have.
///
/// Where something acts from outside, the reduced form's momentum h, in inertial axes, is three more states:
/// ḣ is the moment from outside.
///
/// Where the duration is free, one more state follows: ζ, the duration as a share of the longest. It does not
/// change along the way, and all rates are multiplied by it: the grid is that of the longest duration. Where the
/// axis of a cone or the nadir moves, the last state is the time t since the start: ṫ = 1.
#[derive(Clone)]
pub(crate) struct Coordinates {
    formulation: Formulation,
    system: Arc<System>,
    /// h₀, the wheels' included, inertial axes, N m s.
    momentum: Vector3<f64>,
    wheel_set: Wheels,
    /// What acts from outside, if anything does.
    environment: Option<Arc<Environment>>,
    /// Where the system's centre of mass rests, inertial axes, m.
    center: Vector3<f64>,
    /// Whether a joint is locked: its control does nothing, and its state stays what it is.
    locked: Arc<[bool]>,
    /// Whether accelerations are states and jerks the controls.
    has_jerk: bool,
    is_duration_free: bool,
    /// Whether time is a state.
    has_time: bool,
}

impl Coordinates {
    pub(crate) fn new(scenario: &Scenario, formulation: Formulation) -> Self {
        let system = Arc::new(scenario.system().model.clone());
        let initial = scenario.initial();
        let attitude = initial.attitude;
        let wheel_set = Wheels::new(scenario);
        let h_body = wheel_set.stored(&wheel_set.at_start())
            + system.angular_momentum(
                &initial.angular_rate_rad_s,
                &initial.joint_angles_rad,
                &initial.joint_rates_rad_s,
            );
        let center = attitude.to_inertial(&system.center_of_mass(&initial.joint_angles_rad));
        let limits = scenario.system().joint_limits.iter();
        let locked = limits.map(righting_scenario::JointLimits::is_locked).collect();
        Self {
            formulation,
            momentum: attitude.to_inertial(&h_body),
            center,
            wheel_set,
            environment: scenario.acting_environment().cloned().map(Arc::new),
            system,
            locked,
            has_jerk: scenario.system().limits_jerk(),
            is_duration_free: scenario.free_duration().is_some(),
            has_time: Cones::has_moving(scenario)
                || scenario.environment().is_some_and(|environment| environment.orbit.is_some()),
        }
    }

    /// Whether a joint is locked.
    pub(crate) fn is_locked(&self, joint: usize) -> bool {
        self.locked[joint]
    }

    fn joints(&self) -> usize {
        self.system.joint_count()
    }

    /// Number of states.
    pub(crate) fn dimension(&self) -> usize {
        self.momentum().end + usize::from(self.is_duration_free) + usize::from(self.has_time)
    }

    fn joints_end(&self) -> usize {
        self.motion_end() + if self.has_jerk { self.joints() } else { 0 }
    }

    /// The angular momentum among the states: empty where it never changes, or follows from the others.
    pub(crate) fn momentum(&self) -> std::ops::Range<usize> {
        let is_state = self.environment.is_some() && self.formulation == Formulation::Reduced;
        let first = self.wheels().end;
        first..first + if is_state { 3 } else { 0 }
    }

    /// The shares of the wheels that work among the states.
    pub(crate) fn wheels(&self) -> std::ops::Range<usize> {
        self.joints_end()..self.joints_end() + self.wheel_set.working().len()
    }

    /// The wheels themselves.
    pub(crate) fn wheel_set(&self) -> &Wheels {
        &self.wheel_set
    }

    /// What all wheels store in a state, body axes.
    pub(crate) fn wheel_momentum<T: Scalar>(&self, x: &[T]) -> Vector3<T> {
        self.wheel_set.stored(&x[self.wheels()])
    }

    /// Index of the rate of the first wheel's share among the controls.
    pub(crate) fn first_wheel(&self) -> usize {
        self.joints()
    }

    /// Number of controls: of the joints, and then of the wheels that work.
    pub(crate) fn control_dimension(&self) -> usize {
        self.joints() + self.wheels().len()
    }

    /// The rates of the shares of the wheels that work among the controls.
    pub(crate) fn wheel_rates<'u, T>(&self, u: &'u [T]) -> &'u [T] {
        &u[self.first_wheel()..]
    }

    /// Where the states of the free-floating system end.
    fn motion_end(&self) -> usize {
        self.first_joint_angle() + 2 * self.joints()
    }

    /// Whether accelerations are states and jerks the controls.
    pub(crate) fn has_jerk(&self) -> bool {
        self.has_jerk
    }

    /// What the controls alone move: joint angles and rates among the states, accelerations where they are, and the
    /// shares of wheels.
    pub(crate) fn driven_states(&self) -> std::ops::Range<usize> {
        self.joint_angle(0)..self.wheels().end
    }

    /// The time of a state since the start of the maneuver; zero where it is none of the states.
    pub(crate) fn time_of<T: Scalar>(&self, x: &[T]) -> T {
        if self.has_time { x[self.dimension() - 1] } else { T::from(0.0) }
    }

    /// Sets the time of a state, where it is one of the states.
    pub(crate) fn set_time(&self, x: &mut [f64], time: f64) {
        if self.has_time {
            x[self.dimension() - 1] = time;
        }
    }

    /// Index of ζ among the states, where the duration is free.
    pub(crate) fn duration(&self) -> Option<usize> {
        self.is_duration_free.then(|| self.momentum().end)
    }

    /// ζ, which is one where the duration is given.
    pub(crate) fn duration_share<T: Scalar>(&self, x: &[T]) -> T {
        self.duration().map_or(T::from(1.0), |index| x[index])
    }

    fn first_joint_angle(&self) -> usize {
        match self.formulation {
            Formulation::Full => 13,
            Formulation::Reduced => 4,
        }
    }

    /// The attitude among the states.
    pub(crate) fn attitude(&self) -> std::ops::Range<usize> {
        match self.formulation {
            Formulation::Full => 3..7,
            Formulation::Reduced => 0..4,
        }
    }

    /// Index of a joint's angle among the states.
    pub(crate) fn joint_angle(&self, joint: usize) -> usize {
        self.first_joint_angle() + joint
    }

    /// Index of a joint's rate among the states.
    pub(crate) fn joint_rate(&self, joint: usize) -> usize {
        self.first_joint_angle() + self.joints() + joint
    }

    /// Index of a joint's acceleration among the states, where accelerations are.
    pub(crate) fn joint_acceleration(&self, joint: usize) -> Option<usize> {
        self.has_jerk.then(|| self.motion_end() + joint)
    }

    /// The accelerations among the states: none where they are no states.
    pub(crate) fn acceleration_states<'x, T>(&self, x: &'x [T]) -> &'x [T] {
        &x[self.motion_end()..self.joints_end()]
    }

    /// Takes what the controls alone move of one state over into another.
    pub(crate) fn copy_driven(&self, from: &[f64], to: &mut [f64]) {
        let driven = self.driven_states();
        to[driven.clone()].copy_from_slice(&from[driven]);
    }

    /// Moves the joints and wheels of a state on by a step with the controls `u`.
    pub(crate) fn move_driven(&self, x: &mut [f64], u: &[f64], step_s: f64) {
        let (accelerations, jerks) = (self.accelerations(x, u), self.jerks(u));
        for (joint, (&u, &jerk)) in accelerations.iter().zip(&jerks).enumerate() {
            let (angle, rate) = (self.joint_angle(joint), self.joint_rate(joint));
            let gained = step_s * (u + 0.5 * step_s * jerk);
            x[angle] += step_s * (x[rate] + 0.5 * step_s * (u + step_s * jerk / 3.0));
            x[rate] += gained;
            if let Some(acceleration) = self.joint_acceleration(joint) {
                x[acceleration] += step_s * jerk;
            }
        }
        let shares = x[self.wheels()].iter_mut().zip(self.wheel_rates(u));
        shares.for_each(|(share, rate)| *share += step_s * rate);
    }

    /// The controls of steps of length `step` that stop a joint, as multiples of its rate: one acceleration, or a
    /// jerk and back.
    pub(crate) fn stop(&self, step: f64) -> Vec<f64> {
        match self.has_jerk {
            true => vec![-step.powi(-2), step.powi(-2)],
            false => vec![-step.recip()],
        }
    }

    /// The joint angles among the states.
    pub(crate) fn joint_angles<'x, T>(&self, x: &'x [T]) -> &'x [T] {
        &x[self.joint_angle(0)..self.joint_rate(0)]
    }

    /// The joint rates among the states.
    pub(crate) fn joint_rates<'x, T>(&self, x: &'x [T]) -> &'x [T] {
        &x[self.joint_rate(0)..self.motion_end()]
    }

    /// The state at the start.
    pub(crate) fn initial(&self, initial: &Initial) -> Vec<f64> {
        let attitude = initial.attitude;
        let state = State {
            position: Vector3::zeros(),
            attitude,
            velocity: self.base_velocity(
                &attitude,
                &initial.angular_rate_rad_s,
                &initial.joint_angles_rad,
                &initial.joint_rates_rad_s,
            ),
            angular_rate: initial.angular_rate_rad_s,
            joint_angles: initial.joint_angles_rad.clone(),
            joint_rates: initial.joint_rates_rad_s.clone(),
        };
        self.of_free_floating_state(&state, 0.0)
    }

    /// The state at a time in these coordinates, of a motion of the longest duration; joint accelerations that
    /// are states are zero, and wheels have what they have at the start.
    pub(crate) fn of_free_floating_state(&self, state: &State<f64>, time: f64) -> Vec<f64> {
        self.of_state_and_wheels(state, &self.wheel_set.at_start(), time)
    }

    /// The same where the wheels that work store these shares of the most that they can.
    pub(crate) fn of_state_and_wheels(
        &self,
        state: &State<f64>,
        shares: &[f64],
        time: f64,
    ) -> Vec<f64> {
        let mut x = match self.formulation {
            Formulation::Full => state.to_vec(),
            Formulation::Reduced => {
                let attitude = state.attitude.to_array();
                [&attitude[..], &state.joint_angles, &state.joint_rates].concat()
            }
        };
        x.resize(self.joints_end(), 0.0);
        x.extend(shares);
        if !self.momentum().is_empty() {
            let of_wheels = state.attitude.to_inertial(&self.wheel_momentum(&x));
            let momentum = self.system.inertial_angular_momentum(state) + of_wheels;
            x.extend(momentum.iter());
        }
        x.extend(self.is_duration_free.then_some(1.0));
        x.extend(self.has_time.then_some(time));
        x
    }

    /// ẋ for the controls `u`, in the time of the grid.
    pub(crate) fn rates<T: Scalar>(&self, x: &[T], u: &[T]) -> Vec<T> {
        let mut rates = self.rates_in_time(x, u);
        if let Some(index) = self.duration() {
            let moving = rates.iter_mut().enumerate().filter(|&(state, _)| state != index);
            moving.for_each(|(_, rate)| *rate *= x[index]);
        }
        rates
    }

    /// ẋ for the controls `u`.
    fn rates_in_time<T: Scalar>(&self, x: &[T], u: &[T]) -> Vec<T> {
        let accelerations = self.accelerations(x, u);
        let attitude = self.attitude_of(x);
        let external = self.surrounding(&attitude, self.time_of(x));
        let mut rates = match self.formulation {
            Formulation::Full => {
                let motion = &x[..self.motion_end()];
                let rate = Vector3::new(x[10], x[11], x[12]);
                let stored = self.wheel_momentum(x);
                let shares = self.wheel_rates(u);
                let external = self.wheel_set.beside(external.clone(), &rate, &stored, shares);
                self.system.state_derivative(motion, &accelerations, external.as_ref())
            }
            Formulation::Reduced => {
                let turning = attitude.rate(&self.reduced_angular_rate(&attitude, x)).to_array();
                [&turning[..], self.joint_rates(x), &accelerations].concat()
            }
        };
        if self.has_jerk {
            rates.extend(self.jerks(u));
        }
        rates.extend(self.wheel_rates(u));
        if let (false, Some(external)) = (self.momentum().is_empty(), external) {
            let moment = self.system.external_moment(&external, self.joint_angles(x));
            rates.extend(attitude.to_inertial(&moment).iter());
        }
        if self.is_duration_free {
            rates.push(T::from(0.0));
        }
        if self.has_time {
            rates.push(T::from(1.0));
        }
        rates
    }

    /// The attitude of a state.
    pub(crate) fn attitude_of<T: Scalar>(&self, x: &[T]) -> Quaternion<T> {
        let first = self.attitude().start;
        Quaternion::from_array(std::array::from_fn(|i| x[first + i]))
    }

    /// The state a time `after_s` later under the controls `u`: one step of the classical Runge–Kutta method.
    pub(crate) fn moved_on<T: Scalar>(&self, x: &[T], u: &[T], after_s: T) -> Vec<T> {
        let from = |rates: &[T], share: f64| -> Vec<T> {
            x.iter().zip(rates).map(|(&x, &rate)| x + after_s * share * rate).collect()
        };
        let first = self.rates_in_time(x, u);
        let second = self.rates_in_time(&from(&first, 0.5), u);
        let third = self.rates_in_time(&from(&second, 0.5), u);
        let fourth = self.rates_in_time(&from(&third, 1.0), u);
        let middle = second.iter().zip(&third).map(|(&second, &third)| (second + third) * 2.0);
        let ends = first.iter().zip(&fourth).map(|(&first, &fourth)| first + fourth);
        let sums: Vec<T> = middle.zip(ends).map(|(middle, ends)| middle + ends).collect();
        from(&sums, 1.0 / 6.0)
    }

    /// Everything that moves, at state `x`.
    pub(crate) fn free_floating_state<T: Scalar>(&self, x: &[T]) -> State<T> {
        match self.formulation {
            Formulation::Full => {
                State::from_slice(&x[..self.motion_end()]).expect("the full form's states")
            }
            Formulation::Reduced => {
                let (q, qdot) = (self.joint_angles(x), self.joint_rates(x));
                let attitude = self.attitude_of(x);
                let angular_rate = self.reduced_angular_rate(&attitude, x);
                State {
                    position: self.system.base_position(&attitude, q, &self.center.map(T::from)),
                    velocity: self.base_velocity(&attitude, &angular_rate, q, qdot),
                    attitude,
                    angular_rate,
                    joint_angles: q.to_vec(),
                    joint_rates: qdot.to_vec(),
                }
            }
        }
    }

    /// The joints' angles at a time `s` after the beginning of a step from state `x` with the controls `u`.
    pub(crate) fn joint_angles_within<T: Scalar>(&self, x: &[T], u: &[T], s: T) -> Vec<T> {
        let (accelerations, jerks) = (self.accelerations(x, u), self.jerks(u));
        let joints = self.joint_angles(x).iter().zip(self.joint_rates(x));
        let joints = joints.zip(accelerations.iter().zip(&jerks));
        joints
            .map(|((&angle, &rate), (&u, &jerk))| {
                angle + s * (rate + s * 0.5 * (u + s * jerk * (1.0 / 3.0)))
            })
            .collect()
    }

    /// Their rates.
    pub(crate) fn joint_rates_within<T: Scalar>(&self, x: &[T], u: &[T], s: T) -> Vec<T> {
        let (accelerations, jerks) = (self.accelerations(x, u), self.jerks(u));
        let joints = self.joint_rates(x).iter().zip(accelerations.iter().zip(&jerks));
        joints.map(|(&rate, (&u, &jerk))| rate + s * (u + s * 0.5 * jerk)).collect()
    }

    /// The motion at a time `s` after the beginning of a step from state `x` with the controls `u`.
    pub(crate) fn within<T: Scalar>(&self, x: &[T], u: &[T], s: T) -> Moment<T> {
        let joint_angles = self.joint_angles_within(x, u, s);
        let joint_rates = self.joint_rates_within(x, u, s);
        let mut external = None;
        let stored = self.stored_within(x, u, s);
        let h_body = match self.environment.is_none() && self.momentum == Vector3::zeros() {
            true => stored.map(|entry| -entry),
            false => {
                let attitude = self.attitude_of(x);
                let rate = match self.formulation {
                    Formulation::Full => Vector3::new(x[10], x[11], x[12]),
                    Formulation::Reduced => self.reduced_angular_rate(&attitude, x),
                };
                let (here, turning) = (attitude.to_array(), attitude.rate(&rate).to_array());
                let there =
                    Quaternion::from_array(std::array::from_fn(|i| here[i] + s * turning[i]));
                let length = there.norm_squared().recip();
                let mut momentum = self.momentum_of(x, &rate);
                if let Some(here) = self.surrounding(&attitude, self.time_of(x)) {
                    let moment = self.system.external_moment(&here, self.joint_angles(x));
                    momentum += attitude.to_inertial(&moment).map(|entry| entry * s);
                    let unit = length.sqrt();
                    let there = there.to_array().map(|entry| entry * unit);
                    external =
                        self.surrounding(&Quaternion::from_array(there), self.time_of(x) + s);
                }
                let of_all = there.to_body(&momentum);
                Vector3::from_fn(|i, _| of_all[i] * length - stored[i])
            }
        };
        let angular_rate = self.system.reduced_angular_rate(&joint_angles, &joint_rates, &h_body);
        let shares = self.wheel_rates(u);
        let external = self.wheel_set.beside(external, &angular_rate, &stored, shares);
        let begins = self.accelerations(x, u).into_iter().zip(self.jerks(u));
        let joint_accelerations = begins.map(|(begins, jerk)| begins + s * jerk).collect();
        Moment { angular_rate, joint_angles, joint_rates, joint_accelerations, external }
    }

    /// The joint accelerations where a step from state `x` with the controls `u` begins: a locked joint has
    /// none.
    pub(crate) fn accelerations<T: Scalar>(&self, x: &[T], u: &[T]) -> Vec<T> {
        match self.has_jerk {
            true => self.of_moving(self.acceleration_states(x)),
            false => self.of_moving(u),
        }
    }

    /// The joint jerks in a step with the controls `u`, zero where accelerations are held.
    pub(crate) fn jerks<T: Scalar>(&self, u: &[T]) -> Vec<T> {
        match self.has_jerk {
            true => self.of_moving(u),
            false => vec![T::from(0.0); self.joints()],
        }
    }

    /// The same values with zero for locked joints.
    fn of_moving<T: Scalar>(&self, values: &[T]) -> Vec<T> {
        let moving = values.iter().zip(self.locked.iter());
        moving.map(|(&value, &is_locked)| if is_locked { T::from(0.0) } else { value }).collect()
    }

    fn reduced_angular_rate<T: Scalar>(&self, attitude: &Quaternion<T>, x: &[T]) -> Vector3<T> {
        let momentum = match self.momentum() {
            states if states.is_empty() => self.momentum.map(T::from),
            states => Vector3::from_column_slice(&x[states]),
        };
        let of_all = attitude.to_body(&momentum);
        let stored = self.wheel_momentum(x);
        let h_body = Vector3::from_fn(|i, _| of_all[i] - stored[i]);
        self.system.reduced_angular_rate(self.joint_angles(x), self.joint_rates(x), &h_body)
    }

    /// The angular momentum of a state whose base turns at `rate`, inertial axes.
    fn momentum_of<T: Scalar>(&self, x: &[T], rate: &Vector3<T>) -> Vector3<T> {
        match self.momentum() {
            states if !states.is_empty() => Vector3::from_column_slice(&x[states]),
            _ if self.environment.is_none() => self.momentum.map(T::from),
            _ => {
                let (angles, rates) = (self.joint_angles(x), self.joint_rates(x));
                let momentum = self.system.angular_momentum(rate, angles, rates);
                self.attitude_of(x).to_inertial(&(momentum + self.wheel_momentum(x)))
            }
        }
    }

    /// What all wheels store at a time `s` after the beginning of a step from state `x` with the controls `u`.
    fn stored_within<T: Scalar>(&self, x: &[T], u: &[T], s: T) -> Vector3<T> {
        let shares = x[self.wheels()].iter().zip(self.wheel_rates(u));
        let shares: Vec<T> = shares.map(|(&share, &rate)| share + s * rate).collect();
        self.wheel_set.stored(&shares)
    }

    /// What acts from outside in an attitude at a time.
    fn surrounding<T: Scalar>(&self, attitude: &Quaternion<T>, time: T) -> Option<External<T>> {
        self.environment.as_ref().map(|environment| environment.external(attitude, time))
    }

    fn base_velocity<T: Scalar>(
        &self,
        attitude: &Quaternion<T>,
        angular_rate: &Vector3<T>,
        q: &[T],
        qdot: &[T],
    ) -> Vector3<T> {
        let rest = Vector3::from_element(T::from(0.0));
        self.system.base_velocity(attitude, angular_rate, q, qdot, &rest)
    }
}
