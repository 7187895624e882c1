#!/usr/bin/env python3
"""What an initial guess is worth: plans every maneuver from the constant guess, from the automatic
one and from many low-discrepancy starts, and writes the objectives as docs/starts.md.

    scripts/starts.py [--righting target/release/righting] [--out docs/starts.md] [--jobs 1]
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHIPPED = [
    f"{kind}_{system}"
    for kind in ("slew", "detumble")
    for system in ("2dof", "4dof", "canadarm2_table", "canadarm2")
]
HALTON_STARTS = 64
SEED = 0
# Plans this close to each other are the same optimum.
SAME = 1e-3
LARGE_SLEWS = [(45, [0.3, -0.8, 0.5], 60), (75, None, 120), (90, [0.74, 0.02, 0.68], 120)]
# The starts were chosen on other skew axes, but on x and y too.
FURTHER_AXES = [[1, 0, 0], [0, 1, 0], [0.6, 0.64, -0.48], [-0.36, 0.48, 0.8]]
FURTHER_SLEWS = {
    "2dof": [(30, 45), (45, 60), (60, 90), (75, 120), (90, 120)],
    "4dof": [(30, 45), (45, 60), (60, 90)],
}
FURTHER_STEPS = 120


def scenario(name):
    read = json.loads((ROOT / "scenarios" / f"{name}.json").read_text())
    read["system"] = str(ROOT / "scenarios" / read["system"])
    return read


def slew(system, angle_deg, axis, duration_s, steps):
    made = scenario(f"slew_{system}")
    made["maneuver"].update(axis=axis, angle_deg=angle_deg)
    made["horizon"] = {"duration_s": duration_s, "steps": steps}
    return made


def objective(righting, asked, guess):
    """The objective of the plan; infinite where there is none."""
    asked = json.loads(json.dumps(asked))
    asked.setdefault("solver", {})["guess"] = guess
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scenario.json"
        file.write_text(json.dumps(asked))
        command = [righting, "solve", file, "--out", Path(folder) / "plan", "--json"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3, 4):
        sys.exit(f"{asked['name']}: {done.stderr}")
    plan = json.loads(done.stdout)
    return plan["objective"] if plan["status"] in ("solved", "acceptable") else math.inf


def compared(righting, asked):
    guesses = ["constant", "auto", {"starts": HALTON_STARTS, "seed": SEED}]
    found = [objective(righting, asked, guess) for guess in guesses]
    print(asked["name"], asked["maneuver"], found, file=sys.stderr, flush=True)
    return found


def number(value, best):
    text = f"{value:.4e}" if math.isfinite(value) else "none"
    return f"**{text}**" if value <= best * (1 + SAME) else text


def cells(found):
    return [number(value, min(found)) for value in found]


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def report(named, further):
    columns = ["constant", "auto", f"{HALTON_STARTS} Halton"]
    return f"""# What an initial guess is worth

The tables show the objectives of plans from three initial guesses: the constant guess, the automatic one, and
the best of {HALTON_STARTS} low-discrepancy starts (`{{"starts": {HALTON_STARTS}, "seed": {SEED}}}`). A low-discrepancy
start moves every joint smoothly to some angle; the angles are points of a Halton sequence. The best of a row
is in bold, and so is what lies within {SAME:.1%} of it. The best known is no more than the best of these three.

The automatic guess misses more than these tables show: of 38 slews of other arms too, it missed the best known
plan of three by more than 1 % ([decisions.md](decisions.md#initial-guesses)).

`make starts` plans all of it again and writes this page. Do not edit it.

{table(["maneuver", *columns], [[name, *cells(found)] for name, found in named])}
{summary(named, "maneuvers above")}
## Further slews

These are on {FURTHER_STEPS} steps. The kinds of starts were chosen on slews about x, y and two other skew axes. The
skew axes here had no part in that choice.

{table(["arm", "angle", "axis", "duration", *columns], [[*name, *cells(found)] for name, found in further])}
{summary(further, "further slews")}
{summary([row for row in further if row[0][2] not in ("[1, 0, 0]", "[0, 1, 0]")], "skew slews among them")}"""


def summary(rows, what):
    def line(name, index):
        hits = sum(found[index] <= min(found) * (1 + SAME) for _, found in rows)
        ratios = sorted(found[index] / min(found) for _, found in rows)
        worst = f"{ratios[-1] - 1:.0%}" if math.isfinite(ratios[-1]) else "no plan"
        return f"| {name} | {hits} of {len(rows)} | {ratios[len(ratios) // 2] - 1:.1%} | {worst} |"

    names = ["constant", "auto", f"{HALTON_STARTS} Halton"]
    return "\n".join(
        [
            f"Of the {len(rows)} {what}, how many end at the best known plan, and how far the objectives lie above it:",
            "",
            "| initial guess | best known | median excess | largest excess |",
            "| --- | --- | --- | --- |",
            *(line(name, index) for index, name in enumerate(names)),
            "",
        ]
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--righting", default=ROOT / "target/release/righting")
    parser.add_argument("--out", type=Path, default=ROOT / "docs/starts.md")
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    named = [(f"`{name}`", scenario(name)) for name in SHIPPED]
    for angle, axis, duration in LARGE_SLEWS:
        if axis is None:
            named.append((f"`slew{angle}_4dof`", scenario(f"slew{angle}_4dof")))
        else:
            asked = slew("4dof", angle, axis, duration, 600)
            named.append((f"4-DOF slew, {angle}° about {axis}, {duration} s", asked))
    further = [
        ((system, f"{angle}°", str(axis), f"{duration} s"), slew(system, angle, axis, duration, FURTHER_STEPS))
        for system, slews in FURTHER_SLEWS.items()
        for angle, duration in slews
        for axis in FURTHER_AXES
    ]
    with ThreadPoolExecutor(arguments.jobs) as pool:
        found = list(pool.map(lambda row: compared(arguments.righting, row[1]), named + further))
    named = [(name, row) for (name, _), row in zip(named, found)]
    further = [(name, row) for (name, _), row in zip(further, found[len(named) :])]
    arguments.out.write_text(report(named, further))


if __name__ == "__main__":
    main()
