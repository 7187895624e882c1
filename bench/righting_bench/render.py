"""docs/benchmarks.md out of the saved measurements."""

from __future__ import annotations

import math

from .compare import BEST_PAPER, BEST_REDUCED, MANEUVERS, PAPER, REDUCED, Solve
from .measurements import Measurements
from .ours import VARIANTS

MISSING = "-"


def render(kept: Measurements) -> str:
    """The whole page."""
    sections = [
        _head(kept),
        _like_for_like_table(kept),
        _best_table(kept, "CasADi given our reduced form", (REDUCED, *BEST_REDUCED)),
        _best_table(kept, "CasADi's best, the paper's form", BEST_PAPER),
        _paper_table(kept),
        _derivative_table(kept),
        _own_table(kept),
        _growth_tables(kept),
        _linear_solver_table(kept),
    ]
    return "\n\n".join(section for section in sections if section) + "\n"


def _head(kept: Measurements) -> str:
    used = {value["run"] for value in kept.values.values()}
    lines = [
        "# Benchmarks",
        "",
        "Written by `make bench` (a subset, under ten minutes) and `make bench-all` (everything, hours). Do "
        "not edit.",
        "",
        "All times are wall-clock seconds. *Ours* is `timing_s` trace + guess + solve of `righting solve`, "
        "from the parsed scenario to the trajectory. It is the median of runs just before and just after "
        "the CasADi run beside it. *Process* is the whole command with verification and files. CasADi's "
        "time is its solve call alone, the median of three where it is shorter than 1 s. Building and "
        "compiling come on top and have columns of their own. Compiled code is kept between runs: *compile* "
        "is the time of the run that made it, whatever else the machine did then. Both sides run with BLAS "
        "and OpenMP on one thread. *Ratio* is CasADi's time over ours.",
        "",
        "CasADi is set up as its experts would do it: stage functions as flattened SX expressions with "
        "common subexpressions removed, mapped over the stages; the exact Hessian; decision vector and "
        "constraints in stage order; squared distances. *Composed* derivatives are written by hand on top "
        "of CasADi: the Jacobian and Hessian of the Runge-Kutta step are put together from those of the "
        "differential equation, mapped, and given to nlpsol in place of its own. *Compiled* is CasADi's C "
        "code through `gcc -O3 -march=native`.",
        "",
    ]
    for run in sorted(used & kept.runs.keys()):
        machine = kept.runs[run]
        count = sum(value["run"] == run for value in kept.values.values())
        lines.append(
            f"- {run}: {machine['cpu']}, {machine['cores']} cores, {machine['system']}, "
            f"CasADi {machine['casadi']}, gcc {machine['gcc']}, load average "
            f"{machine['load']:.1f} at the start; {count} measurements"
        )
    versions = next(
        (
            value["versions"]
            for key, value in kept.values.items()
            if key.startswith("ours/") and value["versions"]
        ),
        None,
    )
    if versions:
        lines.append("- ours: " + ", ".join(f"{name} {version}" for name, version in versions.items()))
    return "\n".join(lines)


