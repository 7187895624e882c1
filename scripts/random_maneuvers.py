#!/usr/bin/env python3
"""Plan maneuvers of random arms and say what came of each.

Arms of 1 to 8 joints with random rows, masses, limits and postures; slews of 5 to 180 degrees and detumbles
of 0.1 to 20 deg/s. The same seed gives the same maneuvers. Writes one JSON line a maneuver, and the
scenarios and plans themselves, to a folder; prints a table. Needs nothing but Python.
"""

from __future__ import annotations

import argparse
import collections
import json
import math
import random
import re
import statistics
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# A start that lies within a keep-out zone is drawn again so often.
DRAWS = 60
TIME_LIMIT_S = 120
NAMES = {0: "verified", 2: "refused", 3: "no plan", 4: "not verified"}


def main() -> int:
    options = parser().parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    scenarios = [maneuver(options.seed, number) for number in range(options.count)]
    with ThreadPoolExecutor(options.jobs) as pool:
        records = list(pool.map(lambda scenario: planned(options, scenario), scenarios))
    text = "".join(json.dumps(record) + "\n" for record in records)
    (options.out / "records.jsonl").write_text(text, encoding="utf-8")
    print(f"seed {options.seed}, {options.count} maneuvers")
    report(records)
    return 0


def parser() -> argparse.ArgumentParser:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--righting", type=Path, default=Path("target/release/righting"))
    options.add_argument("--out", type=Path, default=Path("out/random"))
    options.add_argument("--count", type=int, default=300)
    options.add_argument("--seed", type=int, default=20261125)
    options.add_argument("--jobs", type=int, default=1, help="plans made at a time")
    return options


def maneuver(seed: int, number: int) -> dict:
    """Maneuver `number` of a seed: whatever else is drawn, it is the same."""
    draw = random.Random(f"{seed}/{number}")
    joints = draw.randint(1, 8)
    links = [link(draw, joints) for _ in range(joints)]
    arm_kg = sum(link["mass_kg"] for link in links)
    side_m = draw.uniform(0.3, 1.5)
    system = {
        "name": f"random_{number}",
        "base": {"mass_kg": round(arm_kg * 10 ** draw.uniform(0.3, 1.8), 3), "cube_side_m": round(side_m, 3)},
        "mount": {"position_m": [0.0, 0.0, round(side_m / 2, 4)]},
        "dh_convention": draw.choice(["standard", "standard", "modified"]),
        "links": links,
    }
    angles = clear_posture(draw, system)
    is_slew = draw.random() < 0.7
    duration_s = round(10 ** draw.uniform(1.3, 2.3), 1)
    scenario = {
        "name": f"random_{number}",
        "system": system,
        "initial": {"joint_angles_deg": angles},
        "horizon": {"duration_s": duration_s, "steps": draw.choice([100, 150, 200, 300, 400])},
    }
    axis = [draw.gauss(0, 1) for _ in range(3)]
    length = math.hypot(*axis)
    axis = [round(component / length, 6) for component in axis]
    if is_slew:
        angle_deg = round(5 * 36 ** draw.random(), 2)
        scenario["maneuver"] = {"type": "slew", "axis": axis, "angle_deg": angle_deg}
    else:
        rate_deg_s = 0.1 * 200 ** draw.random()
        scenario["initial"]["angular_rate_deg_s"] = [round(rate_deg_s * a, 5) for a in axis]
        scenario["maneuver"] = {"type": "detumble"}
    return scenario


def link(draw: random.Random, joints: int) -> dict:
    length = lambda: round(draw.uniform(0.1, 1.2), 3) if draw.random() < 0.7 else 0.0
    limit_deg = draw.choice([None, None, 360, 170, 120, 90])
    return {
        "mass_kg": round(10 ** draw.uniform(0.0, 1.5), 3),
        "a_m": length(),
        "alpha_deg": draw.choice([0.0, 90.0, -90.0, 90.0, -90.0, round(draw.uniform(-180, 180), 1)]),
        "d_m": length(),
        "theta_deg": draw.choice([0.0, 90.0, -90.0, 180.0]),
        "angle_min_deg": None if limit_deg is None else -limit_deg,
        "angle_max_deg": limit_deg,
        "rate_max_deg_s": round(10 ** draw.uniform(0.3, 1.6), 2),
        "acceleration_max_deg_s2": round(10 ** draw.uniform(0.0, 1.5), 2),
    }


