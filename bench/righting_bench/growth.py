"""Scenarios that grow: chains of more joints, and grids of more steps."""

from __future__ import annotations

from pathlib import Path

from .ours import inlined

JOINTS = (2, 4, 7, 10, 14, 20)
STEPS = (600, 1200, 2400, 4800, 9600)


def chain_scenario(slew: Path, joints: int) -> dict:
    """The 4-DOF slew with an arm of the same mass and reach cut into any number of links."""
    scenario = inlined(slew, {})
    system = scenario["system"]
    column, *_ = system["links"]
    reach = sum(link["a_m"] for link in system["links"])
    mass = sum(link["mass_kg"] for link in system["links"])
    links = []
    for index in range(joints):
        link = {**column, "mass_kg": mass / joints}
        if index > 0:
            link |= {
                "a_m": reach / (joints - 1),
                "d_m": 0.0,
                # Axes turn by a right angle from the third joint on, else the arm would stay planar.
                "alpha_deg": 90.0 * (-1) ** index if 2 <= index < joints - 1 else 0.0,
                "theta_deg": 90.0 if index == 1 else 0.0,
                "angle_min_deg": -90.0 if index == 1 else -50.0,
                "angle_max_deg": 90.0 if index == 1 else 50.0,
                "body_exempt": False,
            }
        links.append(link)
    system["name"] = scenario["name"] = f"chain_{joints}"
    system["links"] = links
    scenario["initial"]["joint_angles_deg"] = [0.0] * joints
    return scenario


def grid_scenario(slew: Path, steps: int) -> dict:
    """The same maneuver on another grid, its control weight scaled as the sum without a step asks."""
    scenario = inlined(slew, {"guess": "constant"})
    scenario["weights"]["control"] *= scenario["horizon"]["steps"] / steps
    scenario["horizon"]["steps"] = steps
    return scenario
