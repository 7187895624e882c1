#!/usr/bin/env python3
"""What each limit costs, and whether it holds outside: the table of docs/limits.md.

Every limit by itself and all together, on the 2-, 4- and 7-joint arms of the paper: each is set to a share of
what the plan without it takes, so that it has to be kept. Every plan is judged by Pinocchio, which knows nothing
of this program: at ten points in every step the joint torques come from its recursive Newton-Euler equations,
the loads at the mount from what moves the base, and angles from cones from the quaternions. Clearances are measured by
coal. Needs `pin`, `coal` and `numpy`.
"""

from __future__ import annotations

import argparse
import copy
import json
import math
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import coal
import numpy as np
import pinocchio as pin

from coal_distances import compared, distance, frames_at, placed, solids_of
from pinocchio_replay import build, configuration, read, rotation

ROOT = Path(__file__).resolve().parents[1]
ARMS = ["slew_2dof", "slew_4dof", "slew_canadarm2_table"]
# Points within a step at which a plan is judged, its beginning and its end among them.
POINTS = 10
# How much of its limit a load may be past it, and how far an angle, rad.
SHARE = 0.01
ANGLE_RAD = 1e-3
# What links are made as thick as, m.
RADIUS_M = 0.02
# What all limits together are called: those that can be kept together.
TOGETHER = "all but the last"
# A timing is the median of so many runs.
RUNS = 5


@dataclass
class Loads:
    """The largest of everything that a limit may be on."""

    torques: np.ndarray
    force: float = 0.0
    moment: float = 0.0
    rate_deg_s: float = 0.0
    # The boresight [1, 0, 0] in inertial axes at every point.
    boresight: list[np.ndarray] = field(default_factory=list)
    # Where the end of the arm is farthest from the arm at the start, body axes, and that distance, m.
    way: np.ndarray = field(default_factory=lambda: np.zeros(3))
    room_m: float = 0.0


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--righting", required=True)
    righting = arguments.parse_args().righting
    rows, wrong = [], 0
    with tempfile.TemporaryDirectory() as scratch:
        for arm in ARMS:
            scenario = resolved(ROOT / "scenarios" / f"{arm}.json")
            free = plan(righting, scenario, Path(scratch))
            loads = judged(free)
            for name, limited in variants(scenario, loads, free):
                planned = plan(righting, limited, Path(scratch))
                problems = kept(planned, limited)
                wrong += bool(problems)
                for problem in problems:
                    print(f"{arm}, {name}: {problem}", file=sys.stderr)
                rows.append((arm, name, planned, free, problems))
    write(rows)
    return 1 if wrong else 0


def resolved(path: Path) -> dict:
    scenario = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(scenario["system"], str):
        system = path.parent / scenario["system"]
        scenario["system"] = json.loads(system.read_text(encoding="utf-8"))
    return scenario


@dataclass
class Plan:
    solution: dict
    scenario: dict
    folder: Path
    time_s: float


