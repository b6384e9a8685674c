"""Joints: hinges that turn parts and slides that shift them, and how their motions add up along a chain of parts.

A joint hangs some parts `on` another one. Where that part itself hangs on a joint, its motion carries all that hangs on
it, as an upper arm carries the lower one. Turning is the one thing of a rig that is not linear in the parameters.
"""

from typing import NamedTuple

import numpy as np

HINGE, SLIDE = "hinge", "slide"


class Joint(NamedTuple):
    """What `parts` turn about or shift along: a fixed axis, a point on it, and a value that is 0 in the rest pose."""

    name: str
    kind: str
    parts: tuple
    on: str
    axis: tuple
    pivot: tuple
    value: object


def hinge(name, parts, on, axis, pivot, angle):
    """Parts turn about the axis through the pivot by an angle in radians, counterclockwise seen against the axis.

    Raises ValueError for an axis without a direction.
    """
    return Joint(name, HINGE, tuple(parts), on, _unit(axis, f"{HINGE} {name}"), pivot, angle)


def slide(name, parts, on, axis, pivot, distance):
    """Parts shift along the axis; the pivot is where to draw it.

    Raises ValueError for an axis without a direction.
    """
    return Joint(name, SLIDE, tuple(parts), on, _unit(axis, f"{SLIDE} {name}"), pivot, distance)


def turns(axis, angles):
    """Rotations (N, 3, 3) about one unit axis by angles (N,), after Rodrigues."""
    x, y, z = axis
    K = np.array([(0, -z, y), (z, 0, -x), (-y, x, 0)])
    s, c = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.eye(3) + s * K + (1 - c) * (K @ K)


def motion(joint, pivot, value):
    """The turn (N, 3, 3) and shift (N, 3) of one joint alone, for pivots (N, 3) and values (N,): q = turn r + shift."""
    if joint.kind == SLIDE:
        return np.broadcast_to(np.eye(3), (len(value), 3, 3)), value[:, None] * joint.axis
    turn = turns(joint.axis, value)
    return turn, pivot - np.einsum("nij,nj->ni", turn, pivot)


def after(parent, child):
    """The motion of a child joint carried by its parent's; each a turn (N, 3, 3) and a shift (N, 3)."""
    (outer, shift), (inner, own) = parent, child
    return outer @ inner, np.einsum("nij,nj->ni", outer, own) + shift


def parents(joints):
    """For each joint the index of the joint that carries it, or -1. Parents stand before their children."""
    return [next((i for i, one in enumerate(joints) if joint.on in one.parts), -1) for joint in joints]


def _unit(axis, where):
    found = np.asarray(axis, np.float64)
    if found.shape != (3,) or not 0 < np.linalg.norm(found) < np.inf:
        raise ValueError(f"{where}: axis must be three numbers, not all 0, got {axis}; (0, 1, 0) is upwards")
    return tuple((found / np.linalg.norm(found)).tolist())
