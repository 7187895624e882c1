#!/usr/bin/env python3
"""Plan the maneuvers of tests/cases and compare what comes of each with what is right.

tests/cases/expected.json says for every file: `exit` (the exit code), and where it matters `effort` (sum of
squared joint accelerations over the steps, rad^2/s^4, the best known; at most `within` above it), `rate_deg_s`
(the base's rate that a detumble may leave at the most) and `says` (what the messages or notes must contain).
Needs nothing but Python. Exit code 1 when anything is otherwise.
"""

from __future__ import annotations

import argparse
import csv
import json
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CASES = ROOT / "tests" / "cases"
TIME_LIMIT_S = 180


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("names", nargs="*", help="these cases; all by default")
    options.add_argument("--righting", type=Path, default=ROOT / "target/release/righting")
    options.add_argument("--out", type=Path, default=ROOT / "out/cases")
    options = options.parse_args()
    expected = json.loads((CASES / "expected.json").read_text(encoding="utf-8"))
    names = options.names or sorted(path.stem for path in CASES.glob("*.json") if path.stem != "expected")
    wrong = 0
    for name in names:
        problems, facts = judged(options, name, expected.get(name))
        wrong += bool(problems)
        print(f"{'WRONG' if problems else 'ok':5}  {name:32} {facts}")
        for problem in problems:
            print(f"       {problem}")
    print(f"{len(names) - wrong} of {len(names)} as they should be")
    return 1 if wrong else 0


def judged(options: argparse.Namespace, name: str, right: dict | None) -> tuple[list[str], str]:
    """What is not right, and what is to be known of the run."""
    out = options.out / name
    command = [options.righting, "solve", CASES / f"{name}.json", "--out", out, "--json", "--no-report"]
    started = time.monotonic()
    try:
        done = subprocess.run(
            [*command, "--figures", "none"], capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False
        )
    except subprocess.TimeoutExpired:
        return [f"no end in {TIME_LIMIT_S} s"], ""
    seconds = time.monotonic() - started
    said = done.stderr
    facts = f"exit {done.returncode}, {seconds:.2f} s"
    effort = rate_deg_s = None
    try:
        solution = json.loads(done.stdout)
    except json.JSONDecodeError:
        solution = {}
    if (out / "trajectory.csv").exists() and "terminal" in solution:
        said += "\n".join(solution.get("notes", []))
        with open(out / "trajectory.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))[:-1]
        controls = [key for key in rows[0] if key.startswith("u")]
        effort = sum(float(row[key]) ** 2 for row in rows for key in controls)
        rate_deg_s = solution["terminal"]["angular_rate_deg_s"]
        facts += f", {solution['status']}, sum u^2 {effort:.4e}, rate {rate_deg_s:.4f} deg/s"
        facts += f" (bound {solution['bound_deg_s']:.4f})" if solution.get("bound_deg_s") else ""
    if right is None:
        return ["nothing is expected of it"], facts
    problems = []
    if done.returncode != right["exit"]:
        problems.append(f"exit code {done.returncode}, expected {right['exit']}: {said.strip()[:600]}")
    if "effort" in right and effort is not None:
        most = right["effort"] * (1 + right.get("within", 0.01))
        if effort > most:
            problems.append(f"sum u^2 {effort:.4e}, best known {right['effort']:.4e}")
    if "rate_deg_s" in right and rate_deg_s is not None and rate_deg_s > right["rate_deg_s"]:
        problems.append(f"rate {rate_deg_s:.4f} deg/s, expected at most {right['rate_deg_s']}")
    for words in right.get("says", []):
        if words not in said:
            problems.append(f"does not say {words!r}: {said.strip()[:400]}")
    return problems, facts


if __name__ == "__main__":
    sys.exit(main())