def _like_for_like_table(kept: Measurements) -> str:
    rows = []
    for solve in (*BEST_REDUCED, *BEST_PAPER, REDUCED, PAPER):
        rivals = [(name, theirs) for name in MANEUVERS if (theirs := kept.get(solve.key(name)))]
        cells = []
        for variant in LIKE_FOR_LIKE:
            label = f"{solve.form}, {variant}"
            is_alike = variant != "MUMPS, cold" or solve.solver == "ipopt"
            pairs = [(kept.get(f"ours/{name}/{label}"), theirs) for name, theirs in rivals if is_alike]
            cells.append(_spread([ratio for pair in pairs if (ratio := _ratio(*pair))]))
        whole = [ratio for _, theirs in rivals if (ratio := _ratio(theirs["ours"], theirs))]
        if whole:
            form = {"reduced": "momentum eliminated", "full": "the paper's"}[solve.form]
            rows.append([form, _casadi_setup(solve), *cells, _spread(whole)])
    if not rows:
        return ""
    header = ["form", "CasADi", *(f"ours: {what}" for what in LIKE_FOR_LIKE.values()), "ours: whole plan"]
    note = (
        "How many times as long CasADi takes, over the maneuvers measured: geometric mean (least to "
        "largest). Building and compiling on CasADi's side are not counted. In the columns *constant guess* "
        "both sides have the same form, the paper's guess and the same grid. They differ in evaluation, in "
        "the linear solver (*stage* is the factorisation that knows the stages), and in iterations where "
        "they end in different optima. *Whole plan* is what `righting solve` does by default: it compares "
        "initial guesses and refines the mesh, always in the form with the momentum eliminated."
    )
    return f"## Like for like\n\n{note}\n\n{_table(header, rows)}"


LIKE_FOR_LIKE = {"MUMPS, cold": "constant guess, MUMPS", "stage, cold": "constant guess, stage"}


def _spread(ratios: list[float]) -> str:
    """Geometric mean, least and largest."""
    if not ratios:
        return MISSING
    mean = math.exp(sum(math.log(ratio) for ratio in ratios) / len(ratios))
    return f"{_digits(mean)} ({_digits(min(ratios))} to {_digits(max(ratios))})"


def _digits(ratio: float) -> str:
    return f"{ratio:,.1f}" if ratio < 100 else f"{ratio:,.0f}"


def _casadi_setup(solve: Solve) -> str:
    return f"{solve.solver}, {'composed, compiled' if solve.compiled else 'as nlpsol derives'}"


def _paper_table(kept: Measurements) -> str:
    rows, ratios = [], []
    for name in MANEUVERS:
        theirs = kept.get(PAPER.key(name))
        ours = theirs["ours"] if theirs else kept.get(f"ours/{name}/default")
        if ratio := _ratio(ours, theirs):
            ratios.append(ratio)
        rows.append(
            [
                name,
                _seconds(ours, "plan_s"),
                _seconds(ours, "process_s"),
                _plain(ours, "iterations"),
                _objective(ours),
                _seconds(theirs, "solve_s"),
                _plain(theirs, "iterations"),
                _objective(theirs),
                _excess(ours, theirs),
                _ratio_text(ours, theirs),
            ]
        )
    table = _table(
        [
            "maneuver",
            "ours",
            "process",
            "iterations",
            "objective",
            "CasADi",
            "iterations",
            "objective",
            "ours above",
            "ratio",
        ],
        rows,
    )
    mean = ""
    if ratios:
        value = math.exp(sum(math.log(ratio) for ratio in ratios) / len(ratios))
        mean = f"\n\nGeometric mean of the {len(ratios)} ratios: {value:,.0f}; least: {min(ratios):,.0f}."
    title = "## CasADi + Ipopt in the paper's form"
    note = (
        "This is the script that people write today: 13 + 2j states, constant guess, Ipopt and MUMPS as "
        "shipped in CasADi's wheel, derivatives by nlpsol from mapped stage functions, nothing compiled. "
        "Most of the ratio is due to that set-up; the tables above say what is left of it with compiled "
        "derivatives."
    )
    return f"{title}\n\n{note}\n\n{table}{mean}"


def _best_table(kept: Measurements, title: str, solves: tuple[Solve, ...]) -> str:
    rows = []
    for name in MANEUVERS:
        for solve in solves:
            theirs = kept.get(solve.key(name))
            if theirs is None:
                continue
            ours = theirs["ours"]
            rows.append(
                [
                    name,
                    _casadi_setup(solve),
                    _seconds(theirs, "build_s"),
                    _seconds(theirs, "compile_s"),
                    _seconds(theirs, "solve_s"),
                    _plain(theirs, "iterations") if theirs["success"] else theirs["status"],
                    _objective(theirs),
                    _seconds(ours, "plan_s"),
                    _excess(ours, theirs),
                    _ratio_text(ours, theirs),
                ]
            )
    if not rows:
        return ""
    header = [
        "maneuver",
        "CasADi",
        "build",
        "compile",
        "solve",
        "iterations",
        "objective",
        "ours",
        "ours above",
        "ratio",
    ]
    return f"## {title}\n\n{_table(header, rows)}"


