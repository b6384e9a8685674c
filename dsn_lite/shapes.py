"""Collections of shapes: what is known about them, some of them, and their split."""

from dataclasses import dataclass, field, fields, replace
from itertools import chain
from typing import Any

import numpy as np
import torch
from jaxtyping import Bool, Float, Int
from torch import Tensor, nn

SPLIT = (0.85, 0.05, 0.10)  # training, validation, test: Section 4.1 of the paper
PARTS = ("train", "validation", "test")
FEWEST = (1, 2, 1)  # shapes in each
SHARED = {"labels": 1, "rest": 2, "faces": 1, "weights": 2}  # axes of what all shapes may share


@dataclass(frozen=True)
class Shapes:
    """N shapes of n points each, and what is known about them.

    points (N, n, 3); labels (N, n) part of each point or -1; rest (N, n, 3) each point in its part's unit box;
    faces (N, n) and weights (N, n, 2) its triangle and place there. These four lack the axis N where all shapes share
    them. boxes (N, P, 15) = centre 3, rotation 9, extents 3; joints (N, J, 8) = axis 3, pivot 3, value, kind.
    families (N,) rows of about["families"] where shapes of several are mixed: then parts, joints and parameters that a
    shape lacks are NaN.
    """

    points: Float[Tensor, "N n 3"]
    labels: Int[Tensor, "..."] | None = None
    rest: Float[Tensor, "..."] | None = None
    faces: Int[Tensor, "..."] | None = None
    weights: Float[Tensor, "..."] | None = None
    boxes: Float[Tensor, "N P 15"] | None = None
    parameters: Float[Tensor, "N p"] | None = None
    joints: Float[Tensor, "N J 8"] | None = None
    families: Int[Tensor, " N"] | None = None
    parameter_names: tuple[str, ...] = ()
    part_names: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    about: dict[str, Any] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def corresponds(self) -> bool:
        """True where point i of one shape is point i of every other: shared samples of one family."""
        return bool(self.about.get("corresponds", False)) and self.families is None

    @property
    def has_parts(self) -> bool:
        """True where labels, rest and boxes are known: what the handles of parts are made of."""
        return all(known is not None for known in (self.labels, self.rest, self.boxes))

    @property
    def truth_is_known(self) -> bool:
        """True where boxes tell the true deformations: one family of parts that keep their form, every point in one."""
        if self.families is not None or not self.has_parts:
            return False
        forms_stay = all(rig.get("by_boxes", True) for rig in self.about.get("rigs", {}).values())
        return forms_stay and bool((self.labels >= 0).all()) and bool(self.boxes.isfinite().all())

    @property
    def ranges(self) -> np.ndarray | None:
        """Lowest and highest value of every parameter (p, 2), where the file tells all for one family, else None."""
        known = self.about.get("rigs", {}).get(self.about.get("family"), {}).get("ranges", {})
        if self.parameters is None or not self.parameter_names or not set(self.parameter_names) <= set(known):
            return None
        return np.array([known[name] for name in self.parameter_names]) + np.array([-1e-6, 1e-6])  # files hold float32

    def __getitem__(self, index: int | slice | Int[Tensor, " j"]) -> "Shapes":
        """The shapes at these indices, in this order; one index gives a collection of one, a slice copies nothing."""
        kept = torch.arange(len(self))[index].reshape(-1)
        taken = {
            name: value[index if isinstance(index, slice) else kept]
            for name, value in self._tensors().items()
            if value.ndim != SHARED.get(name)
        }
        names = tuple(self.names[i] for i in kept.tolist()) if len(self.names) == len(self) else self.names
        about = (
            {**self.about, "split": None} if self.about.get("split") else self.about
        )  # its rows are those of the whole
        return replace(self, names=names, about=about, **taken)

    @property
    def family_names(self) -> tuple[str, ...]:
        """Names of the families that these shapes are of, in the order of their rows; empty if nothing tells."""
        if self.families is None:
            return (self.about["family"],) if "family" in self.about else ()
        return tuple(self.about["families"][row] for row in self.families.unique().tolist())

    def of_family(self, name: str) -> "Shapes":
        """The shapes of one family of a mixed collection, in their order and with their part of a split that it tells.

        What this family lacks stays NaN. Raises ValueError, naming the families there are, where there is no such.
        """
        if not self.family_names:
            raise ValueError(f"of_family: these shapes must tell their families, got none; leave --family {name} out")
        if name not in self.family_names:
            known = ", ".join(self.family_names)
            raise ValueError(f"of_family: shapes of {name!r} must be among these, they are {known}; take one of them")
        if self.families is None:
            return self
        own = self.families == self.about["families"].index(name)
        split = self.about.get("split") and _rows(self.about["split"], len(self))
        about = self.about | {"split": split and _among(own, split)}
        return replace(self[own.nonzero().flatten()], about=about)

    def like(self, space: nn.Module) -> "Shapes":
        """The same shapes in the precision and on the device of a space's weights, where it has any."""
        weight = next(chain(space.parameters(), space.buffers()), self.points)
        moved = {
            name: value.to(weight) if value.is_floating_point() else value.to(weight.device)
            for name, value in self._tensors().items()
        }
        return replace(self, **moved)

    def _tensors(self) -> dict[str, Tensor]:
        return {f.name: getattr(self, f.name) for f in fields(self) if isinstance(getattr(self, f.name), Tensor)}

    def split(self, seed: int = 0) -> tuple["Shapes", "Shapes", "Shapes"]:
        """Training, validation and hold-out shapes: as the file says, or else 85-5-10 by a shuffle of this seed.

        Raises ValueError where there are not at least 1, 2 and 1 of them.
        """
        train, validation, test = self.rows(seed)
        return self[train], self[validation], self[test]

    def rows(self, seed: int = 0) -> tuple[slice | Int[Tensor, " _"], ...]:
        """The rows of the three parts of `split`; of collections larger than memory, some of them can be taken."""
        if self.about.get("split"):
            return tuple(_rows(self.about["split"], len(self)))
        N = len(self)
        if N < sum(FEWEST):
            raise ValueError(
                f"split: at least 4 shapes are needed for training, validation and test, got {N}; add shapes"
            )
        order = torch.from_numpy(np.random.default_rng(seed).permutation(N))
        test, validation = max(1, round(SPLIT[2] * N)), max(2, round(SPLIT[1] * N))
        return order[test + validation :], order[test : test + validation], order[:test]

    def at_boxes(self, boxes: Float[Tensor, "N P 15"]) -> Float[Tensor, "N n 3"]:
        """The same samples placed on other boxes: p = c + R diag(s) u."""
        labels, rest = self.labels.expand(self.points.shape[:2]), self.rest.expand(self.points.shape)
        own = torch.take_along_dim(boxes, labels.long().unsqueeze(-1), dim=1)
        local = own[..., 12:] * rest
        return own[..., :3] + (own[..., 3:12].unflatten(-1, (3, 3)) @ local.unsqueeze(-1)).squeeze(-1)


def _rows(split: Any, N: int) -> list[slice]:
    """The rows of each part of a split that a file tells. Raises ValueError where it tells no split of N shapes."""
    try:
        rows = [range(*map(int, split[part])) for part in PARTS]
        apart = len({row for part in rows for row in part}) == sum(map(len, rows))
        whole = apart and all(0 <= part.start and part.stop <= N for part in rows)
    except (TypeError, KeyError, ValueError):
        whole, rows = False, []
    if not whole or any(len(part) < fewest for part, fewest in zip(rows, FEWEST, strict=True)):
        raise ValueError(
            f"split: the file must give [start, stop] rows of its {N} shapes for train, validation and test, apart, at "
            f"least 1, 2 and 1 of them, got {split}; write the file again, or without a split"
        )
    return [slice(part.start, part.stop) for part in rows]


def _among(own: Bool[Tensor, " N"], split: list[slice]) -> dict[str, list[int]]:
    """The rows of a split, counted among some of the shapes."""
    before = [0, *own.cumsum(0).tolist()]
    return {part: [before[rows.start], before[rows.stop]] for part, rows in zip(PARTS, split, strict=True)}
