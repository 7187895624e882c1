"""Plans: their arrays, their verification, and how a solve ends early."""

from __future__ import annotations

import pickle
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import righting as rt


def test_a_plan_has_arrays_of_the_shapes_that_its_documentation_says(plan: rt.Plan) -> None:
    assert plan.verified and plan.status == "solved"
    nodes, steps, joints = plan.steps + 1, plan.steps, plan.joint_count
    assert (steps, joints) == (600, 4)
    shapes = {
        "time_s": (nodes,),
        "position_m": (nodes, 3),
        "quaternion": (nodes, 4),
        "velocity_m_s": (nodes, 3),
        "angular_rate_rad_s": (nodes, 3),
        "joint_angles_rad": (nodes, joints),
        "joint_rates_rad_s": (nodes, joints),
        "joint_accelerations_rad_s2": (steps, joints),
        "joint_torques_n_m": (steps, joints),
        "power_w": (nodes,),
    }
    for name, shape in shapes.items():
        array = getattr(plan, name)
        assert array.shape == shape, name
        assert array.dtype == np.float64 and array.flags.c_contiguous, name
        assert array is getattr(plan, name), f"{name} is made once"
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


def test_the_motion_is_what_the_scenario_asked_for(plan: rt.Plan) -> None:
    asked = plan.scenario.to_dict()["maneuver"]
    axis = np.array(asked["axis"]) / np.linalg.norm(asked["axis"])
    half = np.radians(asked["angle_deg"]) / 2
    target = np.array([np.cos(half), *(np.sin(half) * axis)])
    assert abs(plan.quaternion[-1] @ target) == pytest.approx(1.0, abs=1e-6)
    # The integration of the paper keeps the length of quaternions to its own error.
    assert np.abs(np.linalg.norm(plan.quaternion, axis=1) - 1.0).max() < 1e-6
    assert plan.time_s[[0, -1]] == pytest.approx([0.0, 30.0])
    assert plan.attitude_error <= 1e-3
    # Joints follow from the held accelerations.
    step_s = 30.0 / 600
    rates = np.cumsum(plan.joint_accelerations_rad_s2, axis=0) * step_s
    assert plan.joint_rates_rad_s[1:] == pytest.approx(rates, abs=1e-9)


def test_a_plan_is_verified_again_and_says_what_was_checked(plan: rt.Plan) -> None:
    again = plan.verify()
    assert again and again.passed and not again.failures
    assert again.momentum_drift == plan.verification.momentum_drift
    names = {check.name for check in again.checks}
    assert "attitude error at the end" in names
    assert all(check.is_limit for check in plan.limits) and plan.limits
    assert plan.raise_for_status() is plan


def test_limited_jerks_have_an_array(plan: rt.Plan, scenarios: Path) -> None:
    assert plan.joint_jerks_rad_s3 is None
    smooth = rt.Scenario(scenarios / "slew_2dof.json").to_dict()
    for link in smooth["system"]["links"]:
        link["jerk_max_deg_s3"] = 20.0
    made = rt.solve(smooth)
    assert made.verified and made.joint_jerks_rad_s3 is not None
    step_s = made.duration_s / made.steps
    accelerations = made.joint_accelerations_rad_s2
    assert np.allclose(accelerations[1:], accelerations[:-1] + step_s * made.joint_jerks_rad_s3[:-1], atol=1e-9)
    copy = pickle.loads(pickle.dumps(made))
    assert np.array_equal(copy.joint_jerks_rad_s3, made.joint_jerks_rad_s3)


def test_a_plan_survives_its_folder(plan: rt.Plan, tmp_path: Path) -> None:
    plan.save(tmp_path / "plan")
    names = {file.name for file in (tmp_path / "plan").iterdir()}
    assert names == {"trajectory.csv", "solution.json", "report.html"}
    read = rt.Plan.read(tmp_path / "plan")
    assert read.verified
    assert np.array_equal(read.quaternion, plan.quaternion)
    assert np.array_equal(read.joint_torques_n_m, plan.joint_torques_n_m)
    assert read.objective == plan.objective
    assert str(read).startswith("slew_4dof: ")


def test_a_plan_can_be_pickled(plan: rt.Plan, scenarios: Path) -> None:
    chosen = rt.solve(scenarios / "real/slew_4dof_fastest.json")
    for made in (plan, chosen):
        copy = pickle.loads(pickle.dumps(made))
        assert copy.to_dict() == made.to_dict() and copy.scenario == made.scenario
        assert np.array_equal(copy.quaternion, made.quaternion)
        assert np.array_equal(copy.joint_torques_n_m, made.joint_torques_n_m)
        assert copy.verify().passed and copy.duration_s == made.duration_s


def test_a_changed_plan_fails_its_verification(plan: rt.Plan, tmp_path: Path) -> None:
    plan.save(tmp_path)
    table = (tmp_path / "trajectory.csv").read_text().splitlines()
    header = table[0].split(",")
    last = table[-1].split(",")
    last[header.index("q1_rad")] = "0.5"
    (tmp_path / "trajectory.csv").write_text("\n".join([*table[:-1], ",".join(last), ""]))
    changed = rt.Plan.read(tmp_path)
    assert not changed.verified and "NOT VERIFIED" in repr(changed)
    with pytest.raises(rt.VerificationError) as raised:
        changed.raise_for_status()
    assert raised.value.check == changed.verification.failures[0].name


