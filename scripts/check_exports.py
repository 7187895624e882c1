#!/usr/bin/env python3
"""Check a plan's exported files with the programs that they are for.

For the plan in a folder, exported in every format, and for random states of its system from
`cargo run -p righting-export --example reference`: Pinocchio (URDF) and MuJoCo (MJCF) find the same mass matrix,
center of mass, momenta and forces; SPICE (CK), SciPy (MAT) and NumPy (NPZ) read the same attitudes and columns;
STK's file and the Attitude Ephemeris Message have the same numbers; PyYAML reads the joint trajectory. Needs
`pin`, `mujoco`, `spiceypy`, `scipy`, `pyyaml` and `numpy`. `checked` returns the largest deviations by name.
"""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import scipy.io
import spiceypy
import yaml


def checked(folder: Path, states: list[dict]) -> dict[str, float]:
    """The largest deviation of each kind: of models relative to the largest entry, of files absolute."""
    table = columns(folder / "trajectory.csv")
    return {
        "URDF in Pinocchio": urdf(folder / "system.urdf", states),
        "MJCF in MuJoCo": mjcf(folder / "system.xml", states),
        "CK in SPICE": ck(folder, table),
        "STK and AEM": stk(folder, table),
        "MAT in SciPy": arrays(scipy.io.loadmat(folder / "trajectory.mat"), table),
        "NPZ in NumPy": arrays(np.load(folder / "trajectory.npz"), table),
        "YAML and JSON": joint_trajectory(folder, table),
    }


def columns(file: Path) -> dict[str, np.ndarray]:
    with file.open(encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    numbers = {key: np.array([float(row[key]) for row in rows if row[key]]) for key in rows[0]}
    # Joints that slide have metres and newtons in the names of their columns.
    joints = sum(bool(re.fullmatch(r"q\d+_(rad|m)", key)) for key in numbers)
    column = lambda pattern: next(numbers[key] for key in numbers if re.fullmatch(pattern, key))
    of_joints = lambda prefix, unit: np.transpose([column(f"{prefix}{i + 1}_{unit}") for i in range(joints)])
    several = lambda *keys: np.transpose([numbers[key] for key in keys])
    return {
        "t_s": numbers["t_s"],
        "r_m": several("rx_m", "ry_m", "rz_m"),
        "q_wxyz": several("qw", "qx", "qy", "qz"),
        "v_m_s": several("vx_m_s", "vy_m_s", "vz_m_s"),
        "w_rad_s": several("wx_rad_s", "wy_rad_s", "wz_rad_s"),
        "q_rad": of_joints("q", "(rad|m)"),
        "dq_rad_s": of_joints("dq", "(rad|m)_s"),
        "u_rad_s2": of_joints("u", "(rad|m)_s2"),
        "tau_n_m": of_joints("(tau|f)", "n(_m)?"),
        "power_w": numbers["power_w"],
    }


def relative(found: np.ndarray, expected: np.ndarray) -> float:
    found, expected = np.asarray(found), np.asarray(expected)
    return float(np.abs(found - expected).max() / max(np.abs(expected).max(), 1e-300))


class Sample:
    """A state of the reference, with what belongs to it, without the joints that are locked."""

    def __init__(self, state: dict):
        turning = ~np.array(state["is_locked"])
        free = np.r_[np.ones(6, bool), turning]
        vector = lambda key: np.array(state[key])
        self.position, self.attitude = vector("position_m"), vector("attitude_wxyz")
        self.velocity, self.rate = vector("velocity_body_m_s"), vector("angular_rate_body_rad_s")
        self.angles, self.rates = vector("joint_angles_rad")[turning], vector("joint_rates_rad_s")[turning]
        self.acceleration = vector("acceleration_body_m_s2")
        self.angular_acceleration = vector("angular_acceleration_body_rad_s2")
        self.accelerations = vector("joint_accelerations_rad_s2")[turning]
        self.mass = vector("mass_matrix")[np.ix_(free, free)]
        self.forces = vector("inverse_dynamics")[free]
        self.center = vector("center_of_mass_m")
        self.momentum = np.r_[vector("linear_momentum"), vector("angular_momentum")]


def urdf(file: Path, states: list[dict]) -> float:
    model = pin.buildModelFromUrdf(str(file), pin.JointModelFreeFlyer())
    model.gravity.setZero()
    data, worst = model.createData(), 0.0
    for sample in map(Sample, states):
        q = np.r_[sample.position, sample.attitude[[1, 2, 3, 0]]]
        for joint, angle in zip(range(2, model.njoints), sample.angles):
            # A joint without limits of angle has the cosine and the sine of its angle.
            q = np.r_[q, angle if model.joints[joint].nq == 1 else [np.cos(angle), np.sin(angle)]]
        v = np.r_[sample.velocity, sample.rate, sample.rates]
        spatial = sample.acceleration - np.cross(sample.rate, sample.velocity)
        a = np.r_[spatial, sample.angular_acceleration, sample.accelerations]
        mass = pin.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        pin.computeCentroidalMomentum(model, data, q, v)
        worst = max(
            worst,
            relative(mass, sample.mass),
            relative(data.com[0], sample.center),
            relative(data.hg.vector, sample.momentum),
            relative(pin.rnea(model, data, q, v, a), sample.forces),
        )
    return worst


def mjcf(file: Path, states: list[dict]) -> float:
    # A joint that turns no inertia makes the mass matrix singular; no accelerations are asked for.
    mujoco.set_mju_user_warning(lambda _: None)
    model = mujoco.MjModel.from_xml_path(str(file))
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    data, worst = mujoco.MjData(model), 0.0
    for sample in map(Sample, states):
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, sample.attitude)
        turn = turn.reshape(3, 3)
        data.qpos[:] = np.r_[sample.position, sample.attitude, sample.angles]
        data.qvel[:] = np.r_[turn @ sample.velocity, sample.rate, sample.rates]
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        mass = np.zeros((model.nv, model.nv))
        for row, unit in zip(mass, np.eye(model.nv)):
            mujoco.mj_mulM(model, data, row, unit)
        # MuJoCo's base moves along inertial axes, ours along the body's.
        to_inertial = np.eye(model.nv)
        to_inertial[:3, :3] = turn
        mujoco.mj_subtreeVel(model, data)
        total = data.subtree_linvel[1] * model.body_subtreemass[1]
        data.qacc[:] = to_inertial @ np.r_[sample.acceleration, sample.angular_acceleration, sample.accelerations]
        mujoco.mj_inverse(model, data)
        worst = max(
            worst,
            relative(to_inertial.T @ mass @ to_inertial, sample.mass),
            relative(data.subtree_com[1], sample.center),
            relative(np.r_[total, data.subtree_angmom[1]], sample.momentum),
            relative(to_inertial.T @ data.qfrc_inverse, sample.forces),
        )
    return worst


