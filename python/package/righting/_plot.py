"""Figures of a plan with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from righting._progress import in_notebook
from righting._righting import Plan

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot(plan: Plan) -> Figure:
    """Attitude, angular rate, joint angles, rates, accelerations and torques over time, six axes of one figure.

    Limits of a joint that are in sight are drawn as dashed lines of its color. In a notebook the figure is shown as the output of its
    cell, elsewhere by ``matplotlib.pyplot.show()``.
    """
    from matplotlib import pyplot

    figure = pyplot.figure(figsize=(11, 7.5), layout="constrained")
    if in_notebook():
        # Otherwise it would be shown twice: as an output, and as a figure that is left open.
        pyplot.close(figure)
    axes = figure.subplots(3, 2, sharex=True)
    time_s, starts_s = plan.time_s, plan.time_s[:-1]
    system = plan.scenario.system
    joints = system.joint_names
    columns = [
        (axes[0, 0], "quaternion", time_s, plan.quaternion, ["w", "x", "y", "z"]),
        (axes[0, 1], "angular rate [deg/s]", time_s, np.degrees(plan.angular_rate_rad_s), ["x", "y", "z"]),
        (axes[1, 0], "joint angle [deg]", time_s, np.degrees(plan.joint_angles_rad), joints),
        (axes[1, 1], "joint rate [deg/s]", time_s, np.degrees(plan.joint_rates_rad_s), joints),
    ]
    for axis, label, places, values, names in columns:
        axis.plot(places, values, label=names)
        axis.set_ylabel(label)
    accelerations = np.degrees(plan.joint_accelerations_rad_s2)
    if plan.joint_jerks_rad_s3 is None:
        axes[2, 0].step(time_s, np.vstack([accelerations, accelerations[-1:]]), where="post", label=joints)
    else:
        # They are linear between nodes, and zero at the end.
        axes[2, 0].plot(time_s, np.vstack([accelerations, np.zeros_like(accelerations[:1])]), label=joints)
    axes[2, 0].set_ylabel("joint acceleration [deg/s²]")
    axes[2, 1].plot(starts_s, plan.joint_torques_n_m, label=joints)
    axes[2, 1].set_ylabel("joint torque [N m]")
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    for axis in axes[2]:
        axis.set_xlabel("time [s]")
    for axis in (axes[0, 0], axes[0, 1], axes[1, 0]):
        axis.legend(loc="best", fontsize="small", ncols=2)
    for number, row in enumerate(_joint_rows(system.to_dict())):
        _draw_limits(axes[1, 0], number, [row.get("angle_min_deg"), row.get("angle_max_deg")])
        _draw_limits(axes[1, 1], number, [-row["rate_max_deg_s"], row["rate_max_deg_s"]])
    verdict = "verified" if plan.verified else "NOT VERIFIED"
    figure.suptitle(f"{plan.name}: {verdict}")
    return figure


def _joint_rows(system: dict[str, Any]) -> list[dict[str, Any]]:
    """What a system file says of each joint that moves: rows of links, or the joints of its bodies."""
    if "links" in system:
        rows: list[dict[str, Any]] = system["links"]
        return rows
    return [body["joint"] for body in system["bodies"] if body["joint"]["type"] != "fixed"]


def _draw_limits(axis: Axes, joint: int, limits: list[float | None]) -> None:
    """Draws those limits of a joint that are in sight, without moving what is in sight."""
    low, high = axis.get_ylim()
    for limit in limits:
        if limit is not None and low <= limit <= high:
            axis.axhline(limit, color=f"C{joint}", linewidth=0.8, linestyle="--")
