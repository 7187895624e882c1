"""Momentum and equations of motion of the free-floating system, in both forms."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from .chain import chain_kinematics
from .scenario import System


@dataclass(frozen=True)
class Momentum:
    """H = inertia omega + relative, about the system's centre of mass, in body axes."""

    inertia: ca.SX
    relative: ca.SX
    mass_center: ca.SX
    mass_center_rate: ca.SX

    def angular_velocity(self, angular_momentum: ca.SX) -> ca.SX:
        """The base rate that gives the system this angular momentum (body axes)."""
        return solve_symmetric(self.inertia, angular_momentum - self.relative)


def momentum(system: System, angles: ca.SX, rates: ca.SX) -> Momentum:
    """Configuration inertia, arm momentum and centre of mass relative to the base."""
    chain = chain_kinematics(system, angles, rates)
    inertia = ca.SX(system.base_inertia_kg_m2)
    relative, first, first_rate = ca.SX.zeros(3), ca.SX.zeros(3), ca.SX.zeros(3)
    for body in chain.bodies:
        inertia += body.inertia + body.mass_kg * _spread(body.center)
        relative += body.inertia @ body.angular_velocity + body.mass_kg * ca.cross(body.center, body.velocity)
        first += body.mass_kg * body.center
        first_rate += body.mass_kg * body.velocity
    center, center_rate = first / system.mass_kg, first_rate / system.mass_kg
    inertia -= system.mass_kg * _spread(center)
    relative -= ca.cross(center, first_rate)
    return Momentum(inertia, relative, center, center_rate)


def rotation_matrix(quaternion: ca.SX) -> ca.SX:
    """Body to inertial, of a scalar-first Hamilton quaternion of unit norm."""
    w, x, y, z = ca.vertsplit(quaternion)
    return ca.vertcat(
        ca.horzcat(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        ca.horzcat(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        ca.horzcat(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


def quaternion_rate(quaternion: ca.SX, angular_velocity: ca.SX) -> ca.SX:
    """Half of q (0, omega) with omega in body axes."""
    w, vector = quaternion[0], quaternion[1:4]
    scalar = -ca.dot(vector, angular_velocity)
    return 0.5 * ca.vertcat(scalar, w * angular_velocity + ca.cross(vector, angular_velocity))


def attitude_error(target: np.ndarray, quaternion: ca.SX) -> ca.SX:
    """Vector part of the target's conjugate times the attitude."""
    w, vector = target[0], ca.SX(target[1:4])
    return w * quaternion[1:4] - quaternion[0] * vector - ca.cross(vector, quaternion[1:4])


def full_dynamics(system: System) -> ca.Function:
    """The paper's equations of motion: (x, u) to the rate of x = [r, q_BN, r', omega, q, q']."""
    joints = system.joints
    state, control = ca.SX.sym("x", 13 + 2 * joints), ca.SX.sym("u", joints)
    _, attitude, velocity, spin, angles, rates = ca.vertsplit(
        state, [0, 3, 7, 10, 13, 13 + joints, 13 + 2 * joints]
    )
    parts = momentum(system, angles, rates)
    body_momentum = parts.inertia @ spin + parts.relative
    arm = ca.vertcat(angles, rates)
    arm_rate = ca.vertcat(rates, control)
    # Derivative in the body frame at a held base rate, so that only omega' is left to solve for.
    held = ca.jtimes(ca.vertcat(body_momentum, parts.mass_center_rate), arm, arm_rate)
    spin_rate = solve_symmetric(parts.inertia, -held[0:3] - ca.cross(spin, body_momentum))
    center, center_rate, center_acceleration = parts.mass_center, parts.mass_center_rate, held[3:6]
    acceleration = -rotation_matrix(attitude) @ (
        center_acceleration
        + 2 * ca.cross(spin, center_rate)
        + ca.cross(spin_rate, center)
        + ca.cross(spin, ca.cross(spin, center))
    )
    rate = ca.vertcat(velocity, quaternion_rate(attitude, spin), acceleration, spin_rate, rates, control)
    return ca.Function("full_dynamics", [state, control], [rate], ["x", "u"], ["xdot"])


def reduced_angular_velocity(system: System, inertial_momentum: np.ndarray) -> ca.Function:
    """The base rate that conserved momentum dictates: (q_BN, q, q') to omega."""
    joints = system.joints
    attitude, angles, rates = ca.SX.sym("q_bn", 4), ca.SX.sym("q", joints), ca.SX.sym("qd", joints)
    parts = momentum(system, angles, rates)
    body_momentum = rotation_matrix(attitude).T @ ca.SX(ca.sparsify(ca.DM(inertial_momentum)))
    spin = parts.angular_velocity(ca.densify(body_momentum))
    return ca.Function("angular_velocity", [attitude, angles, rates], [spin])


def reduced_dynamics(system: System, inertial_momentum: np.ndarray) -> ca.Function:
    """Momentum eliminated: (x, u) to the rate of x = [q_BN, q, q']."""
    joints = system.joints
    state, control = ca.SX.sym("x", 4 + 2 * joints), ca.SX.sym("u", joints)
    attitude, angles, rates = ca.vertsplit(state, [0, 4, 4 + joints, 4 + 2 * joints])
    spin = reduced_angular_velocity(system, inertial_momentum)(attitude, angles, rates)
    rate = ca.vertcat(quaternion_rate(attitude, spin), rates, control)
    return ca.Function("reduced_dynamics", [state, control], [rate], ["x", "u"], ["xdot"])


def runge_kutta_step(dynamics: ca.Function, step_s: float) -> ca.Function:
    """One classical fourth-order step with the control held, as a flat expression."""
    state, control = ca.SX.sym("x", dynamics.size1_in(0)), ca.SX.sym("u", dynamics.size1_in(1))
    k1 = dynamics(state, control)
    k2 = dynamics(state + step_s / 2 * k1, control)
    k3 = dynamics(state + step_s / 2 * k2, control)
    k4 = dynamics(state + step_s * k3, control)
    following = state + step_s / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return ca.Function("step", [state, control], [ca.cse(following)], ["x", "u"], ["x_next"])


def _spread(vector: ca.SX) -> ca.SX:
    """|v|^2 1 - v v^T, a unit point mass's inertia."""
    return ca.dot(vector, vector) * ca.SX.eye(3) - vector @ vector.T


def solve_symmetric(matrix: ca.SX, right: ca.SX) -> ca.SX:
    """Solve a symmetric 3x3 system by cofactors: the shortest graph there is."""
    a, b, c = matrix[0, 0], matrix[0, 1], matrix[0, 2]
    d, e, f = matrix[1, 1], matrix[1, 2], matrix[2, 2]
    m00, m01, m02 = d * f - e * e, c * e - b * f, b * e - c * d
    m11, m12, m22 = a * f - c * c, b * c - a * e, a * d - b * b
    scale = 1 / (a * m00 + b * m01 + c * m02)
    x, y, z = ca.vertsplit(right)
    return scale * ca.vertcat(
        m00 * x + m01 * y + m02 * z, m01 * x + m11 * y + m12 * z, m02 * x + m12 * y + m22 * z
    )
