//! One scenario, one plan: to the byte, on any number of threads.

use std::num::NonZeroUsize;

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::JointKind;
use righting_test_support::{shipped, solves, varied};

fn small(name: &str) -> Scenario {
    varied(&shipped(name), |file| file.horizon.steps = 120.0)
}

fn csv(plan: &Planned) -> Vec<u8> {
    let mut bytes = Vec::new();
    let turning = vec![JointKind::Revolute; plan.trajectory.joints()];
    plan.trajectory.print_csv(&turning, &mut bytes).unwrap();
    bytes
}

#[test]
fn two_plans_of_one_scenario_are_the_same_bytes() {
    for name in ["slew_2dof", "detumble_2dof", "slew_4dof_full"] {
        let scenario = small(name);
        let [first, second] =
            [(); 2].map(|()| Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap());
        assert!(first.solution.status.is_acceptable(), "{name}");
        assert_eq!(first.solution.history, second.solution.history, "{name}");
        assert_eq!(solves(&first.solution.attempts), solves(&second.solution.attempts), "{name}");
        assert!(csv(&first) == csv(&second), "{name}");
    }
}

#[test]
fn the_number_of_threads_does_not_show() {
    for name in ["slew_2dof", "slew_4dof", "detumble_4dof"] {
        let scenario = small(name);
        let [one, two, many] = [1, 2, 7].map(|threads| {
            let threads = NonZeroUsize::new(threads).unwrap();
            Planner::new().threads(threads).plan(&scenario, &mut |_| Control::Continue).unwrap()
        });
        assert!(one.solution.attempts.len() > 3, "several starts were compared");
        for other in [two, many] {
            assert_eq!(solves(&one.solution.attempts), solves(&other.solution.attempts), "{name}");
            assert!(csv(&one) == csv(&other), "{name}");
        }
    }
}
