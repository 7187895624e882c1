#!/usr/bin/env python3
"""Fly a plan of Righting in Basilisk by its torques alone; nothing corrects them.

Written by `righting export --format basilisk`; needs `bsk` and `numpy`. Within a step of the plan the joint
accelerations are constant or linear and the torques are polynomials of degree six. Basilisk reads motor torques
once a step of its own. So every two steps get two torques with the polynomial's impulse and its moment in time:
they move the joints as the polynomial does. Printed are how far the end is from the plan's, and how far the
largest torque of each joint is from what Basilisk's own equations need there for the plan's accelerations.

Some motions are unstable: an error of the joints grows until they leave the plan, however exact the torques are.
With --track the joints are held to the plan, and what that takes is printed as well.
"""

import argparse
import base64
import json
from importlib.metadata import version

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import spacecraft, spinningBodyNDOFStateEffector
from Basilisk.utilities import SimulationBaseClass


def decoded(text, shape):
    return np.frombuffer(base64.b64decode(text), "<f8").reshape(shape)


# CONSTANTS
SIMULATOR = "Basilisk"

NANOSECONDS = 1e9
# Of the steps from which accelerations are told, s.
INSTANT = 1e-5


class Simulation:
    """The system in Basilisk, at a node of the plan, stepped by `step_s`."""

    def __init__(self, node, step_s):
        self.step_ns = round(step_s * NANOSECONDS)
        self.now_ns = 0
        self.simulation = SimulationBaseClass.SimBaseClass()
        process = self.simulation.CreateNewProcess("process")
        process.addTask(self.simulation.CreateNewTask("task", self.step_ns))
        self.spacecraft = spacecraft.Spacecraft()
        self.spacecraft.ModelTag = "spacecraft"
        hub = self.spacecraft.hub
        hub.mHub = BASE["mass_kg"]
        hub.r_BcB_B = column(BASE["center_m"])
        hub.IHubPntBc_B = BASE["inertia_kg_m2"]
        # The center of mass of the whole system rests at the origin.
        hub.r_CN_NInit = column(np.zeros(3))
        hub.v_CN_NInit = column(np.zeros(3))
        w, *vector = ATTITUDES[node] * (1 if ATTITUDES[node][0] >= 0 else -1)
        hub.sigma_BNInit = column(np.array(vector) / (1 + w))
        hub.omega_BN_BInit = column(ANGULAR_RATES[node])
        self.arms, self.motors, first = [], [], 0
        for bodies in ARMS:
            arm = spinningBodyNDOFStateEffector.SpinningBodyNDOFStateEffector()
            arm.ModelTag = f"arm_{len(self.arms) + 1}"
            for joint, body in enumerate(bodies, first):
                link = spinningBodyNDOFStateEffector.SpinningBody()
                link.setMass(body["mass_kg"])
                link.setISPntSc_S(body["inertia_kg_m2"])
                link.setR_ScS_S(column(body["center_m"]))
                link.setR_SP_P(column(body["position_m"]))
                link.setDCM_S0P(body["from_parent"])
                link.setSHat_S(column([0, 0, 1]))
                link.setThetaInit(ANGLES[node][joint])
                link.setThetaDotInit(RATES[node][joint])
                arm.addSpinningBody(link)
            self.spacecraft.addStateEffector(arm)
            motors = messaging.ArrayMotorTorqueMsg()
            arm.motorTorqueInMsg.subscribeTo(motors)
            # The arms read their torques before the spacecraft moves.
            self.simulation.AddModelToTask("task", arm, 2)
            self.arms.append(arm)
            self.motors.append((motors, slice(first, first + len(bodies))))
            first += len(bodies)
        self.simulation.AddModelToTask("task", self.spacecraft, 1)
        self.simulation.InitializeSimulation()
        self.simulation.ConfigureStopTime(0)
        self.simulation.ExecuteSimulation()

    def step(self, torques):
        """One step with these torques."""
        for motors, joints in self.motors:
            motors.write(messaging.ArrayMotorTorqueMsgPayload(motorTorque=list(torques[joints])))
        self.now_ns += self.step_ns
        self.simulation.ConfigureStopTime(self.now_ns)
        self.simulation.ExecuteSimulation()

    def angles(self):
        return self.state([arm.getNameOfThetaState() for arm in self.arms])

    def rates(self):
        return self.state([arm.getNameOfThetaDotState() for arm in self.arms])

    def state(self, names):
        """Of the joints; the arms' messages are a step behind."""
        states = [self.spacecraft.dynManager.getStateObject(name).getState() for name in names]
        return np.concatenate([np.array(state).reshape(-1) for state in states])

    def attitude(self):
        """Body to inertial, scalar first."""
        sigma = np.array(self.spacecraft.scStateOutMsg.read().sigma_BN)
        square = sigma @ sigma
        return np.r_[1 - square, 2 * sigma] / (1 + square)


