"""Linear algebra of offset fields: a dictionary A holds k fields over n points, and A v is one of their combinations.

The paper writes A as a (3n, k) matrix. Here it is (..., n, 3, k), and this module is the only place that flattens it.
"""

import torch
from jaxtyping import Float, Int
from torch import Tensor

from .types import Dictionary, Points, Vector


def matrix(A: Dictionary) -> Float[Tensor, "*#b n3 k"]:
    """A as the paper's matrix with 3n rows."""
    return A.flatten(-3, -2)


def offsets(A: Dictionary, v: Vector) -> Points:
    """A v: how far each point moves, in the unit of the points."""
    return torch.einsum("...nck,...k->...nc", A, v)


def rms(u: Points) -> float:
    """Root mean square length of offsets, over points and batch, in the unit of the points."""
    return u.square().sum(-1).mean().sqrt().item()


def coordinates(A: Dictionary, u: Points) -> Vector:
    """A+u: the shortest v whose offsets A v are nearest to u."""
    return (torch.linalg.pinv(matrix(A)) @ u.flatten(-2).unsqueeze(-1)).squeeze(-1)


def project(A: Dictionary, u: Points) -> Points:
    """AA+u: the part of the offsets u that A can make."""
    return offsets(A, coordinates(A, u))


def residual(A: Dictionary, B: Float[Tensor, "*#b n 3 m"]) -> Float[Tensor, "*#b n 3 m"]:
    """(I - AA+)B: the part of each column of B that A cannot make."""
    reachable = matrix(A) @ (torch.linalg.pinv(matrix(A)) @ matrix(B))
    return B - reachable.unflatten(-2, B.shape[-3:-1])


def rank(A: Dictionary) -> Int[Tensor, "*#b"]:
    """How many columns of A are independent: the vector of a deformation is unique only if all k are."""
    return torch.linalg.matrix_rank(matrix(A))


def column_rms(A: Dictionary) -> Float[Tensor, "*#b k"]:
    """Root of the mean over points of |A_i|^2: how far a unit of each coordinate moves the points."""
    return A.square().sum(-2).mean(-2).sqrt()


def column_scales(A: Dictionary, columns: str) -> Float[Tensor, "*#b 1 1 k"]:
    """What each column is divided by so that it has unit length.

    "rms": mean over points of |A_i|^2 is 1, whatever n is. "unit": the 3n-vector has length 1, as in the paper, which
    makes the same points move sqrt(n_train / n) times as far when n changes. The floor keeps zero columns from NaN.
    """
    mean_square = A.square().sum(-2).mean(-2)
    if columns == "unit":
        mean_square = mean_square * A.shape[-3]
    elif columns != "rms":
        raise ValueError(f'column_scales: columns must be "rms" or "unit", got {columns!r}; "rms" does not depend on n')
    return mean_square.clamp_min(1e-12).sqrt()[..., None, None, :]