def clear_posture(draw: random.Random, system: dict) -> list[float]:
    """A posture with the links clear of the base, drawn a few times; the last one drawn if none is. Links
    that are inside the keep-out sphere there are exempt."""
    for _ in range(DRAWS):
        angles = []
        for row in system["links"]:
            limit_deg = row["angle_max_deg"] or 180
            angles.append(round(draw.uniform(-0.6, 0.6) * limit_deg, 2))
        distances = from_base(system, angles)
        least_m = system["base"]["cube_side_m"] * math.sqrt(3) / 2 + 0.02
        inside = [distance < least_m for distance in distances]
        # Only the links next to the mount may be part of it.
        first_outside = inside.index(False) if False in inside else len(inside)
        if first_outside <= 2 and not any(inside[first_outside:]):
            break
    for row, is_inside in zip(system["links"], inside):
        if is_inside:
            row["body_exempt"] = True
    return angles


def from_base(system: dict, angles: list[float]) -> list[float]:
    """The distance of each link from the base's center of mass."""
    rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    origin = list(system["mount"]["position_m"])
    distances = []
    for row, angle in zip(system["links"], angles):
        alpha, theta = math.radians(row["alpha_deg"]), math.radians(row["theta_deg"] + angle)
        if system["dh_convention"] == "modified":
            rotation = product(rotation, about_x(alpha))
            offset = [row["a_m"], 0.0, row["d_m"]]
            after = about_z(theta)
        else:
            rotation = product(rotation, about_z(theta))
            offset = [row["a_m"], 0.0, row["d_m"]]
            after = about_x(alpha)
        end = [o + sum(r * x for r, x in zip(line, offset)) for o, line in zip(origin, rotation)]
        distances.append(from_origin(origin, end))
        rotation, origin = product(rotation, after), end
    return distances


def about_x(angle: float) -> list[list[float]]:
    c, s = math.cos(angle), math.sin(angle)
    return [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]


def about_z(angle: float) -> list[list[float]]:
    c, s = math.cos(angle), math.sin(angle)
    return [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]


def product(a: list[list[float]], b: list[list[float]]) -> list[list[float]]:
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def from_origin(start: list[float], end: list[float]) -> float:
    along = [e - s for s, e in zip(start, end)]
    squared = sum(x * x for x in along)
    share = 0.0 if squared == 0 else min(1.0, max(0.0, -sum(s * x for s, x in zip(start, along)) / squared))
    return math.hypot(*(s + share * x for s, x in zip(start, along)))


def planned(options: argparse.Namespace, scenario: dict) -> dict:
    name = scenario["name"]
    path = options.out / f"{name}.json"
    path.write_text(json.dumps(scenario, indent=1), encoding="utf-8")
    command = [options.righting, "solve", path, "--out", options.out / name, "--json", "--no-report"]
    command += ["--figures", "none"]
    started = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False)
    except subprocess.TimeoutExpired:
        return {"name": name, "outcome": "no end", "seconds": TIME_LIMIT_S, **facts(scenario)}
    seconds = time.monotonic() - started
    record = {
        "name": name,
        "outcome": NAMES.get(done.returncode, f"exit code {done.returncode}"),
        "seconds": seconds,
        **facts(scenario),
        "says": [line for line in done.stderr.splitlines() if line.strip()][-6:],
    }
    try:
        solution = json.loads(done.stdout)
    except json.JSONDecodeError:
        return record
    if "objective" in solution:
        record["objective"] = solution["objective"]
        record["status"] = solution["status"]
        record["terminal"] = solution["terminal"]
        record["bound_deg_s"] = solution.get("bound_deg_s")
        record["notes"] = solution.get("notes", [])
        checks = solution["verification"]["checks"]
        record["failed"] = [check["name"] for check in checks if not check["passed"]]
        record["iterations"] = sum(attempt["iterations"] for attempt in solution["attempts"])
    return record


def facts(scenario: dict) -> dict:
    return {
        "joints": len(scenario["system"]["links"]),
        "steps": scenario["horizon"]["steps"],
        "type": scenario["maneuver"]["type"],
        "angle_deg": scenario["maneuver"].get("angle_deg"),
    }


def report(records: list[dict]) -> None:
    outcomes = collections.Counter(cause(record) for record in records)
    for what, count in outcomes.most_common():
        print(f"{count:5}  {what}")
    print("\njoints  plans   median s     most s   most / median")
    for joints in sorted({record["joints"] for record in records}):
        times = [r["seconds"] for r in records if r["joints"] == joints and r["outcome"] != "refused"]
        if times:
            middle, most = statistics.median(times), max(times)
            print(f"{joints:6} {len(times):6} {middle:10.3f} {most:10.3f} {most / middle:10.1f}")


def cause(record: dict) -> str:
    outcome = record["outcome"]
    if record.get("failed"):
        outcome += ": " + ", ".join(record["failed"])
    elif outcome != "verified":
        said = record["says"][0] if record.get("says") else ""
        # Numbers and names of files are the maneuver's own.
        outcome += ": " + re.sub(r"-?[0-9][0-9.e+-]*", "#", re.sub(r"\S+\.json: ", "", said))[:110]
    return outcome


if __name__ == "__main__":
    raise SystemExit(main())
