"""How plausible many generated shapes are, judged by real ones: MMD-CD and Cov-CD of Achlioptas et al. (2018).

Both read one table of the Chamfer distances from each of G generated shapes to each of R references. The paper's
sentence on MMD has it the other way round, from each generated shape to its closest reference; its numbers come from
code that does what stands here.
"""

import torch
from jaxtyping import Float
from torch import Tensor

from .types import check_clouds

BLOCK = 1 << 18  # squared distances at a time: 1 MB of float32 stays in the cache


def chamfer_table(generated: Float[Tensor, "G n 3"], references: Float[Tensor, "R p 3"]) -> Float[Tensor, "G R"]:
    """Ch of every generated shape (G, n, 3) to every reference (R, p, 3), without gradient.

    Raises ValueError where one of them is not a batch of finite clouds.
    """
    check_clouds("chamfer_table", generated=generated, references=references)
    if generated.ndim != 3 or references.ndim != 3:
        raise ValueError(
            f"chamfer_table: shapes must be (G, n, 3) and (R, p, 3), got {tuple(generated.shape)} and "
            f"{tuple(references.shape)}; stack them"
        )
    centre, size = references.mean((0, 1)), max(1, BLOCK // (generated.shape[1] * references.shape[1]))
    with torch.no_grad():
        rows, columns = _factors(generated - centre)[0], _factors(references - centre)[1]
        return torch.stack([torch.cat([_to_many(x, y) for y in columns.split(size)]) for x in rows])


def mmd_cd(table: Float[Tensor, "G R"]) -> float:
    """Minimum matching distance: how far each reference is from the nearest generated shape, mean over references."""
    return table.amin(0).mean().item()


def coverage_cd(table: Float[Tensor, "G R"]) -> float:
    """Coverage: the share of references that are the nearest one of some generated shape."""
    return len(table.argmin(1).unique()) / table.shape[1]


def _factors(x: Tensor) -> tuple[Tensor, Tensor]:
    """What |x - y|^2 = |x|^2 1 + 1 |y|^2 - 2 x.y is the product of, for x on the left (n, 5) and for it as y (5, n)."""
    square, one = x.square().sum(-1, keepdim=True), torch.ones_like(x[..., :1])
    return torch.cat([square, one, -2 * x], dim=-1), torch.cat([one, square, x], dim=-1).mT


def _to_many(x: Tensor, y: Tensor) -> Tensor:
    """Ch of one cloud (n, 5) to each of (b, 5, p)."""
    squared = (x @ y.transpose(0, 1).flatten(1)).unflatten(1, (len(y), -1))
    return squared.amin(2).clamp_min(0).mean(0) + squared.amin(0).clamp_min(0).mean(1)
