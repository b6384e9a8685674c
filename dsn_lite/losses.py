"""The training losses of Section 3.3 (Eqs. 9-13). Chamfer terms carry no factor: the paper states none (the authors'
code multiplies both by 100, which matters only against the weight of the sparsity terms).
"""

from collections.abc import Sequence

from jaxtyping import Float
from scipy.spatial import cKDTree
from torch import Tensor

from .chamfer import chamfer
from .types import OtherPoints, Points

AXES = {"x": 0, "y": 1, "z": 2}


def fitting(deformed: Points, y: OtherPoints, trees: Sequence[cKDTree] | None = None) -> Float[Tensor, ""]:
    """L_F = Ch(d(x -> y), y), mean over the batch (Eq. 9)."""
    return chamfer(deformed, y, trees).mean()


def symmetry(deformed: Points, axis: str = "x") -> Float[Tensor, ""]:
    """L_R = Ch(d, R d), mean over the batch, R the mirror at the plane where `axis` is 0 (Eq. 10)."""
    return chamfer(deformed, mirror(deformed, axis)).mean()


def mirror(x: Points, axis: str) -> Points:
    """R x: the sign of one coordinate flipped."""
    if axis not in AXES:
        raise ValueError(f'mirror: axis must be "x", "y" or "z", got {axis!r}; data_gen shapes mirror at x = 0')
    flip = x.new_ones(3)
    flip[AXES[axis]] = -1
    return x * flip


def sparsity_l1(handle_dictionary: Float[Tensor, "*b m k"]) -> Float[Tensor, ""]:
    """L_S1 = |B+F(x)|_1 / k, mean over the batch (Eq. 11). Padded handles must be rows of zeros."""
    return handle_dictionary.abs().sum((-2, -1)).mean() / handle_dictionary.shape[-1]


def sparsity_l21(handle_dictionary: Float[Tensor, "*b m k"]) -> Float[Tensor, ""]:
    """L_S2,1 = |B+F(x)|_2,1 / k, the sum of the columns' lengths, mean over the batch (Eq. 12)."""
    # the floor keeps the gradient of a zero column from being NaN
    lengths = handle_dictionary.square().sum(-2).clamp_min(1e-24).sqrt()
    return lengths.sum(-1).mean() / handle_dictionary.shape[-1]
