"""Connected components of triangles, by the form of a mesh and not by how its file repeats vertices."""

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

SAME = 1e-6  # of the longest edge of the box: vertices that are nearer coincide


def components(vertices: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]) -> Int[np.ndarray, " f"]:
    """The component of each face, counted in the order of their first faces.

    Faces are connected where they share a vertex of the file, or an edge between places that no third triangle uses:
    seams, duplicate vertices and a file without any shared vertex (STL) do not split, and closed parts that touch in a
    corner or along an edge stay apart. Nothing needs to be watertight or manifold.
    """
    links = np.concatenate([faces[:, :2], faces[:, 1:]])
    own = joined(links, len(vertices))[faces[:, 0]]
    if own.max(initial=0) > 0:
        own = joined(_over_edges(weld(vertices)[faces], own), int(own.max()) + 1)[own]
    return in_order(own)


def weld(vertices: Float[np.ndarray, "v 3"]) -> Int[np.ndarray, " v"]:
    """A number for each place: vertices that coincide have the same."""
    low, size = vertices.min(0), np.ptp(vertices, axis=0).max()
    cells = np.rint((vertices - low) / (SAME * size or 1)).astype(np.int64)
    return np.unique((cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2], return_inverse=True)[1].reshape(-1)


def in_order(labels: Int[np.ndarray, " f"]) -> Int[np.ndarray, " f"]:
    """The same labels, counted 0, 1, 2 in the order in which they first appear."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse.reshape(-1)]


def joined(links: Int[np.ndarray, "l 2"], count: int) -> Int[np.ndarray, " count"]:
    """For each of `count` things the group it is in, where these pairs are linked."""
    graph = coo_array((np.ones(len(links), dtype=bool), tuple(links.T)), shape=(count, count))
    return connected_components(graph, directed=False)[1]


def _over_edges(faces: Int[np.ndarray, "f 3"], own: Int[np.ndarray, " f"]) -> Int[np.ndarray, "l 2"]:
    """Pairs of components that meet at an edge which at most two different triangles use, or in the same triangle."""
    a, b, c = np.sort(faces, axis=1).T
    triangle = _numbered(_numbered(a, b), c)
    start, end = np.concatenate([a, b, a]), np.concatenate([b, c, c])
    real = start != end
    edge, which = _numbered(start[real], end[real]), np.tile(np.arange(len(faces)), 3)[real]
    order = np.lexsort([triangle[which], edge])
    edge, which = edge[order], which[order]
    same_edge, same_triangle = _repeats(edge), _repeats(triangle[which])
    others = np.bincount(edge[1:][same_edge & ~same_triangle], minlength=len(edge))  # different triangles but one
    linked = same_edge & (same_triangle | (others[edge[1:]] == 1))
    return own[np.column_stack([which[:-1], which[1:]])[linked]]


def _numbered(a: Int[np.ndarray, " n"], b: Int[np.ndarray, " n"]) -> Int[np.ndarray, " n"]:
    """A number for each different pair."""
    return np.unique(a * (b.max(initial=0) + 1) + b, return_inverse=True)[1].reshape(-1)


def _repeats(values: Int[np.ndarray, " n"]) -> Bool[np.ndarray, " m"]:
    return values[1:] == values[:-1]
