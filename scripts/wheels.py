#!/usr/bin/env python3
"""What arm and wheels do alone and together: the tables of docs/wheels.md.

The shortest slew of the 4-DOF system about ten axes with the arm alone, with wheels alone and with both, and how far
the base drifts while the arm goes from one posture to another. Every plan is replayed by Pinocchio. Needs `pin` and
`numpy`.
"""

from __future__ import annotations

import argparse
import copy
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from pinocchio_replay import base_rates, build, read, replayed

ROOT = Path(__file__).resolve().parents[1]
AXES = 10
ANGLE_DEG = 20.0
# Bounds of a duration that the plan chooses, s, and steps.
DURATION_S = {"min": 2.0, "max": 120.0}
STEPS = 200
# The kinds of slew: what is said of them, the wheels that work, and whether the arm moves.
KINDS = [
    ("arm", 0, True),
    ("four wheels", 4, False),
    ("four wheels and arm", 4, True),
    ("two wheels", 2, False),
    ("two wheels and arm", 2, True),
]
# How much slower than each of its parts alone a system may be, for the steps of its grid.
SLOWER = 0.005
# Parts of a step in which the uncompensated motion is integrated.
PARTS = 4


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--righting", required=True)
    righting = arguments.parse_args().righting
    with tempfile.TemporaryDirectory() as scratch:
        slews_are_right = slews(righting, Path(scratch))
        print()
        return 0 if relocations(righting, Path(scratch)) and slews_are_right else 1


def slews(righting: str, scratch: Path) -> bool:
    """The table of the shortest slews; whether two together are never slower than one."""
    base = resolved(ROOT / "scenarios" / "slew_4dof.json")
    base["horizon"] = {"duration_s": DURATION_S, "steps": STEPS}
    base["weights"] = {"time": 1.0, "control": 1e-4, "wheel_torque": 1e-4}
    print(f"| axis | {' | '.join(name for name, *_ in KINDS)} |")
    print("| --- |" + " ---: |" * len(KINDS))
    are_right = True
    for axis in fibonacci(AXES):
        times = {}
        for name, working, moves in KINDS:
            scenario = copy.deepcopy(base)
            scenario["maneuver"] = {"type": "slew", "axis": axis, "angle_deg": ANGLE_DEG}
            if working:
                scenario["wheels"] = pyramid(working)
            else:
                del scenario["weights"]["wheel_torque"]
            if not moves:
                lock(scenario)
            plan = planned(righting, scenario, scratch)
            times[name] = plan["duration_s"] if plan else math.inf
        for wheels in ("four wheels", "two wheels"):
            together, alone = times[f"{wheels} and arm"], min(times["arm"], times[wheels])
            if together > alone * (1 + SLOWER):
                print(f"{axis}: {wheels} and arm take {together}, alone {alone}", file=sys.stderr)
                are_right = False
        shown = (f"{time:.2f}" if math.isfinite(time) else "none" for time in times.values())
        print(f"| [{', '.join(f'{entry:.2f}' for entry in axis)}] | {' | '.join(shown)} |")
    return are_right


def relocations(righting: str, scratch: Path) -> bool:
    """The table of the base's drift while the arm is relocated."""
    free = resolved(ROOT / "scenarios" / "wheels" / "relocation_4dof.json")
    held = resolved(ROOT / "scenarios" / "wheels" / "relocation_4dof_wheels.json")
    print("| arm from one posture to another in 60 s | largest drift [deg] | drift at the end [deg] | effort |")
    print("| --- | ---: | ---: | ---: |")
    drift, effort = uncompensated(free)
    print(f"| shortest way of the joints | {drift.max():.3f} | {drift[-1]:.3f} | {effort:.2e} |")
    are_right = True
    for name, scenario in (("planned", free), ("planned, four wheels", held)):
        plan = planned(righting, scenario, scratch)
        are_right = are_right and plan is not None
        if plan:
            print(f"| {name} | {plan['drift'].max():.3f} | {plan['drift'][-1]:.5f} | {plan['effort']:.2e} |")
    return are_right


