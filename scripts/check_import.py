#!/usr/bin/env python3
"""Import public and random robots, and compare them with Pinocchio's and MuJoCo's models of the same files.

Every robot is imported by `righting import`; at random states its mass matrix, centroidal momentum map, center of
mass and inverse dynamics are those that Pinocchio finds in the robot's own URDF file. Then the system is exported as
URDF and MJCF, and Pinocchio and MuJoCo find the same again. The public robots are those of the package
example-robot-data, which stays where it is. Writes docs/import.md. Exit code 1 when a number is farther off than it may be.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

ROOT = Path(__file__).resolve().parents[1]
STATES = 20
RANDOM_ROBOTS = 40
# Relative to the largest entry.
TOLERANCE = 1e-11
ROBOTS_FOLDER = "share/example-robot-data/robots"


@dataclass
class Robot:
    """A URDF file and how it is imported."""

    name: str
    file: Path
    base: str
    locked: dict[str, float] = field(default_factory=dict)
    options: tuple[str, ...] = ()


def public_robots() -> list[Robot]:
    robots = next(path for path in map(Path, sys.path) if (path / "cmeel.prefix" / ROBOTS_FOLDER).is_dir())
    folder = robots / "cmeel.prefix" / ROBOTS_FOLDER
    fingers = {"panda_finger_joint1": 0.02, "panda_finger_joint2": 0.02}
    return [
        Robot("UR5", folder / "ur_description/urdf/ur5_robot.urdf", "base_link"),
        Robot("Panda", folder / "panda_description/urdf/panda.urdf", "panda_link0", fingers),
        Robot("xArm 7", folder / "xarm_description/urdf/xarm7.urdf", "link_base"),
        Robot("Kinova Jaco", folder / "kinova_description/robots/kinova.urdf", "base"),
        Robot("Z1", folder / "z1_description/urdf/z1.urdf", "link00"),
        Robot("SO-101", folder / "so_arm_description/urdf/so101.urdf", "base_link", options=("--point-masses",)),
        Robot("TALOS arm", folder / "talos_data/robots/talos_left_arm.urdf", "arm_left_1_link",
              options=("--point-masses",)),
        Robot("Solo 12", folder / "solo_description/robots/solo12.urdf", "base_link"),
        Robot("A1", folder / "a1_description/urdf/a1.urdf", "base"),
        Robot("Go2", folder / "go2_description/urdf/go2.urdf", "base"),
        Robot("G1", folder / "g1_description/urdf/g1_29dof_rev_1_0.urdf", "pelvis"),
        Robot("Baxter", folder / "baxter_description/urdf/baxter.urdf", "base", options=("--point-masses",),
              locked={f"{side}_gripper_{finger}_finger_joint": 0.0 for side in "lr" for finger in "lr"}),
        # A link in the middle as base: the robot is re-rooted.
        Robot("UR5 by its wrist", folder / "ur_description/urdf/ur5_robot.urdf", "wrist_1_link"),
        Robot("Solo 12 by a foot", folder / "solo_description/robots/solo12.urdf", "FL_FOOT"),
    ]


def random_robot(folder: Path, number: int) -> Robot:
    """A tree of 3 to 12 links with revolute, continuous, prismatic and fixed joints, any of which is the base."""
    draw = random.Random(number)
    numbers = lambda count, size: " ".join(repr(size * draw.uniform(-1, 1)) for _ in range(count))
    count = draw.randint(3, 12)
    lines = ['<robot name="random">']
    for link in range(count):
        points = np.array([[draw.uniform(-0.3, 0.3) for _ in range(3)] for _ in range(4)])
        inertia = sum((p @ p) * np.eye(3) - np.outer(p, p) for p in points)
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = inertia.tolist()
        lines.append(
            f'<link name="l{link}"><inertial><origin xyz="{numbers(3, 0.4)}" rpy="{numbers(3, 3)}"/>'
            f'<mass value="{draw.uniform(0.5, 20)!r}"/><inertia ixx="{xx!r}" ixy="{xy!r}" ixz="{xz!r}" '
            f'iyy="{yy!r}" iyz="{yz!r}" izz="{zz!r}"/></inertial></link>'
        )
    for child in range(1, count):
        kind = "revolute" if child == 1 else draw.choice(["revolute", "revolute", "continuous", "prismatic", "prismatic", "fixed"])
        axis = draw.choice(["1 0 0", "0 1 0", "0 0 -1", numbers(3, 1)])
        lines.append(
            f'<joint name="j{child}" type="{kind}"><parent link="l{draw.randrange(child)}"/><child link="l{child}"/>'
            f'<origin xyz="{numbers(3, 1)}" rpy="{numbers(3, 3)}"/><axis xyz="{axis}"/>'
            f'<limit lower="-3" upper="3" velocity="1" effort="10"/></joint>'
        )
    file = folder / f"random_{number}.urdf"
    file.write_text("\n".join(lines + ["</robot>\n"]), encoding="utf-8")
    return Robot(f"random {number}", file, f"l{draw.randrange(count)}")


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--righting", type=Path, default=ROOT / "target/release/righting")
    options.add_argument("--reference", type=Path, default=ROOT / "target/release/examples/reference")
    options.add_argument("--out", type=Path, default=ROOT / "out/import")
    options.add_argument("--page", type=Path, default=ROOT / "docs/import.md")
    options = options.parse_args()
    options.righting, options.reference = options.righting.resolve(), options.reference.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    # MuJoCo leaves its log where it runs.
    os.chdir(options.out)
    rows, worst_random, wrong = [], {}, []
    for robot in public_robots():
        joints, found = compared(robot, options)
        rows.append((robot.name, joints, found))
        print(f"{robot.name:20} {joints:3} joints  " + ", ".join(f"{k} {v:.1e}" for k, v in found.items()), flush=True)
        wrong += [f"{robot.name}: {kind}" for kind, off in found.items() if not off <= TOLERANCE]
    for number in range(RANDOM_ROBOTS):
        robot = random_robot(Path.cwd(), number)
        _, found = compared(robot, options)
        for kind, off in found.items():
            worst_random[kind] = max(worst_random.get(kind, 0.0), off)
            if not off <= TOLERANCE:
                wrong.append(f"{robot.name}: {kind}")
    rows.append((f"{RANDOM_ROBOTS} random trees", "1 to 11", worst_random))
    options.page.write_text(page(rows), encoding="utf-8")
    for line in wrong:
        print(f"too far off: {line}", file=sys.stderr)
    return 1 if wrong else 0


def compared(robot: Robot, options) -> tuple[int, dict[str, float]]:
    """The number of joints, and the largest deviations by what is compared."""
    system = Path.cwd() / f"{robot.name.replace(' ', '_')}.json"
    command = [options.righting, "import", robot.file, "--base", robot.base, "--out", system]
    command += ["--acceleration-max-deg-s2", "60", "--rate-max-deg-s", "60", "--acceleration-max-m-s2", "1"]
    command += ["--speed-max-m-s", "1", *robot.options]
    for joint, at in robot.locked.items():
        command += ["--lock", f"{joint}={at}"]
    run(*command)
    models = system.with_suffix("")
    models.mkdir(exist_ok=True)
    states = [json.loads(line) for line in run(options.reference, system, STATES, models).splitlines()]
    found = of_urdf(own_model(robot, states[0]["joint_names"]), robot.base, states)
    exported = pin.buildModelFromUrdf(str(models / "system.urdf"), pin.JointModelFreeFlyer())
    again = of_urdf(exported, None, states)
    found["export in Pinocchio"] = max(again.values())
    found["export in MuJoCo"] = of_mjcf(models / "system.xml", states)
    return len(states[0]["joint_names"]), found


def own_model(robot: Robot, moving: list[str]) -> pin.Model:
    """Pinocchio's model of the robot's file, floating by the file's root, with joints held as the import says."""
    model = pin.buildModelFromUrdf(str(robot.file), pin.JointModelFreeFlyer())
    held = [name for name in list(model.names)[2:] if name not in moving]
    q = pin.neutral(model)
    for name in held:
        joint = model.joints[model.getJointId(name)]
        low, high = model.lowerPositionLimit[joint.idx_q], model.upperPositionLimit[joint.idx_q]
        q[joint.idx_q] = robot.locked.get(name, min(max(0.0, low), high))
    return pin.buildReducedModel(model, [model.getJointId(name) for name in held], q) if held else model


