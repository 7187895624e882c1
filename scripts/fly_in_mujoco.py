#!/usr/bin/env python3
"""MuJoCo as the spacecraft of `righting fly --plant stdio`: one flight of a plan with drawn masses.

    scripts/fly_in_mujoco.py --out DIR [--seed N] [--mass-percent P] PLAN_FOLDER [-- OPTIONS OF righting fly]

The system is the plan's own MJCF export with every mass and inertia multiplied by a number of its own. The joints do
what they are told; MuJoCo says how the base moves. Needs `mujoco` and `numpy`. An example of how any simulator, or
hardware, can be the plant: all that it does with righting is read one JSON object a line and answer with one.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import mujoco
import numpy as np

# The longest step of MuJoCo's integrator, s.
STEP_S = 0.025


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("plan", type=Path)
    options.add_argument("--out", type=Path, required=True)
    options.add_argument("--righting", default="righting")
    options.add_argument("--seed", type=int, default=0)
    options.add_argument("--mass-percent", type=float, default=10.0)
    options.add_argument("--attitude-noise-deg", type=float, default=0.0)
    options.add_argument("--joint-noise-deg", type=float, default=0.0)
    options.add_argument("--joint-rate-noise-deg-s", type=float, default=0.0)
    options.add_argument("options", nargs="*", help="options of righting fly, after --")
    options = options.parse_args()
    draws = np.random.default_rng(options.seed)
    spacecraft = Spacecraft(options.righting, options.plan, options.mass_percent / 100, draws)
    noise = np.radians(
        [options.attitude_noise_deg, options.joint_noise_deg, options.joint_rate_noise_deg_s]
    )
    command = [options.righting, "fly", options.plan, "--out", options.out, "--plant", "stdio"]
    if options.attitude_noise_deg > 0:
        command += ["--attitude-noise-deg", str(options.attitude_noise_deg)]
    pilot = subprocess.Popen(
        [*command, *options.options], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    opening = json.loads(pilot.stdout.readline())
    spacecraft.start(opening["start"])
    for line in pilot.stdout:
        told = json.loads(line)
        spacecraft.advance(np.array(told["joint_accelerations_rad_s2"]), told["duration_s"])
        is_last = told["step"] == opening["steps"] - 1
        # The end is judged by where the spacecraft is, not by where it is measured to be.
        answer = spacecraft.measured(np.zeros(3) if is_last else noise, draws)
        pilot.stdin.write(json.dumps(answer) + "\n")
        pilot.stdin.flush()
    return pilot.wait()


class Spacecraft:
    """The system of a plan in MuJoCo, with other masses."""

    def __init__(self, righting: str, plan: Path, share: float, draws: np.random.Generator):
        with tempfile.TemporaryDirectory() as scratch:
            file = Path(scratch) / "system.xml"
            export = [righting, "export", plan, "--format", "mjcf", "--out", file]
            subprocess.run(export, check=True, stdout=subprocess.DEVNULL)
            self.model = mujoco.MjModel.from_xml_path(str(file))
        for body in range(1, self.model.nbody):
            mass, inertia = 1 + share * draws.uniform(-1, 1, 2)
            # The inertia of a rod goes with its mass; the base's is drawn by itself.
            self.model.body_mass[body] *= mass
            self.model.body_inertia[body] *= inertia if body == 1 else mass
        mujoco.mj_setConst(self.model, mujoco.MjData(self.model))
        self.data = mujoco.MjData(self.model)

    def start(self, start: dict) -> None:
        """Where the flight starts, the center of mass at rest."""
        data, model = self.data, self.model
        data.qpos[3:7] = start["attitude"]
        data.qpos[7:] = start["joint_angles_rad"]
        data.qvel[3:6] = start["angular_rate_rad_s"]
        data.qvel[6:] = start["joint_rates_rad_s"]
        mujoco.mj_forward(model, data)
        mujoco.mj_subtreeVel(model, data)
        data.qvel[:3] -= data.subtree_linvel[1]
        mujoco.mj_forward(model, data)

    def advance(self, accelerations: np.ndarray, duration_s: float) -> None:
        """Classical Runge-Kutta steps in which the joints accelerate so."""
        model, data = self.model, self.data
        steps = max(1, round(duration_s / STEP_S))
        step_s = duration_s / steps
        for _ in range(steps):
            position, velocity = data.qpos.copy(), data.qvel.copy()
            rates, slopes = [], []
            for share in (0.0, 0.5, 0.5, 1.0):
                data.qpos[:], data.qvel[:] = position, velocity
                if slopes:
                    mujoco.mj_integratePos(model, data.qpos, rates[-1], share * step_s)
                    data.qvel[:] = velocity + share * step_s * slopes[-1]
                rates.append(data.qvel.copy())
                slopes.append(self.accelerations(accelerations))
            weights = np.array([1, 2, 2, 1]) / 6
            data.qpos[:] = position
            mujoco.mj_integratePos(model, data.qpos, weights @ rates, step_s)
            data.qvel[:] = velocity + step_s * weights @ slopes

    def accelerations(self, of_joints: np.ndarray) -> np.ndarray:
        """MuJoCo's accelerations under the joint forces that make the joints accelerate so."""
        model, data = self.model, self.data
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        inertia = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, inertia)
        base = np.linalg.solve(
            inertia[:6, :6], -data.qfrc_bias[:6] - inertia[:6, 6:] @ of_joints
        )
        forces = inertia @ np.concatenate([base, of_joints]) + data.qfrc_bias
        data.qfrc_applied[6:] = forces[6:]
        mujoco.mj_forward(model, data)
        return data.qacc.copy()

    def measured(self, noise: np.ndarray, draws: np.random.Generator) -> dict:
        """What sensors say with noise of these deviations: attitude, joint angles, joint rates."""
        data = self.data
        turn = 0.5 * noise[0] * draws.standard_normal(3)
        attitude = np.zeros(4)
        mujoco.mju_mulQuat(attitude, data.qpos[3:7], np.concatenate([[1.0], turn]))
        joints = len(data.qpos) - 7
        return {
            "attitude": list(attitude / np.linalg.norm(attitude)),
            "joint_angles_rad": list(data.qpos[7:] + noise[1] * draws.standard_normal(joints)),
            "joint_rates_rad_s": list(data.qvel[6:] + noise[2] * draws.standard_normal(joints)),
            "angular_rate_rad_s": list(data.qvel[3:6]),
        }


if __name__ == "__main__":
    raise SystemExit(main())
