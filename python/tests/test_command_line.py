"""The same plan from Python and from the command line, whose program RIGHTING names."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import pytest
import righting as rt

PROGRAM = os.environ.get("RIGHTING")


@pytest.mark.skipif(PROGRAM is None, reason="RIGHTING names no program")
@pytest.mark.parametrize("name", ["slew_4dof", "detumble_2dof", "real/slew_4dof_fastest"])
def test_the_plan_is_that_of_the_command_line_bit_for_bit(scenarios: Path, tmp_path: Path, name: str) -> None:
    scenario, theirs, ours = scenarios / f"{name}.json", tmp_path / "theirs", tmp_path / "ours"
    command = [str(PROGRAM), "solve", str(scenario), "--out", str(theirs), "--figures", "none"]
    subprocess.run(command, check=True, capture_output=True)
    rt.solve(scenario).save(ours)
    tables = [(folder / "trajectory.csv").read_bytes() for folder in (theirs, ours)]
    assert tables[0] == tables[1]
    solutions = [json.loads((folder / "solution.json").read_text()) for folder in (theirs, ours)]
    for key in ("scenario", "status", "objective", "iterations", "terminal", "verification", "notes"):
        assert solutions[0].get(key) == solutions[1].get(key), key