class State:
    """A state of the reference in the order of a model's velocities."""

    def __init__(self, model: pin.Model, state: dict):
        joints = [model.joints[model.getJointId(name)] for name in state["joint_names"]]
        vector = lambda key: np.array(state[key])
        self.position, self.attitude = vector("position_m"), vector("attitude_wxyz")
        self.angles = vector("joint_angles_rad")
        self.order = np.r_[np.arange(6), [joint.idx_v for joint in joints]].astype(int)
        self.q = pin.neutral(model)
        for joint, angle in zip(joints, self.angles):
            # A joint without limits of angle has the cosine and the sine of its angle.
            turned = [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
            self.q[joint.idx_q : joint.idx_q + joint.nq] = turned
        self.velocity, self.rate = vector("velocity_body_m_s"), vector("angular_rate_body_rad_s")
        self.v = np.r_[self.velocity, self.rate, vector("joint_rates_rad_s")]
        linear = vector("acceleration_body_m_s2") - np.cross(self.rate, self.velocity)
        self.a = np.r_[linear, vector("angular_acceleration_body_rad_s2"), vector("joint_accelerations_rad_s2")]
        self.mass, self.map = vector("mass_matrix"), vector("momentum_map").T
        self.forces, self.center = vector("inverse_dynamics"), vector("center_of_mass_m")


def of_urdf(model: pin.Model, base: str | None, states: list[dict]) -> dict[str, float]:
    """The largest deviations from Pinocchio's numbers of a model whose base is its link `base`, or its root."""
    model.gravity.setZero()
    data = model.createData()
    worst = {"mass matrix": 0.0, "momentum map": 0.0, "center of mass": 0.0, "inverse dynamics": 0.0}
    for state in states:
        state = State(model, state)
        frame = model.getFrameId(base) if base else None
        placement = pin.SE3(pin.Quaternion(*state.attitude).matrix(), state.position)
        q = state.q
        if frame is not None:
            # Where the root is so that the base is where it shall be.
            pin.framesForwardKinematics(model, data, q)
            root = placement * data.oMf[frame].inverse() * data.oMi[1]
        else:
            root = placement
        q[:3], q[3:7] = root.translation, pin.Quaternion(root.rotation).coeffs()
        to_root = np.eye(model.nv)[:, state.order]
        bias = np.zeros(model.nv)
        if frame is not None:
            # The base's twist is J v; so v follows from it and the joints' rates.
            pin.computeJointJacobians(model, data, q)
            pin.framesForwardKinematics(model, data, q)
            jacobian = pin.getFrameJacobian(model, data, frame, pin.LOCAL)
            to_root[:6] = np.linalg.solve(
                jacobian[:, :6], np.eye(6, model.nv) - np.c_[np.zeros((6, 6)), jacobian[:, state.order[6:]]]
            )
            v = to_root @ state.v
            pin.forwardKinematics(model, data, q, v, np.zeros(model.nv))
            # What the base accelerates at without any acceleration of the coordinates.
            drift = pin.getFrameAcceleration(model, data, frame, pin.LOCAL).vector
            bias[:6] = -np.linalg.solve(jacobian[:, :6], drift)
        mass = pin.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        v, a = to_root @ state.v, to_root @ state.a + bias
        forces = to_root.T @ pin.rnea(model, data, q, v, a)
        pin.ccrba(model, data, q, v)
        momentum_map = data.Ag @ to_root
        for kind, found, expected in [
            ("mass matrix", to_root.T @ mass @ to_root, state.mass),
            ("momentum map", momentum_map, state.map),
            ("center of mass", data.com[0], state.center),
            ("inverse dynamics", forces, state.forces),
        ]:
            worst[kind] = max(worst[kind], relative(found, expected))
    return worst


def of_mjcf(file: Path, states: list[dict]) -> float:
    """The largest deviation from MuJoCo's mass matrix, center of mass and inverse dynamics."""
    # A joint that turns no inertia makes the mass matrix singular; no accelerations are asked for.
    mujoco.set_mju_user_warning(lambda _: None)
    model = mujoco.MjModel.from_xml_path(str(file))
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    data, worst = mujoco.MjData(model), 0.0
    for state in states:
        joints = [model.joint(name) for name in state["joint_names"]]
        vector = lambda key: np.array(state[key])
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, vector("attitude_wxyz"))
        turn = turn.reshape(3, 3)
        order = np.r_[np.arange(6), [joint.dofadr[0] for joint in joints]].astype(int)
        # MuJoCo's base moves along inertial axes, ours along the body's.
        to_model = np.eye(model.nv)[:, order]
        to_model[:3, :3] = turn
        data.qpos[:7] = np.r_[vector("position_m"), vector("attitude_wxyz")]
        for joint, angle in zip(joints, state["joint_angles_rad"]):
            data.qpos[joint.qposadr[0]] = angle
        rates = np.r_[vector("velocity_body_m_s"), vector("angular_rate_body_rad_s"), vector("joint_rates_rad_s")]
        data.qvel[:] = to_model @ rates
        accelerations = np.r_[
            vector("acceleration_body_m_s2"),
            vector("angular_acceleration_body_rad_s2"),
            vector("joint_accelerations_rad_s2"),
        ]
        data.qacc[:] = to_model @ accelerations
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        mass = np.zeros((model.nv, model.nv))
        for row, unit in zip(mass, np.eye(model.nv)):
            mujoco.mj_mulM(model, data, row, unit)
        mujoco.mj_inverse(model, data)
        worst = max(
            worst,
            relative(to_model.T @ mass @ to_model, vector("mass_matrix")),
            relative(data.subtree_com[1], vector("center_of_mass_m")),
            relative(to_model.T @ data.qfrc_inverse, vector("inverse_dynamics")),
        )
    return worst


