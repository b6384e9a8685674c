"""A linear layer and the maximum over points behind it, as one step.

The maximum lets only one point a channel through, so the gradient needs the inputs of those points alone: neither the
n x g activations are kept nor the gradient multiplied through all points. At the authors' widths (128 to 1024 over
2048 points) that layer is nine tenths of the encoder, and this makes its backward pass all but free.
"""

from typing import Any

import torch
from jaxtyping import Float
from torch import Tensor
from torch.autograd.function import once_differentiable

BLOCK = 1 << 20  # activations at a time: 4 MB of float32 stay in the cache
RUN = 32


class _LinearMax(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, h: Tensor, weight: Tensor, bias: Tensor) -> Tensor:
        rows = max(1, BLOCK // weight.shape[0])
        clouds = h.reshape(-1, *h.shape[-2:])
        found = [_largest(cloud, weight, rows) for cloud in clouds]
        where = torch.stack([index for _, index in found])
        ctx.save_for_backward(h, weight, where)
        pooled = torch.stack([value for value, _ in found]) + bias
        return pooled.reshape(*h.shape[:-2], -1)

    @staticmethod
    @once_differentiable
    def backward(ctx: Any, gradient: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        h, weight, where = ctx.saved_tensors
        n, width = h.shape[-2:]
        gradient = gradient.reshape(len(where), -1)
        rows = (where + n * torch.arange(len(where), device=where.device).unsqueeze(-1)).flatten()
        winners = h.reshape(-1, width)[rows].view(*where.shape, width)
        to_weight = (gradient.unsqueeze(-1) * winners).sum(0)
        to_h = torch.zeros_like(h).view(-1, width)
        to_h.index_add_(0, rows, (gradient.unsqueeze(-1) * weight).view(-1, width))
        return to_h.view(h.shape), to_weight, gradient.sum(0)


def _largest(cloud: Tensor, weight: Tensor, rows: int) -> tuple[Tensor, Tensor]:
    """The largest value of each channel over the points (n, c) of a cloud, and which point has it."""
    best, where = _largest_of(cloud[:rows] @ weight.mT)
    for start in range(rows, len(cloud), rows):
        value, index = _largest_of(cloud[start : start + rows] @ weight.mT)
        better = value > best
        best, where = torch.where(better, value, best), torch.where(better, index + start, where)
    return best, where


def _largest_of(values: Tensor) -> tuple[Tensor, Tensor]:
    """max(0), several times as fast: runs of rows first, by value alone, then the place in the run that won."""
    whole = len(values) // RUN * RUN
    if whole < len(values) or whole <= RUN:
        return values.max(0)
    runs = values.view(-1, RUN, values.shape[1])
    best, run = runs.amax(1).max(0)
    place = runs[run, :, torch.arange(len(run), device=run.device)].argmax(-1)
    return best, run * RUN + place


def linear_max(
    h: Float[Tensor, "*b n c"], weight: Float[Tensor, "g c"], bias: Float[Tensor, " g"]
) -> Float[Tensor, "*b g"]:
    """max over points of W h + b. Where points tie, one of them gets the gradient."""
    return _LinearMax.apply(h, weight, bias)
