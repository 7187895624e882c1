"""What the tests share: the scenarios of the repository, and one plan."""

from __future__ import annotations

from pathlib import Path

import pytest
import righting as rt

SCENARIOS = Path(__file__).parents[2] / "scenarios"


@pytest.fixture(scope="session")
def scenarios() -> Path:
    return SCENARIOS


@pytest.fixture(scope="session")
def plan() -> rt.Plan:
    """The paper's 4-DOF slew."""
    return rt.solve(SCENARIOS / "slew_4dof.json")
