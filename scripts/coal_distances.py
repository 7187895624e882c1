#!/usr/bin/env python3
"""Measure the clearances of plans with coal: does another library find the distances that the checks name?

For every folder with a plan that is given: links, payload and base are built as coal's capsules and boxes from
the scenario in solution.json, and moved by the table's own kinematics. At every node the least distance of all
pairs is compared with the checks "… at nodes"; between the nodes, at PLACES places in every step, none may be
less than the checks "… between nodes" name. Needs `coal` and `numpy`.
"""

from __future__ import annotations

import csv
import json
import math
import sys
from dataclasses import dataclass
from pathlib import Path

import coal
import numpy as np

# Places looked at within a step.
PLACES = 10
# How far the distances at the nodes may differ, m, and how much less may be found between them: what coal's
# own iterations leave.
AT_NODES = 1e-6
# A capsule cannot be thinner.
THIN = 1e-9


@dataclass
class Solid:
    """A capsule of the arm: the frame that it moves with, the ends of its segment there, its radius."""

    part: int
    names: tuple[str, ...]
    frame: int
    ends: tuple[np.ndarray, np.ndarray] | None
    radius: float

    def segment(self, frames: list[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
        if self.ends is None:
            return frames[self.part][1], frames[self.part + 1][1]
        rotation, origin = frames[self.frame]
        start, end = self.ends
        return origin + rotation @ start, origin + rotation @ end


def main() -> int:
    wrong = 0
    for folder in map(Path, sys.argv[1:]):
        for found, is_same in compared(folder):
            print(f"{folder.name}, {found}")
            wrong += not is_same
    print("coal finds the same" if not wrong else f"{wrong} are not what coal finds")
    return 1 if wrong else 0


def compared(folder: Path) -> list[tuple[str, bool]]:
    """What the checks of a plan and coal say of its clearances, and whether that is the same."""
    solution = json.loads((folder / "solution.json").read_text(encoding="utf-8"))
    checks = {check["name"]: check for check in solution["verification"]["checks"]}
    found = []
    for what, (at_nodes, between) in measured(solution["scenario"], folder / "trajectory.csv").items():
        named = [checks.get(f"clearance {what} {where} nodes") for where in ("at", "between")]
        if named[0] is None:
            found.append((f"{what}: no check, coal {at_nodes:.9f}", not math.isfinite(at_nodes)))
            continue
        rooms = [check["value"] - check["limit"] for check in named]
        is_same = abs(rooms[0] - at_nodes) <= AT_NODES and between >= rooms[1] - AT_NODES
        text = (
            f"{what}: beyond the least distance at the nodes {rooms[0]:.9f}, coal {at_nodes:.9f} m; "
            f"between them {rooms[1]:.9f}, coal {between:.9f} m"
        )
        found.append((text, is_same))
    return found


def measured(scenario: dict, table: Path) -> dict[str, tuple[float, float]]:
    """The least distance beyond what is asked, from the base and between links: at nodes, between them."""
    system, clearance = scenario["system"], scenario["collision"]["clearance_m"]
    pairs = kept_pairs(system, clearance)
    with table.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    joints = range(1, len(system["links"]) + 1)
    least = {"from body": [math.inf, math.inf], "between links": [math.inf, math.inf]}
    for row, following in zip(rows, [*rows[1:], None]):
        q = np.array([float(row[f"q{i}_rad"]) for i in joints])
        look(system, pairs, q, least, 0)
        if following is None:
            break
        rates = np.array([float(row[f"dq{i}_rad_s"]) for i in joints])
        control = np.array([float(row[f"u{i}_rad_s2"]) for i in joints])
        step = float(following["t_s"]) - float(row["t_s"])
        for place in range(1, PLACES + 1):
            after = step * place / (PLACES + 1)
            look(system, pairs, q + rates * after + 0.5 * control * after**2, least, 1)
    return {what: (values[0], values[1]) for what, values in least.items()}


def look(system: dict, pairs: list, q: np.ndarray, least: dict, which: int) -> None:
    frames = frames_at(system, q)
    for what, solid, other, asked in pairs:
        room = distance(placed(solid, frames), placed(other, frames)) - asked
        least[what][which] = min(least[what][which], room)


def frames_at(system: dict, q: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Rotation and origin of frames 0 to j in body axes."""
    mount = system["mount"]
    w, x, y, z = mount.get("rotation") or (1.0, 0.0, 0.0, 0.0)
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    frames = [(rotation, np.array(mount["position_m"], dtype=float))]
    for row, angle in zip(system["links"], q):
        theta, alpha = math.radians(row["theta_deg"]) + angle, math.radians(row["alpha_deg"])
        about_z = np.array(
            [[math.cos(theta), -math.sin(theta), 0], [math.sin(theta), math.cos(theta), 0], [0, 0, 1]]
        )
        about_x = np.array(
            [[1, 0, 0], [0, math.cos(alpha), -math.sin(alpha)], [0, math.sin(alpha), math.cos(alpha)]]
        )
        rotation, origin = frames[-1]
        a, d = np.array([row["a_m"], 0.0, 0.0]), np.array([0.0, 0.0, row["d_m"]])
        if system["dh_convention"] == "modified":
            frames.append((rotation @ about_x @ about_z, origin + rotation @ (a + about_x @ d)))
        else:
            frames.append((rotation @ about_z @ about_x, origin + rotation @ (about_z @ a + d)))
    return frames


def kept_pairs(system: dict, clearance: float) -> list:
    """(which check, solid, other thing, least distance) as README says it."""
    solids = solids_of(system)
    links, base = system["links"], system["base"]
    lengths = [math.hypot(link["a_m"], link["d_m"]) for link in links]
    rounding = 1e-9 * sum(lengths)
    ignored = [set(pair) for pair in system.get("ignored_pairs", [])]

    def is_ignored(a: tuple[str, ...], b: tuple[str, ...]) -> bool:
        return any({x, y} in ignored for x in a for y in b)

    fixed = []
    radius = base.get("keep_out_radius_m")
    if radius is None and "keep_out" not in base:
        radius = base["cube_side_m"] * math.sqrt(3) / 2
    if radius is not None:
        # The sphere's center is what distances are measured from.
        fixed.append(("base.keep_out_radius_m", (coal.Sphere(THIN), np.zeros(3)), radius + clearance - THIN))
    for index, shape in enumerate(base.get("keep_out", [])):
        (kind, values), = shape.items()
        name = f"base.keep_out[{index}]"
        if kind == "box":
            thing = (coal.Box(*values["size_m"]), np.array(values["center_m"], dtype=float))
        else:
            start = np.array(values["center_m"] if kind == "sphere" else values["from_m"], dtype=float)
            end = np.array(values["center_m"] if kind == "sphere" else values["to_m"], dtype=float)
            thing = ((start, end), values["radius_m"])
        fixed.append((name, thing, clearance))
    pairs = []
    for solid in solids:
        is_exempt = solid.part < len(links) and links[solid.part].get("body_exempt", False)
        for name, thing, asked in fixed:
            if not is_exempt and not is_ignored(solid.names, (name,)):
                pairs.append(("from body", solid, thing, asked))
    for a in solids:
        for b in solids:
            if a.part >= b.part or is_ignored(a.names, b.names):
                continue
            between = sum(lengths[a.part + 1 : b.part])
            is_on_line = len(a.names) == 1 and len(b.names) == 1
            needed = clearance + a.radius + b.radius if is_on_line else rounding
            if between > max(needed, rounding):
                pairs.append(("between links", a, b, clearance))
    return pairs


def solids_of(system: dict) -> list[Solid]:
    links = system["links"]
    rounding = 1e-9 * sum(math.hypot(link["a_m"], link["d_m"]) for link in links)
    solids = []
    for index, link in enumerate(links):
        usual = "previous" if system["dh_convention"] == "modified" else "own"
        frame = index + 1 if link.get("inertial_frame", usual) == "own" else index
        radius = link.get("radius_m") or 0.0
        if "shapes" in link:
            solids += shaped(link["shapes"], index, f"links[{index}]", frame)
        elif radius > 0 or math.hypot(link["a_m"], link["d_m"]) > rounding:
            solids.append(Solid(index, (f"links[{index}]",), frame, None, radius))
    payload, last = system.get("payload"), len(links)
    if payload and "shapes" in payload:
        solids += shaped(payload["shapes"], last, "payload", last)
    elif payload and payload.get("radius_m"):
        solids.append(Solid(last, ("payload",), last, (np.zeros(3), np.zeros(3)), payload["radius_m"]))
    return solids


def shaped(shapes: list, part: int, name: str, frame: int) -> list[Solid]:
    solids = []
    for index, shape in enumerate(shapes):
        (kind, values), = shape.items()
        ends = [values[key] for key in (("center_m", "center_m") if kind == "sphere" else ("from_m", "to_m"))]
        start, end = (np.array(point, dtype=float) for point in ends)
        names = (name, f"{name}.shapes[{index}]")
        solids.append(Solid(part, names, frame, (start, end), values["radius_m"]))
    return solids


def placed(thing, frames):
    """Coal's shape, its transform, and how much it is too thick."""
    if isinstance(thing, Solid):
        return capsule(*thing.segment(frames), thing.radius)
    first, second = thing
    if isinstance(first, tuple):
        return capsule(*first, second)
    return first, coal.Transform3s(np.eye(3), second), 0.0


def capsule(start: np.ndarray, end: np.ndarray, radius: float):
    along = end - start
    length = float(np.linalg.norm(along))
    rotation = np.eye(3)
    if length > 0:
        z = along / length
        x = np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))])
        x /= np.linalg.norm(x)
        rotation = np.column_stack([x, np.cross(z, x), z])
    transform = coal.Transform3s(rotation, (start + end) / 2)
    return coal.Capsule(max(radius, THIN), length), transform, max(THIN - radius, 0.0)


def distance(first, second) -> float:
    (a, at_a, more_a), (b, at_b, more_b) = first, second
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    coal.distance(a, at_a, b, at_b, request, result)
    return result.min_distance + more_a + more_b


if __name__ == "__main__":
    sys.exit(main())
