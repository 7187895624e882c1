"""Scenario and system files, read into plain SI and radian values."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Link:
    """One row of the DH table with the body that hangs on it."""

    mass_kg: float
    a_m: float
    alpha_rad: float
    d_m: float
    theta_rad: float
    angle_min_rad: float
    angle_max_rad: float
    rate_max_rad_s: float
    acceleration_max_rad_s2: float
    body_exempt: bool
    center_of_mass_m: np.ndarray | None
    inertia_kg_m2: np.ndarray | None

    @property
    def length_m(self) -> float:
        """Distance from the inboard to the outboard origin; no joint angle changes it."""
        return math.hypot(self.a_m, self.d_m)


@dataclass(frozen=True)
class Payload:
    """A body held rigidly at the last origin."""

    mass_kg: float
    inertia_kg_m2: np.ndarray


@dataclass(frozen=True)
class System:
    """Base, mount and chain."""

    name: str
    base_mass_kg: float
    base_inertia_kg_m2: np.ndarray
    keep_out_radius_m: float
    mount_position_m: np.ndarray
    modified_dh: bool
    links: tuple[Link, ...]
    payload: Payload | None

    @property
    def joints(self) -> int:
        """Number of revolute joints."""
        return len(self.links)

    @property
    def mass_kg(self) -> float:
        """Mass of base, links and payload together."""
        payload = self.payload.mass_kg if self.payload else 0.0
        return self.base_mass_kg + sum(link.mass_kg for link in self.links) + payload


@dataclass(frozen=True)
class Weights:
    """Cost weights, named as in the scenario file."""

    control: float
    attitude: float
    angular_rate: float
    joint_rate: float


@dataclass(frozen=True)
class Scenario:
    """A maneuver to plan: system, start, target, grid and weights."""

    path: Path
    name: str
    system: System
    initial_joint_angles_rad: np.ndarray
    initial_joint_rates_rad_s: np.ndarray
    initial_angular_rate_rad_s: np.ndarray
    initial_attitude: np.ndarray
    target_attitude: np.ndarray | None
    duration_s: float
    steps: int
    weights: Weights
    clearance_m: float
    formulation: str

    @property
    def step_s(self) -> float:
        """Length of one integration step."""
        return self.duration_s / self.steps


def load_scenario(path: Path) -> Scenario:
    """Read a scenario file and the system it names."""
    raw = json.loads(path.read_text())
    raw_system = raw["system"]
    if isinstance(raw_system, str):
        raw_system = json.loads((path.parent / raw_system).read_text())
    system = _system(raw_system)
    initial = raw["initial"]
    joints = system.joints
    maneuver = raw["maneuver"]
    target = None
    if maneuver["type"] == "slew":
        target = _target(maneuver)
    elif maneuver["type"] != "detumble":
        raise ValueError(f"{path}: maneuver type {maneuver['type']!r} has no CasADi counterpart")
    attitude = np.array(initial.get("attitude", [1.0, 0.0, 0.0, 0.0]), dtype=float)
    return Scenario(
        path=path,
        name=raw["name"],
        system=system,
        initial_joint_angles_rad=np.radians(initial["joint_angles_deg"]),
        initial_joint_rates_rad_s=np.radians(initial.get("joint_rates_deg_s", [0.0] * joints)),
        initial_angular_rate_rad_s=np.radians(initial.get("angular_rate_deg_s", [0.0] * 3)),
        initial_attitude=attitude / np.linalg.norm(attitude),
        target_attitude=target,
        duration_s=float(raw["horizon"]["duration_s"]),
        steps=int(raw["horizon"]["steps"]),
        weights=_weights(path, raw["weights"]),
        clearance_m=float(raw.get("collision", {}).get("clearance_m", 0.01)),
        formulation=raw.get("solver", {}).get("formulation", "reduced"),
    )


def _target(maneuver: dict) -> np.ndarray:
    axis = np.array(maneuver["axis"], dtype=float)
    axis /= np.linalg.norm(axis)
    half = math.radians(maneuver["angle_deg"]) / 2.0
    return np.concatenate([[math.cos(half)], math.sin(half) * axis])


def _weights(path: Path, raw: dict) -> Weights:
    for name in ("position", "velocity", "joint_angle"):
        if raw.get(name, 0.0):
            raise ValueError(f"{path}: weights.{name} is not covered by the CasADi reference")
    return Weights(
        control=float(raw.get("control", 0.0)),
        attitude=float(raw.get("attitude", 0.0)),
        angular_rate=float(raw.get("angular_rate", 0.0)),
        joint_rate=float(raw.get("joint_rate", 0.0)),
    )


def _system(raw: dict) -> System:
    base = raw["base"]
    mass = float(base["mass_kg"])
    if "cube_side_m" in base:
        side = float(base["cube_side_m"])
        inertia = np.eye(3) * mass * side**2 / 6.0
        radius = side * math.sqrt(3.0) / 2.0
        mount = [0.0, 0.0, side / 2.0]
    else:
        inertia = np.array(base["inertia_kg_m2"], dtype=float)
        radius = float(base["keep_out_radius_m"])
        mount = [0.0, 0.0, 0.0]
    payload = raw.get("payload")
    return System(
        name=raw["name"],
        base_mass_kg=mass,
        base_inertia_kg_m2=inertia,
        keep_out_radius_m=radius,
        mount_position_m=np.array((raw.get("mount") or {}).get("position_m", mount), dtype=float),
        modified_dh=raw.get("dh_convention", "standard") == "modified",
        links=tuple(_link(link) for link in raw["links"]),
        payload=_payload(payload) if payload else None,
    )


def _payload(raw: dict) -> Payload:
    inertia = raw.get("inertia_kg_m2", np.zeros((3, 3)))
    return Payload(float(raw["mass_kg"]), np.array(inertia, dtype=float))


def _link(raw: dict) -> Link:
    low, high = raw.get("angle_min_deg"), raw.get("angle_max_deg")
    mass_center, inertia = raw.get("center_of_mass_m"), raw.get("inertia_kg_m2")
    return Link(
        mass_kg=float(raw["mass_kg"]),
        a_m=float(raw["a_m"]),
        alpha_rad=math.radians(raw["alpha_deg"]),
        d_m=float(raw["d_m"]),
        theta_rad=math.radians(raw["theta_deg"]),
        angle_min_rad=-math.inf if low is None else math.radians(low),
        angle_max_rad=math.inf if high is None else math.radians(high),
        rate_max_rad_s=math.radians(raw["rate_max_deg_s"]),
        acceleration_max_rad_s2=math.radians(raw["acceleration_max_deg_s2"]),
        body_exempt=bool(raw.get("body_exempt", False)),
        center_of_mass_m=None if mass_center is None else np.array(mass_center, dtype=float),
        inertia_kg_m2=None if inertia is None else np.array(inertia, dtype=float),
    )
