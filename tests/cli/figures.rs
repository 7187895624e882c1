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
        let drawn = folder.path().join("drawn");
        std::fs::create_dir(&drawn).expect("a new folder");
        for of_another_plan in ["clearances.svg", "clearances.png"] {
            std::fs::write(drawn.join(of_another_plan), "").expect("written");
        }
        let run = righting(folder.path(), &["figures", "out", "--out", "drawn"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
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
fn where_instruments_look_is_drawn_with_the_half_angle() {
    let mut scenario = small_slew();
    scenario["pointing"] = serde_json::json!([{
        "name": "tracker", "boresight_body": [0, 0, 1], "direction_inertial": [0, 1, 1], "keep_out_deg": 30
    }]);
    let folder = folder_with(&scenario);
    let run = solve(folder.path());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let figure = std::fs::read_to_string(folder.path().join("out/pointing.svg")).expect("drawn");
    for text in ["tracker: at least 30° off", "Angle [deg]"] {
        assert!(figure.contains(text), "{text}");
    }
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).expect("a page");
    assert!(page.contains("\"half_angle_rad\":0.52359"));
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

/// Width and height of an SVG, and of a PNG by its header.
#[cfg(feature = "png")]
fn sizes(svg: &std::path::Path) -> [[u32; 2]; 2] {
    let text = std::fs::read_to_string(svg).expect("an SVG");
    let side = |name: &str| {
        let (_, rest) = text.split_once(&format!(" {name}=\"")).expect("an SVG has a size");
        rest.split('"').next().and_then(|value| value.parse().ok()).expect("a number of pixels")
    };
    let png = std::fs::read(svg.with_extension("png")).expect("a PNG beside it");
    assert_eq!(png[..16], *b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR");
    let word = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
    [[side("width"), side("height")], [word(16), word(20)]]
}

#[cfg(feature = "png")]
#[test]
fn every_figure_has_its_png_where_asked() {
    let folder = folder_with(&small_slew());
    let arguments = ["solve", "scenario.json", "--out", "out", "--png", "--json"];
    let run = righting(folder.path(), &arguments);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let out = folder.path().join("out");
    for name in &FIGURES[..5] {
        let [[width, height], png] = sizes(&out.join(name));
        assert_eq!(png, [2 * width, 2 * height], "{name}");
    }
    assert_eq!(run.json()["files"]["figures"].as_array().map(Vec::len), Some(10));
    for (arguments, figure) in [
        (&["figures", "out", "--out", "drawn", "--png"][..], "sparsity.svg"),
        (&["power", "out", "--out", "costs", "--png"], "power.svg"),
        (&["explain", "scenario.json", "--out", "told", "--png"], "explain.svg"),
        (
            &["envelope", "scenario.json", "--samples", "20", "--out", "seen", "--png"],
            "envelope.svg",
        ),
    ] {
        let run = righting(folder.path(), arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        let out = arguments.iter().skip_while(|argument| **argument != "--out").nth(1);
        let [[width, height], png] = sizes(&folder.path().join(out.expect("given")).join(figure));
        assert_eq!(png, [2 * width, 2 * height], "{figure}");
    }

    // Those of an earlier plan do not outlive it.
    assert_eq!(solve(folder.path()).code, 0);
    assert!(files_in(&out).iter().all(|name| !name.ends_with(".png")));
}

#[cfg(not(feature = "png"))]
#[test]
fn a_build_without_png_says_how_to_get_one() {
    let folder = folder_with(&small_slew());
    let run = righting(folder.path(), &["solve", "scenario.json", "--out", "out", "--png"]);
    run.assert_refused("this build draws no PNG");
    assert!(run.stderr.contains("--features png"), "{}", run.stderr);
    assert!(!folder.path().join("out").exists());
}

#[test]
fn what_is_no_plan_has_no_figures() {
    let folder = folder_with(&small_slew());
    righting(folder.path(), &["figures", "out"]).assert_refused("no such file");
    righting(folder.path(), &["figures"]).assert_refused("scenarios/paper");
}
