"""Compiled functions of a system, against finite differences and against plans."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import righting as rt
from numpy.typing import NDArray

Array = NDArray[np.float64]
STEP = 1e-6


def differences(function: Callable[[Array], Array], x: Array) -> Array:
    """Central differences of a function of one vector, a column an entry."""
    columns = [(function(x + e) - function(x - e)) / (2 * STEP) for e in STEP * np.eye(len(x))]
    return np.stack(columns, axis=-1)


@pytest.fixture(scope="module")
def system(scenarios: Path) -> rt.System:
    return rt.System(scenarios / "systems/xlink_4dof.json")


@pytest.mark.parametrize("form", ["reduced", "full"])
def test_jacobians_and_hessians_are_those_of_finite_differences(system: rt.System, form: str) -> None:
    dynamics = system.dynamics(form, order=2)
    random = np.random.default_rng(1)
    values = [random.normal(size=length) for length in dynamics.inputs.values()]
    quaternion = slice(0, 4) if form == "reduced" else slice(3, 7)
    values[0][quaternion] /= np.linalg.norm(values[0][quaternion])
    found = dynamics(*values)
    states, controls = len(values[0]), len(values[1])
    at = np.concatenate(values[:2])

    def called(z: Array) -> dict[str, Array]:
        return dynamics(z[:states], z[states:], *values[2:])

    assert found["rates"].shape == (states,)
    assert found["jacobian"].shape == (states, states + controls)
    expected = differences(lambda z: called(z)["rates"], at)
    assert np.abs(found["jacobian"] - expected).max() < 1e-6
    expected = differences(lambda z: values[-1] @ called(z)["jacobian"], at)
    assert np.abs(found["hessian"] - expected).max() < 1e-5
    assert np.array_equal(found["hessian"], found["hessian"].T)
    rows, columns = dynamics.sparsity("jacobian")
    filled = np.zeros_like(found["jacobian"], dtype=bool)
    filled[rows, columns] = True
    assert not found["jacobian"][~filled].any()


def test_a_plan_follows_the_full_dynamics(plan: rt.Plan) -> None:
    dynamics = plan.scenario.system.dynamics("full", order=0)
    states = np.hstack(
        [
            plan.position_m,
            plan.quaternion,
            plan.velocity_m_s,
            plan.angular_rate_rad_s,
            plan.joint_angles_rad,
            plan.joint_rates_rad_s,
        ]
    )
    x, u, h = states[:-1], plan.joint_accelerations_rad_s2, plan.duration_s / plan.steps
    # One step of the classical Runge-Kutta method from every node at once.
    k1 = dynamics(x, u)["rates"]
    k2 = dynamics(x + h / 2 * k1, u)["rates"]
    k3 = dynamics(x + h / 2 * k2, u)["rates"]
    k4 = dynamics(x + h * k3, u)["rates"]
    reached = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    assert np.abs(reached - states[1:]).max() < 1e-9


def test_torques_are_those_of_the_plan(plan: rt.Plan) -> None:
    torques = plan.scenario.system.joint_torques(order=0)
    nodes = (plan.angular_rate_rad_s, plan.joint_angles_rad, plan.joint_rates_rad_s)
    found = torques(*(values[:-1] for values in nodes), plan.joint_accelerations_rad_s2)
    assert found["torques"] == pytest.approx(plan.joint_torques_n_m, abs=1e-12)


def test_the_momentum_of_a_slew_is_zero_all_along(plan: rt.Plan) -> None:
    found = plan.scenario.system.momentum_map()(plan.joint_angles_rad)
    assert found["inertia"].shape == (plan.steps + 1, 3, 3)
    momentum = np.einsum("kij,kj->ki", found["inertia"], plan.angular_rate_rad_s)
    momentum += np.einsum("kij,kj->ki", found["joint_columns"], plan.joint_rates_rad_s)
    assert np.abs(momentum).max() < 1e-9


def test_points_are_evaluated_alike_alone_and_together(system: rt.System) -> None:
    dynamics = system.dynamics()
    assert dynamics.inputs == {"x": 12, "u": 4, "momentum": 3}
    assert dynamics.outputs == {"rates": (12,), "jacobian": (12, 16)}
    random = np.random.default_rng(2)
    x, u, momentum = random.normal(size=(11, 12)), random.normal(size=4), [0.1, 0.2, 0.3]
    together = dynamics(x, u, momentum)
    assert together["jacobian"].shape == (11, 12, 16)
    for k, point in enumerate(x):
        alone = dynamics(point, u, momentum)
        assert np.array_equal(alone["rates"], together["rates"][k])
        assert np.array_equal(alone["jacobian"], together["jacobian"][k])


def test_arguments_are_checked(system: rt.System) -> None:
    dynamics = system.dynamics(order=0)
    with pytest.raises(TypeError, match="found 2 inputs, expected 3: x, u, momentum"):
        dynamics(np.zeros(12), np.zeros(4))
    with pytest.raises(ValueError, match=r"u: found an array of shape \[5\], expected \(4,\)"):
        dynamics(np.zeros(12), np.zeros(5), np.zeros(3))
    with pytest.raises(ValueError, match="of 2 and of 3 points"):
        dynamics(np.zeros((2, 12)), np.zeros((3, 4)), np.zeros(3))
    for wrong in ({"form": "half"}, {"order": 3}):
        with pytest.raises(rt.InputError):
            system.dynamics(**wrong)
    with pytest.raises(ValueError, match="no matrix is called"):
        dynamics.sparsity("rates")