def ck(folder: Path, table: dict) -> float:
    """Attitudes and rates, rad and rad/s."""
    kernels = [str(folder / f"attitude.{kind}") for kind in ("tsc", "tf", "bc")]
    spiceypy.furnsh(kernels)
    worst = 0.0
    try:
        body = spiceypy.ckobj(kernels[2])[0]
        for time, attitude, rate in zip(table["t_s"], table["q_wxyz"], table["w_rad_s"]):
            matrix, found_rate, _ = spiceypy.ckgpav(body, time * 1e6, 0.0, "J2000")
            to_body = rotation(attitude).T
            worst = max(worst, np.abs(matrix - to_body).max(), np.abs(found_rate - to_body.T @ rate).max())
        # By name and by time, as users ask; ephemeris times of today are good to 1e-7 s.
        name = spiceypy.frmnam(body)
        start = spiceypy.sct2e(body // 1000, 0.0)
        for time, attitude in list(zip(table["t_s"], table["q_wxyz"]))[1:-1:50]:
            off = spiceypy.pxform("J2000", name, start + time) - rotation(attitude).T
            assert np.abs(off).max() < 1e-6, off
    finally:
        spiceypy.kclear()
    return float(worst)


def rotation(wxyz: np.ndarray) -> np.ndarray:
    """Body to inertial."""
    w, x, y, z = wxyz / np.linalg.norm(wxyz)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def stk(folder: Path, table: dict) -> float:
    """Times (s), quaternions and rates (deg/s); those of both files are the same text."""
    lines = (folder / "attitude.a").read_text(encoding="ascii").splitlines()
    lines = lines[lines.index("AttitudeTimeQuatAngVels") + 1 : -1]
    message = (folder / "attitude.aem").read_text(encoding="ascii").splitlines()
    message = message[message.index("DATA_START") + 1 : -1]
    assert [line.split()[1:] for line in lines] == [line.split()[1:] for line in message]
    found = np.array([[float(cell) for cell in line.split()] for line in lines])
    expected = np.c_[table["t_s"], table["q_wxyz"][:, [1, 2, 3, 0]], np.degrees(table["w_rad_s"])]
    norms = np.linalg.norm(table["q_wxyz"], axis=1)
    expected[:, 1:5] /= norms[:, None]
    return float(np.abs(found - expected).max())


def arrays(found, table: dict) -> float:
    return max(float(np.abs(found[name].reshape(values.shape) - values).max()) for name, values in table.items())


def joint_trajectory(folder: Path, table: dict) -> float:
    read = yaml.safe_load((folder / "joint_trajectory.yaml").read_text(encoding="utf-8"))
    assert read == json.loads((folder / "joint_trajectory.json").read_text(encoding="utf-8"))
    joints = [int(name.removeprefix("joint_")) - 1 for name in read["joint_names"]]
    points, worst = read["points"], 0.0
    for key, column in [
        ("positions", "q_rad"),
        ("velocities", "dq_rad_s"),
        ("accelerations", "u_rad_s2"),
        ("effort", "tau_n_m"),
    ]:
        values = table[column][:, joints]
        found = np.array([point[key] for point in points[: len(values)]])
        worst = max(worst, float(np.abs(found - values).max()))
    times = [point["time_from_start"] for point in points]
    seconds = np.array([time["sec"] + 1e-9 * time["nanosec"] for time in times])
    assert (np.diff(seconds) > 0).all()
    return max(worst, float(np.abs(seconds - table["t_s"]).max()))