def planned(righting: str, scenario: dict, scratch: Path) -> dict | None:
    """The verified plan of a scenario, confirmed by Pinocchio."""
    folder = Path(tempfile.mkdtemp(dir=scratch))
    file = folder / "scenario.json"
    file.write_text(json.dumps(scenario), encoding="utf-8")
    command = [righting, "solve", str(file), "--out", str(folder), "--no-report", "--figures", "none"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 3:
        return None
    if done.returncode != 0:
        raise SystemExit(f"{scenario['name']}: {done.stderr}")
    solution = json.loads((folder / "solution.json").read_text(encoding="utf-8"))
    table = folder / "trajectory.csv"
    problems = [] if "duration_s" in solution else replayed(solution["scenario"], table)
    if problems:
        raise SystemExit(f"{scenario['name']}: {problems}")
    time_s, states, controls, _ = read(table, list(range(len(scenario["system"]["links"]))))
    step_s = time_s[1] - time_s[0]
    return {
        "duration_s": solution.get("duration_s"),
        "drift": drifts(states[:, 3:7]),
        "effort": float((controls**2).sum() * step_s),
    }


def uncompensated(scenario: dict) -> tuple[np.ndarray, float]:
    """The base's drift while the joints go the shortest way with the least effort, rest to rest, and that effort."""
    model, _ = build(scenario["system"])
    data = model.createData()
    start, end = (
        np.radians(angles)
        for angles in (scenario["initial"]["joint_angles_deg"], scenario["final"]["joint_angles_deg"])
    )
    duration_s, steps = scenario["horizon"]["duration_s"], scenario["horizon"]["steps"]
    way = end - start

    def derivative(pose: np.ndarray, time_s: float) -> np.ndarray:
        s = time_s / duration_s
        angles, rates = start + way * (3 - 2 * s) * s**2, way * 6 * s * (1 - s) / duration_s
        return base_rates(model, data, pose, (angles, rates), np.zeros(6))

    pose, h = np.r_[0.0, 0, 0, 1, 0, 0, 0], duration_s / steps / PARTS
    attitudes = [pose[3:]]
    for part in range(steps * PARTS):
        time_s = part * h
        k1 = derivative(pose, time_s)
        k2 = derivative(pose + h / 2 * k1, time_s + h / 2)
        k3 = derivative(pose + h / 2 * k2, time_s + h / 2)
        k4 = derivative(pose + h * k3, time_s + h)
        pose = pose + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        attitudes.append(pose[3:] / np.linalg.norm(pose[3:]))
    return drifts(np.array(attitudes)), float(12 * (way @ way) / duration_s**3)


def drifts(attitudes: np.ndarray) -> np.ndarray:
    """Angles from the identity, deg."""
    vectors = np.linalg.norm(attitudes[:, 1:], axis=1)
    return np.degrees(2 * np.arctan2(vectors, np.abs(attitudes[:, 0])))


def resolved(path: Path) -> dict:
    scenario = json.loads(path.read_text(encoding="utf-8"))
    system = path.parent / scenario["system"]
    scenario["system"] = json.loads(system.read_text(encoding="utf-8"))
    return scenario


def pyramid(working: int) -> list[dict]:
    """Four wheels along the diagonals, of which so many work: of two, opposite ones."""
    wheel = {"momentum_max_n_m_s": 1.0, "torque_max_n_m": 0.1}
    axes = [[1, 1, 1], [-1, -1, 1], [-1, 1, 1], [1, -1, 1]]
    return [{"axis": axis, **wheel, "failed": index >= working} for index, axis in enumerate(axes)]


def lock(scenario: dict) -> None:
    for link, angle_deg in zip(scenario["system"]["links"], scenario["initial"]["joint_angles_deg"]):
        link["angle_min_deg"] = link["angle_max_deg"] = angle_deg


def fibonacci(count: int) -> list[list[float]]:
    """Directions spread evenly over the sphere."""
    axes = []
    for i in range(count):
        z = 1 - (2 * i + 1) / count
        angle = math.pi * (3 - math.sqrt(5)) * i
        across = math.sqrt(1 - z * z)
        axes.append([across * math.cos(angle), across * math.sin(angle), z])
    return axes


if __name__ == "__main__":
    sys.exit(main())
