"""Plans how a free-floating spacecraft turns itself with nothing but its robot arm.

>>> import righting as rt
>>> plan = rt.solve("scenarios/slew_4dof.json")        # doctest: +SKIP
>>> plan.verified, plan.time_s.shape, plan.quaternion.shape, plan.joint_angles_rad.shape   # doctest: +SKIP
(True, (601,), (601, 4), (601, 4))

SI units and radians inside; degrees stand only where a name says so (``_deg``), as in scenario files. Quaternions are
Hamilton, scalar first, and turn body vectors into inertial ones.

One solve runs at a time in a process: MUMPS is not thread-safe. Other threads wait for their turn, with Python's lock
released. Sweeps use processes of their own.
"""

from __future__ import annotations

from righting._reach import reach
from righting._righting import (
    Check,
    Comparison,
    Envelope,
    Envelopes,
    Flights,
    Function,
    Iteration,
    Plan,
    Power,
    Reach,
    Scenario,
    System,
    Verification,
    __version__,
    compare,
    envelope,
    schema,
)
from righting._solve import solve
from righting._sweep import SweepResults, sweep
from righting.errors import (
    FileError,
    ImpossibleError,
    InputError,
    NoPlanError,
    NotReadyError,
    RightingError,
    VerificationError,
)

__all__ = [
    "Check",
    "Comparison",
    "Envelope",
    "Envelopes",
    "FileError",
    "Flights",
    "Function",
    "ImpossibleError",
    "InputError",
    "Iteration",
    "NoPlanError",
    "NotReadyError",
    "Plan",
    "Power",
    "Reach",
    "RightingError",
    "Scenario",
    "SweepResults",
    "System",
    "Verification",
    "VerificationError",
    "__version__",
    "compare",
    "envelope",
    "reach",
    "schema",
    "solve",
    "sweep",
]
