"""Box handles: a translation and a scale for each part along each axis of its box, so that x = B z0 (Section 3.2).

A point of a part is p = R (c + diag(s) u): u its rest coordinates in the part's unit box, R the box's fixed rotation,
c the centre along the box's axes, s the edge lengths. It is linear in z = (c, s), and B+ falls apart into one small
regression a part and axis, so B is never formed unless it is asked for. B+ acts on changes as well as on positions.
"""

from collections.abc import Sequence

import torch
from jaxtyping import Float, Int
from torch import Tensor

AXES = "xyz"


class BoxHandles:
    """The handles of one shape: names, default values z0, and the maps B and B+.

    labels (n,) part of each point, or -1 for points without handles; rest (n, 3); boxes (P, 15) = centre, rotation,
    extents. Parts without points have no handles, and an axis along which a part's points have no spread has no scale
    handle: `dropped` lists both. Raises ValueError where the sizes do not agree.
    """

    def __init__(
        self,
        labels: Int[Tensor, " n"],
        rest: Float[Tensor, "n 3"],
        boxes: Float[Tensor, "P 15"],
        part_names: Sequence[str] | None = None,
    ):
        if labels.shape != rest.shape[:1] or boxes.shape[-1] != 15 or labels.max() >= len(boxes):
            raise ValueError(
                f"BoxHandles: labels (n,), rest (n, 3) and boxes (P, 15) must agree, got {tuple(labels.shape)}, "
                f"{tuple(rest.shape)}, {tuple(boxes.shape)} and labels up to {int(labels.max())}; take one shape's"
            )
        self.labels, self.rest = labels.long(), rest
        self.rotation = boxes[:, 3:12].unflatten(-1, (3, 3))
        self._center_rest()
        parts = part_names or [f"part_{part}" for part in range(len(boxes))]
        self.kept = torch.stack([(self.count > 0).expand(-1, 3), self.spread], dim=1)  # (P, 2, 3)
        every = [f"{part}.{kind}.{axis}" for part in parts for kind in ("translation", "scale") for axis in AXES]
        kept = self.kept.flatten().tolist()
        self.names = [name for name, keep in zip(every, kept, strict=True) if keep]
        self.dropped = [name for name, keep in zip(every, kept, strict=True) if not keep]
        centre = torch.einsum("pca,pc->pa", self.rotation, boxes[:, :3])
        # where no scale is kept, its fixed share of the position belongs to the translation, so that x = B z0 still
        centre = centre + torch.where(self.spread, 0, boxes[:, 12:] * self.mean)
        self.z0 = torch.stack([centre, boxes[:, 12:]], dim=1)[self.kept]

    @property
    def B(self) -> Float[Tensor, "n 3 m"]:
        """The dense matrix, for small shapes, checks and the edit projection."""
        m = len(self.names)
        unit = torch.eye(m, dtype=self.rest.dtype, device=self.rest.device)
        return torch.stack([self.offsets(unit[j]) for j in range(m)], dim=-1)

    def offsets(self, z: Float[Tensor, " m"]) -> Float[Tensor, "n 3"]:
        """B z."""
        full = self.rest.new_zeros(self.kept.shape).masked_scatter(self.kept, z.to(self.rest.dtype))
        return self._out(self._place(full.unsqueeze(-1), self.rest)).squeeze(-1)

    def coordinates(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "m *j"]:
        """B+u, for points, offsets (n, 3) or a whole dictionary (n, 3, k)."""
        intercept, slope = self._regress(u.reshape(*u.shape[:2], -1))
        translation = intercept - slope * self.mean.unsqueeze(-1)
        return torch.stack([translation, slope], dim=1)[self.kept].reshape(-1, *u.shape[2:])

    def project(self, u: Float[Tensor, "n 3 *j"]) -> Float[Tensor, "n 3 *j"]:
        """BB+u; points labelled -1 keep theirs."""
        intercept, slope = self._regress(u.reshape(*u.shape[:2], -1))
        placed = self._place(torch.stack([intercept, slope], dim=1), self.centred)
        return torch.where(self.held[:, None, None], self._out(placed), u.reshape(placed.shape)).reshape(u.shape)

    def _center_rest(self) -> None:
        P = len(self.rotation)
        self.held = self.labels >= 0
        self.slot = torch.where(self.held, self.labels, P)  # points without a part share a slot that is never read
        self.count = self._sum(torch.ones_like(self.rest[:, :1]))
        self.mean = self._sum(self.rest) / self.count.clamp_min(1)
        padded = torch.cat([self.mean, self.mean.new_zeros(1, 3)])
        self.centred = self.rest - padded[self.slot]
        self.variance = self._sum(self.centred.square())
        self.spread = self.variance > 1e-10 * self.count.clamp_min(1)

    def _sum(self, values: Tensor) -> Tensor:
        total = values.new_zeros(len(self.rotation) + 1, *values.shape[1:])
        return total.index_add(0, self.slot, values)[:-1]

    def _turned(self) -> Tensor:
        own = self.rotation.new_zeros(1, 3, 3) + torch.eye(3).to(self.rotation)
        return torch.cat([self.rotation, own])[self.slot].to(self.rest.dtype)

    def _regress(self, u: Tensor) -> tuple[Tensor, Tensor]:
        """Mean and slope of the local coordinates of u against the rest coordinates, (P, 3, j) each."""
        local = torch.einsum("nca,ncj->naj", self._turned(), u)
        mean = self._sum(local) / self.count.clamp_min(1).unsqueeze(-1)
        against = self._sum(local * self.centred.unsqueeze(-1))
        variance = torch.where(self.spread, self.variance, 1).unsqueeze(-1)
        return mean, torch.where(self.spread.unsqueeze(-1), against / variance, 0)

    def _place(self, z: Tensor, rest: Tensor) -> Tensor:
        """Translation plus scale times rest, per point along its box's axes: (n, 3, j) from (P, 2, 3, j)."""
        z = torch.cat([z, z.new_zeros(1, *z.shape[1:])])[self.slot]
        return z[:, 0] + z[:, 1] * rest.unsqueeze(-1)

    def _out(self, local: Tensor) -> Tensor:
        return torch.einsum("nca,naj->ncj", self._turned(), local)
