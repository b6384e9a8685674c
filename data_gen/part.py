"""Parts: closed surfaces whose vertices are linear in the numbers they are made of.

Every part is a loft: cross-sections joined by a skin and closed at both ends. A box is a loft of two rectangles, a
cylinder of two polygons, a ball of many between two tips. A bent plate, a tapered leg, a swept wing, a bottle are lofts
as well; their vertices are linear in the centres and edge lengths of the sections. So a shape made of parts is linear
in its parameters however it tapers or bends, as long as the sections are; only turning is not linear (`joint.py`).
A number may be one number for all shapes or an array (N,) over shapes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

AXES = "xyz"


@dataclass(frozen=True)
class Part:
    """A name, vertices (N or 1, V, 3), outward triangles (F, 3) that close it, and a UV (V, 2) a vertex."""

    name: str
    vertices: np.ndarray
    triangles: np.ndarray
    uv: np.ndarray


class Section(NamedTuple):
    """A cross-section: the outline's point (q, r), both in [-0.5, 0.5], stands at centre + q a + r b."""

    centre: tuple
    a: tuple
    b: tuple


class Tip(NamedTuple):
    """A point in which a loft ends."""

    centre: tuple


def section(axis, centre, size):
    """A section perpendicular to an axis, its two edge lengths in the order of the other two: "y" takes (x, z)."""
    other = [i for i in range(3) if AXES[i] != axis]
    a, b = ([length if i == at else 0 for i in range(3)] for at, length in zip(other, size, strict=True))
    return Section(centre, tuple(a), tuple(b))


def ellipse(sides=16):
    """An outline (sides, 2) on a circle; it fills its box if sides is a multiple of 4."""
    turn = 2 * np.pi * np.arange(sides) / sides
    return np.stack([np.cos(turn), np.sin(turn)], axis=1).round(15) / 2


def rounded(share=0.25, steps=3):
    """An outline of a rectangle whose corners are quarter ellipses over `share` of each edge, in `steps` pieces."""
    turn = np.linspace(0, np.pi / 2, steps + 1)
    corner = (0.5 - share) + share * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    turned = [corner, (corner * [-1, 1])[::-1], -corner, (corner * [1, -1])[::-1]]
    return np.concatenate(turned)


RECTANGLE = np.array([(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)])


def loft(name: str, sections: Sequence[Section | Tip], outline=RECTANGLE, closed=False):
    """A skin over sections in their order; first and last are closed by flat caps, or joined where `closed`.

    The outline (m, 2) is convex, in [-0.5, 0.5]^2. Sections may run back inside the skin, as the inside of a cup does.
    """
    rings = [_ring(one, outline) for one in sections]
    shapes = max(len(ring) for ring in rings)
    vertices = np.concatenate([np.broadcast_to(ring, (shapes, *ring.shape[1:])) for ring in rings], axis=1)
    triangles = _skin([ring.shape[1] for ring in rings], closed)
    return Part(name, vertices, _outward(vertices[0], triangles), _unrolled(rings, outline, closed))


def box(name, centre, extents):
    """A box by its centre and its edge lengths along x, y, z."""
    return prism(name, centre, extents, "y", RECTANGLE)


def cylinder(name, centre, extents, axis="y", sides=16):
    """A cylinder along an axis that fills a box: its ends are ellipses if the box is not square there."""
    return prism(name, centre, extents, axis, ellipse(sides))


def prism(name, centre, extents, axis, outline):
    """An outline drawn out along an axis, to fill a box."""
    return loft(name, [_slice(centre, extents, axis, share) for share in (-0.5, 0.5)], outline)


def ball(name, centre, extents, sides=16, rings=8):
    """An ellipsoid that fills a box, its poles up and down."""
    turn = np.pi * np.arange(1, rings) / rings
    middle = [_slice(centre, extents, "y", -np.cos(t) / 2, np.sin(t)) for t in turn]
    low, high = (Tip(_slice(centre, extents, "y", end).centre) for end in (-0.5, 0.5))
    return loft(name, [low, *middle, high], ellipse(sides))