def plan(righting: str, scenario: dict, scratch: Path) -> Plan:
    """The plan of a scenario, and the median time of its solves."""
    times = []
    folder = Path(tempfile.mkdtemp(dir=scratch))
    file = folder / "scenario.json"
    file.write_text(json.dumps(scenario), encoding="utf-8")
    for _ in range(RUNS):
        command = [righting, "solve", str(file), "--out", str(folder), "--no-report", "--figures", "none"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if not (folder / "solution.json").exists():
            raise SystemExit(f"{scenario['name']}: {done.stderr}")
        solution = json.loads((folder / "solution.json").read_text(encoding="utf-8"))
        timing = solution["timing_s"]
        times.append(timing["trace"] + timing["guess"] + timing["solve"])
    return Plan(solution, solution["scenario"], folder, statistics.median(times))


def variants(scenario: dict, loads: Loads, free: Plan) -> list[tuple[str, dict]]:
    """Each limit alone, and all of them."""
    largest = loads.torques.max()

    def torques(changed: dict, share: float) -> None:
        for link, torque in zip(changed["system"]["links"], loads.torques):
            link["torque_max_n_m"] = share * max(torque, 1e-3 * largest)

    def force(changed: dict, share: float) -> None:
        changed["system"]["mount"]["force_max_n"] = share * loads.force

    def moment(changed: dict, share: float) -> None:
        changed["system"]["mount"]["moment_max_n_m"] = share * loads.moment

    def rate(changed: dict, share: float) -> None:
        changed["system"]["base"]["angular_rate_max_deg_s"] = share * loads.rate_deg_s

    def cone(changed: dict, share: float) -> None:
        # About a place that the boresight goes through, small enough for the start and the end to be outside.
        middle = loads.boresight[len(loads.boresight) // 2]
        ends = [angle(middle, loads.boresight[i]) for i in (0, -1)]
        keep_out = {
            "name": "star tracker",
            "boresight_body": [1.0, 0.0, 0.0],
            "direction_inertial": list(middle),
            "keep_out_deg": math.degrees(share * min(ends)),
        }
        changed["pointing"] = [keep_out]

    def capsules(changed: dict, _: float) -> None:
        # Of those that are no part of the mount.
        for link in changed["system"]["links"][1:]:
            link["radius_m"] = RADIUS_M

    def box(changed: dict, share: float) -> None:
        # Its corners are as far from its center as the arm is at the start, times the share.
        edge = 2.0 / math.sqrt(3.0) * share * loads.room_m
        keep_out(changed, {"box": {"center_m": list(loads.way), "size_m": [edge] * 3}})

    def capsule(changed: dict, share: float) -> None:
        half = 0.5 * share * loads.room_m * np.array([0.0, 0.6, 0.8])
        ends = {"from_m": list(loads.way - half), "to_m": list(loads.way + half)}
        keep_out(changed, {"capsule": {**ends, "radius_m": 0.5 * share * loads.room_m}})

    def keep_out(changed: dict, shape: dict) -> None:
        base, links = changed["system"]["base"], changed["system"]["links"]
        long = [link for link in links if math.hypot(link["a_m"], link["d_m"]) > 0]
        if all(link.get("body_exempt") for link in long):
            # The 2-joint arm is part of the mount: its link keeps away from this alone.
            links[-1]["body_exempt"] = False
        elif "keep_out" not in base:
            base["keep_out_radius_m"] = base["cube_side_m"] * math.sqrt(3.0) / 2.0
        base.setdefault("keep_out", []).append(shape)

    def stow(changed: dict, _: float) -> None:
        changed["final"] = {"joint_angles_deg": changed["initial"]["joint_angles_deg"]}

    alone = [
        ("joint torques", torques, 0.85),
        ("force at the mount", force, 0.85),
        ("moment at the mount", moment, 0.85),
        ("rate of the base", rate, 0.9),
        ("a cone across its way", cone, 0.5),
        ("links with a radius", capsules, 1.0),
        ("a box in the arm's way", box, 0.5),
        ("a capsule in the arm's way", capsule, 0.5),
        ("ends as it starts", stow, 1.0),
    ]
    found = []
    for name, limit, share in alone:
        changed = copy.deepcopy(scenario)
        limit(changed, share)
        found.append((name, changed))
    everything = copy.deepcopy(scenario)
    together = {cone: 0.15, box: 0.3, capsule: 0.3}
    for _, limit, share in alone[:-1]:
        limit(everything, together.get(limit, 1.1))
    found.append((TOGETHER, everything))
    return found


def angle(a: np.ndarray, b: np.ndarray) -> float:
    return math.atan2(np.linalg.norm(np.cross(a, b)), float(a @ b))


def judged(planned: Plan) -> Loads:
    """The loads of a plan by Pinocchio, at POINTS points in every step."""
    system = planned.scenario["system"]
    model, order = build(system)
    data, joints = model.createData(), len(order)
    time_s, states, controls, _ = read(planned.folder / "trajectory.csv", order)
    loads = Loads(np.zeros(joints))
    mount = np.array(system["mount"]["position_m"], float)
    body = base_inertia(system)
    turn = rotation(states[0, 3:7])
    angles, rates = states[0, 13 : 13 + joints], states[0, 13 + joints :]
    velocity = np.r_[turn.T @ states[0, 7:10], states[0, 10:13], rates]
    pin.computeCentroidalMomentum(model, data, configuration(states[0, :3], states[0, 3:7], angles), velocity)
    momentum = data.hg.vector.copy()
    for k, u in enumerate(controls):
        step_s = time_s[k + 1] - time_s[k]
        for point in range(POINTS):
            s = step_s * point / (POINTS - 1)
            q, qd = angles + s * rates + 0.5 * s * s * u, rates + s * u
            # The base's pose straight between the nodes, which momentum in body axes and cones bear; its rate
            # from the momentum.
            pose = between(states[k], states[k + 1], point / (POINTS - 1))
            at = configuration(pose[:3], pose[3:], q)
            matrix = pin.computeCentroidalMap(model, data, at)
            twist = np.linalg.solve(matrix[:, :6], momentum - matrix[:, 6:] @ qd)
            v = np.r_[twist, qd]
            mass = pin.crba(model, data, at)
            mass = np.triu(mass) + np.triu(mass, 1).T
            bias = pin.rnea(model, data, at, v, np.zeros(model.nv))
            acceleration = np.linalg.solve(mass[:6, :6], -bias[:6] - mass[:6, 6:] @ u)
            torque = pin.rnea(model, data, at, v, np.r_[acceleration, u])[6:]
            loads.torques = np.maximum(loads.torques, np.abs(torque))
            # What the arm does to the base: the only thing that moves it. Linear parts are those of the body
            # frame's origin, seen from the turning base.
            omega = twist[3:]
            spin = acceleration[3:]
            force = system["base"]["mass_kg"] * (acceleration[:3] + np.cross(omega, twist[:3]))
            moment = body @ spin + np.cross(omega, body @ omega) - np.cross(mount, force)
            loads.force = max(loads.force, float(np.linalg.norm(force)))
            loads.moment = max(loads.moment, float(np.linalg.norm(moment)))
            loads.rate_deg_s = max(loads.rate_deg_s, math.degrees(np.linalg.norm(omega)))
            loads.boresight.append(rotation(pose[3:]) @ np.array([1.0, 0.0, 0.0]))
        angles, rates = angles + step_s * rates + 0.5 * step_s**2 * u, rates + step_s * u
    frames = frames_at(system, states[0, 13 : 13 + joints])
    at_start = [placed(solid, frames) for solid in solids_of(system)]
    for state in states:
        tip = frames_at(system, state[13 : 13 + joints])[-1][1]
        point = (coal.Sphere(1e-9), coal.Transform3s(np.eye(3), tip), 0.0)
        room_m = min(distance(solid, point) for solid in at_start)
        if room_m > loads.room_m:
            loads.way, loads.room_m = tip, room_m
    return loads


def base_inertia(system: dict) -> np.ndarray:
    base = system["base"]
    if base.get("inertia_kg_m2") is not None:
        return np.array(base["inertia_kg_m2"], float)
    return np.eye(3) * base["mass_kg"] * base["cube_side_m"] ** 2 / 6


def between(start: np.ndarray, end: np.ndarray, share: float) -> np.ndarray:
    """Position and attitude at a share of a step, straight between the nodes: loads do not depend on either."""
    q0, q1 = start[3:7], end[3:7]
    if q0 @ q1 < 0.0:
        q1 = -q1
    straight = (1.0 - share) * q0 + share * q1
    position = (1.0 - share) * start[:3] + share * end[:3]
    return np.r_[position, straight / np.linalg.norm(straight)]


def kept(planned: Plan, limited: dict) -> list[str]:
    """The limits that do not hold by Pinocchio."""
    if not planned.solution["verification"]["passed"]:
        return ["not verified"]
    loads = judged(planned)
    system = limited["system"]
    problems = [found for found, is_same in compared(planned.folder) if not is_same]
    pairs = [
        (f"torque {i + 1}", torque, link.get("torque_max_n_m"))
        for i, (torque, link) in enumerate(zip(loads.torques, system["links"]))
    ]
    pairs.append(("force at the mount", loads.force, system["mount"].get("force_max_n")))
    pairs.append(("moment at the mount", loads.moment, system["mount"].get("moment_max_n_m")))
    pairs.append(("rate of the base", loads.rate_deg_s, system["base"].get("angular_rate_max_deg_s")))
    problems += [
        f"{name} {value:.6g} of {limit:.6g}"
        for name, value, limit in pairs
        if limit is not None and value > (1.0 + SHARE) * limit
    ]
    for cone in limited.get("pointing", []):
        direction = np.array(cone["direction_inertial"])
        least = min(angle(direction, boresight) for boresight in loads.boresight)
        if least < math.radians(cone["keep_out_deg"]) - ANGLE_RAD:
            problems.append(f"cone {math.degrees(least):.4f} of {cone['keep_out_deg']:.4f} deg")
    return problems


def write(rows: list) -> None:
    lines = [
        "# What limits cost",
        "",
        "This page is written by `make limits` (`scripts/limits.py`). Each limit is set to a share of what the plan",
        "without it takes: torques, force and moment to 85 %, the base's rate to 90 %; the cone stands on the boresight's",
        "way, half as wide as its way to start or end. The box and the capsule stand where the end of the arm gets farthest",
        "from the arm at the start, their farthest points half as far from there as that is. With all together the loads get",
        "110 %, the cone is a third as wide, box and capsule are three fifths as large. Links with a radius are 20 mm thick.",
        f"*Effort* is the objective and *time* the planning time (the median of {RUNS} runs), both as a multiple of those of",
        "the plan without limits. An effort of 1.000 with something in the way: another way takes no more.",
        "",
        f"Every plan is judged by Pinocchio {pin.__version__} at {POINTS} points in each step: torques by its recursive",
        "Newton-Euler equations, the loads at the mount by what moves the base, cones by quaternions. A load may be 1 %",
        f"past its limit. coal {coal.__version__} measures the clearances of every plan, boxes, capsules and the sphere: at the",
        "nodes they are to be those of the verification within 1e-6 m, and in between, at ten places in each step, no less",
        "than the least that it names.",
        "",
        "| scenario | limit | effort | time | outside |",
        "| --- | --- | --- | --- | --- |",
    ]
    for arm, name, planned, free, problems in rows:
        effort = planned.solution["objective"] / free.solution["objective"]
        time = planned.time_s / free.time_s
        outside = "; ".join(problems) if problems else "holds"
        lines.append(f"| `{arm}` | {name} | {effort:.3f} | {time:.1f} | {outside} |")
    times = {(arm, name): planned.time_s for arm, name, planned, *_ in rows}
    alone = {arm: free.time_s for arm, _, _, free, _ in rows}
    seven = ARMS[-1]
    lines += [
        "",
        f"The 7-joint slew takes {alone[seven]:.2f} s without limits, {times[seven, 'joint torques']:.2f} s with limits of",
        f"the torques and {times[seven, TOGETHER]:.2f} s with all of them.",
        "",
        "## What else is checked",
        "",
        "- Distances of capsules from each other and from boxes against a search over their points, with their derivatives:",
        "  `crates/multibody/tests/distances.rs` and `cuboids.rs`. `scripts/coal.sh DIR…` measures any plan with coal.",
        "- Durations that the plan chooses against closed forms, within 0.5 %: one joint at its largest acceleration or rate",
        "  (`crates/planner/tests/free_duration.rs`), a hinge beside the base's center of mass and two joints that share a turn",
        "  (`planar.rs`), one wheel (`wheels.rs`).",
        "- Every field of a scenario with text in place of a number, with one entry too few or too many, and below its least:",
        "  `crates/scenario/tests/every_field.rs`, which takes the fields from the schema. Limits, targets, cones, wheels and",
        "  surroundings that cannot be: `tests/cli/bad_limits.rs`.",
    ]
    (ROOT / "docs" / "limits.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    raise SystemExit(main())
