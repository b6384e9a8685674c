"""Upholstery: boxes with round edges, and how furniture makers put them together."""

from dataclasses import replace

import numpy as np

from data_gen.part import RECTANGLE, box, loft, rounded, section
from data_gen.rig import FLOOR

STEPS = 2
"""Pieces of each round corner seen from above."""
BENDS = np.radians([-75.0, -38.0, 0.0, 0.0, 38.0, 75.0])
"""The slope of a cushion's side at each level; not 90 degrees, where a corner would shrink to a point."""


def between(x, y, z):
    """The centre and the edge lengths of a box between two values each of x, height above the floor, and z."""
    spans = (x, (FLOOR + y[0], FLOOR + y[1]), z)
    return tuple((low + high) / 2 for low, high in spans), tuple(high - low for low, high in spans)


def soft(name, centre, extents, radius=0.02):
    """A box whose edges and corners are round: each corner an eighth of a ball of the same radius whatever the box."""
    corner = np.broadcast_to(np.arange(8).reshape(2, 1, 4, 1), (2, len(BENDS) // 2, 4, STEPS + 1)).ravel()
    outward, around = _rounding()
    vertices = box(name, centre, extents).vertices[:, corner] - radius * (outward - around)
    return replace(_sleeve(name), vertices=vertices)


def tilted(part, height, slope=0.15):
    """The part sheared backwards: it keeps its place at a height above the floor and recedes by `slope` above it."""
    back = np.array([(1, 0, 0), (0, 1, -slope), (0, 0, 1)])
    shift = np.zeros(3) + np.multiply.outer(FLOOR + np.asarray(height), (0, 0, slope))
    return replace(part, vertices=part.vertices @ back + shift.reshape(-1, 1, 3))


def _sleeve(name):
    """The skin of a cushion, whose vertices are yet to be placed."""
    levels = np.linspace(-0.5, 0.5, len(BENDS))
    return loft(name, [section("y", (0, y, 0), (1, 1)) for y in levels], rounded(0.25, STEPS))


def _rounding():
    """For every vertex of a cushion the corner of the cube [-1, 1]^3 it belongs to, and its place on a unit ball."""
    turn = np.linspace(0, np.pi / 2, STEPS + 1)
    quarter = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    ring = np.concatenate([quarter, quarter[::-1] * [-1, 1], -quarter, quarter[::-1] * [1, -1]])
    signs = np.repeat(2 * RECTANGLE, STEPS + 1, axis=0)
    outward = [[(x, np.sign(i - 2.5), z) for x, z in signs] for i in range(len(BENDS))]
    around = [[(x * np.cos(b), np.sin(b) / np.sin(BENDS[-1]), z * np.cos(b)) for x, z in ring] for b in BENDS]
    return (np.array(one).reshape(-1, 3) for one in (outward, around))
