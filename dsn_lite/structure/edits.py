"""Random edits by the paper's rule: one handle of one shape, moved or stretched (Section 4.1)."""

from typing import NamedTuple

import numpy as np

from ..handles import BoxHandles
from ..shapes import Shapes

REACH = 0.5  # a translation t goes to [t - 0.5, t + 0.5], an edge length s to [0.5 s, 1.5 s]


class Edit(NamedTuple):
    """A handle of shape i of a collection, by its name, and the value that it is pinned at."""

    shape: int
    handle: str
    value: float


def random_edits(shapes: Shapes, count: int, seed: int = 0) -> list[Edit]:
    """`count` edits, each of a random handle of a random shape, uniform within the paper's range.

    Raises ValueError where the shapes tell no parts, or count is not 1 or more.
    """
    if count < 1:
        raise ValueError(f"random_edits: count must be 1 or more, got {count}; the paper makes 2000")
    rng, handles = np.random.default_rng(seed), {}
    drawn = [(int(i), *map(float, rng.random(2))) for i in rng.integers(len(shapes), size=count)]
    for i in {i for i, _, _ in drawn}:
        handles[i] = BoxHandles.of(shapes, i)
    return [_edit(i, handles[i], which, where) for i, which, where in drawn]


def _edit(i: int, handles: BoxHandles, which: float, where: float) -> Edit:
    """The handle at `which` of the way through all of them, and the value at `where` of the way through its range."""
    j = int(which * len(handles.names))
    value = handles.z0[j].item()
    reach = REACH * (value if ".scale." in handles.names[j] else 1.0)
    return Edit(i, handles.names[j], value + (2 * where - 1) * reach)
