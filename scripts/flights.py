#!/usr/bin/env python3
"""Fly plans many times with spacecraft that are not as planned, and write docs/flown.md.

Every mass and inertia off by up to 10 percent, noisy sensors, gravity gradient at 400 km: replanned once a second,
with the masses that the flight has shown and with the plan's, with feedback alone, with both, and open loop; then the
same slew with MuJoCo as the spacecraft. Needs `mujoco` and `numpy`.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "flown.md"
NOISE = [
    *("--attitude-noise-deg", "0.005", "--joint-noise-deg", "0.005"),
    *("--joint-rate-noise-deg-s", "0.002"),
]
ENVIRONMENT = {"gravity_gradient": {"altitude_km": 400}}
SLEWS = {
    "slew_4dof": "20° in 30 s, 4 joints",
    "slew75_4dof": "75° in 120 s, 4 joints",
    "slew_canadarm2": "20° in 30 s, 7 joints",
}
DETUMBLES = {"detumble_4dof": "from 20 °/s in 30 s, 4 joints"}
# What is done about it, and how it is asked for.
KINDS = {
    "replanned": ["--mode", "replan"],
    "replanned, plan's masses": ["--mode", "replan", "--keep-masses"],
    "replanned, with feedback": ["--mode", "both"],
    "feedback alone": ["--mode", "feedback"],
}
# How many flights of all kinds but the first.
OTHER_FLIGHTS = 100
# At least so many of a hundred slews shall end within so many degrees.
WITHIN_DEG, SHARE = 0.1, 95
# Quantiles of samples that are drawn anew from both spacecraft's flights lie so often between these.
RESAMPLES, CONFIDENCE = 2000, (0.5, 99.5)


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--righting", type=Path, default=ROOT / "target/release/righting")
    options.add_argument("--flights", type=int, default=1000)
    options.add_argument("--mujoco-flights", type=int, default=200)
    options.add_argument("--out", type=Path, default=ROOT / "out/flights")
    options = options.parse_args()
    options.righting, options.out = options.righting.resolve(), options.out.resolve()
    # What one version has flown it would fly again: a run that was stopped goes on.
    version = run(options.righting, "--version").strip()
    folder = options.out / "".join(c if c.isalnum() else "_" for c in version)
    folder.mkdir(parents=True, exist_ok=True)
    os.chdir(folder)
    rows, are_near = slews(options)
    agree, in_mujoco = mujoco(options)
    PAGE.write_text(page(options, rows, detumbles(options), in_mujoco))
    print(PAGE)
    return 0 if are_near and agree else 1


def slews(options) -> tuple[list[str], bool]:
    """Rows of the table of slews; whether enough of the replanned ones end near enough."""
    rows, are_near = [], True
    for name, what in SLEWS.items():
        scenario = with_environment(name)
        is_first = True
        for kind, arguments in KINDS.items():
            count = options.flights if is_first else min(options.flights, OTHER_FLIGHTS)
            found = fly(options, scenario, f"{name} {kind}", arguments, count)
            if is_first:
                are_near &= found["final_error_deg"]["p95"] <= WITHIN_DEG
                rows.append(row(f"`{name}`, {what}", "open loop", found["open_loop"]["final_error_deg"], None, found))
                is_first = False
            rows.append(row("", kind, found["final_error_deg"], found["replan_ms"], found))
    return rows, are_near


def row(name: str, kind: str, errors: dict, times: dict | None, found: dict) -> str:
    has_replans = times is not None and times["median"] is not None
    cells = [name, kind, *(short(errors[key]) for key in ("median", "p95", "max"))]
    cells.append(str(found["missed_replans"]) if has_replans else "–")
    cells.append(", ".join(short(times[key]) for key in ("median", "p999")) if has_replans else "–")
    return f"| {' | '.join(cells)} |"


def detumbles(options) -> list[str]:
    rows = []
    for name, what in DETUMBLES.items():
        count = min(options.flights, OTHER_FLIGHTS)
        found = fly(options, with_environment(name), f"{name} replanned", KINDS["replanned"], count)
        for kind, ends in (("open loop", found["open_loop"]), ("replanned", found)):
            rates = [short(ends["final_rate_deg_s"][key]) for key in ("median", "p95", "max")]
            rows.append(f"| `{name}`, {what} | {kind} | {' | '.join(rates)} |")
    return rows


def mujoco(options) -> tuple[bool, list[str]]:
    """The 4-joint slew with both spacecraft; whether their distributions agree within sampling error."""
    plan = Path("plan")
    run(options.righting, "solve", ROOT / "scenarios/slew_4dof.json", "--out", plan, "--figures", "none", "--no-report")
    count = str(options.mujoco_flights)
    rows, agree = [], True
    for kind in ("open loop", "replanned"):
        mode = ["--mode", "open-loop" if kind == "open loop" else "replan"]
        run(options.righting, "fly", plan, "--out", "model", "--flights", count, *mode, *NOISE)
        ours = np.array([float(line.split(",")[1]) for line in lines("model/flights.csv")])

        def flown(seed: int) -> float:
            out = f"mujoco/{kind.replace(' ', '_')}_{seed}"
            script = ROOT / "scripts/fly_in_mujoco.py"
            arguments = ["--righting", options.righting, "--out", out, "--seed", str(seed), *NOISE]
            if not Path(out, "fly.json").exists():
                run(sys.executable, script, *arguments, plan, "--", *mode)
            return float(lines(f"{out}/flights.csv")[0].split(",")[1])

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            theirs = np.array(list(pool.map(flown, range(options.mujoco_flights))))
        for share, name in ((50, "median"), (95, "95 %")):
            draws = np.random.default_rng(0)
            differences = [
                np.percentile(draws.choice(theirs, len(theirs)), share)
                - np.percentile(draws.choice(ours, len(ours)), share)
                for _ in range(RESAMPLES)
            ]
            low, high = np.percentile(differences, CONFIDENCE)
            agree &= low <= 0 <= high
            cells = [short(np.percentile(values, share)) for values in (ours, theirs)]
            rows.append(f"| {kind}, {name} | {' | '.join(cells)} | {short(low)} to {short(high)} |")
    return agree, rows


def with_environment(name: str) -> Path:
    """A shipped scenario with the gravity gradient on."""
    shipped = ROOT / "scenarios" / f"{name}.json"
    scenario = json.loads(shipped.read_text())
    scenario["system"] = str(shipped.parent / scenario["system"])
    scenario["environment"] = ENVIRONMENT
    file = Path(f"{name}.json")
    file.write_text(json.dumps(scenario))
    return file


def fly(options, scenario: Path, name: str, arguments: list[str], count: int) -> dict:
    print(name, file=sys.stderr, flush=True)
    out = Path(f"{name} {count}".replace(" ", "_").replace(",", "").replace("'", ""))
    if not (out / "fly.json").exists():
        run(options.righting, "fly", scenario, "--out", out, "--flights", str(count), *arguments, *NOISE)
    return json.loads((out / "fly.json").read_text())


def run(*command) -> str:
    ended = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if ended.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}\n{ended.stderr}")
    return ended.stdout


def lines(file: str) -> list[str]:
    return Path(file).read_text().splitlines()[1:]


def short(value: float) -> str:
    return f"{value:.2g}" if abs(value) < 10 else f"{value:.1f}"


def page(options, slew_rows: list[str], detumble_rows: list[str], mujoco_rows: list[str]) -> str:
    version = run(options.righting, "--version").strip()
    return f"""# Flights that were flown

