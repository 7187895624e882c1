"""The model against an independent rigid-body library's momenta and accelerations."""

import json
import unittest
from pathlib import Path

import casadi as ca
import numpy as np

from righting_bench.dynamics import full_dynamics, momentum, reduced_angular_velocity, rotation_matrix
from righting_bench.scenario import load_scenario

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "crates" / "multibody" / "tests" / "data" / "dynamics.json"
SCENARIO_OF = {"single_link_2dof": "slew_2dof", "canadarm2_table": "slew_canadarm2_table"}


class Dynamics(unittest.TestCase):
    def test_equal_the_reference(self) -> None:
        cases = json.loads(REFERENCE.read_text())["systems"]
        for name, samples in cases.items():
            system = load_scenario(ROOT / "scenarios" / f"{SCENARIO_OF[name]}.json").system
            dynamics = full_dynamics(system)
            for number, sample in enumerate(samples):
                with self.subTest(system=name, sample=number):
                    state = np.array(sample["x"])
                    self._close(dynamics(state, sample["u"]), sample["xdot"])
                    self._momentum(system, state, sample)

    def _momentum(self, system, state, sample) -> None:
        attitude, spin, arm = state[3:7], state[10:13], state[13:]
        angles, rates = ca.DM(arm[: system.joints]), ca.DM(arm[system.joints :])
        parts = momentum(system, ca.SX(angles), ca.SX(rates))
        self._close(ca.DM(parts.inertia @ ca.SX(spin) + parts.relative), sample["angular_momentum_body"])
        rotation = np.array(ca.DM(rotation_matrix(ca.SX(attitude))))
        inertial = rotation @ sample["angular_momentum_body"]
        self._close(ca.DM(inertial), sample["angular_momentum_inertial"])
        self._close(reduced_angular_velocity(system, inertial)(attitude, angles, rates), spin)

    def _close(self, value, expected) -> None:
        expected = np.array(expected)
        error = np.abs(np.array(value).ravel() - expected).max() / np.abs(expected).max()
        self.assertLess(error, 1e-10)


if __name__ == "__main__":
    unittest.main()
