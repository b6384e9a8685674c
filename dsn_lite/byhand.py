"""Spaces small enough to check with pencil and paper, and one broken space for each law.

`translations()` is the smallest DeformSyncNet: E(x) is the centroid and F(x) the identity at every point, so vectors
are arrows in space and the action is translation. On copies of one shape it keeps all seven laws. Each space in
`BROKEN` changes one thing and fails the law it is filed under (and sometimes others, which `who_breaks_what` shows).
"""

from typing import Any

import torch
from jaxtyping import Float
from torch import nn

from .axioms import LAWS, residuals
from .data import Shapes, triplets
from .space import ActionSpace, DeformSyncNet
from .types import OtherPoints, Points, Vector


class Centroid(nn.Module):
    """E(x): the mean of the points, so k = 3."""

    def forward(self, x: Points) -> Vector:
        return x.mean(-2)


class Identity(nn.Module):
    """F(x): column j moves every point by 1 along axis j."""

    def forward(self, x: Points, at: OtherPoints | None = None) -> Float[torch.Tensor, "*#b _ 3 3"]:
        here = x if at is None else at
        return torch.eye(3, dtype=x.dtype).expand(*here.shape, 3)


def translations() -> DeformSyncNet:
    """x (+) v = x + v at every point, xy = centroid(y) - centroid(x)."""
    return DeformSyncNet(Centroid(), Identity())


class ByHand(ActionSpace):
    """Translation, to be broken: subclasses replace one of the two methods."""

    def act(self, x: Points, v: Vector) -> Points:
        return x + v.unsqueeze(-2)

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        return y.mean(-2) - x.mean(-2)


class Stamp(ByHand):
    """x (+) v = T + centroid(x) + v: one template T, drawn wherever x was. An autoencoder in miniature."""

    def act(self, x: Points, v: Vector) -> Points:
        corners = torch.linspace(-1, 1, x.shape[-2], dtype=x.dtype)
        template = torch.stack([corners, corners.square() - corners.square().mean(), 0 * corners], dim=-1)
        return template + (x.mean(-2) + v).unsqueeze(-2)


class OwnStride(ByHand):
    """x (+) v = x + (1 + height of x) v: the higher x stands, the longer its step, so the dictionary depends on x."""

    def act(self, x: Points, v: Vector) -> Points:
        return x + (1 + x.mean(-2)[..., 1:2, None]) * v.unsqueeze(-2)


class NoHeight(ByHand):
    """x (+) v drops the second coordinate of v: k is too small for these shapes."""

    def act(self, x: Points, v: Vector) -> Points:
        return x + (v * torch.tensor([1, 0, 1], dtype=v.dtype)).unsqueeze(-2)


class Concatenation(ByHand):
    """xy = E(y) - E(x) / 2: a function of both codes, but not their difference, as networks on [E(x); E(y)] learn."""

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        return y.mean(-2) - x.mean(-2) / 2


class OfDifference(ByHand):
    """xy = f(E(y) - E(x)) for a function f of vectors; anything may be given, since readers bring their own."""

    def __init__(self, function: Any):
        super().__init__()
        self.function = function

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        return self.function(super().vector(x, y))


class Distance(OfDifference):
    """xy = |E(y) - E(x)|, each coordinate: how far, but not which way."""

    def __init__(self) -> None:
        super().__init__(torch.abs)


class Saturation(OfDifference):
    """xy = tanh(E(y) - E(x)): short steps are kept, long ones cut, alike in both directions."""

    def __init__(self) -> None:
        super().__init__(torch.tanh)


class OwnRuler(OwnStride):
    """As OwnStride, with xy measured by x's own ruler so that the target is reached: unsynchronized dictionaries."""

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        return super().vector(x, y) / (1 + x.mean(-2)[..., 1:2])


BROKEN: dict[str, ActionSpace] = {
    "zero_acts_trivially": Stamp(),
    "actions_add": OwnStride(),
    "target_is_reached": NoHeight(),
    "self_vector_is_zero": Concatenation(),
    "reversal_negates": Distance(),
    "triangle_closes": Saturation(),
    "parallelogram_closes": OwnRuler(),
}


def copies(count: int = 12, seed: int = 0) -> Shapes:
    """One triangle at `count` places, in correspondence, float64: shapes (count, 3, 3)."""
    generator = torch.Generator().manual_seed(seed)
    triangle = torch.tensor([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=torch.float64)
    places = torch.rand(count, 1, 3, generator=generator, dtype=torch.float64) * 2
    return Shapes(points=triangle + places, about={"corresponds": True})


def who_breaks_what(spaces: dict[str, ActionSpace], shapes: Shapes) -> Float[torch.Tensor, "spaces laws"]:
    """The residual of every law (columns, in the order of axioms.LAWS) for every space (rows)."""
    drawn = triplets(shapes, 32)
    return torch.tensor([[scores[law] for law in LAWS] for scores in (residuals(s, *drawn) for s in spaces.values())])