def relative(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.abs(found - expected).max() / max(np.abs(expected).max(), 1e-300))


def page(rows: list) -> str:
    kinds = list(rows[0][2])
    lines = [
        "# Imported robots beside Pinocchio and MuJoCo",
        "",
        "This page is written by `make check-import` (`scripts/check_import.py`). Every robot is imported by",
        "`righting import URDF --base LINK`, and compared at 20 random states with Pinocchio's model of the same",
        "file: mass matrix, centroidal momentum map, center of mass and inverse dynamics. Then it is exported, and",
        "Pinocchio (URDF) and MuJoCo (MJCF) read it and are compared again. The numbers are the largest deviations,",
        f"relative to the largest entry; {TOLERANCE:.0e} is allowed. The robots are those of the public package",
        f"example-robot-data {version('example-robot-data')}; Pinocchio is {pin.__version__}, MuJoCo {mujoco.__version__}.",
        "",
        "| robot | joints | " + " | ".join(kinds) + " |",
        "| --- " * (2 + len(kinds)) + "|",
    ]
    for name, joints, found in rows:
        lines.append(f"| {name} | {joints} | " + " | ".join(f"{found[kind]:.1e}" for kind in kinds) + " |")
    return "\n".join(lines) + "\n"


def version(package: str) -> str:
    from importlib import metadata

    return metadata.version(package)


def run(*command) -> str:
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done.stdout


if __name__ == "__main__":
    sys.exit(main())