def _derivative_table(kept: Measurements) -> str:
    rows = []
    for name in MANEUVERS:
        for form in ("full", "reduced"):
            cells = [kept.get(f"derivatives/{name}/{form}/{variant}") for variant in DERIVATIVES]
            if not any(cells):
                continue
            labels = ("default", f"{form}, stage, cold", f"{form}, MUMPS, cold")
            ours = next((run for label in labels if (run := _per_iteration(kept, name, label, form))), None)
            times = [cell["jacobian_ms"] + cell["hessian_ms"] if cell else None for cell in cells]
            rows.append(
                [
                    name,
                    form,
                    *(f"{time:.2f}" if time else MISSING for time in times),
                    f"{ours:.2f}" if ours else MISSING,
                ]
            )
    if not rows:
        return ""
    header = ["maneuver", "form", *DERIVATIVES.values(), "ours, all evaluation"]
    note = (
        "Processor milliseconds for the constraint Jacobian and the Lagrangian Hessian of all stages, once, "
        "on one core. Ours is `timing_s` evaluate divided by iterations, so it includes every function "
        "evaluation of an iteration."
    )
    return f"## Derivatives of one iteration\n\n{note}\n\n{_table(header, rows)}"


DERIVATIVES = {
    "nlpsol": "as nlpsol derives",
    "mapped": "mapped stage function",
    "composed": "composed, mapped",
    "compiled": "composed, compiled",
}


def _per_iteration(kept: Measurements, name: str, label: str, form: str) -> float | None:
    run = kept.get(f"ours/{name}/{label}")
    if not run or not run["iterations"] or (label == "default" and form == "full"):
        return None
    spent = run["timing_s"].get("evaluate")
    return 1e3 * spent / run["iterations"] if spent else None


def _own_table(kept: Measurements) -> str:
    rows = []
    for name in MANEUVERS:
        for label in VARIANTS:
            run = kept.get(f"ours/{name}/{label}")
            if run is None:
                continue
            iterations = run["iterations"] or math.nan
            rows.append(
                [
                    name,
                    label,
                    _seconds(run, "plan_s"),
                    str(run["iterations"]),
                    _objective(run),
                    *(
                        f"{1e3 * run['timing_s'].get(part, math.nan) / iterations:.2f}"
                        for part in ("evaluate", "linear_algebra")
                    ),
                    f"{run['peak_mib']:.0f}",
                    "yes" if run["verified"] else run["status"],
                ]
            )
    if not rows:
        return ""
    header = [
        "maneuver",
        "variant",
        "ours",
        "iterations",
        "objective",
        "evaluate, ms/it.",
        "linear algebra, ms/it.",
        "peak MiB",
        "verified",
    ]
    note = (
        "*Cold* is the paper's constant guess, *continuation* the program's own choice of initial guess. "
        "Iterations are those of the asked grid. The optimizer named at the top of this page makes them, "
        "unless the variant names another; with MUMPS it is always Ipopt."
    )
    return f"## Inside ours\n\n{note}\n\n{_table(header, rows)}"


