"""What the projection of an edit needs of a mesh: points on all of its parts, their handles, the dictionary there."""

import numpy as np
import torch
from jaxtyping import Float, Int

from ..handles import BoxHandles
from ..space import ActionSpace
from .boxes import rest_of
from .bringing import weights_like
from .parts import Parts
from .similarity import Similarity
from .surface import Mesh, drawn, spread, triangles

FEWEST = 16  # samples on a part: its handles are found by regression


def turned(there: Similarity, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Places in the unit of the file, along the axes of the training box."""
    return np.asarray(points, dtype=np.float64) @ there.rotation.T


def held(mesh: Mesh, parts: Parts, n: int, seed: int) -> tuple[Float[np.ndarray, "p 3"], Int[np.ndarray, " p"]]:
    """The samples of a surface and their parts, and further ones on parts that have too few for a regression."""
    corners = triangles(mesh, "edit")
    points, chosen = drawn(corners, n, seed)
    labels = parts.faces[chosen]
    few = np.flatnonzero(np.bincount(labels, minlength=len(parts)) < FEWEST)
    if not len(few):
        return points, labels
    own = np.isin(parts.faces, few)
    more = spread(corners[own], np.searchsorted(few, parts.faces[own]), FEWEST)
    return np.concatenate([points, more.reshape(-1, 3)]), np.concatenate([labels, np.repeat(few, FEWEST)])


def handles_at(
    points: Float[np.ndarray, "p 3"],
    labels: Int[np.ndarray, " p"],
    boxes: Float[np.ndarray, "P 15"],
    names: tuple[str, ...],
) -> BoxHandles:
    """The box handles of points on parts."""
    rest = torch.from_numpy(rest_of(points, labels, boxes))
    return BoxHandles(torch.from_numpy(labels), rest, torch.from_numpy(boxes), names)


@torch.no_grad()
def dictionary_at(space: ActionSpace, cloud: Float[np.ndarray, "n 3"], at: Float[np.ndarray, "p 3"]) -> torch.Tensor:
    """F of the cloud at these places (p, 3, k), double precision."""
    return space.dictionary(weights_like(space, cloud), at=weights_like(space, at)).double().cpu()
