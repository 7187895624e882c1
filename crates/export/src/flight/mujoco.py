#!/usr/bin/env python3
"""Fly a plan of Righting in MuJoCo by its torques alone; nothing corrects them.

Written by `righting export --format mujoco`; needs `mujoco` and `numpy`. Within a step of the plan the joint
accelerations are constant or linear and the torques are polynomials of degree six. MuJoCo asks for them at every
stage of its Runge-Kutta method. Printed are how far the end is from the plan's, and how far the largest torque of
each joint is from the largest that MuJoCo's own equations need for the plan's accelerations along the flight.

Some motions are unstable: an error of the joints grows until they leave the plan, however exact the torques are.
With --track the joints are held to the plan, and what that takes is printed as well.
"""

import argparse
import base64
import json

import mujoco
import numpy as np


def decoded(text, shape):
    return np.frombuffer(base64.b64decode(text), "<f8").reshape(shape)


# CONSTANTS
SIMULATOR = "MuJoCo"
# The first body is the world.
BASE = 1


def fly(step_s, track):
    """The flight in steps of at most `step_s`."""
    substeps = max(1, round(np.ceil((TIMES[1] - TIMES[0]) / step_s - 1e-6)))
    model = mujoco.MjModel.from_xml_string(MODEL)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    # The plan keeps the limits of the joints; here nothing but the motors acts, as they are told.
    for disabled in (mujoco.mjtDisableBit.mjDSBL_CONSTRAINT, mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL):
        model.opt.disableflags |= int(disabled)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    step, held = 0, np.zeros(len(JOINTS))
    needed, largest_held = np.zeros(TORQUES.shape), np.zeros(len(JOINTS))

    def motors(model, data):
        push(model, data, step)
        place = 2 * (data.time - TIMES[step]) / (TIMES[step + 1] - TIMES[step]) - 1
        data.ctrl[:] = place ** np.arange(7) @ TORQUE_COEFFICIENTS[step] + held

    mujoco.set_mjcb_control(motors)
    try:
        for step in range(len(TORQUES)):
            data.time = TIMES[step]
            mass, bias = reduced(model, data)
            needed[step] = mass @ ACCELERATIONS[step] + bias
            model.opt.timestep = (TIMES[step + 1] - TIMES[step]) / substeps
            for part in range(substeps):
                data.time = TIMES[step] + part * model.opt.timestep
                if track:
                    angles, rates = planned(step, part * model.opt.timestep)
                    angles, rates = data.qpos[7:] - angles, data.qvel[6:] - rates
                    held = -mass @ (2 * RETURN * rates + RETURN**2 * angles)
                    largest_held = np.maximum(largest_held, np.abs(held))
                mujoco.mj_step(model, data)
    finally:
        mujoco.set_mjcb_control(None)
    outcome = {
        "simulator": f"MuJoCo {mujoco.__version__}",
        "integrator": "RK4",
        "step_s": model.opt.timestep,
        "attitude_error_rad": angle_between(data.qpos[3:7], END_ATTITUDE),
        "joint_error_rad": float(np.abs(data.qpos[7:] - ANGLES[-1]).max(initial=0.0)),
        "peak_torque_difference_percent": percent(np.abs(needed).max(axis=0) - np.abs(TORQUES).max(axis=0)),
    }
    return outcome | ({"tracking_torque_percent": percent(largest_held)} if track else {})


def push(model, data, step):
    """What wheels and surroundings do to the bodies, as forces and couples in inertial axes. The momentum of the wheels
    is known all the time; what it makes on a turning base is a couple too."""
    attitude, rate = data.xmat[BASE].reshape(3, 3), data.qvel[3:6]
    store = WHEEL_MOMENTA[step] + (data.time - TIMES[step]) * WHEEL_TORQUES[step]
    on_base = TORQUE_BODY - WHEEL_TORQUES[step] - np.cross(rate, store)
    data.xfrc_applied[BASE, 3:] = attitude @ on_base + TORQUE_INERTIAL
    if ORBIT_RATE == 0:
        return
    data.xfrc_applied[BASE + 1 :, 3:] = 0
    angle = ORBIT_RATE * data.time
    nadir = np.cos(angle) * np.array(NADIR) - np.sin(angle) * np.array(AHEAD)
    for body in range(BASE, model.nbody):
        place = data.xipos[body] - data.subtree_com[BASE]
        axes = data.ximat[body].reshape(3, 3)
        along = axes @ (model.body_inertia[body] * (axes.T @ nadir))
        pull = ORBIT_RATE**2 * (3 * (nadir @ place) * nadir - place)
        data.xfrc_applied[body, :3] = model.body_mass[body] * pull
        data.xfrc_applied[body, 3:] += 3 * ORBIT_RATE**2 * np.cross(nadir, along)


def reduced(model, data):
    """Mass matrix and bias forces of the joints, the base moving freely."""
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    for row, unit in zip(mass, np.eye(model.nv)):
        mujoco.mj_mulM(model, data, row, unit)
    bias = data.qfrc_bias.copy()
    for body in range(1, model.nbody):
        pushed = np.zeros(model.nv)
        force, torque = data.xfrc_applied[body, :3], data.xfrc_applied[body, 3:]
        mujoco.mj_applyFT(model, data, force, torque, data.xipos[body], body, pushed)
        bias -= pushed
    of_base = np.linalg.solve(mass[:6, :6], np.c_[mass[:6, 6:], bias[:6]])
    return mass[6:, 6:] - mass[6:, :6] @ of_base[:, :-1], bias[6:] - mass[6:, :6] @ of_base[:, -1]
