//! Plans keep their limits between the nodes of coarse grids too.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::{self, Horizon, SystemReference};
use righting_test_support::thin_links::thin_link;
use righting_test_support::{shipped, varied};

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

/// Whether a note says that limits had to be stated within the steps.
fn is_mended(planned: &Planned) -> bool {
    planned.solution.notes.iter().any(|note| note.contains("are stated within the steps too"))
}

#[track_caller]
fn assert_kept(planned: &Planned, name: &str) {
    assert!(planned.solution.status.is_acceptable(), "{:?}", planned.solution.status);
    let checks = planned.solution.verification.checks.iter();
    for check in checks.filter(|check| check.name.starts_with(name)) {
        assert!(check.passed, "{check}: {:?}", planned.solution.notes);
    }
}

/// Joints that may turn little and accelerate fast, on long steps.
fn narrow(name: &str, steps: f64, span_deg: f64) -> Scenario {
    varied(&shipped(name), |file| {
        let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
        for (link, start_deg) in system.links.iter_mut().zip(&file.initial.joint_angles_deg) {
            link.angle_max_deg = Some(start_deg + span_deg);
            link.angle_min_deg = Some(start_deg - span_deg);
            link.acceleration_max_deg_s2 *= 3.0;
        }
        file.horizon.steps = steps;
        file.maneuver.angle_deg = file.maneuver.angle_deg.map(|_| 15.0);
    })
}

#[test]
fn no_joint_angle_is_passed_between_nodes() {
    let mut mended = 0;
    for name in ["slew_4dof", "slew_2dof", "detumble_4dof"] {
        for (steps, span_deg) in [(24.0, 25.0), (40.0, 20.0), (61.0, 15.0)] {
            let planned = plan(&narrow(name, steps, span_deg));
            assert_kept(&planned, "joint angle");
            mended += usize::from(is_mended(&planned));
        }
    }
    assert!(mended >= 5, "{mended} of 9");
}

#[test]
fn the_paper_s_guess_keeps_the_paper_s_problem() {
    let scenario = varied(&narrow("detumble_4dof", 24.0, 25.0), |file| {
        file.solver.guess = Some(file::Guess::Named(file::NamedGuess::Constant));
    });
    assert!(!is_mended(&plan(&scenario)));
}

/// A small base with four thin links.
struct ThinLinks {
    lengths_m: [f64; 4],
    twists_deg: [f64; 4],
    joint_angles_deg: [f64; 4],
    axis: [f64; 3],
    angle_deg: f64,
    horizon: Horizon,
}

impl ThinLinks {
    fn scenario(&self) -> Scenario {
        varied(&shipped("slew_4dof"), |file| {
            let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
            let links = self.lengths_m.iter().zip(&self.twists_deg);
            system.links = links
                .map(|(&a_m, &alpha_deg)| thin_link(4.0 * a_m, a_m, alpha_deg, [60.0, 40.0]))
                .collect();
            system.base = file::Base {
                name: None,
                center_of_mass_m: None,
                mass_kg: 60.0,
                cube_side_m: None,
                inertia_kg_m2: Some([[4.0, 0.0, 0.0], [0.0, 5.0, 0.0], [0.0, 0.0, 6.0]]),
                keep_out_radius_m: Some(0.2),
                angular_rate_max_deg_s: None,
                keep_out: None,
            };
            file.initial.joint_angles_deg = self.joint_angles_deg.to_vec();
            file.maneuver.axis = Some(self.axis);
            file.maneuver.angle_deg = Some(self.angle_deg);
            file.horizon = self.horizon.clone();
            file.weights.control = Some(1e-4);
            file.collision.clearance_m = Some(0.01);
        })
    }
}

/// On the nodes alone the cheapest way leads the links through each other.
#[test]
fn no_link_passes_through_another_between_nodes() {
    let maneuvers = [
        ThinLinks {
            lengths_m: [0.67, 0.516, 1.065, 0.61],
            twists_deg: [0.0, -90.0, 0.0, 0.0],
            joint_angles_deg: [45.0, 110.0, -56.0, -104.0],
            axis: [0.387, -0.122, -0.04],
            angle_deg: 55.0,
            horizon: Horizon { duration_s: file::Duration::Given(15.4), steps: 44.0 },
        },
        ThinLinks {
            lengths_m: [0.442, 0.613, 0.687, 0.903],
            twists_deg: [-90.0, -90.0, 0.0, 45.0],
            joint_angles_deg: [-119.5, 13.0, -110.0, 16.6],
            axis: [0.266, -0.436, -0.145],
            angle_deg: 47.0,
            horizon: Horizon { duration_s: file::Duration::Given(18.0), steps: 76.0 },
        },
        ThinLinks {
            lengths_m: [1.14, 0.91, 0.65, 0.434],
            twists_deg: [0.0, 0.0, 90.0, 0.0],
            joint_angles_deg: [-54.1, 73.0, 7.0, 5.7],
            axis: [0.208, -0.213, -0.429],
            angle_deg: 23.9,
            horizon: Horizon { duration_s: file::Duration::Given(26.4), steps: 26.0 },
        },
        ThinLinks {
            lengths_m: [0.949, 1.051, 1.335, 0.417],
            twists_deg: [90.0, 45.0, 90.0, -90.0],
            joint_angles_deg: [-67.5, 9.7, -117.0, -36.5],
            axis: [0.379, -0.386, 0.366],
            angle_deg: 59.7,
            horizon: Horizon { duration_s: file::Duration::Given(27.0), steps: 21.0 },
        },
        ThinLinks {
            lengths_m: [0.795, 1.096, 0.591, 0.684],
            twists_deg: [-90.0, 0.0, 45.0, 45.0],
            joint_angles_deg: [64.8, 89.2, -110.6, 88.1],
            axis: [0.478, 0.371, -0.047],
            angle_deg: 51.1,
            horizon: Horizon { duration_s: file::Duration::Given(21.9), steps: 24.0 },
        },
    ];
    let mut mended = 0;
    for maneuver in maneuvers {
        let planned = plan(&maneuver.scenario());
        assert_kept(&planned, "clearance between links between nodes");
        assert!(planned.solution.terminal.attitude_error < 1e-3);
        mended += usize::from(is_mended(&planned));
    }
    assert!(mended >= 1, "none of five needed it");
}
