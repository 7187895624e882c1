"""Runs of the `righting` program as a user would make them, timed from outside and by itself."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

# solver fields of each variant; "default" leaves the scenario as it is.
VARIANTS: dict[str, dict[str, str]] = {
    "default": {},
    "full, MUMPS, cold": {"formulation": "full", "linear_solver": "mumps", "guess": "constant"},
    "full, stage, cold": {"formulation": "full", "linear_solver": "stage", "guess": "constant"},
    "full, stage, continuation": {"formulation": "full", "linear_solver": "stage", "guess": "auto"},
    "reduced, MUMPS, cold": {"formulation": "reduced", "linear_solver": "mumps", "guess": "constant"},
    "reduced, stage, cold": {"formulation": "reduced", "linear_solver": "stage", "guess": "constant"},
    "reduced, stage, continuation": {"formulation": "reduced", "linear_solver": "stage", "guess": "auto"},
    "reduced, stage, continuation, all by interior": {
        "formulation": "reduced",
        "linear_solver": "stage",
        "guess": "auto",
        "optimizer": "interior",
    },
}


@dataclass(frozen=True)
class OurRun:
    """One run of the program: its own account, the whole process by the clock, and its peak memory."""

    exit_code: int
    status: str
    objective: float | None
    iterations: int
    verified: bool
    timing_s: dict[str, float]
    process_s: float
    peak_mib: float
    versions: dict[str, str]

    @property
    def plan_s(self) -> float:
        """From parsed scenario to trajectory: tracing, guessing and solving."""
        return sum(self.timing_s[name] for name in ("trace", "guess", "solve"))


def inlined(path: Path, solver: dict[str, str]) -> dict:
    """A scenario with its system inline and some of its solver fields replaced."""
    raw = json.loads(path.read_text())
    if isinstance(raw["system"], str):
        raw["system"] = json.loads((path.parent / raw["system"]).read_text())
    raw["solver"] = {**raw.get("solver", {}), **solver}
    return raw


def run_ours(program: Path, scenario: dict) -> OurRun:
    """Plan one scenario in a fresh process."""
    with tempfile.TemporaryDirectory() as folder:
        source, out = Path(folder, "scenario.json"), Path(folder, "out")
        source.write_text(json.dumps(scenario))
        begun = time.perf_counter()
        child = subprocess.Popen(
            [program, "solve", source, "--out", out, "--json"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        _, status, usage = os.wait4(child.pid, 0)
        process_s = time.perf_counter() - begun
        child.returncode = os.waitstatus_to_exitcode(status)
        solution = out / "solution.json"
        raw = json.loads(solution.read_text()) if solution.exists() else {}
    return OurRun(
        exit_code=child.returncode,
        status=raw.get("status", "no result"),
        objective=raw.get("objective"),
        iterations=raw.get("iterations", 0),
        verified=raw.get("verification", {}).get("passed", False),
        timing_s={**dict.fromkeys(("trace", "guess", "solve"), 0.0), **raw.get("timing_s", {})},
        process_s=process_s,
        peak_mib=usage.ru_maxrss / 1024,
        versions=raw.get("versions", {}),
    )


def summarise(runs: list[OurRun]) -> dict:
    """The run of median planning time as a record, with the spread of all."""
    ordered = sorted(runs, key=lambda run: run.plan_s)
    middle = ordered[len(ordered) // 2]
    return {
        "exit_code": middle.exit_code,
        "status": middle.status,
        "objective": middle.objective,
        "iterations": middle.iterations,
        "verified": all(run.verified for run in runs),
        "timing_s": middle.timing_s,
        "plan_s": middle.plan_s,
        "plan_s_range": [ordered[0].plan_s, ordered[-1].plan_s],
        "process_s": statistics.median(run.process_s for run in runs),
        "peak_mib": max(run.peak_mib for run in runs),
        "runs": len(runs),
        "versions": middle.versions,
    }
