"""Kinematics of the chain in body axes: origins, frames, rates and the bodies they carry."""

from __future__ import annotations

import math
from dataclasses import dataclass

import casadi as ca
import numpy as np

from .scenario import Link, System


@dataclass(frozen=True)
class Segment:
    """The straight line from a link's inboard to its outboard origin, in body axes."""

    inboard: ca.SX
    outboard: ca.SX
    length_m: float


@dataclass(frozen=True)
class Body:
    """A massive body of the chain: all vectors in body axes, rates relative to the base."""

    mass_kg: float
    center: ca.SX
    velocity: ca.SX
    angular_velocity: ca.SX
    inertia: ca.SX


@dataclass(frozen=True)
class Chain:
    """Every segment, and every body that has mass."""

    segments: list[Segment]
    bodies: list[Body]


def chain_kinematics(system: System, angles: ca.SX, rates: ca.SX) -> Chain:
    """Walk the DH table from the mount outwards.

    A standard row's body moves with its own frame; a modified row's body spans origin i-1 to i and so
    moves with the frame before it.
    """
    rotation = ca.SX.eye(3)
    origin = ca.SX(system.mount_position_m)
    velocity = ca.SX.zeros(3)
    spin = ca.SX.zeros(3)
    segments: list[Segment] = []
    bodies: list[Body] = []
    for index, link in enumerate(system.links):
        angle, rate = angles[index] + link.theta_rad, rates[index]
        if system.modified_dh:
            carrier, carrier_spin = rotation, spin
            rotation = ca.mtimes(ca.mtimes(carrier, _rotation_x(link.alpha_rad)), _rotation_z(angle))
            offset = carrier @ ca.SX(_modified_offset(link))
            spin = spin + rotation[:, 2] * rate
        else:
            spin = spin + rotation[:, 2] * rate
            rotation = ca.mtimes(ca.mtimes(rotation, _rotation_z(angle)), _rotation_x(link.alpha_rad))
            offset = rotation @ ca.SX(_standard_offset(link))
            carrier, carrier_spin = rotation, spin
        segments.append(Segment(origin, origin + offset, link.length_m))
        if link.mass_kg > 0.0:
            bodies.append(_link_body(system, link, carrier, carrier_spin, origin, velocity, offset))
        origin = origin + offset
        velocity = velocity + ca.cross(carrier_spin, offset)
    if system.payload:
        inertia = rotation @ ca.SX(system.payload.inertia_kg_m2) @ rotation.T
        bodies.append(Body(system.payload.mass_kg, origin, velocity, spin, inertia))
    return Chain(segments, bodies)


def _link_body(
    system: System, link: Link, carrier: ca.SX, spin: ca.SX, inboard: ca.SX, velocity: ca.SX, offset: ca.SX
) -> Body:
    if link.center_of_mass_m is None:
        arm = offset / 2.0
    elif system.modified_dh:
        arm = carrier @ ca.SX(link.center_of_mass_m)
    else:
        arm = offset + carrier @ ca.SX(link.center_of_mass_m)
    if link.inertia_kg_m2 is not None:
        inertia = carrier @ ca.SX(link.inertia_kg_m2) @ carrier.T
    else:
        # A slender rod: m L^2/12 (1 - n n^T) with n along the offset; nothing left when it has no length.
        inertia = link.mass_kg / 12.0 * (link.length_m**2 * ca.SX.eye(3) - offset @ offset.T)
    return Body(link.mass_kg, inboard + arm, velocity + ca.cross(spin, arm), spin, inertia)


def _standard_offset(link: Link) -> np.ndarray:
    """Origin i-1 to origin i, in frame i."""
    return np.array([link.a_m, link.d_m * _sin(link.alpha_rad), link.d_m * _cos(link.alpha_rad)])


def _modified_offset(link: Link) -> np.ndarray:
    """Origin i-1 to origin i, in frame i-1."""
    return np.array([link.a_m, -link.d_m * _sin(link.alpha_rad), link.d_m * _cos(link.alpha_rad)])


def _rotation_x(angle: float) -> ca.SX:
    c, s = _cos(angle), _sin(angle)
    return ca.sparsify(ca.SX(np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])))


def _rotation_z(angle: ca.SX) -> ca.SX:
    c, s = ca.cos(angle), ca.sin(angle)
    return ca.sparsify(ca.vertcat(ca.horzcat(c, -s, 0), ca.horzcat(s, c, 0), ca.horzcat(0, 0, 1)))


def _cos(angle: float) -> float:
    """Cosine without the 6e-17 that would keep a zero of a right-angled table alive in the graph."""
    value = math.cos(angle)
    return 0.0 if abs(value) < 1e-15 else value


def _sin(angle: float) -> float:
    value = math.sin(angle)
    return 0.0 if abs(value) < 1e-15 else value
