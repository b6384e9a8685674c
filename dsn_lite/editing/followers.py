"""The other shapes: their dictionaries are computed once, and a vector then moves them by one product each."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import torch
from jaxtyping import Float
from torch import Tensor

from ..dictionary import offsets, rms
from ..files import as_shapes
from ..handles import BoxHandles
from ..shapes import Shapes
from ..space import ActionSpace
from ..types import Dictionary, Points, Vector

Others = Shapes | Tensor | Sequence[Shapes | Tensor]


@dataclass(frozen=True)
class Followed:
    """Another shape z after an edit: points = z (+) v, and how far it moved, the root mean square length of A v.

    Where its parts are known, by_handles = z + BB+ A v is what its own handles, `names`, make of it, and z_hat (m,) are
    the values that they take; points of no part are those of `points`. Otherwise there are no names, and both are None.
    """

    points: Points
    moved: float
    names: tuple[str, ...] = ()
    z_hat: Float[Tensor, " m"] | None = None
    by_handles: Points | None = None

    def __getitem__(self, name: str) -> float:
        """The value of one of its handles."""
        return self.z_hat[self.names.index(name)].item()


class Follower:
    """A shape that follows: its points x, its dictionary A and, where its parts are known, BB+A and B+A."""

    def __init__(self, space: ActionSpace, one: Shapes):
        self.x = one.points[0]
        with torch.no_grad():
            self.A = space.dictionary(one.like(space).points)[0].to(self.x)
        if len(self.A) != len(self.x):
            raise ValueError(
                f"co_edit: others must have the {len(self.A)} points of the space's one dictionary, got {len(self.x)}; "
                "a DeformSyncNet takes clouds of any size"
            )
        self.handles = BoxHandles.of(one) if one.has_parts else None
        if self.handles:
            self.projected, self.B_plus_A = self.handles.project(self.A), self.handles.coordinates(self.A).double()

    def by(self, v: Vector) -> Followed:
        """This shape, moved by v."""
        points = moved(self.x, self.A, v)
        far, handles = rms(points - self.x), self.handles
        if handles is None:
            return Followed(points, far)
        z_hat = handles.z0.double().cpu() + self.B_plus_A.cpu() @ v
        return Followed(points, far, handles.names, z_hat, moved(self.x, self.projected, v))


def moved(x: Points, A: Dictionary, v: Vector) -> Points:
    """x + A v, and where v is 0 the very bits of x: -0 + 0 is another zero."""
    return x + offsets(A, v.to(A)).to(x) if bool(v.any()) else x


def each(others: Others) -> Iterator[Shapes]:
    """The shapes of a collection, or of a sequence of clouds and collections, one at a time."""
    for group in [others] if isinstance(others, Shapes | Tensor) else others:
        shapes = as_shapes(group[None] if isinstance(group, Tensor) and group.ndim == 2 else group)
        yield from (shapes[i] for i in range(len(shapes)))
