"""Few parts of many pieces: small ones go to their closest neighbour, overlapping ones become one."""

from itertools import combinations, product

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import cKDTree
from tqdm.auto import tqdm

from .boxes import oriented
from .connecting import joined
from .surface import spread

SMALL = 0.1  # of the shape's diagonal: pieces with a shorter one are not parts of their own
OVERLAP = 0.5  # volume that two boxes share, of what they fill together, above which two pieces are one
PADDED = 0.005  # of the shape's diagonal, around every box: flat pieces fill a volume too
MOST = 64  # pieces that are looked at one by one: the largest; all the others go to these
SAMPLES = 200_000  # on all pieces together, by which neighbours are found
ALIKE = 1.001  # pieces whose sizes differ less are merged together: of four legs, not one
GRID = (np.array([*product(range(8), repeat=3)]) + 0.5) / 8 - 0.5


def merged(
    corners: Float[np.ndarray, "f 3 3"], labels: Int[np.ndarray, " f"], most: int, *, small: float, overlap: float
) -> Int[np.ndarray, " P"]:
    """For each of P pieces the piece whose part it belongs to, the largest of the part; at least two parts are left.

    Three steps: pieces smaller than `small` go to the closest other; pieces whose oriented boxes share more than
    `overlap` of their common volume become one (intersection over union; boxes, since surfaces need not be closed);
    while there are more than `most`, the smallest goes to its closest neighbour, together with those of its size.
    """
    low, high = _bounds(corners, labels)
    size, whole = np.linalg.norm(high - low, axis=1), float(np.linalg.norm(high.max(0) - low.min(0)))
    clouds = spread(corners, labels, int(np.clip(SAMPLES // len(low), 1, 256)))
    into = np.arange(len(low))
    kept = np.flatnonzero(_large(size, small * whole))
    rest = np.setdiff1d(into, kept)
    into[rest] = kept[_closest(clouds[kept], clouds[rest])]
    if overlap < 1:
        into = _overlapping(corners, labels, kept, (low, high), overlap, PADDED * whole)[into]
    return _few(clouds, size, np.unique(into), most)[into]


def _large(size: Float[np.ndarray, " P"], least: float) -> Bool[np.ndarray, " P"]:
    """The pieces that are large enough, but the two largest at least and the MOST largest at most."""
    rank = np.argsort(np.argsort(-size, kind="stable"))
    return (rank < 2) | ((size >= least) & (rank < MOST))


def _closest(clouds: Float[np.ndarray, "K s 3"], others: Float[np.ndarray, "R s 3"]) -> Int[np.ndarray, " R"]:
    """For each other cloud, which of the first comes nearest to it."""
    distance, index = cKDTree(clouds.reshape(-1, 3)).query(others)
    nearest = distance.argmin(1)
    return index[np.arange(len(others)), nearest] // clouds.shape[1]


def _overlapping(corners, labels, kept, bounds, overlap, padding) -> Int[np.ndarray, " P"]:
    """For each of the kept pieces the largest of those that it overlaps, directly or through others."""
    size = np.linalg.norm(bounds[1] - bounds[0], axis=1)
    low, high = (ends[kept] for ends in bounds)
    pairs = [
        (i, j)
        for i, j in combinations(range(len(kept)), 2)
        if (np.minimum(high[i], high[j]) - np.maximum(low[i], low[j]) >= -2 * padding).all()
    ]
    near = tqdm(sorted({*sum(pairs, ())}), desc="boxes of pieces", leave=False, delay=2)
    boxes = {i: _padded(corners[labels == kept[i]], padding) for i in near}
    links = np.array([pair for pair in pairs if _shared(*map(boxes.get, pair)) > overlap], dtype=np.int64).reshape(
        -1, 2
    )
    group, into = joined(links, len(kept)), np.arange(len(size))
    for g in np.unique(group):
        members = kept[group == g]
        into[members] = members[size[members].argmax()]
    return into


def _padded(corners: Float[np.ndarray, "f 3 3"], padding: float) -> Float[np.ndarray, " 15"]:
    return oriented(corners.reshape(-1, 3)) + padding * np.repeat([0, 2], [12, 3])


def _shared(a: Float[np.ndarray, " 15"], b: Float[np.ndarray, " 15"]) -> float:
    """The volume two boxes share as a part of what they fill together, by a grid of points in the smaller one."""
    a, b = sorted((a, b), key=lambda box: box[12:].prod())
    places = (GRID * a[12:]) @ a[3:12].reshape(3, 3).T + a[:3]
    inside = (np.abs((places - b[:3]) @ b[3:12].reshape(3, 3)) <= b[12:] / 2).all(1).mean()
    shared = inside * a[12:].prod()
    return float(shared / (a[12:].prod() + b[12:].prod() - shared))


def _few(clouds, size, left, most) -> Int[np.ndarray, " P"]:
    """Merges the smallest on until `most` are left, or would be fewer than two: for each piece where it went."""
    into, size = np.arange(len(size)), size.copy()
    if len(left) <= most:
        return into
    trees = [cKDTree(clouds[i]) for i in left]
    distance = np.array([[tree.query(clouds[i])[0].min() for tree in trees] for i in left])
    np.fill_diagonal(distance, np.inf)
    alive = np.ones(len(left), dtype=bool)
    while alive.sum() > most:
        least = size[left[alive]].min()
        going = np.flatnonzero(alive & (size[left] <= ALIKE * least))
        if alive.sum() - len(going) < 2:
            going = going[:1]
        for i in going:
            others = np.where(alive, distance[i], np.inf)
            others[np.setdiff1d(going, i)] = np.inf
            j = int(others.argmin())
            alive[i] = False
            into[into == left[i]] = left[j]
            distance[j] = np.minimum(distance[j], distance[i])
            distance[:, j] = distance[j]
            distance[j, j] = np.inf
    return into


def _bounds(
    corners: Float[np.ndarray, "f 3 3"], labels: Int[np.ndarray, " f"]
) -> tuple[Float[np.ndarray, "P 3"], Float[np.ndarray, "P 3"]]:
    """The lowest and highest corner of every piece."""
    order = np.argsort(labels, kind="stable")
    start = np.flatnonzero(np.diff(labels[order], prepend=-1))
    low, high = corners.min(1)[order], corners.max(1)[order]
    return np.minimum.reduceat(low, start), np.maximum.reduceat(high, start)
