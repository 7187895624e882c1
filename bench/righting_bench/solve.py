"""One CasADi solve of a scenario, timed apart: build, compile and the solve call alone."""

from __future__ import annotations

import dataclasses
import time
from dataclasses import dataclass
from pathlib import Path

import casadi as ca
import numpy as np

from .compiled import FLAGS, compile_functions
from .distance import checked_clearances
from .nlp_derivatives import derivative_functions
from .problem import StageProblem, stage_problem
from .scenario import Scenario
from .stage_derivatives import StageDerivatives, composed_derivatives
from .transcription import transcribe


@dataclass(frozen=True)
class Setup:
    """How CasADi is asked to solve.

    `derivatives` is "nlpsol" (whatever nlpsol derives from the mapped stage functions) or "composed"
    (mapped hand-arranged stage derivatives). Compiled means C with -O3 -march=native.
    """

    form: str
    solver: str
    derivatives: str
    compile: bool
    print_level: int = 0


@dataclass(frozen=True)
class Outcome:
    """What a solve gave and what it cost."""

    scenario: str
    form: str
    solver: str
    derivatives: str
    compiled: bool
    status: str
    success: bool
    objective: float
    iterations: int
    solve_s: float
    solve_cpu_s: float
    build_s: float
    compile_s: float
    evaluate_s: dict[str, float]
    attitude_error: float
    angular_rate_deg_s: float
    joint_rate_deg_s: float
    body_links: list[int]
    pairs: list[tuple[int, int]]
    casadi: str


def compile_stage(
    problem: StageProblem, stage: StageDerivatives, cache: Path
) -> tuple[StageProblem, StageDerivatives, float]:
    """Replace every function that a solve evaluates at each stage by its compiled twin."""
    kept = [problem.step, stage.step_jacobian, stage.stage_hessian]
    if problem.path_rows:
        kept += [problem.path, stage.path_jacobian]
    result = compile_functions(kept, cache)
    problem_names = {"step", "path"} & result.functions.keys()
    stage_names = result.functions.keys() - problem_names
    return (
        dataclasses.replace(problem, **{name: result.functions[name] for name in problem_names}),
        dataclasses.replace(stage, **{name: result.functions[name] for name in stage_names}),
        result.compile_s,
    )


def solve(scenario: Scenario, setup: Setup, cache: Path) -> Outcome:
    """Build, solve from the constant guess and report."""
    begun = time.perf_counter()
    problem = stage_problem(scenario, setup.form)
    report, compile_s = problem.report, 0.0
    fatrop = setup.solver == "fatrop"
    options: dict = {"print_time": False, "record_time": True}
    transcription = transcribe(problem, pinned_by_rows=fatrop)
    if setup.derivatives == "composed":
        stage, stage_problem_used = composed_derivatives(problem), problem
        if setup.compile:
            compile_begun = time.perf_counter()
            stage_problem_used, stage, compile_s = compile_stage(problem, stage, cache)
            begun += time.perf_counter() - compile_begun
        options["cache"] = derivative_functions(stage_problem_used, transcription, stage, mirrored=fatrop)
    elif setup.compile:
        options |= {
            "jit": True,
            "compiler": "shell",
            "jit_options": {"compiler": "gcc", "flags": list(FLAGS[:2])},
        }
    options |= _solver_options(setup, transcription.rows_low == transcription.rows_high)
    created = time.perf_counter()
    solver = ca.nlpsol("solver", setup.solver, transcription.nlp, options)
    build_s = time.perf_counter() - begun
    if setup.compile and setup.derivatives == "nlpsol":
        # nlpsol differentiates and compiles in one call; nearly all of it is the compiler.
        compile_s = time.perf_counter() - created
        build_s -= compile_s

    begun, cpu_begun = time.perf_counter(), time.process_time()
    result = solver(
        x0=transcription.guess,
        lbx=transcription.variables_low,
        ubx=transcription.variables_high,
        lbg=transcription.rows_low,
        ubg=transcription.rows_high,
    )
    solve_s, solve_cpu_s = time.perf_counter() - begun, time.process_time() - cpu_begun
    stats = solver.stats()
    error, spin, rates = (np.array(part).ravel() for part in report(result["x"][-problem.states :]))
    checked = checked_clearances(scenario.system)
    return Outcome(
        scenario=scenario.name,
        form=setup.form,
        solver=setup.solver,
        derivatives=setup.derivatives,
        compiled=setup.compile,
        status=str(stats.get("return_status", stats.get("unified_return_status"))),
        success=bool(stats["success"]),
        objective=float(result["f"]),
        iterations=_iterations(stats),
        solve_s=solve_s,
        solve_cpu_s=solve_cpu_s,
        build_s=build_s,
        compile_s=compile_s,
        evaluate_s=_evaluation_times(stats),
        attitude_error=float(np.linalg.norm(error)),
        angular_rate_deg_s=float(np.degrees(np.linalg.norm(spin))),
        joint_rate_deg_s=float(np.degrees(np.linalg.norm(rates))),
        body_links=checked.body_links,
        pairs=checked.pairs,
        casadi=ca.__version__,
    )


def _solver_options(setup: Setup, equality: np.ndarray) -> dict:
    if setup.solver == "ipopt":
        # An ipopt.opt left in the working directory would change the solve without a word.
        return {"ipopt": {"print_level": setup.print_level, "sb": "yes", "option_file_name": ""}}
    return {
        "structure_detection": "auto",
        "equality": equality.tolist(),
        "fatrop": {"print_level": setup.print_level, "max_iter": 3000},
    }


def _iterations(stats: dict) -> int:
    if "iter_count" in stats and stats["iter_count"] >= 0:
        return int(stats["iter_count"])
    return int(stats["fatrop"]["iterations_count"])


def _evaluation_times(stats: dict) -> dict[str, float]:
    prefix = "t_wall_nlp_"
    return {name.removeprefix(prefix): value for name, value in stats.items() if name.startswith(prefix)}
