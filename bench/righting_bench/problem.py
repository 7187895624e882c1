"""The optimal control problem of a scenario as stage functions, in the full or the reduced form."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from .distance import squared_margins
from .dynamics import (
    attitude_error,
    full_dynamics,
    momentum,
    reduced_angular_velocity,
    reduced_dynamics,
    rotation_matrix,
    runge_kutta_step,
)
from .scenario import Scenario


@dataclass(frozen=True)
class StageProblem:
    """Stage functions over SX and the bounds that come with them.

    `dynamics` is (x, u) to the rate of x, `step` is (x, u) to the next x, `path` is (x) to rows that must
    not be negative, `running` is (u) and `terminal` is (x) to a cost, `report` is (x_N) to the attitude
    error, the base rate and the joint rates.
    """

    steps: int
    step_s: float
    dynamics: ca.Function
    step: ca.Function
    path: ca.Function
    running: ca.Function
    terminal: ca.Function
    report: ca.Function
    initial_state: np.ndarray
    state_low: np.ndarray
    state_high: np.ndarray
    control_limit: np.ndarray

    @property
    def states(self) -> int:
        """Length of x."""
        return self.step.size1_in(0)

    @property
    def controls(self) -> int:
        """Length of u."""
        return self.step.size1_in(1)

    @property
    def path_rows(self) -> int:
        """Length of the path constraint at one node."""
        return self.path.size1_out(0)


def stage_problem(scenario: Scenario, form: str) -> StageProblem:
    """Build the stage functions of a scenario; `form` is "full" or "reduced"."""
    system, joints = scenario.system, scenario.system.joints
    start = _Start.of(scenario)
    if form == "full":
        size, base = 13 + 2 * joints, 13
        dynamics = full_dynamics(system)
        head = np.concatenate(
            [np.zeros(3), scenario.initial_attitude, start.velocity, scenario.initial_angular_rate_rad_s]
        )
    elif form == "reduced":
        size, base = 4 + 2 * joints, 4
        dynamics = reduced_dynamics(system, start.inertial_momentum)
        head = scenario.initial_attitude
    else:
        raise ValueError(f"form is full or reduced, not {form!r}")

    state, control = ca.SX.sym("x", size), ca.SX.sym("u", joints)
    attitude = state[3:7] if form == "full" else state[0:4]
    angles, rates = state[base : base + joints], state[base + joints :]
    if form == "full":
        spin = state[10:13]
    else:
        spin = reduced_angular_velocity(system, start.inertial_momentum)(attitude, angles, rates)
    error = ca.SX.zeros(3)
    if scenario.target_attitude is not None:
        error = attitude_error(scenario.target_attitude, attitude)
    weights = scenario.weights
    terminal = (
        weights.attitude * ca.sumsqr(error)
        + weights.angular_rate * ca.sumsqr(spin)
        + weights.joint_rate * ca.sumsqr(rates)
    )
    margins = squared_margins(system, scenario.clearance_m)
    links = system.links
    rate_max = np.array([link.rate_max_rad_s for link in links])
    free = np.full(base, np.inf)
    return StageProblem(
        steps=scenario.steps,
        step_s=scenario.step_s,
        dynamics=dynamics,
        step=runge_kutta_step(dynamics, scenario.step_s),
        path=ca.Function("path", [state], [margins(angles)], ["x"], ["margin"]),
        running=ca.Function("running", [control], [weights.control * ca.sumsqr(control)], ["u"], ["cost"]),
        terminal=ca.Function("terminal", [state], [ca.cse(terminal)], ["x"], ["cost"]),
        report=ca.Function("report", [state], [error, spin, rates], ["x"], ["e_v", "omega", "qd"]),
        initial_state=np.concatenate(
            [head, scenario.initial_joint_angles_rad, scenario.initial_joint_rates_rad_s]
        ),
        state_low=np.concatenate([-free, [link.angle_min_rad for link in links], -rate_max]),
        state_high=np.concatenate([free, [link.angle_max_rad for link in links], rate_max]),
        control_limit=np.array([link.acceleration_max_rad_s2 for link in links]),
    )


@dataclass(frozen=True)
class _Start:
    """What the start fixes: conserved angular momentum, and the base velocity that rests the CM."""

    inertial_momentum: np.ndarray
    velocity: np.ndarray

    @staticmethod
    def of(scenario: Scenario) -> _Start:
        parts = momentum(
            scenario.system,
            ca.SX(ca.DM(scenario.initial_joint_angles_rad)),
            ca.SX(ca.DM(scenario.initial_joint_rates_rad_s)),
        )
        rotation = rotation_matrix(ca.SX(ca.DM(scenario.initial_attitude)))
        spin = ca.SX(ca.DM(scenario.initial_angular_rate_rad_s))
        inertial = rotation @ (parts.inertia @ spin + parts.relative)
        velocity = -rotation @ (ca.cross(spin, parts.mass_center) + parts.mass_center_rate)
        values = ca.Function("start", [], [inertial, velocity])()
        return _Start(*(np.array(values[name]).ravel() for name in ("o0", "o1")))
