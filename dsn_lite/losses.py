"""The training losses of Section 3.3 (Eqs. 9-13), L = 100 (L_F + w_R L_R) + w_S L_S.

The paper states no factor before its Chamfer terms; the authors' code has 100. Without it the paper's w_S = 10 lets the
sparsity term decide alone (it is some 0.3 where L_F is 0.003), so the factor is kept: it is what w_S is measured by.
"""

from collections.abc import Sequence

from jaxtyping import Float
from scipy.spatial import cKDTree
from torch import Tensor

from .chamfer import chamfer, one_way
from .handles import BatchHandles
from .types import Dictionary, OtherPoints, Points

AXES = {"x": 0, "y": 1, "z": 2}
FACTOR = 100.0  # of the Chamfer terms
REFERENCE = 2048  # points at which a column of the paper has length 1


def fitting(
    deformed: Points, y: OtherPoints, trees: Sequence[cKDTree] | None = None, own: Sequence[cKDTree] | None = None
) -> Float[Tensor, ""]:
    """L_F = Ch(d(x -> y), y), mean over the batch (Eq. 9). `trees` are kept trees of y, `own` of the deformed."""
    return chamfer(deformed, y, trees, own).mean()


def symmetry(deformed: Points, axis: str = "x", own: Sequence[cKDTree] | None = None) -> Float[Tensor, ""]:
    """L_R = Ch(d, R d), mean over the batch, R the mirror at the plane where `axis` is 0 (Eq. 10).

    R is its own inverse and keeps lengths, so both directions are one number and one query of the trees of d.
    """
    return 2 * one_way(mirror(deformed, axis), deformed, own).mean()


def mirror(x: Points, axis: str) -> Points:
    """R x: the sign of one coordinate flipped."""
    if axis not in AXES:
        raise ValueError(f'mirror: axis must be "x", "y" or "z", got {axis!r}; data_gen shapes mirror at x = 0')
    flip = x.new_ones(3)
    flip[AXES[axis]] = -1
    return x * flip


def handle_dictionary(A: Dictionary, handles: BatchHandles, columns: str = "rms") -> Float[Tensor, "N m k"]:
    """B+F(x), with columns as long as the paper's: of length 1 over 3n at n = 2048, whatever n and `columns` are.

    A has unit columns by `columns`. So a weight of the sparsity terms means the same at every n.
    """
    unit = A.shape[-3] if columns == "unit" else 1
    return handles.coordinates(A) * (unit / REFERENCE) ** 0.5


def seen_dictionary(A: Dictionary, handles: BatchHandles) -> Float[Tensor, "N m k"]:
    """B+F(x), with columns of which the handles see as much as of a column of length 1 over 3n at n = 2048.

    What lies outside the handles' space B+ does not see: a column that is normalised as a whole can hide there, and
    the sparsity loss pushes it to. Here hiding gains nothing, and the length of A's columns does not matter.
    """
    return handles.coordinates(A) / (handles.seen(A).unsqueeze(1) * REFERENCE**0.5)


def sparsity_l1(handle_dictionary: Float[Tensor, "*b m k"]) -> Float[Tensor, ""]:
    """L_S1 = |B+F(x)|_1 / k, mean over the batch (Eq. 11). Padded handles must be rows of zeros."""
    return handle_dictionary.abs().sum((-2, -1)).mean() / handle_dictionary.shape[-1]


def sparsity_l21(handle_dictionary: Float[Tensor, "*b m k"]) -> Float[Tensor, ""]:
    """L_S2,1 = |B+F(x)|_2,1 / k, the sum of the columns' lengths, mean over the batch (Eq. 12)."""
    # the floor keeps the gradient of a zero column from being NaN
    lengths = handle_dictionary.square().sum(-2).clamp_min(1e-24).sqrt()
    return lengths.sum(-1).mean() / handle_dictionary.shape[-1]


SPARSITY = {"l1": sparsity_l1, "l21": sparsity_l21}
