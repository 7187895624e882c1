"""The search for what is possible, with progress."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import Any, Literal

from righting import _righting
from righting._progress import both, shown
from righting._righting import Iteration, Reach, Scenario


def reach(
    scenario: Scenario | str | os.PathLike[str] | Mapping[str, Any],
    what: Literal["duration", "angle"] = "duration",
    *,
    resolution: float | None = None,
    within_percent: float | None = None,
    starts: int = 0,
    progress: bool | None = None,
    on_iteration: Callable[[Iteration], object] | None = None,
) -> Reach:
    """Finds the shortest duration in which a maneuver succeeds, or the largest angle of a slew.

    A slew succeeds when its plan is verified; a detumble when in addition the rate it leaves is within some percent of
    the least that momentum allows. A value counts as failed once it has failed from the nearest success and from the
    scenario's own guess.

    Parameters
    ----------
    scenario
        A `Scenario`, the path of a scenario file, or a mapping of what such a file holds.
    what
        ``"duration"`` or ``"angle"``.
    resolution
        How close to find the edge: durations in percent, 1 by default; angles in degrees, 0.5.
    within_percent
        Detumble: how many percent above the bound the rate left may be; 2 by default.
    starts
        So many more initial guesses are tried before a value counts as failed.
    progress, on_iteration
        As of `solve`.

    Raises
    ------
    InputError, FileError
        Something is wrong with the scenario or an argument; ``field`` names it.
    ImpossibleError
        No motion of the arm makes any of the maneuvers tried.
    """
    with ExitStack() as stack:
        return _righting.reach(
            scenario,
            what,
            resolution=resolution,
            within_percent=within_percent,
            starts=starts,
            on_iteration=both(on_iteration, shown(stack, progress)),
        )
