"""The forms parts are made of, each a surface that is linear in where its box is and how large it is.

A part of any form lives in the unit box [-0.5, 0.5]^3. A point of its surface has a rest coordinate u there, and in the
shape it stands at p = c + s * u, with c the centre of the part's box and s its edge lengths: linear in (c, s).
A form says three things: the areas of its patches for given edge lengths, the rest coordinate of a point of a patch,
and its mesh in the unit box.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Box:
    """A box-shaped part: a name, the centre and the edge lengths, x, y, z each a number or an array over shapes."""

    name: str
    centre: tuple
    extents: tuple

    PATCHES = 3
    """The surface in patches of one area each: the two faces across x, the two across y, the two across z."""

    @staticmethod
    def areas(extents):
        """Areas (..., 3) of the patches of boxes with edge lengths (..., 3)."""
        x, y, z = np.moveaxis(extents, -1, 0)
        return 2 * np.stack([y * z, z * x, x * y], axis=-1)

    @staticmethod
    def rest(patch, u, v):
        """Rest coordinates (M, 3) float32 of points of the patches (M,), uniform where u, v (M,) are uniform in [0, 1).

        The two faces of a patch share v: its lower half is the low face, its upper half the high one. Nothing is
        rounded if u and v are multiples of 2^-24, as numpy draws float32.
        """
        high = v >= 0.5
        own = (high - np.float32(0.5), u - np.float32(0.5), 2 * v - high - np.float32(0.5))
        rest = np.zeros((len(patch), 3), np.float32)
        first = np.arange(0, rest.size, 3)
        for step, values in enumerate(own):
            rest.ravel()[first + (patch + step) % 3] = values
        return rest

    @staticmethod
    def unit_mesh():
        """Vertices (8, 3), triangles (12, 3) that face outwards, and one UV a vertex (8, 2).

        The UVs unroll the box as seen from straight above: the top in the middle, the four sides around it, and the
        bottom under all of them. So vertices are shared by faces, which keeps the mesh watertight.
        """
        corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        triangles = [triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))]
        reach = np.where(corners[:, 1:2] > 0, 0.5, 1.0)
        return corners, np.array(triangles), 0.5 + corners[:, [0, 2]] * [1, -1] * reach
