//! Shortest slews of arms that move in a plane, against closed forms.

use righting_ocp::Control;
use righting_planner::Planner;
use righting_scenario::Scenario;
use righting_scenario::file::{Duration, DurationRange};
use righting_test_support::{by_hand, varied};
use serde_json::{Value, json};

/// The largest rate and acceleration of all joints, deg/s and deg/s².
const RATE: f64 = 20.0;
const ACCELERATION: f64 = 10.0;
/// Mass and side of the base, and so its inertia about z.
const BASE_KG: f64 = 100.0;
const BASE_KG_M2: f64 = BASE_KG / 6.0;

/// The shortest duration that a plan finds for a slew about z.
#[track_caller]
fn shortest_s(arm: &Scenario, angle_deg: f64) -> f64 {
    let scenario = varied(arm, |file| {
        file.maneuver.angle_deg = Some(angle_deg);
        file.horizon.steps = 200.0;
        file.horizon.duration_s = Duration::Free(DurationRange { min: 0.1, max: 40.0 });
        file.weights.control = Some(1e-9);
        file.weights.time = Some(1.0);
    });
    let planned = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
    let failures: Vec<_> = planned.solution.verification.failures().collect();
    assert!(failures.is_empty(), "{:?} {failures:?}", planned.solution.status);
    planned.solution.duration_s.expect("it is free")
}

/// From rest to rest a joint turns by so much in a time at most, deg.
fn most_deg(duration_s: f64) -> f64 {
    match duration_s < 2.0 * RATE / ACCELERATION {
        true => ACCELERATION * duration_s * duration_s / 4.0,
        false => RATE * (duration_s - RATE / ACCELERATION),
    }
}

/// The time that `most_deg` needs for an angle.
fn least_s(angle_deg: f64) -> f64 {
    match angle_deg < RATE * RATE / ACCELERATION {
        true => 2.0 * (angle_deg / ACCELERATION).sqrt(),
        false => angle_deg / RATE + RATE / ACCELERATION,
    }
}

#[track_caller]
fn assert_within_half_a_percent(found_s: f64, expected_s: f64) {
    let off = found_s / expected_s - 1.0;
    assert!(off.abs() < 0.005, "{found_s} s, {expected_s} s by hand: {off:.1e}");
}

/// Two bodies in a plane, hinged beside the base's centre of mass. With the reduced mass μ, the hinge at b from the
/// base's centre of mass, the rod's at c from the hinge and the joint's angle q, angular momentum about the common
/// centre of mass is zero where
///
/// ```text
/// ω (I_b + I_a + μ (b² + c² + 2 b c cos q)) = −q̇ (I_a + μ (c² + b c cos q))
/// ```
///
/// The base's angle is the integral of it over q, and grows with q: it is reached soonest by the joint's bang-bang.
#[test]
fn a_hinge_beside_the_center_of_mass() {
    let (mass, length, hinge) = (20.0, 1.5, 0.8_f64);
    let arm =
        by_hand::on_a_cube([hinge, 0.0, 0.0], &[by_hand::link(mass, length, 0.0, Some(170.0))]);
    let reduced = mass * BASE_KG / (mass + BASE_KG);
    let (center, own) = (length / 2.0, mass * length * length / 12.0);
    let slope = |q: f64| {
        let coupled = reduced * hinge * center * q.cos();
        let arm = own + reduced * center * center + coupled;
        arm / (BASE_KG_M2 + arm + reduced * hinge * hinge + coupled)
    };
    for joint_deg in [20.0, 90.0, 150.0_f64] {
        // Simpson's rule.
        let parts = 1000;
        let h = joint_deg.to_radians() / f64::from(parts);
        let weight = |k: i32| if k % parts == 0 { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
        let turned: f64 = (0..=parts).map(|k| weight(k) * slope(f64::from(k) * h)).sum();
        let angle_deg = -(turned * h / 3.0).to_degrees();
        assert_within_half_a_percent(shortest_s(&arm, angle_deg), least_s(joint_deg));
    }
}

/// Two rotors in a row about the base's axis z. The base's angle is linear in those of the joints,
/// θ = −((I₁ + I₂) q₁ + I₂ q₂)/(I_b + I₁ + I₂), so both are at their limits all the time, until the second one is at the end
/// of its range and is left behind.
#[test]
fn two_joints_share_a_turn() {
    let rotor = |inertia: f64, range_deg: Value| {
        json!({
            "mass_kg": 5.0, "a_m": 0.0, "alpha_deg": 0.0, "d_m": 0.0, "theta_deg": 0.0,
            "angle_min_deg": null, "angle_max_deg": range_deg,
            "rate_max_deg_s": RATE, "acceleration_max_deg_s2": ACCELERATION, "body_exempt": true,
            "center_of_mass_m": [0, 0, 0], "inertia_kg_m2": [[4, 0, 0], [0, 4, 0], [0, 0, inertia]]
        })
    };
    let (first, second) = (4.0, 6.0);
    let all = BASE_KG_M2 + first + second;
    // A joint that is stopped at `range` has the whole time for it.
    let base_deg = |duration_s: f64, range: f64| {
        let most = most_deg(duration_s);
        ((first + second) * most + second * most.min(range)) / all
    };
    for (duration_s, range_deg) in [(3.0, None), (9.0, None), (9.0, Some(60.0))] {
        let arm = by_hand::on_a_cube(
            [0.0; 3],
            &[rotor(first, json!(null)), rotor(second, json!(range_deg))],
        );
        let angle_deg = -base_deg(duration_s, range_deg.unwrap_or(f64::INFINITY));
        assert_within_half_a_percent(shortest_s(&arm, angle_deg), duration_s);
    }
}
