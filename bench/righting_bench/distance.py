"""Distances between segments, and which of them a plan must keep."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from .chain import Segment, chain_kinematics
from .scenario import System

# Relative to the product of squared lengths: below it two segments count as parallel.
PARALLEL = 1e-12


@dataclass(frozen=True)
class Clearances:
    """The checked distances: links against the base sphere, then pairs of links (numbered from 1)."""

    body_links: list[int]
    pairs: list[tuple[int, int]]

    @property
    def count(self) -> int:
        """How many distances are kept at a node."""
        return len(self.body_links) + len(self.pairs)


def checked_clearances(system: System) -> Clearances:
    """Links not exempt against the base sphere, and every pair that shares no joint.

    Two links share a joint when every link between them has no length. A link of no length is an end
    point of its neighbours and is checked with them.
    """
    lengths = [link.length_m for link in system.links]
    body_links = [
        index + 1 for index, link in enumerate(system.links) if not link.body_exempt and lengths[index] > 0.0
    ]
    pairs = [
        (first + 1, second + 1)
        for first in range(system.joints)
        for second in range(first + 1, system.joints)
        if lengths[first] > 0.0 and lengths[second] > 0.0 and any(lengths[first + 1 : second])
    ]
    return Clearances(body_links, pairs)


def squared_margins(system: System, clearance_m: float) -> ca.Function:
    """Squared distance less its squared limit, for each checked clearance: (q) to a column.

    Squared, since the square root's derivative is singular where a distance vanishes.
    """
    angles = ca.SX.sym("q", system.joints)
    segments = chain_kinematics(system, angles, ca.SX.zeros(system.joints)).segments
    checked = checked_clearances(system)
    margins = []
    for index in checked.body_links:
        limit = system.keep_out_radius_m + clearance_m
        margins.append((_to_origin(segments[index - 1]), limit))
    for first, second in checked.pairs:
        margins.append((_between(segments[first - 1], segments[second - 1]), clearance_m))
    rows = [squared - limit**2 for squared, limit in margins]
    return ca.Function("margins", [angles], [ca.cse(ca.vertcat(ca.SX(0, 1), *rows))], ["q"], ["margin"])


def _to_origin(segment: Segment) -> ca.SX:
    direction = segment.outboard - segment.inboard
    position = _clamp(-ca.dot(segment.inboard, direction) / segment.length_m**2)
    return ca.sumsqr(segment.inboard + position * direction)


def _between(first: Segment, second: Segment) -> ca.SX:
    """Squared distance of two segments (Ericson, Real-Time Collision Detection, 5.1.9)."""
    along, across = first.outboard - first.inboard, second.outboard - second.inboard
    apart = first.inboard - second.inboard
    a, e = first.length_m**2, second.length_m**2
    b, c, f = ca.dot(along, across), ca.dot(along, apart), ca.dot(across, apart)
    area = a * e - b * b
    parallel = area <= PARALLEL * a * e
    # The divisor is replaced, not the quotient: a NaN times zero would still be NaN.
    on_first = _clamp((b * f - c * e) / ca.if_else(parallel, 1, area))
    on_second = _clamp((b * on_first + f) / e)
    on_first = _clamp((b * on_second - c) / a)
    return ca.sumsqr(apart + on_first * along - on_second * across)


def _clamp(value: ca.SX) -> ca.SX:
    return ca.fmin(ca.fmax(value, 0), 1)
