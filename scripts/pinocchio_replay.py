#!/usr/bin/env python3
"""Replay plans with Pinocchio: does an independent library's model of the arm move as the plan says?

For every folder with a verified plan: the model is built from the scenario in solution.json, joints and wheels follow
the controls of trajectory.csv exactly, and the base's attitude follows from the momentum, which is conserved or
changes by what acts from outside, integrated in small steps. Compared are attitude, joints, momentum at rest and the joint torques. Needs `pin` and `numpy`.
"""

from __future__ import annotations

import csv
import json
import math
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin

# Steps of the replay in each step of the plan, at the least, and how far the base may turn in one, rad.
SUBSTEPS = 4
TURN = 0.02
ATTITUDE = 2e-5
JOINTS = 1e-6
TORQUE = 1e-4
LOOKED_AT = 25


def main() -> int:
    folders = sorted(path.parent for path in Path(sys.argv[1]).glob("*/solution.json"))
    confirmed, wrong = 0, 0
    for folder in folders:
        solution = json.loads((folder / "solution.json").read_text(encoding="utf-8"))
        if not solution["verification"]["passed"]:
            continue
        problems = replayed(solution["scenario"], folder / "trajectory.csv")
        confirmed += not problems
        wrong += bool(problems)
        for problem in problems:
            print(f"{folder.name}: {problem}")
    print(f"Pinocchio {pin.__version__} confirms {confirmed} of {confirmed + wrong} verified plans")
    return 1 if wrong else 0


