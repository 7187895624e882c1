//! The spacecraft that is flown.

use righting_scenario::file;
use righting_verifier::DormandPrince;
use righting_verifier::model::{BaseAcceleration, Model, Motion, State};

/// A spacecraft in motion: the verifier's model, integrated with error control.
pub struct Plant {
    model: Model,
    motion: Motion,
    integrator: DormandPrince,
    x: Vec<f64>,
}

impl Plant {
    /// A system whose base and joints start as in `state`, but with its own center of mass at rest.
    ///
    /// # Panics
    /// The state is of another number of joints.
    pub fn new(system: &file::System, state: &State<'_>) -> Self {
        let model = Model::new(system);
        let mut motion = Motion::new(&model);
        let still = vec![0.0; model.joint_count()];
        motion.set(&model, state, &BaseAcceleration::default(), &still);
        let drift = motion.linear_momentum() / model.total_mass();
        let x = State { velocity: state.velocity - drift, ..*state }.to_vec();
        let integrator = DormandPrince::new(x.len());
        Self { model, motion, integrator, x }
    }

    /// How it moves.
    pub fn state(&self) -> State<'_> {
        State::from_slice(&self.x)
    }

    /// Moves on by `duration_s` while the joints accelerate by `accelerations` (j, rad/s²). The state is NaN
    /// from where it cannot be followed.
    ///
    /// # Panics
    /// There is not one acceleration a joint.
    pub fn advance(&mut self, accelerations: &[f64], duration_s: f64) {
        let Self { model, motion, integrator, x } = self;
        let followed = integrator.advance(x, duration_s, |_, x, rate| {
            model.state_derivative(x, accelerations, motion, rate);
        });
        if !followed {
            x.fill(f64::NAN);
        }
    }
}
