"""Box handles of one shape, by name: a translation and an edge length for each part along each axis of its box.

A point of a part is p = R (c + diag(s) u): u its rest coordinates in the part's unit box, R the box's fixed rotation,
c the centre along the box's axes, s the edge lengths. It is linear in z = (c, s), so x = B z0 (Section 3.2). The
arithmetic is that of BatchHandles, for a batch of one.
"""

from collections.abc import Sequence
from copy import copy

import torch
from jaxtyping import Float, Int
from torch import Tensor

from ..shapes import Shapes
from .batch import BatchHandles
from .kinds import Handles

AXES = "xyz"
KINDS = ("translation", "scale")
THINNEST = 1e-3  # of its edge as it stands: edge lengths stay more than 0


class BoxHandles(Handles):
    """The handles of one shape, named like leg_2.scale.y: values are places and edge lengths, in the unit of the shape.

    labels (n,) part of each point, or -1 for points without handles; rest (n, 3); boxes (P, 15) = centre, rotation,
    extents; NaN rows for parts that are not there. Parts without points have no handles, and an axis along which a
    part's points have no spread has no scale handle: `dropped` lists both. Raises ValueError where sizes do not agree.
    """

    def __init__(
        self,
        labels: Int[Tensor, " n"],
        rest: Float[Tensor, "n 3"],
        boxes: Float[Tensor, "P 15"],
        part_names: Sequence[str] | None = None,
    ):
        if boxes.ndim != 2 or boxes.shape[-1] != 15:
            raise ValueError(f"BoxHandles: boxes must be (P, 15), got {tuple(boxes.shape)}; take one shape's")
        _check(labels, rest, len(boxes))
        boxes, parts = boxes.to(rest.dtype), part_names or [f"part_{part}" for part in range(len(boxes))]
        if len(parts) != len(boxes) or len(set(parts)) < len(parts):
            raise ValueError(
                f"BoxHandles: part_names must be one for each of the {len(boxes)} boxes, all different, "
                f"got {', '.join(parts)}; number those that repeat"
            )
        self.batch = BatchHandles(labels[None], rest[None], boxes[None])
        self.rotation, self.kept = self.batch.rotation[0], self.batch.mask[0]
        self._place_at(labels, rest)
        every = [f"{part}.{kind}.{axis}" for part in parts for kind in KINDS for axis in AXES]
        kept = self.kept.flatten().tolist()
        self.names = tuple(name for name, keep in zip(every, kept, strict=True) if keep)
        self.dropped = tuple(name for name, keep in zip(every, kept, strict=True) if not keep)
        self.z0 = self._values(boxes)[self.kept]
        is_scale = torch.arange(2, device=rest.device)[:, None].expand_as(self.kept)[self.kept] == 1
        self.lower = torch.where(is_scale, THINNEST * self.z0, -torch.inf)
        self.upper = torch.full_like(self.z0, torch.inf)

    @classmethod
    def of(cls, shapes: Shapes, i: int = 0) -> "BoxHandles":
        """The handles of one shape of a collection. Raises ValueError where it tells no parts."""
        if not shapes.has_parts:
            raise ValueError(
                "BoxHandles: shapes must have labels, rest and boxes, these have no parts; take shapes of data_gen"
            )
        one = shapes[i]
        labels, rest = one.labels.expand(1, one.points.shape[1])[0], one.rest.expand(one.points.shape)[0]
        return cls(labels, rest, one.boxes[0], one.part_names or None)

    def at(self, labels: Int[Tensor, " q"], rest: Float[Tensor, "q 3"]) -> "BoxHandles":
        """The same handles at other points of the same parts, the vertices of a mesh for instance: names and values
        stay, B and `offsets` are those of the points; `coordinates` and `project` still read the points it was made of.
        Raises ValueError where labels and rest do not agree, or name parts that are not there.
        """
        _check(labels, rest, len(self.kept))
        other = copy(self)
        other._place_at(labels, rest)
        return other

    @property
    def B(self) -> Float[Tensor, "n 3 m"]:
        along = torch.stack([torch.ones_like(self.rest), self.rest], dim=1)
        dense = self.rest.new_zeros(len(self.rest), 3, *self.kept.shape)
        rows = self.held.nonzero().flatten()
        dense[rows, :, self.labels[rows]] = (self.turned[:, :, None] * along[:, None])[rows]
        return dense[:, :, self.kept]

    def offsets(self, z: Float[Tensor, " m"]) -> Float[Tensor, "n 3"]:
        of_part = self.rest.new_zeros(self.kept.shape).masked_scatter(self.kept, z.to(self.rest))[self.labels]
        local = of_part[:, 0] + of_part[:, 1] * self.rest
        return torch.where(self.held[:, None], (self.turned @ local[..., None])[..., 0], 0)

    def coordinates(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "m *j"]:
        return self.batch.coordinates(u[None])[0][self.kept.flatten()]

    def project(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "n 3 *j"]:
        return self.batch.project(u[None])[0]

    def _place_at(self, labels: Tensor, rest: Tensor) -> None:
        self.labels, self.rest, self.held = labels.long(), rest.nan_to_num(), labels >= 0
        self.turned = self.rotation[self.labels]  # of each point, for a drag

    def _values(self, boxes: Tensor) -> Tensor:
        """Centres along the boxes' axes and edge lengths (P, 2, 3)."""
        boxes, spread = boxes.nan_to_num(), self.kept[:, 1]
        centre, edges = torch.einsum("pca,pc->pa", self.rotation, boxes[:, :3]), boxes[:, 12:]
        # where no scale is kept, its fixed share of the position belongs to the translation, so that x = B z0 still
        return torch.stack([centre + torch.where(spread, 0, edges * self.batch.mean[0]), edges], dim=1)


def _check(labels: Tensor, rest: Tensor, P: int) -> None:
    if rest.shape != (*labels.shape, 3) or labels.ndim != 1 or not len(labels) or not -1 <= labels.min():
        raise ValueError(
            f"BoxHandles: labels must be (n,), -1 or a part, and rest (n, 3), got {tuple(labels.shape)} and "
            f"{tuple(rest.shape)}; take one shape's"
        )
    if labels.max() >= P:
        raise ValueError(f"BoxHandles: labels must be below the {P} parts, got {labels.max()}; take one shape's")
