"""The Chamfer distance Ch(x, y) = mean_i min_j |x_i - y_j|^2 + mean_j min_i |x_i - y_j|^2.

Squared, mean over points, both directions summed, no 1/2: so Ch(x, x) is exactly 0 and the unit is length squared.
Neighbours are found without gradient, then measured with it. On the CPU they come from k-d trees, one a cloud;
on a GPU from blocks of all distances.
"""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache

import numpy as np
import torch
from jaxtyping import Float
from scipy.spatial import cKDTree
from torch import Tensor

from .types import OtherPoints, Partners, Points, check_clouds

BLOCK = 1 << 24  # entries of one block of squared distances on a GPU: 64 MB of float32


def chamfer(
    x: Points, y: OtherPoints, trees: Sequence[cKDTree] | None = None, own: Sequence[cKDTree] | None = None
) -> Float[Tensor, "*#b"]:
    """Ch(x, y), one number a pair of clouds, differentiable in both; `trees` are kept trees of y, `own` of x (`plant`).

    Raises ValueError where x or y is not (..., n, 3), has no points, or holds NaN or infinity.
    """
    check_clouds("chamfer", x=x, y=y)
    batch = torch.broadcast_shapes(x.shape[:-2], y.shape[:-2])
    x, y = x.expand(*batch, *x.shape[-2:]), y.expand(*batch, *y.shape[-2:])
    return _one_way(x, y, nearest(x, y, trees)) + _one_way(y, x, nearest(y, x, own))


def one_way(x: Points, y: OtherPoints, trees: Sequence[cKDTree] | None = None) -> Float[Tensor, "*#b"]:
    """mean_i min_j |x_i - y_j|^2: the half of Ch(x, y) that starts from x."""
    return _one_way(x, y, nearest(x, y, trees))


def nearest(x: Points, y: OtherPoints, trees: Sequence[cKDTree] | None = None) -> Partners:
    """For each point of x the index of its nearest point of y. No gradient."""
    with torch.no_grad():
        if x.is_cpu:
            return _nearest_by_trees(x, y, plant(y) if trees is None else trees)
        return _nearest_by_blocks(x, y)


def plant(clouds: Points) -> list[cKDTree]:
    """One k-d tree a cloud, in order. Worth keeping where the same clouds are the targets again and again."""
    flat = clouds.detach().cpu().reshape(-1, *clouds.shape[-2:]).numpy()
    return list(_pool().map(_tree, flat))


def _one_way(x: Points, y: OtherPoints, partners: Partners) -> Float[Tensor, "*#b"]:
    met = torch.take_along_dim(y, partners.unsqueeze(-1), dim=-2)
    return (x - met).square().sum(-1).mean(-1)


def _tree(cloud: np.ndarray) -> cKDTree:
    return cKDTree(cloud, balanced_tree=False, compact_nodes=False)  # building is what costs: clouds are used once


def _nearest_by_trees(x: Points, y: OtherPoints, trees: Sequence[cKDTree]) -> Partners:
    flat = x.detach().reshape(-1, *x.shape[-2:]).numpy()
    found = np.stack(list(_pool().map(lambda tree, cloud: tree.query(cloud)[1], trees, flat)))
    return torch.from_numpy(found).reshape(x.shape[:-1])


def _nearest_by_blocks(x: Points, y: OtherPoints) -> Partners:
    rows = max(1, BLOCK // max(1, y.shape[-2] * y.shape[:-2].numel()))
    return torch.cat([_squared_distances(part, y).argmin(-1) for part in x.split(rows, dim=-2)], dim=-1)


def _squared_distances(x: Points, y: OtherPoints) -> Float[Tensor, "*#b n p"]:
    # not |x|^2 - 2 x.y + |y|^2: float32 then cannot tell points 1e-4 apart, and Ch(x, x) is no longer exactly 0
    axes = zip(x.unsqueeze(-2).unbind(-1), y.unsqueeze(-3).unbind(-1), strict=True)
    return sum((here - there).square() for here, there in axes)


def _pool() -> ThreadPoolExecutor:
    return _threads(torch.get_num_threads())  # several trainings side by side share the cores by it


@cache
def _threads(count: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(max_workers=count, thread_name_prefix="chamfer")
