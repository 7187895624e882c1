#!/usr/bin/env python3
"""Kill `righting solve` (SIGKILL) at every call by which it touches its folder, and look at what is left.

A folder holds the plan of one slew; another is solved into it, and killed as it enters its first, second, … call of
`mkdir`, `openat`, `write`, `fdatasync`, `renameat`, `unlink`. Whatever is left must be the old plan whole, the new plan whole, or
no plan. Needs strace.

    scripts/kill_at_every_call.py --righting target/release/righting
"""

from __future__ import annotations

import argparse
import collections
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

CALLS = ("mkdir", "openat", "write", "fdatasync", "renameat", "unlink")
ROOT = Path(__file__).resolve().parent.parent
FILES = ("solution.json", "trajectory.csv")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--righting", type=Path, required=True)
    righting = parser.parse_args().righting.resolve()
    with tempfile.TemporaryDirectory() as folder:
        return tried(righting, Path(folder))


def tried(righting: Path, folder: Path) -> int:
    plans = {}
    for name, angle_deg in (("old", 2.0), ("new", 3.0)):
        scenario = small_slew(angle_deg)
        (folder / f"{name}.json").write_text(json.dumps(scenario), encoding="utf-8")
        subprocess.run(solve(righting, folder, name, name), check=True, capture_output=True)
        plans[name] = (folder / name / "trajectory.csv").read_bytes()
    calls = counted(righting, folder)
    left: collections.Counter[str] = collections.Counter()
    wrong = 0
    for call in CALLS:
        for number in range(1, calls[call] + 1):
            shutil.rmtree(folder / "out", ignore_errors=True)
            shutil.copytree(folder / "old", folder / "out")
            inject = ["-e", f"trace={call}", "-e", f"inject={call}:signal=KILL:when={number}"]
            command = ["strace", "-qq", "-o", "/dev/null", *inject, *solve(righting, folder, "new", "out")]
            subprocess.run(command, capture_output=True)
            found = judged(righting, folder, plans)
            left[found] += 1
            if found.startswith("WRONG"):
                wrong += 1
                print(f"{found} after {call} {number}", file=sys.stderr)
    print(f"{sum(left.values())} kills: " + ", ".join(f"{count} left {what}" for what, count in left.items()))
    return 1 if wrong else 0


def counted(righting: Path, folder: Path) -> collections.Counter[str]:
    """The calls of the thread that writes."""
    shutil.copytree(folder / "old", folder / "out")
    log = folder / "calls"
    command = ["strace", "-qq", "-o", str(log), "-e", f"trace={','.join(CALLS)}"]
    subprocess.run([*command, *solve(righting, folder, "new", "out")], check=True, capture_output=True)
    names = re.findall(r"^(\w+)\(", log.read_text(encoding="utf-8", errors="replace"), re.MULTILINE)
    return collections.Counter(names)


def judged(righting: Path, folder: Path, plans: dict[str, bytes]) -> str:
    """What is in the folder: the old plan, the new one, none, or what must not be."""
    out = folder / "out"
    for name in FILES:
        path = out / name
        if path.exists() and name == "trajectory.csv" and path.read_bytes() not in plans.values():
            return "WRONG: a table that is neither"
    code = subprocess.run([righting, "verify", out], capture_output=True).returncode
    if not (out / "solution.json").exists():
        return "no plan" if code == 2 else "WRONG: something that is verified without a solution"
    if code != 0:
        return f"WRONG: a plan that is not verified ({code})"
    (name,) = (name for name, table in plans.items() if table == (out / "trajectory.csv").read_bytes())
    return f"the {name} plan"


def solve(righting: Path, folder: Path, scenario: str, out: str) -> list[str]:
    return [str(righting), "solve", str(folder / f"{scenario}.json"), "--out", str(folder / out)]


def small_slew(angle_deg: float) -> dict:
    scenario = json.loads((ROOT / "scenarios" / "slew_2dof.json").read_text(encoding="utf-8"))
    scenario["system"] = json.loads((ROOT / "scenarios" / scenario["system"]).read_text(encoding="utf-8"))
    scenario["maneuver"]["angle_deg"] = angle_deg
    scenario["horizon"]["steps"] = 40
    return scenario


if __name__ == "__main__":
    sys.exit(main())
