//! The spacecraft that is flown.

use righting_scenario::file;
use righting_verifier::DormandPrince;
use righting_verifier::model::{BaseAcceleration, Model, Motion, State, Surroundings};

/// A spacecraft in motion: the verifier's model, integrated with error control.
pub struct Plant {
    model: Model,
    motion: Motion,
    surroundings: Surroundings,
    integrator: DormandPrince,
    x: Vec<f64>,
    time_s: f64,
}

impl Plant {
    /// A system whose base and joints start as in `state`, but with its own center of mass at rest; `environment` acts
    /// from outside.
    ///
    /// # Panics
    /// The state is of another number of joints.
    pub fn new(
        system: &file::System,
        environment: Option<&file::Environment>,
        state: &State<'_>,
    ) -> Self {
        let model = Model::new(system);
        let mut motion = Motion::new(&model);
        let still = vec![0.0; model.joint_count()];
        motion.set(&model, state, &BaseAcceleration::default(), &still);
        let drift = motion.linear_momentum() / model.total_mass();
        let x = State { velocity: state.velocity - drift, ..*state }.to_vec();
        let integrator = DormandPrince::new(x.len());
        let surroundings = Surroundings::new(environment);
        Self { model, surroundings, motion, integrator, x, time_s: 0.0 }
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
        let Self { model, surroundings, motion, integrator, x, time_s } = self;
        let followed = integrator.advance(x, duration_s, |after_s, x, rate| {
            let attitude = State::from_slice(x).attitude;
            let outside = surroundings.at(&attitude, *time_s + after_s);
            model.state_derivative(x, accelerations, &outside, motion, rate);
        });
        if !followed {
            x.fill(f64::NAN);
        }
        *time_s += duration_s;
    }
}
