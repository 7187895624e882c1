//! Figures of a plan, drawn again.

use crate::program::{files_in, folder_with, righting, small_detumble, small_slew, solve};

// No link of the small arm has a clearance to keep.
const FIGURES: [&str; 6] =
    ["attitude.svg", "convergence.svg", "joints.svg", "momentum.svg", "power.svg", "sparsity.svg"];

#[test]
fn every_figure_of_a_plan_is_drawn_with_units() {
    for scenario in [small_slew(), small_detumble()] {
        let folder = folder_with(&scenario);
        assert_eq!(solve(folder.path()).code, 0);
        let run = righting(folder.path(), &["figures", "out", "--out", "drawn"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        let drawn = folder.path().join("drawn");
        assert_eq!(files_in(&drawn), FIGURES);
        assert_eq!(run.stdout.lines().count(), FIGURES.len());
        let read = |name: &str| std::fs::read_to_string(drawn.join(name)).expect("written");
        for (name, label) in [
            ("attitude.svg", "Rate [deg/s]"),
            ("convergence.svg", "Iteration of the last solve"),
            ("joints.svg", "Joint 2 acceleration [deg/s²]"),
            ("momentum.svg", "Drift [N m s]"),
            ("power.svg", "Torque [N m]"),
            ("sparsity.svg", "KKT matrix of 4 of 40 intervals"),
        ] {
            assert!(read(name).contains(label), "{name}");
        }
        // Those that the solve drew are the same.
        for name in &FIGURES[..5] {
            let first = std::fs::read_to_string(folder.path().join("out").join(name));
            let same = first.expect("drawn by the solve") == read(name);
            assert!(same, "{name}");
        }
    }
}

#[test]
fn a_solve_draws_as_much_as_is_asked() {
    let folder = folder_with(&small_slew());
    let solve = |set: &str| {
        let run =
            righting(folder.path(), &["solve", "scenario.json", "--out", "out", "--figures", set]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        let files = files_in(&folder.path().join("out"));
        files.into_iter().filter(|name| name.ends_with(".svg")).count()
    };
    assert_eq!(["all", "none", "usual"].map(solve), [6, 0, 5]);
}

#[test]
fn what_is_no_plan_has_no_figures() {
    let folder = folder_with(&small_slew());
    righting(folder.path(), &["figures", "out"]).assert_refused("no such file");
    righting(folder.path(), &["figures"]).assert_refused("scenarios/paper");
}
