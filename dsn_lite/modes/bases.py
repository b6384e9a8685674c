"""Other bases of the same space: the columns are a choice, the deformations are not."""

from typing import Any

import torch
from jaxtyping import Float
from torch import Tensor

from ..space import ActionSpace
from ..types import Dictionary, OtherPoints, Points, Vector


class Rebased(ActionSpace):
    """A space with dictionary A R and vectors R^-1 v: it deforms as before, and its modes are others."""

    R: Float[Tensor, "k k"]
    R_inverse: Float[Tensor, "k k"]

    def __init__(self, space: ActionSpace, R: Float[Tensor, "k k"]):
        super().__init__()
        self.space, self.by_construction, self.remarks = space, space.by_construction, space.remarks
        like = space._weight()
        self.register_buffer("R", R.to(like))
        self.register_buffer("R_inverse", torch.linalg.inv(R.double()).to(like))

    def act(self, x: Points, v: Vector) -> Points:
        return self.space.act(x, v @ self.R.mT)

    def vector(self, x: Points, y: OtherPoints) -> Vector:
        return self.space.vector(x, y) @ self.R_inverse.mT

    def dictionary(self, x: Points, **at: Any) -> Dictionary:
        """A R."""
        return self.space.dictionary(x, **at) @ self.R

    def untrained(self, seed: int = 0) -> "Rebased":
        """The untrained space in the same basis."""
        return Rebased(self.space.untrained(seed), self.R)


def check_dictionary(where: str, space: ActionSpace) -> None:
    """Raises ValueError where a space has no dictionary."""
    if not hasattr(space, "dictionary"):
        raise ValueError(
            f"{where}: the space must have a dictionary, {type(space).__name__} has none; use a DeformSyncNet"
        )


def change_of_basis(space: ActionSpace, R: Float[Tensor, "k k"]) -> Rebased:
    """The same space with columns A R and coordinates R^-1 v.

    Raises ValueError where R has no inverse, or the space no dictionary.
    """
    check_dictionary("change_of_basis", space)
    k = getattr(space.dictionary, "k", len(R))
    square = R.shape == (k, k) and bool(R.isfinite().all())
    if not square or torch.linalg.matrix_rank(R) < k:
        rank = f" of rank {torch.linalg.matrix_rank(R)}" if square else ""
        raise ValueError(
            f"change_of_basis: R must be (k, k), k = {k}, finite and invertible, got {tuple(R.shape)}{rank}; otherwise "
            "A R cannot make all that A can"
        )
    return Rebased(space, R)
