"""CasADi's objectives as a small fixture that tests compare plans with."""

from __future__ import annotations

import json
from pathlib import Path

from .measurements import Measurements

FIELDS = (
    "objective",
    "iterations",
    "status",
    "attitude_error",
    "angular_rate_deg_s",
    "joint_rate_deg_s",
)


def write_expected(kept: Measurements, path: Path) -> None:
    """Update the objectives by every converged Ipopt solve kept, those with nlpsol's derivatives first."""
    table: dict[str, dict[str, dict]] = {}
    if path.exists():
        table = json.loads(path.read_text())["objectives"]
    for key, value in sorted(kept.values.items()):
        kind, name, form, *how = key.split("/")
        if kind != "casadi" or not value["success"] or how[0] != "ipopt":
            continue
        entry = {field: value[field] for field in FIELDS}
        entry["derivatives"] = "/".join(how[1:])
        known = table.setdefault(name, {}).get(form)
        if known is None or how[1:] == ["nlpsol"]:
            table[name][form] = entry
    path.parent.mkdir(exist_ok=True)
    page = {
        "source": "CasADi 3.8.2 with Ipopt and MUMPS as shipped in its wheel, default tolerances, N = 600",
        "problem": "direct multiple shooting, RK4, exact Hessian, constant guess (x_0 held, no control); "
        "squared distances to every link not exempt and to every pair of links that share no joint",
        "form": "full: 13 + 2j states; reduced: 4 + 2j states, momentum eliminated",
        "made_by": "python -m righting_bench expected",
        "objectives": {name: table[name] for name in sorted(table)},
    }
    path.write_text(json.dumps(page, indent=1) + "\n")
