"""Reach, envelopes, power and exports."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import righting as rt


def test_the_shortest_duration_is_found_with_its_plan(scenarios: Path) -> None:
    found = rt.reach(scenarios / "slew_2dof.json", resolution=50)
    assert found.what == "duration" and found.bound_deg_s is None
    assert found.first_succeeding is not None and found.last_failing is not None
    assert found.last_failing < found.first_succeeding <= 30.0
    assert found.plan is not None and found.plan.verified
    assert found.plan.duration_s == found.first_succeeding
    assert [tried["succeeded"] for tried in found.tries].count(True) >= 1
    assert "reach" in str(found)


def test_a_detumble_has_no_angle_to_vary(scenarios: Path) -> None:
    with pytest.raises(rt.InputError) as raised:
        rt.reach(scenarios / "detumble_2dof.json", "angle")
    assert raised.value.field == "what"
    with pytest.raises(rt.InputError) as raised:
        rt.reach(scenarios / "slew_2dof.json", resolution=0)
    assert raised.value.field == "resolution"


def test_envelopes_are_those_of_the_paper(scenarios: Path) -> None:
    found = rt.envelope(scenarios / "systems/xlink_4dof.json")
    momentum, torque = found.momentum_n_m_s, found.torque_n_m
    # The paper samples 2.7 N m s and 2.2 N m; the true maxima are larger.
    assert momentum.sampled_max == pytest.approx(2.7, abs=0.25)
    assert (momentum.true_max, torque.true_max) == pytest.approx((3.09, 3.43), abs=0.01)
    assert np.linalg.norm(momentum.vertices, axis=1).max() == pytest.approx(momentum.true_max)
    assert momentum.triangles.shape[1] == 3 and momentum.triangles.max() < len(momentum.vertices)
    corners = momentum.vertices[momentum.triangles]
    volume = np.sum(corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume == pytest.approx(momentum.true_volume)
    assert momentum.wheels["max"] > momentum.wheels["min"] > 0


def test_envelopes_take_scenarios_and_wheels(scenarios: Path) -> None:
    scenario = rt.Scenario(scenarios / "slew_2dof.json")
    weak = {"wheels": [{"axis": [1, 0, 0], "momentum_max_n_m_s": 0.5, "torque_max_n_m": 0.01}]}
    sources: list[Any] = [scenario, scenario.system, scenario.to_dict(), scenarios / "slew_2dof.json"]
    maxima = [rt.envelope(source, samples=10, wheels=weak).momentum_n_m_s for source in sources]
    assert len({envelope.true_max for envelope in maxima}) == 1
    assert maxima[0].wheels["max"] == pytest.approx(0.5)
    with pytest.raises(rt.InputError) as raised:
        rt.envelope(scenario, wheels={"wheels": []})
    assert raised.value.field == "wheels"


def test_the_work_of_the_joints_is_the_change_of_the_kinetic_energy(scenarios: Path, plan: rt.Plan) -> None:
    power = plan.power()
    assert power.work_j == pytest.approx(power.kinetic_energy_change_j, abs=1e-9)
    spinning = rt.solve(scenarios / "detumble_2dof.json").power(efficiency=1.0)
    assert abs(spinning.kinetic_energy_change_j) > 0.1
    assert spinning.work_j == pytest.approx(spinning.kinetic_energy_change_j, rel=1e-6)
    assert power.consumption["signed"]["peak_w"] < power.consumption["absolute"]["peak_w"]
    assert power.drawn_w().max() == power.consumption["signed"]["peak_w"]
    points = len(power.time_s)
    assert points == 5 * plan.steps
    assert power.joint_torques_n_m.shape == power.joint_powers_w.shape == (points, 4)
    assert np.abs(power.joint_torques_n_m).max(axis=0) == pytest.approx(power.peak_joint_torques_n_m)
    assert power.wheels_steady_power_w == pytest.approx(20.0)
    with pytest.raises(rt.InputError, match="efficiency"):
        plan.power(efficiency=0)


def test_motors_draw_what_joints_and_losses_take(scenarios: Path, plan: rt.Plan) -> None:
    assert plan.power().motors is None
    driven = rt.Scenario(scenarios / "slew_2dof.json").to_dict()
    drive = {"gear_ratio": 100, "torque_constant_n_m_a": 0.05, "resistance_ohm": 1.0, "gear_efficiency": 0.8}
    for link in driven["system"]["links"]:
        link["drive"] = drive
    power = rt.solve(driven).power()
    assert power.motors is not None
    drawn = power.motors["consumption"]["with_regeneration"]["energy_j"]
    assert drawn == pytest.approx(power.work_j + sum(power.motors["losses"].values()), rel=1e-6, abs=1e-9)
    assert power.motors["peak_currents_a"].shape == (2,)


def test_flights_with_replans_or_feedback_end_nearer_than_open_loop(scenarios: Path) -> None:
    plan = rt.solve(scenarios / "slew_2dof.json")
    flights = plan.fly(4, period_s=5.0, seed=3)
    assert len(flights) == 4 == len(flights.final_error_deg)
    assert np.median(flights.final_error_deg) < np.median(flights.open_loop_error_deg)
    assert flights.summary["open_loop"]["final_error_deg"]["max"] == flights.open_loop_error_deg.max()
    again = plan.fly(2, period_s=5.0, seed=3)
    assert np.array_equal(again.final_error_deg, flights.final_error_deg[:2])
    corrected = plan.fly(4, mode="feedback", seed=3)
    assert np.array_equal(corrected.open_loop_error_deg, flights.open_loop_error_deg)
    assert np.median(corrected.final_error_deg) < np.median(corrected.open_loop_error_deg)
    for wrong in ({"flights": 0}, {"mode": "none"}, {"period_s": 0.0}, {"mass_percent": 100.0}, {"center_m": -1.0}):
        with pytest.raises(rt.InputError) as raised:
            plan.fly(**wrong)
        assert raised.value.field == next(iter(wrong))


def test_what_an_arm_can_do_is_explained_before_any_plan(scenarios: Path) -> None:
    scenario = rt.Scenario(scenarios / "slew_4dof.json")
    explained = scenario.explain()
    assert explained["maneuver"]["possible"] and explained["maneuver"]["angle_deg"] == pytest.approx(20.0)
    axes = np.array(explained["loops"]["principal_axes"])
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    of_system = scenario.system.explain()
    assert of_system["rank"] == 3 and "maneuver" not in of_system


def test_plans_are_compared(plan: rt.Plan, scenarios: Path) -> None:
    other = rt.solve(scenarios / "slew_2dof.json")
    comparison = rt.compare([plan, other], ["four", "two"])
    assert comparison.names == ["four", "two"]
    four, two = comparison.numbers
    assert (four["joints"], two["joints"]) == (4, 2) and four["verified"] and two["verified"]
    assert four["peak_torque_n_m"] == pytest.approx(plan.power().peak_joint_torques_n_m.max(), rel=1e-12)
    step_s = np.diff(plan.time_s)
    effort = (plan.joint_accelerations_rad_s2**2).sum(axis=1) @ step_s
    assert four["effort_rad2_s3"] == pytest.approx(effort, rel=1e-9)
    assert "four" in str(comparison) and comparison.page().lstrip().lower().startswith("<!doctype html")
    assert len(set(rt.compare([plan, plan]).names)) == 2
    for plans, names, field in [([plan], None, "plans"), ([plan, other], ["a", "a"], "names")]:
        with pytest.raises(rt.InputError) as raised:
            rt.compare(plans, names)
        assert raised.value.field == field


def test_wheels_and_what_acts_from_outside_are_columns(scenarios: Path) -> None:
    turned = rt.solve(scenarios / "wheels/slew_4dof_one_wheel_failed.json")
    joints, wheels = turned.joint_count, turned.wheel_momenta_n_m_s.shape[1]
    assert wheels > 0 and turned.wheel_torques_n_m.shape == (turned.steps, wheels)
    # The momenta of the wheels are the integrals of their torques.
    gained = turned.wheel_torques_n_m.T @ np.diff(turned.time_s)
    assert np.diff(turned.wheel_momenta_n_m_s[[0, -1]], axis=0)[0] == pytest.approx(gained, abs=1e-9)
    assert turned.joint_angles_rad.shape == (turned.steps + 1, joints)


def test_an_archive_of_numpy_holds_the_arrays_of_the_plan(plan: rt.Plan, tmp_path: Path) -> None:
    file = tmp_path / "made/plan.npz"
    assert plan.export("npz", file) == [file]
    with np.load(file) as archive:
        assert np.array_equal(archive["q_wxyz"], plan.quaternion)
        assert np.array_equal(archive["tau_n_m"], plan.joint_torques_n_m)


@pytest.mark.parametrize(
    ("format", "name", "begins"),
    [
        ("urdf", "system.urdf", b"<?xml"),
        ("mjcf", "system.xml", b"<?xml"),
        ("joint-trajectory", "motion.json", b"{"),
        ("joint-trajectory", "motion.yaml", b"header:"),
        ("stk", "attitude.a", b"stk.v."),
        ("mat", "plan.mat", b"MATLAB 5.0"),
        ("basilisk", "fly.py", b""),
        ("mujoco", "fly.py", b""),
    ],
)
def test_every_format_is_written(plan: rt.Plan, tmp_path: Path, format: str, name: str, begins: bytes) -> None:
    (file,) = plan.export(format, tmp_path / name)
    contents = file.read_bytes()
    assert contents.startswith(begins)
    if begins.startswith(b"<"):
        ElementTree.fromstring(contents)


def test_messages_say_what_they_are_told(plan: rt.Plan, tmp_path: Path) -> None:
    (file,) = plan.export("aem", tmp_path / "a.aem", epoch="2027-03-01T12:00:00Z", object_name="ARMSAT")
    text = file.read_text()
    assert "OBJECT_NAME = ARMSAT" in text and "2027-03-01T12:00:00" in text
    kernels = plan.export("ck", tmp_path / "a.bc", naif_id=-123)
    assert [kernel.suffix for kernel in kernels] == [".bc", ".tsc", ".tf"]
    assert "-123000" in kernels[2].read_text()
    for arguments in ({"epoch": "noon"}, {"naif_id": -1}, {"nothing": 1}):
        with pytest.raises(rt.InputError):
            plan.export("aem", tmp_path / "b.aem", **arguments)
    with pytest.raises(rt.InputError, match="format"):
        plan.export("obj", tmp_path / "b.obj")
    assert not zipfile.is_zipfile(file)
