"""From a space and a shape to a function of v alone, so that a slider does not evaluate the networks again."""

from collections.abc import Callable
from typing import Any

import torch
from torch import Tensor

from ..dictionary import offsets
from ..space import ActionSpace


def mover(space: ActionSpace, x: Tensor) -> Callable[[Tensor], Tensor]:
    """v -> x (+) v. Where the space has a dictionary, A is computed once and a move is x + A v."""
    if not hasattr(space, "dictionary"):
        return lambda v: _no_grad(space.act, x, v)
    A = _no_grad(space.dictionary, x)
    return lambda v: x + offsets(A, v)


def shapes_like(space: ActionSpace, points: Any) -> list[Tensor]:
    """One shape (n, 3), or several, as tensors of the type and on the device of the space's numbers."""
    if isinstance(points, (list, tuple)):
        return [shape for each in points for shape in shapes_like(space, each)]
    tensor = torch.as_tensor(points).detach()
    own = next((each for each in (*space.parameters(), *space.buffers())), tensor)
    tensor = tensor.to(own.device, own.dtype)
    return list(tensor) if tensor.ndim == 3 else [tensor]


@torch.no_grad()
def _no_grad(function: Callable[..., Tensor], *arguments: Tensor) -> Tensor:
    return function(*arguments)
