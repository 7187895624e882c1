"""Ours and CasADi in turn on one machine, every measurement in a process of its own."""

from __future__ import annotations

import dataclasses
import datetime
import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from .machine import this_machine
from .measurements import Measurements, casadi_key
from .ours import VARIANTS, inlined, run_ours, summarise

MANEUVERS = (
    "slew_2dof",
    "detumble_2dof",
    "slew_4dof",
    "detumble_4dof",
    "slew_canadarm2_table",
    "detumble_canadarm2_table",
    "slew_canadarm2",
    "detumble_canadarm2",
)
# What fits in ten minutes: the paper's form only where CasADi needs about a minute.
QUICK_PAPER = ("slew_2dof", "detumble_2dof")
QUICK_REDUCED = ("slew_2dof", "detumble_2dof", "slew_4dof")
# Runs of ours before and again after each CasADi run.
REPEATS = 2
# Load average above which wall-clock times are no longer this program's alone.
BUSY = 0.5


@dataclass(frozen=True)
class Solve:
    """One way to ask CasADi."""

    form: str
    solver: str
    derivatives: str
    compiled: bool

    def key(self, name: str) -> str:
        """Where its result is kept."""
        return casadi_key(name, self.form, self.solver, self.derivatives, self.compiled)

    def arguments(self) -> list[str]:
        """The same as a command line."""
        asked = ["--form", self.form, "--solver", self.solver, "--derivatives", self.derivatives]
        return [*asked, *(["--compile"] if self.compiled else [])]


PAPER = Solve("full", "ipopt", "nlpsol", compiled=False)
BEST_PAPER = tuple(Solve("full", solver, "composed", compiled=True) for solver in ("ipopt", "fatrop"))
REDUCED = Solve("reduced", "ipopt", "nlpsol", compiled=False)
BEST_REDUCED = tuple(Solve("reduced", solver, "composed", compiled=True) for solver in ("ipopt", "fatrop"))


def compare(root: Path, program: Path, only: list[str] | None, everything: bool, part: str) -> None:
    """Measure what a run covers and keep it under results/.

    `part` is "both", or "ours" or "casadi" to refresh one side alone.
    """
    kept = Measurements.load(root / "results")
    run = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    machine = this_machine()
    if machine.load > BUSY:
        _announce(f"warning: load average {machine.load:.1f}, the times will be too long")
    kept.runs[run] = dataclasses.asdict(machine)
    names = only or MANEUVERS
    complete = everything or bool(only)
    for name in names:
        path = root / "scenarios" / f"{name}.json"
        solves = [] if part == "ours" else list(_solves(name, complete))
        repeats = 0 if part == "casadi" else REPEATS
        runs = [run_ours(program, inlined(path, {})) for _ in range(repeats)]
        for solve in solves:
            _announce(solve.key(name))
            outcome = _casadi(root, ["casadi", str(path), *solve.arguments(), "--json"])
            if outcome:
                kept.keep(run, solve.key(name), outcome)
            runs += [run_ours(program, inlined(path, {})) for _ in range(repeats)]
        if runs:
            kept.keep(run, f"ours/{name}/default", summarise(runs))
        if repeats and (complete or name in QUICK_REDUCED):
            for label, solver in VARIANTS.items():
                if label == "default":
                    continue
                _announce(f"ours/{name}/{label}")
                runs = [run_ours(program, inlined(path, solver)) for _ in range(repeats)]
                kept.keep(run, f"ours/{name}/{label}", summarise(runs))
        for form, variants in () if part == "ours" else _derivatives(name, complete):
            _announce(f"derivatives/{name}/{form}")
            arguments = ["derivatives", str(path), "--form", form, "--variants", *variants, "--json"]
            for one in _casadi(root, arguments) or []:
                kept.keep(run, f"derivatives/{name}/{form}/{one['variant']}", one)
    if not only and part != "casadi":
        _growth(root, program, kept, run)


def _solves(name: str, complete: bool) -> Iterator[Solve]:
    if complete or name in QUICK_PAPER:
        yield PAPER
        yield from BEST_PAPER
    if complete or name in QUICK_REDUCED:
        yield REDUCED
        yield from BEST_REDUCED


def _derivatives(name: str, complete: bool) -> Iterator[tuple[str, list[str]]]:
    if complete or name in QUICK_PAPER:
        yield "full", ["nlpsol", "mapped", "composed", "compiled"]
    if complete or name in QUICK_REDUCED:
        yield "reduced", ["nlpsol", "mapped", "composed", "compiled"]
    elif name == "slew_canadarm2":
        yield "reduced", ["nlpsol", "mapped"]


def _growth(root: Path, program: Path, kept: Measurements, run: str) -> None:
    """What grows and how the linear solvers compare, by the example `costs` beside the program."""
    costs = program.parent / "examples" / "costs"
    if not costs.exists():
        _announce(f"no program at {costs}: no growth")
        return
    for kind, key in (("joints", "joints"), ("steps", "steps"), ("linear-solvers", "scenario")):
        _announce(f"ours, {kind}")
        done = subprocess.run([costs, kind], cwd=root, stdout=subprocess.PIPE, text=True, check=False)
        for line in done.stdout.splitlines():
            record = json.loads(line)
            kept.keep(run, f"{kind}/{record[key]}", record)


def _casadi(root: Path, arguments: list[str]) -> dict | list | None:
    """One command of this package in a fresh process; nothing when it fails without an answer."""
    done = subprocess.run(
        [sys.executable, "-m", "righting_bench", *arguments],
        cwd=root / "bench",
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    # Ipopt and fatrop may print a banner of their own before the answer.
    lines = [line for line in done.stdout.splitlines() if line.startswith(("{", "["))]
    if not lines:
        print(f"no answer (exit code {done.returncode})", file=sys.stderr)
        return None
    return json.loads(lines[-1])


def _announce(what: str) -> None:
    print(what, file=sys.stderr, flush=True)
