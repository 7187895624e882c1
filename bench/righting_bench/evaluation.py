"""Time of one iteration's derivatives: constraint Jacobian and Lagrangian Hessian of every stage."""

from __future__ import annotations

import statistics
import time
from dataclasses import dataclass
from pathlib import Path

import casadi as ca
import numpy as np

from .nlp_derivatives import derivative_functions
from .problem import stage_problem
from .scenario import Scenario
from .solve import compile_stage
from .stage_derivatives import composed_derivatives, unrolled_derivatives
from .transcription import Transcription, transcribe

REPEATS = 7


@dataclass(frozen=True)
class EvaluationTime:
    """Median milliseconds of one Jacobian and one Hessian of the whole problem, on one core.

    `variant` is "nlpsol" (derived by nlpsol from mapped stage functions), "mapped" (mapped symbolic stage
    derivatives, interpreted), "composed" (the same, composed from the differential equation's) or
    "compiled" (composed, as C with -O3 -march=native).
    """

    scenario: str
    form: str
    variant: str
    steps: int
    jacobian_ms: float
    hessian_ms: float
    stage_instructions: int | None
    compile_s: float

    @property
    def total_ms(self) -> float:
        """Both together: what a solver's iteration pays."""
        return self.jacobian_ms + self.hessian_ms


def evaluation_times(scenario: Scenario, form: str, variants: list[str], cache: Path) -> list[EvaluationTime]:
    """Time the variants asked for, one after the other, at a random point near the constant guess."""
    problem = stage_problem(scenario, form)
    transcription = transcribe(problem, pinned_by_rows=False)
    times = []
    for variant in variants:
        instructions, compile_s, used = None, 0.0, problem
        if variant == "nlpsol":
            functions = _nlpsol_functions(transcription)
        else:
            stage = unrolled_derivatives(problem) if variant == "mapped" else composed_derivatives(problem)
            instructions = sum(
                function.n_instructions()
                for function in (stage.step_jacobian, stage.path_jacobian, stage.stage_hessian)
            )
            if variant == "compiled":
                used, stage, compile_s = compile_stage(problem, stage, cache)
            functions = derivative_functions(used, transcription, stage, mirrored=False)
        generator = np.random.default_rng(1)
        point = transcription.guess + 0.01 * generator.standard_normal(transcription.guess.size)
        multipliers = generator.standard_normal(transcription.layout.rows)
        times.append(
            EvaluationTime(
                scenario=scenario.name,
                form=form,
                variant=variant,
                steps=scenario.steps,
                jacobian_ms=_median_ms(functions["nlp_jac_g"], [point, np.zeros(0)], wanted=[1]),
                hessian_ms=_median_ms(
                    functions["nlp_hess_l"], [point, np.zeros(0), np.ones(1), multipliers], wanted=[0]
                ),
                stage_instructions=instructions,
                compile_s=compile_s,
            )
        )
    return times


def _nlpsol_functions(transcription: Transcription) -> dict[str, ca.Function]:
    """The functions that nlpsol hands to Ipopt when it is given nothing else."""
    nlp = transcription.nlp
    oracle = ca.Function("nlp", [nlp["x"], ca.MX.sym("p", 0)], [nlp["f"], nlp["g"]], ["x", "p"], ["f", "g"])
    return {
        "nlp_jac_g": oracle.factory("nlp_jac_g", ["x", "p"], ["g", "jac:g:x"]),
        "nlp_hess_l": oracle.factory(
            "nlp_hess_l", ["x", "p", "lam:f", "lam:g"], ["triu:hess:gamma:x:x"], {"gamma": ["f", "g"]}
        ),
    }


def _median_ms(function: ca.Function, arguments: list[np.ndarray], wanted: list[int]) -> float:
    """Median over repeats of a call through raw buffers, as a solver makes it."""
    buffer, evaluate = function.buffer()
    results = {index: np.zeros(function.nnz_out(index)) for index in wanted}
    for index, argument in enumerate(arguments):
        buffer.set_arg(index, memoryview(argument))
    for index, result in results.items():
        buffer.set_res(index, memoryview(result))
    evaluate()
    samples = []
    for _ in range(REPEATS):
        # Processor time: the evaluation is one thread's pure computing, and other work may share the core.
        begun = time.process_time()
        evaluate()
        samples.append(time.process_time() - begun)
    if not all(np.isfinite(result).all() for result in results.values()):
        raise ArithmeticError(f"{function.name()} gave a value that is not finite")
    return 1e3 * statistics.median(samples)
