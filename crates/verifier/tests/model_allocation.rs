//! Once it has its room, the verifier's model allocates nothing.

#[path = "../../symbolic/tests/counting/mod.rs"]
mod counting;

use std::path::Path;

use righting_scenario::Scenario;
use righting_verifier::model::{Model, Motion, Outside, Pose, State};

use counting::allocations;

#[test]
fn motion_and_torques_allocate_nothing() {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/detumble_canadarm2.json");
    let scenario = Scenario::read(&file).unwrap();
    let model = Model::new(scenario.resolved_system());
    let x = scenario.initial().state().to_vec();
    let u = vec![0.1; 7];
    let mut motion = Motion::new(&model);
    let (mut rate, mut torques) = (vec![0.0; x.len()], vec![0.0; 7]);
    let mut frames = vec![Pose::identity(); 8];
    let before = allocations();
    model.state_derivative(&x, &u, &Outside::default(), &mut motion, &mut rate);
    model.joint_torques(&State::from_slice(&x), &u, &Outside::default(), &mut motion, &mut torques);
    model.frames(&x[13..20], &mut frames);
    assert!(motion.angular_momentum().norm() > 0.0);
    assert_eq!(allocations(), before);
    assert!(before > 0);
}
