"""What a step of training sees: shapes drawn from the collection, paired within themselves, and their kept trees.

Only the rows of a batch are read, so a collection in shards stays on the disk. Every random choice comes from
(seed, step), so a resumed training sees the same batches as an uninterrupted one, and so does every process of several.
"""

from dataclasses import dataclass

import numpy as np
import torch
from jaxtyping import Float, Int
from scipy.spatial import cKDTree
from torch import Tensor

from .chamfer import plant
from .config import Config
from .handles import BatchHandles
from .shapes import Shapes
from .world import World

ROOM = 1 << 22  # points in kept trees: some 300 MB, however large the collection


@dataclass(frozen=True)
class Batch:
    """Clouds, each encoded once, and the pairs of them that one process takes."""

    x: Float[Tensor, "c n 3"]  # what the networks read: sub-sampled where clouds are denser than Config.points
    source: Int[Tensor, " b"]  # rows of x
    target: Int[Tensor, " b"]
    y: Float[Tensor, "b p 3"]  # the targets, as dense as they are
    trees: list[cKDTree] | None  # of y; none on a GPU
    handles: BatchHandles | None  # of the sources, where the losses ask for them


class Batches:
    """The batches of a training on some rows of a collection."""

    def __init__(self, shapes: Shapes, rows: Int[Tensor, " N"], config: Config, world: World):
        self.shapes, self.rows, self.config, self.world = shapes, rows, config, world
        self.device = world.device(config.device)
        self.trees: dict[int, cKDTree] = {}

    def draw(self, step: int, *, dense: bool = False) -> Batch:
        """This process's share of the batch of a step; dense sources keep all their points."""
        rng, n = np.random.default_rng((self.config.seed, step)), self.shapes.points.shape[1]
        drawn = rng.choice(len(self.rows), self.config.batch, replace=False)
        partner = np.roll(np.arange(len(drawn)), rng.integers(1, max(2, len(drawn))))  # nobody meets itself
        few = self.config.points < n and not dense
        kept = rng.choice(n, self.config.points, replace=False) if few else np.arange(n)
        own = np.arange(self.world.rank, len(drawn), self.world.size)
        needed, where = np.unique([own, partner[own]], return_inverse=True)
        source, target = torch.from_numpy(where.reshape(2, -1))
        rows = self.rows[torch.from_numpy(drawn[needed])]
        clouds = self._clouds(rows)
        y, x = clouds[target], clouds[:, torch.from_numpy(kept)]
        trees = self._trees(rows[target], y) if self.device == "cpu" else None
        handles = self._handles(rows[source], kept) if self.config.sparsity or self.config.project else None
        return Batch(
            x.to(self.device), source.to(self.device), target.to(self.device), y.to(self.device), trees, handles
        )

    def _clouds(self, rows: Tensor) -> Tensor:
        clouds = self.shapes.points[rows].float()
        if not clouds.isfinite().all():
            bad = int(rows[~clouds.flatten(1).isfinite().all(1)][0])
            raise ValueError(f"train: points must be finite, shape {bad} holds NaN or infinity; clean or drop it")
        return clouds

    def _trees(self, rows: Tensor, clouds: Tensor) -> list[cKDTree]:
        """Kept trees where there are, and new ones, kept while there is room."""
        wanted = rows.tolist()
        missing = [i for i, row in enumerate(wanted) if row not in self.trees]
        grown = dict(zip((wanted[i] for i in missing), plant(clouds[missing]) if missing else [], strict=True))
        if len(self.trees) * clouds.shape[1] < ROOM:
            self.trees |= grown
        return [self.trees.get(row) or grown[row] for row in wanted]

    def _handles(self, rows: Tensor, kept: np.ndarray) -> BatchHandles:
        shapes, index = self.shapes, torch.from_numpy(kept)
        labels = shapes.labels if shapes.labels.ndim == 1 else shapes.labels[rows]
        rest = shapes.rest if shapes.rest.ndim == 2 else shapes.rest[rows]
        labels, rest = labels[..., index].expand(len(rows), -1), rest[..., index, :].expand(len(rows), -1, -1)
        labels, boxes = crowded(labels, shapes.boxes[rows].float())
        return BatchHandles(labels.to(self.device), rest.float().to(self.device), boxes.to(self.device))


def crowded(
    labels: Int[Tensor, "N n"], boxes: Float[Tensor, "N P 15"]
) -> tuple[Int[Tensor, "N n"], Float[Tensor, "N Q 15"]]:
    """The same parts in the first Q places, Q the most that one of these shapes has.

    A mixed collection names every part of its families, of which a shape has a third: handles cost what P does.
    """
    present = boxes.isfinite().all(-1)
    order = torch.argsort(present.int(), dim=1, descending=True, stable=True)
    place = torch.argsort(order, dim=1)
    moved = torch.where(labels < 0, -1, place.gather(1, labels.long().clamp_min(0)))
    kept = order[:, : int(present.sum(1).max())]
    return moved, boxes.gather(1, kept.unsqueeze(-1).expand(-1, -1, 15))