def test_dictionaries_and_scenarios_give_the_same_plan(scenarios: Path) -> None:
    scenario = rt.Scenario(scenarios / "slew_2dof.json")
    first, second = rt.solve(scenario, threads=1), rt.solve(scenario.to_dict(), threads=2)
    assert np.array_equal(first.joint_angles_rad, second.joint_angles_rad)


def test_mumps_finds_the_same_plan(scenarios: Path) -> None:
    scenario = rt.Scenario(scenarios / "slew_2dof.json").to_dict()
    stage = rt.solve(scenario)
    scenario["solver"]["linear_solver"] = "mumps"
    mumps = rt.solve(scenario)
    assert "mumps" in mumps.to_dict()["versions"]["linear_solver"].lower()
    assert mumps.verified and mumps.objective == pytest.approx(stage.objective, rel=1e-6)


def test_a_warm_start_may_be_a_plan_or_its_folder(scenarios: Path, tmp_path: Path) -> None:
    farther = rt.Scenario(scenarios / "slew_2dof.json").to_dict()
    near = rt.solve(farther)
    farther["maneuver"]["angle_deg"] *= 1.1
    near.save(tmp_path)
    warm = [rt.solve(farther, warm_start=start) for start in (near, tmp_path)]
    assert all(plan.verified for plan in warm)
    assert np.array_equal(warm[0].time_s, warm[1].time_s)
    with pytest.raises(rt.InputError) as raised:
        rt.solve(farther, warm_start=near, library=tmp_path)
    assert raised.value.field == "library"


def test_what_is_impossible_is_refused_with_its_reason(scenarios: Path) -> None:
    system = rt.System(scenarios / "systems/single_link_2dof.json").to_dict()
    system["links"] = [system["links"][1]]
    flat = {
        "name": "flat",
        "system": system,
        "initial": {"joint_angles_deg": [0]},
        "maneuver": {"type": "slew", "axis": [0, 0, 1], "angle_deg": 20},
        "horizon": {"duration_s": 30, "steps": 60},
    }
    with pytest.raises(rt.ImpossibleError, match="impossible"):
        rt.solve(flat)


def test_a_solve_that_does_not_converge_is_a_status(scenarios: Path) -> None:
    scenario = rt.Scenario(scenarios / "slew_4dof.json").to_dict()
    scenario["solver"] = {"guess": "constant", "formulation": "full", "max_iterations": 3}
    stopped = rt.solve(scenario)
    assert stopped.status == "iteration_limit" and not stopped.verified
    assert not stopped.verification
    with pytest.raises(rt.NoPlanError) as raised:
        stopped.raise_for_status()
    assert raised.value.status == "iteration_limit"
    assert raised.value.hint is not None and "max_iterations" in raised.value.hint


def test_iterations_are_shown_and_what_the_callback_raises_ends_the_solve(scenarios: Path) -> None:
    seen: list[rt.Iteration] = []
    rt.solve(scenarios / "slew_2dof.json", on_iteration=seen.append)
    assert seen and seen[-1].primal_infeasibility < 1e-6

    def stop(iteration: rt.Iteration) -> None:
        raise LookupError(f"at {iteration.iteration}")

    with pytest.raises(LookupError, match="at "):
        rt.solve(scenarios / "slew_2dof.json", on_iteration=stop)


def test_a_callback_cannot_solve(scenarios: Path) -> None:
    with pytest.raises(rt.NotReadyError, match="callback"):
        rt.solve(
            scenarios / "slew_2dof.json",
            on_iteration=lambda _: rt.solve(scenarios / "slew_2dof.json"),
        )
    assert rt.solve(scenarios / "slew_2dof.json").verified


def test_threads_solve_one_after_the_other_and_leave_python_running(scenarios: Path) -> None:
    plans: dict[str, rt.Plan] = {}
    solving = threading.Event()

    def work(name: str) -> None:
        plans[name] = rt.solve(scenarios / f"{name}.json", on_iteration=lambda _: solving.set())

    names = ["slew_2dof", "detumble_2dof", "slew_4dof"]
    threads = [threading.Thread(target=work, args=[name]) for name in names]
    for thread in threads:
        thread.start()
    # This thread gets Python's lock while they solve.
    assert solving.wait(timeout=60)
    for thread in threads:
        thread.join()
    assert all(plans[name].verified for name in names)


@pytest.mark.parametrize(("name", "value"), [("time_limit_s", 0.0), ("time_limit_s", -1.0), ("threads", 0)])
def test_arguments_are_checked(scenarios: Path, name: str, value: Any) -> None:
    with pytest.raises(rt.InputError) as raised:
        rt.solve(scenarios / "slew_2dof.json", **{name: value})
    assert raised.value.field == name


def test_the_page_is_a_whole_document(plan: rt.Plan) -> None:
    page = plan.page()
    assert page.startswith("<!doctype html>") and page.rstrip().endswith("</html>")
    assert "<title>slew_4dof</title>" in page