def replayed(scenario: dict, table: Path) -> list[str]:
    """What does not agree."""
    system = scenario["system"]
    model, order = build(system)
    time_s, states, controls, torques = read(table, order)
    outside = Outside(scenario, table)
    data, joints = model.createData(), controls.shape[1]
    position, attitude = states[0, :3], states[0, 3:7]
    angles, rates = states[0, 13 : 13 + joints], states[0, 13 + joints :]
    turn = rotation(attitude)
    velocity = np.r_[turn.T @ states[0, 7:10], states[0, 10:13], rates]
    pin.computeCentroidalMomentum(model, data, configuration(position, attitude, angles), velocity)
    momentum = data.hg.vector.copy()
    momentum[3:] += turn @ outside.stored(0, 0.0)

    def derivative(pose: np.ndarray, k: int, s: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        unit = pose[3:7] / np.linalg.norm(pose[3:7])
        turn = rotation(unit)
        of_bodies = np.r_[momentum[:3], pose[7:] - turn @ outside.stored(k, s)]
        moved = base_rates(model, data, pose[:7], (q, qd), of_bodies)
        moment = outside.moment(model, data, configuration(pose[:3], unit, q), turn, time_s[k] + s)
        return np.r_[moved, moment]

    # Position, attitude and angular momentum.
    pose = np.r_[position, attitude, momentum[3:]]
    worst_attitude = worst_joint = 0.0
    for k, u in enumerate(controls):
        step_s = time_s[k + 1] - time_s[k]
        substeps = max(SUBSTEPS, math.ceil(step_s * np.linalg.norm(states[k, 10:13]) / TURN))
        h = step_s / substeps
        for part in range(substeps):
            moved = lambda s: (k, part * h + s, angles + s * rates + 0.5 * s * s * u, rates + s * u)
            k1 = derivative(pose, *moved(0.0))
            k2 = derivative(pose + h / 2 * k1, *moved(h / 2))
            k3 = derivative(pose + h / 2 * k2, *moved(h / 2))
            k4 = derivative(pose + h * k3, *moved(h))
            pose = pose + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            angles, rates = moved(h)[2:]
        pose[3:7] /= np.linalg.norm(pose[3:7])
        node = states[k + 1]
        off = min(np.abs(pose[3:7] - node[3:7]).max(), np.abs(pose[3:7] + node[3:7]).max())
        worst_attitude = max(worst_attitude, off)
        found = np.r_[angles, rates]
        worst_joint = max(worst_joint, np.abs(found - node[13:]).max())
    problems = []
    if worst_attitude > ATTITUDE:
        problems.append(f"attitude off by {worst_attitude:.1e}")
    if worst_joint > JOINTS:
        problems.append(f"joints off by {worst_joint:.1e}")
    nodes = np.linspace(0, len(controls) - 1, min(LOOKED_AT, len(controls))).astype(int)
    push = lambda k: outside.forces(model, data, states[k], joints, time_s[k], k)
    expected = np.array([torque(model, data, states[k], controls[k], push(k)) for k in nodes])
    largest = np.abs(expected).max()
    if largest > 0 and np.abs(expected - torques[nodes]).max() > TORQUE * largest:
        problems.append(f"torques off by {np.abs(expected - torques[nodes]).max() / largest:.1e}")
    return problems


def base_rates(
    model: pin.Model,
    data: pin.Data,
    pose: np.ndarray,
    joints: tuple[np.ndarray, np.ndarray],
    momentum: np.ndarray,
) -> np.ndarray:
    """Rates of position and attitude of a base whose bodies have this momentum, while the joints move."""
    (angles, rates), unit = joints, pose[3:] / np.linalg.norm(pose[3:])
    matrix = pin.computeCentroidalMap(model, data, configuration(pose[:3], unit, angles))
    twist = np.linalg.solve(matrix[:, :6], momentum - matrix[:, 6:] @ rates)
    spin = twist[3:]
    quaternion = 0.5 * np.r_[-unit[1:] @ spin, unit[0] * spin + np.cross(unit[1:], spin)]
    return np.r_[rotation(unit) @ twist[:3], quaternion]


class Outside:
    """What acts on the bodies: wheels, of which the momenta are known, couples on the base and a gravity gradient."""

    def __init__(self, scenario: dict, table: Path):
        wheels = scenario.get("wheels") or []
        axes = [np.array(wheel["axis"], float) / np.linalg.norm(wheel["axis"]) for wheel in wheels]
        with open(table, encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        sums = lambda name, unit, row: sum(
            (axis * float(row[f"{name}{i + 1}_{unit}"]) for i, axis in enumerate(axes)), np.zeros(3)
        )
        self.momenta = [sums("hw", "n_m_s", row) for row in rows]
        self.torques = [sums("tauw", "n_m", row) for row in rows[:-1]]
        given = scenario.get("environment") or {}
        self.in_body = np.array(given.get("torque_body_n_m") or [0, 0, 0], float)
        self.inertial = np.array(given.get("torque_inertial_n_m") or [0, 0, 0], float)
        self.orbit = orbit(given["gravity_gradient"]) if given.get("gravity_gradient") else None

    def stored(self, k: int, after_s: float) -> np.ndarray:
        """The momentum of the wheels a time after node k, body axes."""
        return self.momenta[k] + after_s * self.torques[min(k, len(self.torques) - 1)]

    def nadir(self, time_s: float) -> np.ndarray:
        rate, up, ahead = self.orbit
        return -(math.cos(rate * time_s) * up + math.sin(rate * time_s) * ahead)

    def moment(
        self, model: pin.Model, data: pin.Data, q: np.ndarray, turn: np.ndarray, time_s: float
    ) -> np.ndarray:
        """The moment from outside about the center of mass, inertial axes."""
        moment = turn @ self.in_body + self.inertial
        if self.orbit:
            pin.ccrba(model, data, q, np.zeros(model.nv))
            nadir = self.nadir(time_s)
            moment = moment + 3 * self.orbit[0] ** 2 * np.cross(nadir, data.Ig.inertia @ nadir)
        return moment

    def forces(
        self, model: pin.Model, data: pin.Data, state: np.ndarray, joints: int, time_s: float, k: int
    ) -> list[pin.Force]:
        """What acts on each body at node k, in the axes and about the origin of its joint."""
        turn, spin = rotation(state[3:7]), state[10:13]
        on_base = self.in_body + turn.T @ self.inertial
        on_base = on_base - self.torques[k] - np.cross(spin, self.momenta[k])
        forces = [pin.Force.Zero(), pin.Force(np.zeros(3), on_base)]
        forces += [pin.Force.Zero() for _ in range(joints)]
        if self.orbit:
            q = configuration(state[:3], state[3:7], state[13 : 13 + joints])
            center = pin.centerOfMass(model, data, q).copy()
            square, nadir = self.orbit[0] ** 2, self.nadir(time_s)
            for joint in range(1, model.njoints):
                placed, body = data.oMi[joint], model.inertias[joint]
                place = placed.act(body.lever) - center
                pull = square * body.mass * (3 * nadir * (nadir @ place) - place)
                along = placed.rotation.T @ nadir
                force = placed.rotation.T @ pull
                moment = 3 * square * np.cross(along, body.inertia @ along) + np.cross(body.lever, force)
                forces[joint] = pin.Force(force, moment) + forces[joint]
        return forces


def orbit(gradient: dict) -> tuple[float, np.ndarray, np.ndarray]:
    """The rate of a circular orbit, and where it is and goes at the start, inertial axes."""
    rate = math.sqrt(3.986004418e14 / (6378137.0 + 1000 * gradient["altitude_km"]) ** 3)
    elements = gradient.get("elements")
    if elements:
        node, inclination, along = (
            math.radians(elements[name])
            for name in ("right_ascension_deg", "inclination_deg", "argument_of_latitude_deg")
        )
        turn = about_z(node) @ about_x(inclination) @ about_z(along)
        return rate, turn @ [1, 0, 0], turn @ [0, 1, 0]
    turn = rotation(np.array(gradient.get("orbit_attitude") or [1, 0, 0, 0], float))
    return rate, turn @ [0, 0, -1], turn @ [1, 0, 0]


def torque(
    model: pin.Model, data: pin.Data, state: np.ndarray, u: np.ndarray, forces: list[pin.Force]
) -> np.ndarray:
    """Joint torques of the free-floating system at a state, on whose bodies these forces act."""
    joints = len(u)
    turn = rotation(state[3:7])
    q = configuration(state[:3], state[3:7], state[13 : 13 + joints])
    v = np.r_[turn.T @ state[7:10], state[10:13], state[13 + joints :]]
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    bias = pin.rnea(model, data, q, v, np.zeros(model.nv), forces)
    base = np.linalg.solve(mass[:6, :6], -bias[:6] - mass[:6, 6:] @ u)
    return (mass @ np.r_[base, u] + bias)[6:]


def build(system: dict) -> tuple[pin.Model, list[int]]:
    """The model of a resolved system, and the joint coordinate of the plan that each of its joints is."""
    model = pin.Model()
    model.gravity.linear = np.zeros(3)
    base = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
    mass_kg = system["base"]["mass_kg"]
    if system["base"].get("inertia_kg_m2") is None:
        inertia = np.eye(3) * mass_kg * system["base"]["cube_side_m"] ** 2 / 6
    else:
        inertia = np.array(system["base"]["inertia_kg_m2"])
    center = np.array(system["base"].get("center_of_mass_m") or [0, 0, 0], float)
    model.appendBodyToJoint(base, pin.Inertia(mass_kg, center, inertia), pin.SE3.Identity())
    if "bodies" in system:
        return model, add_bodies(model, base, system)
    quaternion = system["mount"].get("rotation") or [1.0, 0.0, 0.0, 0.0]
    frame = pin.SE3(rotation(np.array(quaternion)), np.array(system["mount"]["position_m"], float))
    parent = base
    is_modified = system.get("dh_convention") == "modified"
    for index, row in enumerate(system["links"]):
        alpha, theta = math.radians(row["alpha_deg"]), math.radians(row["theta_deg"])
        twist, offset = about_x(alpha), np.array([row["a_m"], 0.0, row["d_m"]])
        if is_modified:
            placed = frame * pin.SE3(twist, twist @ offset)
            segment = frame.actInv(placed.translation)
            joint = model.addJoint(
                parent, pin.JointModelRZ(), placed * pin.SE3(about_z(theta), np.zeros(3)), f"joint{index}"
            )
            own = row.get("inertial_frame") == "own"
            body, axes = (joint, pin.SE3.Identity()) if own else (parent, frame)
            after = pin.SE3.Identity()
        else:
            joint = model.addJoint(
                parent, pin.JointModelRZ(), frame * pin.SE3(about_z(theta), np.zeros(3)), f"joint{index}"
            )
            after = pin.SE3(twist, offset)
            body, axes = joint, after
            segment = offset
        add_link(model, body, axes, row, segment, is_modified)
        frame, parent = after, joint
    payload = system.get("payload")
    if payload:
        inertia = np.array(payload.get("inertia_kg_m2") or np.zeros((3, 3)))
        model.appendBodyToJoint(parent, pin.Inertia(payload["mass_kg"], np.zeros(3), inertia), frame)
    return model, list(range(len(system["links"])))


def add_bodies(model: pin.Model, base: int, system: dict) -> list[int]:
    """A tree of bodies, each after the one that carries it."""
    bodies = system["bodies"]
    moving = [body["name"] for body in bodies if body["joint"]["type"] != "fixed"]
    # The joint that each body moves with, and the body's frame in the joint's.
    carried = {system["base"].get("name", "base"): (base, pin.SE3.Identity())}
    order = []
    while len(carried) <= len(bodies):
        for body in bodies:
            name, joint = body["name"], body["joint"]
            if name in carried or body["parent"] not in carried:
                continue
            parent, frame = carried[body["parent"]]
            position = np.array(joint.get("position_m") or [0, 0, 0], float)
            if joint.get("rotation"):
                turn = rotation(np.array(joint["rotation"]))
            else:
                turn = pin.rpy.rpyToMatrix(np.radians(joint.get("rpy_deg") or [0, 0, 0]))
            frame = frame * pin.SE3(turn, position)
            if joint["type"] != "fixed":
                axis = np.array(joint.get("axis") or [0, 0, 1], float)
                kind = pin.JointModelRevoluteUnaligned(axis / np.linalg.norm(axis))
                parent, frame = model.addJoint(parent, kind, frame, name), pin.SE3.Identity()
                order.append(moving.index(name))
            carried[name] = (parent, frame)
            center = np.array(body.get("center_of_mass_m") or [0, 0, 0], float)
            inertia = np.array(body.get("inertia_kg_m2") or np.zeros((3, 3)), float)
            model.appendBodyToJoint(parent, pin.Inertia(body["mass_kg"], center, inertia), frame)
    return order


def add_link(
    model: pin.Model, body: int, axes: pin.SE3, row: dict, segment: np.ndarray, is_modified: bool
) -> None:
    """The mass of a row: a rod along its segment where nothing else is given."""
    mass_kg = row["mass_kg"]
    if mass_kg == 0:
        return
    along = axes.rotation @ segment if is_modified else segment
    start = axes.translation if is_modified else np.zeros(3)
    center, inertia = row.get("center_of_mass_m"), row.get("inertia_kg_m2")
    center = start + along / 2 if center is None else axes.act(np.array(center, float))
    if inertia is None:
        inertia = mass_kg / 12 * (along @ along * np.eye(3) - np.outer(along, along))
    else:
        inertia = axes.rotation @ np.array(inertia, float) @ axes.rotation.T
    model.appendBodyToJoint(body, pin.Inertia(mass_kg, center, inertia), pin.SE3.Identity())


def read(table: Path, order: list[int]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Times, states, controls and torques, the joints in the order of the model."""
    with open(table, encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    joints, places = len(order), np.array(order)
    cells = lambda chosen, first, count: np.array([[float(x) for x in row[first : first + count]] for row in chosen])
    base = cells(rows, 1, 13)
    angles, rates = (cells(rows, 14 + k * joints, joints)[:, places] for k in (0, 1))
    controls, torques = (cells(rows[:-1], 14 + k * joints, joints)[:, places] for k in (2, 3))
    time_s = np.array([float(row[0]) for row in rows])
    return time_s, np.hstack([base, angles, rates]), controls, torques


def configuration(position: np.ndarray, quaternion: np.ndarray, angles: np.ndarray) -> np.ndarray:
    return np.r_[position, quaternion[1:], quaternion[0], angles]


def rotation(quaternion: np.ndarray) -> np.ndarray:
    return pin.Quaternion(*(quaternion / np.linalg.norm(quaternion))).matrix()


def about_x(angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def about_z(angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


if __name__ == "__main__":
    raise SystemExit(main())
