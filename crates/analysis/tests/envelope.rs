//! Envelopes against the paper, against closed forms by hand, and against brute force.

use std::path::Path;

use nalgebra::Vector3;
use righting_analysis::envelope::sampled_maxima;
use righting_analysis::envelopes;
use righting_scenario::system_or_scenario::read_system_or_scenario;
use righting_scenario::{SystemDescription, WheelArray};

fn system(name: &str) -> SystemDescription {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/systems");
    SystemDescription::read(&folder.join(name)).expect("a shipped system")
}

fn parsed(links: serde_json::Value, mass_kg: f64) -> SystemDescription {
    let value = serde_json::json!({
        "name": "by_hand",
        "base": {"mass_kg": mass_kg, "cube_side_m": 0.5},
        "mount": {"position_m": [0.0, 0.0, 0.25]},
        "links": links
    });
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("system.json");
    std::fs::write(&file, value.to_string()).expect("writable");
    read_system_or_scenario(&file).expect("a system")
}

fn link(mass_kg: f64, a_m: f64, range_deg: Option<f64>) -> serde_json::Value {
    serde_json::json!({
        "mass_kg": mass_kg, "a_m": a_m, "alpha_deg": 0.0, "d_m": 0.0, "theta_deg": 0.0,
        "angle_min_deg": range_deg.map(|r| -r), "angle_max_deg": range_deg,
        "rate_max_deg_s": 30.0, "acceleration_max_deg_s2": 20.0, "body_exempt": true
    })
}

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found} is not {expected}");
}

#[test]
fn samples_of_the_paper_s_arm_average_to_its_figures() {
    let arm = system("xlink_4dof.json");
    let maxima: Vec<[f64; 2]> = (1..=10).map(|seed| sampled_maxima(&arm, 2000, seed)).collect();
    let mean = |i: usize| maxima.iter().map(|pair| pair[i]).sum::<f64>() / 10.0;
    close(mean(0), 2.71, 0.04);
    close(mean(1), 2.21, 0.07);
}

/// Two links one after the other, and a second joint that is locked: one link of twice the length.
#[test]
fn a_locked_joint_adds_nothing() {
    let links = |second: serde_json::Value| {
        parsed(serde_json::json!([link(5.0, 0.5, None), second]), 300.0)
    };
    let locked = links(link(5.0, 0.5, Some(0.0)));
    assert!(locked.joint_limits[1].is_locked());
    let one = parsed(serde_json::json!([link(10.0, 1.0, None)]), 300.0);
    let [found, expected] =
        [&locked, &one].map(|system| envelopes(system, 100, 1, &WheelArray::pyramid()));
    close(found.momentum.true_max, expected.momentum.true_max, 1e-9);
    close(found.torque.true_max, expected.torque.true_max, 1e-9);
    close(sampled_maxima(&locked, 2000, 1)[0], expected.momentum.true_max, 0.01);
}

#[test]
fn the_true_envelope_of_the_paper_s_arm() {
    let arm = system("xlink_4dof.json");
    let wheels = WheelArray::pyramid();
    let found = envelopes(&arm, 2000, 1, &wheels);
    close(found.momentum.true_max, 3.09, 0.005);
    assert!(found.torque.true_max >= 3.43, "{}", found.torque.true_max);
    let array = righting_analysis::Zonotope::torques(wheels.wheels());
    for (envelope, least_flatness) in [(&found.momentum, 0.9), (&found.torque, 0.9)] {
        let [x, y, z] = envelope.per_axis_max;
        assert!(z < least_flatness * x.min(y), "{x} {y} {z}");
        assert!(envelope.sampled_max < envelope.true_max);
        assert!(envelope.hull_volume < envelope.true_volume);
        let bound = envelope.true_volume_bound.expect("the origin is inside");
        assert!(envelope.true_volume < bound && bound < 1.06 * envelope.true_volume);
    }
    // The arm out-torques the wheels along every direction between x and y.
    for degree in 0..360 {
        let (sin, cos) = f64::from(degree).to_radians().sin_cos();
        let direction = Vector3::new(cos, sin, 0.0);
        let reached = found.torque.extreme_points.iter().map(|point| point.dot(&direction));
        let reached = reached.fold(0.0, f64::max);
        assert!(reached > 10.0 * array.extent(&direction), "{degree}°: {reached}");
    }
}

#[test]
fn nothing_sampled_lies_beyond_the_support() {
    for name in ["single_link_2dof.json", "xlink_4dof.json", "canadarm2.json"] {
        let found = envelopes(&system(name), 20_000, 7, &WheelArray::pyramid());
        for envelope in [&found.momentum, &found.torque] {
            let samples = &envelope.sampled_hull.vertices;
            for (i, axis) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().enumerate() {
                let reached = samples.iter().map(|v| v.dot(axis).abs()).fold(0.0, f64::max);
                assert!(reached <= envelope.per_axis_max[i] * (1.0 + 1e-9), "{name}");
            }
            assert!(envelope.sampled_max <= envelope.true_max);
            assert!(envelope.hull_volume <= envelope.true_volume);
        }
    }
}

