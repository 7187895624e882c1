"""Command line of the comparison."""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
from pathlib import Path

from .compare import MANEUVERS, TABLES, Scope, compare
from .evaluation import evaluation_times
from .expected import write_expected
from .measurements import Measurements
from .render import render
from .scenario import load_scenario
from .solve import Setup, solve

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "results"
CACHE = RESULTS / "compiled"


def main(arguments: list[str] | None = None) -> int:
    """Run one command; the exit code is 0 when it did what was asked."""
    options = _parser().parse_args(arguments)
    return options.run(options)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="righting_bench", description=__doc__)
    commands = parser.add_subparsers(required=True)

    casadi = commands.add_parser("casadi", help="solve one scenario with CasADi")
    casadi.add_argument("scenario", type=Path)
    casadi.add_argument("--form", choices=["full", "reduced"], help="default: the scenario's")
    casadi.add_argument("--solver", choices=["ipopt", "fatrop"], default="ipopt")
    casadi.add_argument("--derivatives", choices=["nlpsol", "composed"], default="nlpsol")
    casadi.add_argument("--compile", action="store_true", help="stage functions as C, -O3 -march=native")
    casadi.add_argument("--print-level", type=int, default=0)
    casadi.add_argument("--json", action="store_true", help="one JSON object instead of lines")
    casadi.set_defaults(run=_casadi)

    derivatives = commands.add_parser("derivatives", help="time one iteration's derivatives in CasADi")
    derivatives.add_argument("scenario", type=Path)
    derivatives.add_argument("--form", choices=["full", "reduced"], help="default: the scenario's")
    derivatives.add_argument(
        "--variants", nargs="+", choices=VARIANTS, default=VARIANTS, help="default: all of them"
    )
    derivatives.add_argument("--json", action="store_true")
    derivatives.set_defaults(run=_derivatives)

    comparison = commands.add_parser("compare", help="run ours and CasADi in turn and render the tables")
    comparison.add_argument("--all", action="store_true", help="every maneuver; takes hours")
    comparison.add_argument("--only", nargs="+", metavar="NAME", choices=MANEUVERS, help="these, completely")
    comparison.add_argument("--righting", type=Path, default=ROOT / "target/release/righting")
    comparison.add_argument("--tables", nargs="+", choices=TABLES, help="default: all of them")
    comparison.set_defaults(run=_compare)

    rendering = commands.add_parser("render", help="render docs/benchmarks.md from the saved results")
    rendering.set_defaults(run=_render)

    expected = commands.add_parser("expected", help="write CasADi's objectives as a fixture")
    expected.set_defaults(run=_expected)
    return parser


VARIANTS = ["nlpsol", "mapped", "composed", "compiled"]


def _casadi(options: argparse.Namespace) -> int:
    scenario = load_scenario(options.scenario)
    setup = Setup(
        form=options.form or scenario.formulation,
        solver=options.solver,
        derivatives=options.derivatives,
        compile=options.compile,
        print_level=options.print_level,
    )
    outcome = solve(scenario, setup, CACHE)
    _print(dataclasses.asdict(outcome), options.json)
    return 0 if outcome.success else 3


def _derivatives(options: argparse.Namespace) -> int:
    scenario = load_scenario(options.scenario)
    times = evaluation_times(scenario, options.form or scenario.formulation, options.variants, CACHE)
    if options.json:
        print(json.dumps([dataclasses.asdict(one) for one in times]))
        return 0
    for one in times:
        print(
            f"{one.scenario} {one.form} {one.variant}: Jacobian {one.jacobian_ms:.2f} ms, "
            f"Hessian {one.hessian_ms:.2f} ms, together {one.total_ms:.2f} ms, "
            f"instructions a stage {one.stage_instructions or '-'}, compiled in {one.compile_s:.1f} s"
        )
    return 0


def _compare(options: argparse.Namespace) -> int:
    if not options.righting.exists():
        print(f"no program at {options.righting}; build it with cargo build --release", file=sys.stderr)
        return 2
    scope = Scope(
        names=tuple(options.only or MANEUVERS),
        tables=tuple(options.tables or (table for table in TABLES if not options.only or table != "growth")),
        quick=not (options.all or options.only),
    )
    compare(ROOT, options.righting, scope)
    return _render(options)


def _render(_: argparse.Namespace) -> int:
    page = ROOT / "docs" / "benchmarks.md"
    page.parent.mkdir(exist_ok=True)
    page.write_text(render(Measurements.load(RESULTS)))
    print(f"wrote {page.relative_to(ROOT)}", file=sys.stderr)
    return 0


def _expected(_: argparse.Namespace) -> int:
    path = ROOT / "bench" / "reference" / "objectives.json"
    write_expected(Measurements.load(RESULTS), path)
    print(f"wrote {path.relative_to(ROOT)}", file=sys.stderr)
    return 0


def _print(values: dict, as_json: bool) -> None:
    if as_json:
        print(json.dumps(values))
        return
    for name, value in values.items():
        print(f"{name:20} {value}")


if __name__ == "__main__":
    sys.exit(main())
