"""How far each column of a dictionary moves shapes, and which columns move nothing."""

from jaxtyping import Float, Int
from torch import Tensor

from ..dictionary import column_rms
from ..types import Dictionary, Vector


def moved_by_columns(A: Dictionary, v: Vector) -> Float[Tensor, " k"]:
    """Root mean square of A_j v_j over points and batch, in the unit of the points: what column j is used for.

    v are the vectors that the columns are used with, for instance of pairs x -> y; they may broadcast against A.
    """
    return moved_by_lengths(column_rms(A), v)


def moved_by_lengths(lengths: Vector, v: Vector) -> Float[Tensor, " k"]:
    """The same of columns whose lengths (column_rms, ..., k) are known: offsets (..., n, 3, k) are never formed."""
    return (lengths * v).square().reshape(-1, lengths.shape[-1]).mean(0).sqrt()


def dead_columns(A: Dictionary, v: Vector, below: float = 0.01) -> Int[Tensor, " d"]:
    """Columns, by index, that move shapes by at most `below` times what the most used one does; all, if none moves."""
    return unused(moved_by_columns(A, v), below)


def unused(moved: Float[Tensor, " k"], below: float = 0.01) -> Int[Tensor, " d"]:
    """The same of what `moved_by_columns` found."""
    return (moved <= below * moved.max()).nonzero().flatten()
