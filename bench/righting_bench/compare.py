"""Ours and CasADi in turn on one machine, every measurement in a process of its own."""

from __future__ import annotations

import dataclasses
import datetime
import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from .machine import this_machine
from .measurements import Measurements, casadi_key
from .ours import VARIANTS, OurRun, inlined, run_ours, summarise

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
REPEATS = 9
# A CasADi solve shorter than this, in seconds, is as easily disturbed as ours: the median of as many runs.
SHORT_S = 1.0
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


# What a run can measure, as in the tables of docs/benchmarks.md.
TABLES = ("paper", "best", "reduced", "derivatives", "inside", "growth")


@dataclass(frozen=True)
class Scope:
    """What one run measures: every table of the named maneuvers, or the quick subset of all."""

    names: tuple[str, ...] = MANEUVERS
    tables: tuple[str, ...] = TABLES
    quick: bool = True

    def solves(self, name: str) -> Iterator[Solve]:
        """What CasADi is asked about a maneuver."""
        if not self.quick or name in QUICK_PAPER:
            yield from (PAPER,) if "paper" in self.tables else ()
            yield from BEST_PAPER if "best" in self.tables else ()
        if (not self.quick or name in QUICK_REDUCED) and "reduced" in self.tables:
            yield REDUCED
            yield from BEST_REDUCED

    def variants(self, name: str) -> dict[str, dict[str, str]]:
        """Ours with other solver fields."""
        if "inside" not in self.tables or (self.quick and name not in QUICK_REDUCED):
            return {}
        return {label: solver for label, solver in VARIANTS.items() if label != "default"}

    def derivatives(self, name: str) -> Iterator[tuple[str, list[str]]]:
        """Forms and ways of evaluating CasADi's derivatives."""
        every = ["nlpsol", "mapped", "composed", "compiled"]
        if "derivatives" not in self.tables:
            return
        if not self.quick or name in QUICK_PAPER:
            yield "full", every
        if not self.quick or name in QUICK_REDUCED:
            yield "reduced", every
        elif name == "slew_canadarm2":
            yield "reduced", ["nlpsol", "mapped"]


def compare(root: Path, program: Path, scope: Scope) -> None:
    """Measure what the scope covers and keep it under results/."""
    kept = Measurements.load(root / "results")
    run = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    machine = this_machine()
    if machine.load > BUSY:
        _announce(f"warning: load average {machine.load:.1f}, the times will be too long")
    kept.runs[run] = dataclasses.asdict(machine)
    for name in scope.names:
        path = root / "scenarios" / f"{name}.json"
        ours = partial(_repeated, program, inlined(path, {}))
        before = ours()
        kept.keep(run, f"ours/{name}/default", summarise(before))
        for solve in scope.solves(name):
            _announce(solve.key(name))
            outcome = _median_solve(root, ["casadi", str(path), *solve.arguments(), "--json"])
            after = ours()
            if outcome:
                kept.keep(run, solve.key(name), {**outcome, "ours": summarise(before + after)})
            before = after
        for label, solver in scope.variants(name).items():
            _announce(f"ours/{name}/{label}")
            kept.keep(run, f"ours/{name}/{label}", summarise(_repeated(program, inlined(path, solver))))
        for form, variants in scope.derivatives(name):
            _announce(f"derivatives/{name}/{form}")
            arguments = ["derivatives", str(path), "--form", form, "--variants", *variants, "--json"]
            for one in _casadi(root, arguments) or []:
                kept.keep(run, f"derivatives/{name}/{form}/{one['variant']}", one)
    if "growth" in scope.tables:
        _growth(root, program, kept, run)


def _repeated(program: Path, scenario: dict) -> list[OurRun]:
    return [run_ours(program, scenario) for _ in range(REPEATS)]


def _growth(root: Path, program: Path, kept: Measurements, run: str) -> None:
    """What grows and how the linear solvers compare, by the example `costs` beside the program."""
    costs = program.parent / "examples" / "costs"
    if not costs.exists():
        _announce(f"no program at {costs}: no growth")
        return
    for kind, keys in (
        ("joints", ("joints",)),
        ("steps", ("joints", "steps")),
        ("linear-solvers", ("scenario",)),
    ):
        _announce(f"ours, {kind}")
        done = subprocess.run([costs, kind], cwd=root, stdout=subprocess.PIPE, text=True, check=False)
        for line in done.stdout.splitlines():
            record = json.loads(line)
            kept.keep(run, "/".join((kind, *(str(record[key]) for key in keys))), record)


def _median_solve(root: Path, arguments: list[str]) -> dict | None:
    """The outcome of one solve; of a short one that of median length among several."""
    first = _casadi(root, arguments)
    if not first or first["solve_s"] >= SHORT_S:
        return first
    again = [_casadi(root, arguments) for _ in range(REPEATS - 1)]
    outcomes = sorted((one for one in (first, *again) if one), key=lambda one: one["solve_s"])
    return outcomes[len(outcomes) // 2]


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