def column(values):
    return [[float(value)] for value in values]


def fly(step_s, track):
    """The flight in steps of at most `step_s`."""
    substeps = 2 * max(1, round(np.ceil((TIMES[1] - TIMES[0]) / (2 * step_s) - 1e-6)))
    simulation = Simulation(0, (TIMES[1] - TIMES[0]) / substeps)
    step_s = simulation.step_ns / NANOSECONDS
    in_pairs = torques_of_powers(substeps)
    largest_held = np.zeros(len(JOINTS))
    for step, coefficients in enumerate(TORQUE_COEFFICIENTS):
        mass = reduced(step)[0] if track else None
        for part, torques in enumerate(in_pairs @ coefficients):
            if track:
                angles, rates = planned(step, part * step_s)
                angles, rates = simulation.angles() - angles, simulation.rates() - rates
                held = -mass @ (2 * RETURN * rates + RETURN**2 * angles)
                largest_held = np.maximum(largest_held, np.abs(held))
                torques = torques + held
            simulation.step(torques)
    outcome = {
        "simulator": f"Basilisk {version('bsk')}",
        "integrator": "RK4",
        "step_s": step_s,
        "attitude_error_rad": angle_between(simulation.attitude(), END_ATTITUDE),
        "joint_error_rad": float(np.abs(simulation.angles() - ANGLES[-1]).max(initial=0.0)),
        "peak_torque_difference_percent": percent(needed_at_peaks() - np.abs(TORQUES).max(axis=0)),
    }
    return outcome | ({"tracking_torque_percent": percent(largest_held)} if track else {})


def torques_of_powers(substeps):
    """Of each power of the place in the plan's step (columns), torques over its parts (rows)."""
    powers, length = np.arange(7), 2 / substeps
    rows = []
    for start in np.arange(0, substeps, 2) * length - 1:
        end = start + 2 * length
        impulse = (end ** (powers + 1) - start ** (powers + 1)) / (powers + 1)
        moment = end * impulse - (end ** (powers + 2) - start ** (powers + 2)) / (powers + 2)
        mean = impulse / (2 * length)
        rest = moment / length**2 - 2 * mean
        rows += [mean + rest, mean - rest]
    return np.array(rows)


def needed_at_peaks():
    """Of each joint, what its acceleration needs where its planned torque is the largest."""
    needed = np.zeros(len(JOINTS))
    for joint, step in enumerate(np.abs(TORQUES).argmax(axis=0)):
        mass, bias = reduced(step)
        needed[joint] = abs(mass[joint] @ ACCELERATIONS[step] + bias[joint])
    return needed


def reduced(step):
    """Mass matrix and bias torques of the joints at a node, the base moving freely: joint accelerations are an
    affine function of torques."""
    scale = np.abs(TORQUES).max(axis=0)
    scale = np.where(scale > 0, scale, scale.max(initial=1e-300))
    still = accelerations(step, np.zeros(len(JOINTS)))
    change = np.transpose([(accelerations(step, row) - still) / row.max() for row in np.diag(scale)])
    mass = np.linalg.inv(change)
    return mass, -mass @ still


def accelerations(step, torques):
    simulation = Simulation(step, INSTANT)
    before = simulation.rates()
    simulation.step(torques)
    return (simulation.rates() - before) / INSTANT
