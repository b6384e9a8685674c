"""Whether a mode does the same to every shape, judged by what it does to parts whose names are known.

A mode that raises the seat of one chair must raise the seat of the next. What it does to the kinds of parts that two
shapes both have are two vectors, and their cosine is 1 where they agree, -1 where they are opposed. The mean over pairs
of shapes is weighted by the lengths of the two vectors: where a mode finds nothing of its own to move, it has no say.

It proves less than it seems to: an untrained network is nearly one smooth field for all shapes and scores high. Whether
parts are followed is what `following` tells.
"""

import torch
from jaxtyping import Float
from torch import Tensor

from .reading import Reading


def consistency(reading: Reading) -> Float[Tensor, " k"]:
    """The consistency of each mode over all pairs of shapes, in [-1, 1]; 0 for a mode that moves nothing."""
    p, lengths = reading.profile.flatten(1, 2), _lengths(reading)
    # the sum over pairs is what is left of the square of the sum
    agreed = p.sum(0).square().sum(0) - p.square().sum((0, 1))
    return agreed / _of_pairs(lengths * lengths.mT).clamp_min(1e-12)


def shuffled(reading: Reading) -> float:
    """The same with mode i of one shape against mode j of another, over all i and j that differ: near 0 is no news."""
    p, lengths = reading.profile.flatten(1, 2), _lengths(reading)
    every, own = p.sum(-1), p.sum(0).square().sum() - p.square().sum()
    agreed = every.sum(0).square().sum() - every.square().sum() - own
    total = lengths.sum(0)
    return (agreed / (_of_pairs(total * total.mT) - _of_pairs(lengths * lengths.mT).sum()).clamp_min(1e-12)).item()


def _lengths(reading: Reading) -> Float[Tensor, "k N N"]:
    """How long mode j of shape x is over the kinds of parts that shape y has too."""
    squares = reading.profile.square().sum(2)
    return torch.einsum("xqk,yq->kxy", squares, reading.present.to(squares)).sqrt()


def _of_pairs(values: Float[Tensor, "*k N N"]) -> Float[Tensor, "*k"]:
    """Sum over pairs of different shapes."""
    return values.sum((-2, -1)) - values.diagonal(dim1=-2, dim2=-1).sum(-1)
