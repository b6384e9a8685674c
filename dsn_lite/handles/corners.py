"""The parts' boxes themselves, for pictures."""

from itertools import product

import torch
from jaxtyping import Float
from torch import Tensor

from .boxes import BoxHandles

CUBE = torch.tensor(list(product((-0.5, 0.5), repeat=3)))


def corners(handles: BoxHandles, z: Float[Tensor, " m"] | None = None) -> Float[Tensor, "p 8 3"]:
    """Corners of the p boxes that have handles, in the order of their parts, where the values are z, or z0.

    A box is flat along an axis that has no scale handle.
    """
    parts = handles.kept.flatten(1).any(1).nonzero().flatten()
    labels, rest = parts.repeat_interleave(len(CUBE)), CUBE.to(handles.rest).repeat(len(parts), 1)
    return handles.at(labels, rest).offsets(handles.z0 if z is None else z).view(-1, len(CUBE), 3)
