"""Solving with progress."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import Any

from righting import _righting
from righting._progress import both, shown
from righting._righting import Iteration, Plan, Scenario


def solve(
    scenario: Scenario | str | os.PathLike[str] | Mapping[str, Any],
    *,
    warm_start: Plan | str | os.PathLike[str] | None = None,
    library: str | os.PathLike[str] | None = None,
    time_limit_s: float | None = None,
    threads: int | None = None,
    progress: bool | None = None,
    on_iteration: Callable[[Iteration], object] | None = None,
) -> Plan:
    """Plans a maneuver and verifies the plan by an independent model and integrator.

    Python's lock is released meanwhile, and Ctrl-C stops the solve. One solve runs at a time in a process; another
    thread waits for its turn.

    Parameters
    ----------
    scenario
        A `Scenario`, the path of a scenario file, or a mapping of what such a file holds.
    warm_start
        An earlier plan of the same arm (another angle, axis, duration, grid or mass), or its folder: one more start.
    library
        A folder of plans, each in a folder of its own: the nearest of the same arm and type is one more start.
    time_limit_s
        Stops after so many seconds, with ``plan.status == "time_limit"``.
    threads
        How many starts are compared at a time; one a core by default. The plan does not depend on it.
    progress
        Whether to show the iterations. By default they are shown in notebooks and on terminals, once a solve takes
        longer than a second.
    on_iteration
        Called with every `Iteration` that is seen. What it raises stops the solve and is raised here. It cannot solve
        anything itself.

    Returns
    -------
    Plan
        Also where the optimizer did not converge or the plan failed its verification: ``plan.verified`` says, and
        ``plan.raise_for_status()`` raises.

    Raises
    ------
    InputError, FileError
        Something is wrong with the scenario or an argument; ``field`` names it.
    ImpossibleError
        No motion of the arm makes the maneuver.
    NoPlanError
        There was nothing to optimize.
    """
    with ExitStack() as stack:
        return _righting.solve(
            scenario,
            warm_start=warm_start,
            library=library,
            time_limit_s=time_limit_s,
            threads=threads,
            on_iteration=both(on_iteration, shown(stack, progress)),
        )
