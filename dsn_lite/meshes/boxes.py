"""Oriented boxes of parts, with their axes in one order for all shapes, so that the handles of shapes compare."""

from itertools import permutations, product

import numpy as np
import trimesh
from jaxtyping import Float, Int

LOOSE = 1.2  # of boxes up to so much larger than the smallest, the one that is turned least is taken
THICK = 0.01  # of its longest edge: what a box counts at least in each direction where volumes are compared
FLAT = 1e-7  # of a part's size: what is thinner has no extent
DIRECTIONS = 400  # in which the outermost of many points are found
AT_ONCE = 8192  # points that are compared in one go, which bounds the memory
AXES = np.eye(3)
TURNS = np.array([np.diag(signs) @ axes for axes in permutations(AXES) for signs in product((1, -1), repeat=3)])
TURNS = TURNS[np.linalg.det(TURNS) > 0]  # the 24 turns of a cube


def oriented(points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " 15"]:
    """The box of points: centre 3, rotation 9 (its columns are the box's axes) and extents 3, as sample files have it.

    Its volume is that of trimesh.bounds.oriented_bounds, to a fifth: of several boxes within that, the one turned least
    against x, y and z is taken, so that what is nearly aligned, or round, is aligned. Axis i of the box is the one
    nearest to axis i of the world, right-handed. Flat and straight parts, and points, have extents of 0.
    """
    points = np.asarray(points, dtype=np.float64)
    outer = _outermost(points)
    smallest = _upright(_rotation(outer))
    candidates = [AXES, *(_upright(_swing(i, smallest[:, i])) for i in range(3)), smallest]
    volumes = np.array([_volume(np.ptp(outer @ R, axis=0)) for R in candidates])
    near = volumes <= LOOSE * volumes.min()
    R = max((R for R, ok in zip(candidates, near, strict=True) if ok), key=lambda R: round(np.trace(R), 9))
    low, high = (points @ R).min(0), (points @ R).max(0)
    extents = np.where(high - low > FLAT * (high - low).max(), high - low, 0)
    return np.concatenate([R @ (low + high) / 2, R.reshape(-1), extents])


def boxes_of(
    points: Float[np.ndarray, "n 3"], labels: Int[np.ndarray, " n"], count: int
) -> Float[np.ndarray, "count 15"]:
    """The boxes of `count` parts; labels tell each point's part, -1 none."""
    return np.stack([oriented(points[labels == part]) for part in range(count)])


def rest_of(
    points: Float[np.ndarray, "n 3"], labels: Int[np.ndarray, " n"], boxes: Float[np.ndarray, "P 15"]
) -> Float[np.ndarray, "n 3"]:
    """Where points lie in the unit boxes of their parts: u of p = c + R diag(s) u, 0 along an axis without extent."""
    own = boxes[labels]
    local = np.einsum("nca,nc->na", own[:, 3:12].reshape(-1, 3, 3), points - own[:, :3])
    edges = own[:, 12:]
    return np.where((edges > 0) & (labels >= 0)[:, None], local / np.where(edges > 0, edges, 1), 0)


def _outermost(points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "m 3"]:
    """Those of many points that lie furthest in some direction: their convex hull, or nearly."""
    if len(points) <= DIRECTIONS:
        return np.unique(points, axis=0)  # sorted: of boxes that are equally small, trimesh takes the first
    blocks = [block[_ends(block)] for block in np.array_split(points, -(-len(points) // AT_ONCE))]
    outer = np.concatenate(blocks)
    return np.unique(outer[_ends(outer)], axis=0)


def _ends(points: Float[np.ndarray, "n 3"]) -> Int[np.ndarray, " m"]:
    """Which points are the first or the last in one of many directions, those of edges and corners of boxes too."""
    height, turn = 1 - (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS, np.pi * (1 + 5**0.5) * np.arange(DIRECTIONS)
    width = np.sqrt(1 - height**2)  # half a sphere, since each direction has two ends
    directions = np.column_stack([width * np.cos(turn), height, width * np.sin(turn)])
    along = np.concatenate([directions, [*product((-1, 0, 1), repeat=3)]]) @ points.T
    return np.unique([along.argmin(1), along.argmax(1)])


def _rotation(points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "3 3"]:
    """Axes of the smallest box, as columns, in trimesh's order."""
    middle = points - points.mean(0)
    middle = middle / (np.abs(middle).max() or 1)  # trimesh's tolerances are absolute
    scales, axes = np.linalg.svd(middle, full_matrices=len(points) < 3)[1:]
    rank = int((scales > FLAT * scales[0]).sum())
    if rank == 3:
        return trimesh.bounds.oriented_bounds(middle)[0][:3, :3].T
    if rank < 2:  # a line: the turn about it is the least that leads there
        return _swing(int(np.abs(axes[0]).argmax()), axes[0]) if rank else AXES
    inside = trimesh.bounds.oriented_bounds_2D(middle @ axes[:2].T)[0][:2, :2] @ axes[:2]
    return np.column_stack([*inside, np.cross(*inside)])


def _swing(i: int, axis: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "3 3"]:
    """The smallest rotation that brings world axis i onto this axis, or onto its opposite where that is nearer."""
    axis = axis if axis[i] >= 0 else -axis
    v, c = np.cross(AXES[i], axis), axis[i]
    skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return AXES + skew + skew @ skew / (1 + c)


def _upright(R: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "3 3"]:
    """The same box with its axes named and pointed like the world's nearest, right-handed; of equals, one by rule."""
    turned = (R if np.linalg.det(R) > 0 else R * [1, 1, -1]) @ TURNS
    return max(turned, key=lambda Q: (round(np.trace(Q), 6), *Q.round(6).reshape(-1)))


def _volume(extents: Float[np.ndarray, " 3"]) -> float:
    return float((extents + THICK * extents.max()).prod())
