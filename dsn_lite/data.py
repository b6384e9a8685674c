"""What is asked of collections of shapes: where they lie, triplets of them, and the true answers."""

from dataclasses import dataclass

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor

from .shapes import Shapes


@dataclass(frozen=True)
class Frame:
    """Where the training shapes lie and how large they are, so that a foreign shape can be brought there and back.

    n points a cloud; size: mean over shapes of the longest edge of the bounding box; along each axis the point that
    varies least from shape to shape, `share` of the way from low to high, lies at `anchor` (a floor, or a centre).
    """

    n: int
    size: float
    share: tuple[float, float, float]
    anchor: tuple[float, float, float]

    @classmethod
    def of(cls, shapes: Shapes) -> "Frame":
        """The frame of a collection."""
        low, high = shapes.points.amin(1), shapes.points.amax(1)
        shares = torch.tensor([0.5, 0.0, 1.0], dtype=low.dtype)
        places = low + shares[:, None, None] * (high - low)  # (3 shares, N, 3 axes)
        # the centre wins unless an end is clearly steadier
        steadiest = (places.std(1, correction=0) + 1e-3 * torch.tensor([[0.0], [1.0], [1.0]])).argmin(0)
        anchor = places.mean(1).gather(0, steadiest[None])[0]
        size = (high - low).amax(-1).mean()
        return cls(shapes.points.shape[1], size.item(), tuple(shares[steadiest].tolist()), tuple(anchor.tolist()))


def true_deformation(x: Shapes, y: Shapes) -> Float[Tensor, "N n 3"]:
    """Where the samples of x lie once x has become y, on the boxes of y.

    Raises ValueError where boxes do not tell.
    """
    _check_truth("true_deformation", x, y)
    return x.at_boxes(y.boxes)


def true_transfer(x: Shapes, y: Shapes, z: Shapes) -> Float[Tensor, "N n 3"]:
    """Where the samples of z lie after the change of boxes from x to y is made to z.

    Raises ValueError where boxes do not tell.
    """
    _check_truth("true_transfer", x, y, z)
    return z.at_boxes(z.boxes + y.boxes - x.boxes)


def _check_truth(where: str, *collections: Shapes) -> None:
    for shapes in collections:
        if not shapes.truth_is_known or shapes.about.get("family") != collections[0].about.get("family"):
            raise ValueError(
                f"{where}: shapes must be of one family whose parts keep their form, every point in a part, got "
                f"{_said(shapes)}; take such a family, or ask data_gen.{where.replace('triplets', 'true_transfer')}"
            )


def _said(shapes: Shapes) -> str:
    """What a collection says of its families, in few words."""
    families = shapes.about.get("families") or [shapes.about.get("family", "an unknown family")]
    return f"{len(families)} families" if len(families) > 1 else families[0]


def triplets(shapes: Shapes, count: int, seed: int = 0, *, with_truth: bool = False) -> tuple[Shapes, Shapes, Shapes]:
    """`count` random triplets x, y, z of different shapes.

    with_truth draws only triplets whose true transfer z + (y - x) keeps every parameter in its range (or, where no
    ranges are known, every part larger than nothing): outside, the answer need not be a shape. Raises ValueError where
    there are too few, or boxes do not tell the true transfer.
    """
    if count < 1 or seed < 0:
        raise ValueError(f"triplets: count must be 1 or more and seed 0 or more, got {count} and {seed}; ask for more")
    if with_truth:
        _check_truth("triplets", shapes)
    rng, found = np.random.default_rng(seed), np.zeros((0, 3), dtype=np.int64)
    for _ in range(1000 if len(shapes) > 2 else 0):
        drawn = rng.integers(len(shapes), size=(4 * count, 3))
        wanted = (drawn != np.roll(drawn, 1, axis=1)).all(1)
        if with_truth:
            wanted &= _has_truth(shapes, drawn)
        found = np.concatenate([found, drawn[wanted]])[:count]
        if len(found) == count:
            x, y, z = (shapes[torch.from_numpy(column.copy())] for column in found.T)
            return x, y, z
    raise ValueError(
        f"triplets: {count} triplets of different shapes{' with a true transfer' if with_truth else ''} were asked, "
        f"{len(found)} found among {len(shapes)} shapes; bring more shapes"
    )


def _has_truth(shapes: Shapes, drawn: np.ndarray) -> np.ndarray:
    """Which triplets stay inside the ranges, or, where no ranges are known, keep every part's extents positive."""
    if shapes.ranges is not None:
        values, (low, high) = shapes.parameters, shapes.ranges.T
    else:
        values, low, high = shapes.boxes[..., 12:].flatten(1), 1e-6, np.inf
    values = values.double().numpy()
    moved = values[drawn[:, 2]] + values[drawn[:, 1]] - values[drawn[:, 0]]
    return ((low <= moved) & (moved <= high)).all(1)
