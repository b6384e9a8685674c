"""Collections of shapes: what is known about them, their split, triplets of them, and the true answers."""

from dataclasses import dataclass, field, fields, replace
from itertools import chain
from typing import Any

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor, nn

SPLIT = (0.85, 0.05, 0.10)  # training, validation, test: Section 4.1 of the paper


@dataclass(frozen=True)
class Shapes:
    """N shapes of n points each, and what is known about them.

    points (N, n, 3); labels (N, n) part of each point or -1; rest (N, n, 3) each point in its part's unit box;
    boxes (N, P, 15) = centre 3, rotation 9, extents 3. labels and rest are (n,) and (n, 3) where all shapes share them.
    """

    points: Float[Tensor, "N n 3"]
    labels: Int[Tensor, "..."] | None = None
    rest: Float[Tensor, "..."] | None = None
    boxes: Float[Tensor, "N P 15"] | None = None
    parameters: Float[Tensor, "N p"] | None = None
    parameter_names: tuple[str, ...] = ()
    part_names: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    about: dict[str, Any] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def corresponds(self) -> bool:
        """True where point i of one shape is point i of every other."""
        return bool(self.about.get("corresponds", False))

    @property
    def truth_is_known(self) -> bool:
        """True where every point belongs to a part with a box, so that true deformations can be computed."""
        known = None not in (self.labels, self.rest, self.boxes) and bool((self.labels >= 0).all())
        return known and bool(self.boxes.isfinite().all())

    @property
    def ranges(self) -> np.ndarray | None:
        """Lowest and highest value of every parameter (p, 2), where the file tells of one family; None elsewhere."""
        known = self.about.get("rigs", {}).get(self.about.get("family"), {}).get("ranges")
        if known is None or self.parameters is None:
            return None
        return np.array([known[name] for name in self.parameter_names]) + np.array([-1e-6, 1e-6])  # files hold float32

    def __getitem__(self, index: int | slice | Int[Tensor, " j"]) -> "Shapes":
        """The shapes at these indices, in this order; one index gives a collection of one."""
        N, kept = len(self), torch.arange(len(self))[index].reshape(-1)
        taken = {
            name: value[kept]
            for name, value in self._tensors().items()
            if not (name in ("labels", "rest") and self._shared)
        }
        names = tuple(self.names[i] for i in kept.tolist()) if len(self.names) == N else self.names
        return replace(self, names=names, **taken)

    def like(self, space: nn.Module) -> "Shapes":
        """The same shapes in the precision and on the device of a space's weights, where it has any."""
        weight = next(chain(space.parameters(), space.buffers()), self.points)
        real = {name: v.to(weight) for name, v in self._tensors().items() if v.is_floating_point()}
        return replace(self, **real, labels=None if self.labels is None else self.labels.to(weight.device))

    def _tensors(self) -> dict[str, Tensor]:
        return {f.name: getattr(self, f.name) for f in fields(self) if isinstance(getattr(self, f.name), Tensor)}

    def split(self, seed: int = 0) -> tuple["Shapes", "Shapes", "Shapes"]:
        """Training, validation and hold-out shapes, 85-5-10, by a shuffle of this seed; at least 1, 2 and 1 of them."""
        N = len(self)
        if N < 4:
            raise ValueError(
                f"split: at least 4 shapes are needed for training, validation and test, got {N}; add shapes"
            )
        order = torch.from_numpy(np.random.default_rng(seed).permutation(N))
        test, validation = max(1, round(SPLIT[2] * N)), max(2, round(SPLIT[1] * N))
        return self[order[test + validation :]], self[order[test : test + validation]], self[order[:test]]

    def at_boxes(self, boxes: Float[Tensor, "N P 15"]) -> Float[Tensor, "N n 3"]:
        """The same samples placed on other boxes: p = c + R diag(s) u."""
        labels, rest = (part.expand(self.points.shape[: part.ndim + self._shared]) for part in (self.labels, self.rest))
        own = torch.take_along_dim(boxes, labels.long().unsqueeze(-1), dim=1)
        local = own[..., 12:] * rest
        return own[..., :3] + (own[..., 3:12].unflatten(-1, (3, 3)) @ local.unsqueeze(-1)).squeeze(-1)

    @property
    def _shared(self) -> bool:
        return self.labels is not None and self.labels.ndim == 1


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
    """Where the samples of x lie once x has become y, from the boxes of y."""
    return x.at_boxes(y.boxes)


def true_transfer(x: Shapes, y: Shapes, z: Shapes) -> Float[Tensor, "N n 3"]:
    """Where the samples of z lie after the change of parts from x to y is made to z (exact where the rig is linear)."""
    return z.at_boxes(z.boxes + y.boxes - x.boxes)


def triplets(shapes: Shapes, count: int, seed: int = 0, *, with_truth: bool = False) -> tuple[Shapes, Shapes, Shapes]:
    """`count` random triplets x, y, z of different shapes.

    with_truth draws only triplets whose true transfer z + (y - x) keeps every parameter in its range (or, where no
    ranges are known, every part larger than nothing): outside, the answer need not be a shape. Raises ValueError where
    there are too few.
    """
    if count < 1 or seed < 0:
        raise ValueError(f"triplets: count must be 1 or more and seed 0 or more, got {count} and {seed}; ask for more")
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