def joined(name, *parts):
    """Several closed surfaces as one part, such as the slats of a back or the four bars of a frame."""
    starts = np.cumsum([0, *(part.vertices.shape[1] for part in parts)])
    shapes = max(len(part.vertices) for part in parts)
    vertices = [np.broadcast_to(part.vertices, (shapes, *part.vertices.shape[1:])) for part in parts]
    triangles = [part.triangles + start for part, start in zip(parts, starts, strict=False)]
    tiles = int(np.ceil(np.sqrt(len(parts))))
    uv = [(part.uv + divmod(i, tiles)) / tiles for i, part in enumerate(parts)]
    return Part(name, np.concatenate(vertices, axis=1), np.concatenate(triangles), np.concatenate(uv))


def moved(part, name=None, by=(0, 0, 0)):
    """The same part elsewhere, under another name if one is given."""
    return replace(part, name=name or part.name, vertices=part.vertices + _vector(by))


def mirrored(part, name):
    """The mirror image of a part across x = 0."""
    return replace(part, name=name, vertices=part.vertices * [-1, 1, 1], triangles=part.triangles[:, ::-1])


def volumes(vertices, triangles):
    """Signed volume (N,) inside closed triangles (F, 3) of vertices (N, V, 3): negative where they face inwards."""
    a, b, c = (
        vertices[:, triangles[:, i]] - vertices[:, triangles[:1, :1]].mean(axis=(1, 2))[:, None] for i in range(3)
    )
    return (np.cross(a, b) * c).sum(axis=(1, 2)) / 6


def normals(vertices, triangles):
    """Outward normals (N, F, 3) of triangles, as long as twice their area."""
    a, b, c = (vertices[:, triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def _vector(values):
    """Three numbers or arrays over shapes as (N or 1, 1, 3)."""
    return np.stack(np.broadcast_arrays(*values, np.zeros(1))[:3], axis=-1).astype(np.float64)[:, None]


def _ring(one, outline):
    """The vertices (N or 1, m, 3) of a section, or the one of a tip."""
    centre = _vector(one.centre)
    if isinstance(one, Tip):
        return centre
    return centre + outline[:, :1] * _vector(one.a) + outline[:, 1:] * _vector(one.b)


def _slice(centre, extents, axis, share, scale=1.0):
    """The section of a box `share` of the way along an axis, from -0.5 to 0.5, its edges times `scale`."""
    along = AXES.index(axis)
    at = tuple(c + (share * s if i == along else 0) for i, (c, s) in enumerate(zip(centre, extents, strict=True)))
    return section(axis, at, [scale * s for i, s in enumerate(extents) if i != along])


def _skin(sizes, closed):
    """Triangles over rings of these numbers of vertices: a band between neighbours, and a cap at each end."""
    starts = np.cumsum([0, *sizes])[:-1]
    rings = [start + np.arange(size) for start, size in zip(starts, sizes, strict=True)]
    bands = [_band(a, b) for a, b in zip(rings, rings[1:] + rings[:1] if closed else rings[1:], strict=False)]
    caps = [] if closed else [_cap(rings[0][::-1]), _cap(rings[-1])]
    return np.concatenate([*bands, *caps])


def _band(a, b):
    if len(a) == 1 or len(b) == 1:
        ring = b[::-1] if len(a) == 1 else a
        return np.stack([ring, np.roll(ring, -1), np.full(len(ring), (a if len(a) == 1 else b)[0])], axis=1)
    next_a, next_b = np.roll(a, -1), np.roll(b, -1)
    return np.concatenate([np.stack([a, next_a, next_b], axis=1), np.stack([a, next_b, b], axis=1)])


def _cap(ring):
    """A fan over a convex ring; none over a tip."""
    return np.stack([np.full(max(len(ring) - 2, 0), ring[0]), ring[1:-1], ring[2:]], axis=1)


def _outward(vertices, triangles):
    return triangles if volumes(vertices[None], triangles)[0] > 0 else triangles[:, ::-1]


def _unrolled(rings, outline, closed):
    """UVs: the rings around each other, as a loft looks from above its last section; side by side where it is closed.

    Vertices are shared, which keeps the part watertight; so the first cap lies under the bands.
    """
    if closed:
        across, along = np.meshgrid(np.linspace(0, 1, len(outline)), np.linspace(0, 1, len(rings)))
        return np.stack([across.ravel(), along.ravel()], axis=1)
    reach = np.linspace(1, 0 if rings[-1].shape[1] == 1 else 1 / len(rings), len(rings))
    around = [r * (outline if ring.shape[1] > 1 else np.zeros((1, 2))) for r, ring in zip(reach, rings, strict=True)]
    return 0.5 + np.concatenate(around)