/// A rod of mass m and length l that turns in a plane about a point r from the base's center, base
/// of mass M: H̃ = (m l²/3 − m² l²/(4 (m + M))) q̇ + the part of the arm r that depends on q.
#[test]
fn one_joint_by_hand() {
    let (m, l, mass) = (10.0, 2.0, 300.0);
    let arm = parsed(serde_json::json!([link(m, l, None)]), mass);
    let found = envelopes(&arm, 100, 1, &WheelArray::pyramid());
    let (rate, acceleration) = (30.0_f64.to_radians(), 20.0_f64.to_radians());
    // The joint's axis is z through the base's center, the rod in the plane z = 0.25 m; about the
    // system's center of mass m M / (m + M) of the rod's centre counts.
    let reduced = m * mass / (m + mass);
    let along_z = m * l * l / 12.0 + reduced * (l / 2.0).powi(2);
    // r' is horizontal and 0.25 m above the base: momentum across z, along the rod.
    let across = reduced * 0.25 * (l / 2.0);
    let b = along_z.hypot(across);
    close(found.momentum.true_max, b * rate, 1e-9);
    close(found.momentum.per_axis_max[2], along_z * rate, 1e-9);
    close(found.momentum.per_axis_max[0], across * rate, 1e-9);
    close(found.momentum.per_axis_max[1], across * rate, 1e-9);
    // Ḃ q̇ is the horizontal part turning with q̇: across q̇², perpendicular to B.
    let turning = across * rate * rate;
    close(found.torque.true_max, (b * acceleration).hypot(turning), 1e-6);
    close(found.torque.per_axis_max[2], along_z * acceleration, 1e-9);
    close(found.torque.per_axis_max[0], (across * acceleration).hypot(turning), 1e-6);
}

/// Two rods in a plane through the base's center: H is largest with the arm straight and both joints
/// at their limits the same way; the base is too heavy to give way.
#[test]
fn two_joints_by_hand() {
    let (m, l) = (6.0, 0.8);
    let arm = parsed(serde_json::json!([link(m, l, None), link(m, l, Some(90.0))]), 1e9);
    let found = envelopes(&arm, 100, 1, &WheelArray::pyramid());
    let rate = 30.0_f64.to_radians();
    let first = m * l * l * (1.0 / 3.0 + 1.0 / 12.0 + 2.25);
    let second = m * l * l * (1.0 / 12.0 + 0.75);
    close(found.momentum.per_axis_max[2], (first + second) * rate, 1e-6);
    let acceleration = 20.0_f64.to_radians();
    // About z the torque adds −m l² sin(q₂) (q̇₁ q̇₂ + q̇₂²/2), by Lagrange: looked for by force.
    let most = (-900..=900)
        .flat_map(|tenth| (-20..=20).map(move |v| (f64::from(tenth) / 10.0, f64::from(v) / 20.0)))
        .map(|(degrees, v)| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let inertia = m * l * l;
            let linear =
                inertia * (1.0 / 3.0 + 1.0 / 3.0 + 1.0 + cos) + inertia * (1.0 / 3.0 + 0.5 * cos);
            let (q1, q2) = (rate, v * rate);
            linear * acceleration - inertia * sin * (q1 * q2 + 0.5 * q2 * q2)
        })
        .fold(0.0, f64::max);
    close(found.torque.per_axis_max[2], most, 1e-3);
}

#[test]
fn the_same_seed_gives_the_same_result_and_another_another() {
    let arm = system("xlink_4dof.json");
    assert_eq!(sampled_maxima(&arm, 500, 3), sampled_maxima(&arm, 500, 3));
    assert_ne!(sampled_maxima(&arm, 500, 3), sampled_maxima(&arm, 500, 4));
}

#[test]
fn an_arm_of_the_size_found_matches_the_wheels() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/systems");
    let text = std::fs::read_to_string(folder.join("xlink_4dof.json")).expect("readable");
    let mut file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let wheels = WheelArray::pyramid();
    let as_is = envelopes(&system("xlink_4dof.json"), 10, 1, &wheels);
    let factor = as_is.momentum.sizing.arm_length_factor.expect("some length does");
    for link in file["links"].as_array_mut().expect("links") {
        for length in ["a_m", "d_m"] {
            link[length] = (link[length].as_f64().expect("a number") * factor).into();
        }
    }
    let made = tempfile::tempdir().expect("a folder");
    let path = made.path().join("system.json");
    std::fs::write(&path, file.to_string()).expect("writable");
    let scaled = envelopes(&SystemDescription::read(&path).expect("valid"), 10, 1, &wheels);
    close(scaled.momentum.sizing.arm_length_factor.expect("itself"), 1.0, 3e-3);
}
