"""Measurements kept between runs: each under its key, with the run it came from."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

FILE = "measurements.json"


@dataclass
class Measurements:
    """Everything measured so far, newest by key.

    A key is "casadi/SCENARIO/FORM/SOLVER/DERIVATIVES[/compiled]", "derivatives/SCENARIO/FORM/VARIANT",
    "ours/SCENARIO/VARIANT", "joints/J", "steps/J/N" or "linear-solvers/SCENARIO". Each value carries `run`,
    the start of the run that measured it.
    """

    folder: Path
    runs: dict[str, dict] = field(default_factory=dict)
    values: dict[str, dict] = field(default_factory=dict)

    @staticmethod
    def load(folder: Path) -> Measurements:
        """Read what is there; nothing there is no error."""
        path = folder / FILE
        if not path.exists():
            return Measurements(folder)
        raw = json.loads(path.read_text())
        return Measurements(folder, raw["runs"], raw["values"])

    def keep(self, run: str, key: str, value: dict) -> None:
        """Store one measurement and save at once, so that an interrupted run loses nothing."""
        self.values[key] = {**value, "run": run}
        self.folder.mkdir(parents=True, exist_ok=True)
        temporary = self.folder / f"{FILE}.tmp"
        temporary.write_text(json.dumps({"runs": self.runs, "values": self.values}, indent=1))
        temporary.replace(self.folder / FILE)

    def get(self, key: str) -> dict | None:
        """The newest measurement under a key."""
        return self.values.get(key)


def casadi_key(name: str, form: str, solver: str, derivatives: str, compiled: bool) -> str:
    """Key of a CasADi solve."""
    return "/".join(["casadi", name, form, solver, derivatives, *(["compiled"] if compiled else [])])
