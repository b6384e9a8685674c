"""Whether modes follow parts or places: what F(y) does at the part of y that a point of x belongs to, or where it lies.

A field that is the same for all shapes moves whatever is at a place alike. Such a field is consistent too, as all
chairs have their seats near the middle; an untrained network is nearly that. Parts are followed only where a mode does
the same to a part wherever it stands: then `by_part` is above `by_place`.
"""

from typing import NamedTuple

import torch
from jaxtyping import Float
from torch import Tensor

from ..shapes import Shapes
from ..space import ActionSpace
from .bases import check_dictionary


class Following(NamedTuple):
    """How alike each mode of x and of y is, as cosines over the points of all pairs."""

    by_part: Float[Tensor, " k"]  # at the same point of the same part
    by_place: Float[Tensor, " k"]  # at the same place


@torch.no_grad()
def following(space: ActionSpace, x: Shapes, y: Shapes) -> Following:
    """Compares F(x) at the points of x with F(y) where the boxes of y put them, and where they are, for N pairs.

    Points whose part y lacks are left out. Raises ValueError where shapes tell no parts.
    """
    check_dictionary("following", space)
    if not (x.has_parts and y.has_parts):
        raise ValueError(
            "following: shapes must have labels, rest and boxes, these have no parts; take shapes of data_gen"
        )
    x, y = x.like(space), y.like(space)
    A, moved = space.dictionary(x.points), x.at_boxes(y.boxes)
    known = (x.labels.expand(moved.shape[:2]) >= 0) & moved.isfinite().all(-1)
    places = torch.where(known.unsqueeze(-1), moved, x.points), x.points
    return Following(*(_cosine(A[known], space.dictionary(y.points, at=at)[known]) for at in places))


def _cosine(a: Float[Tensor, "p 3 k"], b: Float[Tensor, "p 3 k"]) -> Float[Tensor, " k"]:
    dot = (a * b).sum((0, 1))
    return dot / (a.square().sum((0, 1)) * b.square().sum((0, 1))).sqrt().clamp_min(1e-12)