This page is written by `make flights` (`scripts/flights.py`, {version}). What a flight is stands in
[flights.md](flights.md).

{options.flights:,} slews flown open loop and replanned, {min(options.flights, OTHER_FLIGHTS)} of the other rows, seed 0. Every mass
and every inertia is off by up to 10 % either way, each by itself.
Measured attitude: 0.005° (standard deviation, each axis), joints: 0.005° and 0.002 °/s. The gravity gradient of an orbit
at 400 km acts on plan and spacecraft. Replans are once a second.

## Slews

Degrees from the target at the end: median, 95 % and largest. Times in ms, two flights at a time on two cores.

| maneuver | flown | median | 95 % | largest | replans missed | a replan, ms: median, 99.9 % |
| --- | --- | --- | --- | --- | --- | --- |
{chr(10).join(slew_rows)}

## Detumbles

Angular rate of the base at the end, °/s.

| maneuver | flown | median | 95 % | largest |
| --- | --- | --- | --- | --- |
{chr(10).join(detumble_rows)}

## MuJoCo as the spacecraft

`slew_4dof` without environment, {options.mujoco_flights} flights of each spacecraft, masses drawn from the same
distributions but not the same draws: the verifier's model in `righting fly`, and MuJoCo at the other end of `righting fly
--plant stdio` (`scripts/fly_in_mujoco.py`). Degrees from the target. The last column is where 99 % of differences between
the two lie when both samples are drawn again from themselves: zero lies in it where they agree within sampling error.

| | verifier's model | MuJoCo | difference |
| --- | --- | --- | --- |
{chr(10).join(mujoco_rows)}
"""


if __name__ == "__main__":
    raise SystemExit(main())