def _growth_tables(kept: Measurements) -> str:
    parts = []
    for kind, what in (
        ("joints", "joints: a 20° slew at N = 600, arms of one mass and reach"),
        ("steps", "the grid: the same slew"),
    ):
        rows = []
        for record in _numbered(kept, kind):
            plan, cold = record["plan"], record["cold"]
            each = cold["iteration_ms"]
            rows.append(
                [
                    *(str(record[number]) for number in ("joints", "steps")),
                    _seconds(plan, "plan_s"),
                    f"{plan['trace_s']:.3f}",
                    f"{plan['peak_mib']:.0f}",
                    str(cold["iterations"]),
                    *(f"{each[part]:.2f}" for part in ("evaluate", "linear_algebra", "optimizer", "total")),
                    f"{1e3 * each['total'] / record['steps']:.2f}",
                    f"{cold['peak_mib']:.0f}",
                    cold["status"],
                ]
            )
        if rows:
            header = [
                *("joints", "steps", "plan, s", "of it tracing, s", "peak MiB"),
                *("cold: iterations", "evaluate, ms/it.", "linear algebra, ms/it.", "vectors, ms/it."),
                *("total, ms/it.", "total, µs/it. and step", "peak MiB, cold", "status"),
            ]
            parts.append(f"## Growth with {what}\n\n{_table(header, rows)}")
    return "\n\n".join(parts)


def _numbered(kept: Measurements, kind: str) -> list[dict]:
    """The records of one kind in the order of joints and steps."""
    found = [value for key, value in kept.values.items() if key.startswith(f"{kind}/")]
    return sorted(found, key=lambda record: (record["joints"], record["steps"]))


def _linear_solver_table(kept: Measurements) -> str:
    rows = []
    for key, record in sorted(kept.values.items()):
        if not key.startswith("linear-solvers/") or not record["ratio"]:
            continue
        stage, mumps, ratio = record["stage"], record["mumps"], record["ratio"]
        rows.append(
            [
                record["scenario"],
                *(str(run["iterations"]) for run in (stage, mumps)),
                *(f"{1e3 * run['augmented_system_cpu_s'] / run['iterations']:.2f}" for run in (stage, mumps)),
                f"{ratio['augmented_system']:.1f}",
                f"{ratio['factor_and_solve']:.1f}",
            ]
        )
    if not rows:
        return ""
    header = [
        "maneuver",
        "iterations, stage",
        "MUMPS",
        "stage, ms/it.",
        "MUMPS, ms/it.",
        "ratio",
        "ratio, KKT alone",
    ]
    note = (
        "Reduced form, N = 600, constant guess. The times are processor time by Ipopt's own clocks, for "
        "assembling, factorising and solving its augmented systems. *KKT alone* leaves out the assembling, "
        "which is the same for both."
    )
    return f"## The stage solver and MUMPS on the same systems\n\n{note}\n\n{_table(header, rows)}"


def _table(header: list[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "| --- |" + " ---: |" * (len(header) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def _ratio(ours: dict | None, theirs: dict | None) -> float | None:
    """How many times longer CasADi takes; none when either side has no sound plan to show."""
    if not ours or not theirs or not theirs["success"] or not ours["verified"]:
        return None
    return theirs["solve_s"] / ours["plan_s"]


def _ratio_text(ours: dict | None, theirs: dict | None) -> str:
    ratio = _ratio(ours, theirs)
    if ratio is None:
        return MISSING
    return _digits(ratio)


def _excess(ours: dict | None, theirs: dict | None) -> str:
    """How far our objective lies above CasADi's, negative when it is better."""
    if not ours or not theirs or not ours.get("objective") or not theirs["success"]:
        return MISSING
    return f"{100 * (ours['objective'] / theirs['objective'] - 1):+.3f} %"


def _seconds(value: dict | None, field: str) -> str:
    if not value or value.get(field) is None:
        return MISSING
    seconds = value[field]
    return f"{seconds:.0f}" if seconds >= 100 else f"{seconds:.3g}"


def _plain(value: dict | None, field: str) -> str:
    return str(value[field]) if value else MISSING


def _objective(value: dict | None) -> str:
    return f"{value['objective']:.6g}" if value and value.get("objective") is not None else MISSING
