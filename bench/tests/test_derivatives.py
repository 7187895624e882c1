"""The hand-arranged derivatives are CasADi's own, in both forms and both solvers' layouts."""

import dataclasses
import unittest
from pathlib import Path

import casadi as ca
import numpy as np

from righting_bench.nlp_derivatives import derivative_functions
from righting_bench.problem import stage_problem
from righting_bench.scenario import load_scenario
from righting_bench.stage_derivatives import composed_derivatives, unrolled_derivatives
from righting_bench.transcription import transcribe

SCENARIOS = Path(__file__).resolve().parents[2] / "scenarios"
ARRANGEMENTS = {"composed": composed_derivatives, "unrolled": unrolled_derivatives}


class NlpDerivatives(unittest.TestCase):
    """Against the derivatives that nlpsol itself would make."""

    def test_equal_those_of_the_oracle(self) -> None:
        for name, form in (("slew_2dof", "full"), ("detumble_2dof", "reduced"), ("detumble_4dof", "reduced")):
            scenario = dataclasses.replace(load_scenario(SCENARIOS / f"{name}.json"), steps=5)
            problem = stage_problem(scenario, form)
            stages = {label: arrange(problem) for label, arrange in ARRANGEMENTS.items()}
            for mirrored in (False, True):
                with self.subTest(scenario=name, form=form, mirrored=mirrored):
                    self._check(problem, stages, mirrored)

    def _check(self, problem, stages, mirrored) -> None:
        transcription = transcribe(problem, pinned_by_rows=mirrored)
        nlp = transcription.nlp
        oracle = ca.Function(
            "nlp", [nlp["x"], ca.MX.sym("p", 0)], [nlp["f"], nlp["g"]], ["x", "p"], ["f", "g"]
        )
        jacobian = oracle.factory("nlp_jac_g", ["x", "p"], ["g", "jac:g:x"])
        outputs = ["grad:gamma:x", "hess:gamma:x:x"] if mirrored else ["triu:hess:gamma:x:x"]
        inputs = ["x", "p", "lam:f", "lam:g"]
        hessian = oracle.factory("nlp_hess_l", inputs, outputs, {"gamma": ["f", "g"]})

        generator = np.random.default_rng(3)
        point = transcription.guess + 0.1 * generator.standard_normal(transcription.guess.size)
        multipliers = generator.standard_normal(transcription.layout.rows)
        for label, stage in stages.items():
            made = derivative_functions(problem, transcription, stage, mirrored)
            for ours, theirs, arguments in (
                (made["nlp_jac_g"], jacobian, (point, [])),
                (made["nlp_hess_l"], hessian, (point, [], 0.7, multipliers)),
            ):
                for left, right in zip(_all(ours, arguments), _all(theirs, arguments), strict=True):
                    error = float(ca.norm_inf(ca.vec(left - right)))
                    self.assertLess(error, 1e-12 * max(1.0, float(ca.norm_inf(ca.vec(right)))), label)


def _all(function: ca.Function, arguments: tuple) -> tuple:
    result = function(*arguments)
    return result if isinstance(result, tuple) else (result,)


if __name__ == "__main__":
    unittest.main()
