"""Which samples of a shape an eye far away sees, exactly: no image is drawn."""

import numpy as np

from data_gen.points import blend, blocks, edges_of

EDGE_ON = 1e-6
"""Triangles whose normal has less of its length than this towards the eye are not seen."""
APART = 1e-9
"""Surfaces less apart than this hide nothing of each other, and edges cover what is so close to them."""


def visible(vertices, triangles, samples, direction):
    """Which samples (n,) of triangles (F, 3) an eye far away in a unit direction (3,) sees.

    A triangle over the two axes across the direction is a plane: three weights tell whether a point lies before or
    behind it, and a fourth number how near to the eye the triangle is there, all affine in the point. Parts are closed
    and face outwards, so that triangles turned away hide nothing that those turned to the eye do not hide.
    """
    edges = edges_of(vertices @ _axes(direction).T, triangles)
    across = np.cross(edges[1], edges[2], axis=0)
    facing = across[2] > EDGE_ON * np.linalg.norm(across, axis=0)
    points, seen = blend(edges, samples), facing[samples.faces]
    planes, asked = _planes(edges[:, :, facing]), np.flatnonzero(seen)
    for rows in blocks(len(asked), 4 * int(facing.sum())):
        seen[asked[rows]] = ~_hidden(points[asked[rows]], planes)
    return seen


def _axes(direction):
    """A right-handed rotation (3, 3) whose last row is the direction."""
    least = np.eye(3)[np.abs(direction).argmin()]
    across = np.cross(least, direction)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(direction, across), direction])


def _planes(edges):
    """For triangles turned to the eye the affine maps (3, 4 F) of (q, r, 1) to three weights, and to the nearness."""
    (aq, ar, az), (bq, br, bz), (cq, cr, cz) = edges
    area = bq * cr - br * cq
    second = np.stack([cr, -cq, ar * cq - aq * cr]) / area
    third = np.stack([-br, bq, aq * br - ar * bq]) / area
    one = np.array([0, 0, 1])[:, None]
    return np.concatenate([1 * one - second - third, second, third, az * one + bz * second + cz * third], axis=1)


def _hidden(points, planes):
    """Which points (m, 3) lie behind a triangle."""
    told = np.concatenate([points[:, :2], np.ones((len(points), 1))], axis=1) @ planes
    *weights, near = told.reshape(len(points), 4, -1).swapaxes(0, 1)
    return ((np.minimum.reduce(weights) > -APART) & (near > points[:, 2:] + APART)).any(axis=1)
