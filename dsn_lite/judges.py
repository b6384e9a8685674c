"""Judges of answers that can be right in many ways: each returns what is wrong in sentences, none if nothing is."""

from collections.abc import Callable

import torch
from torch import Tensor

from .diagnosis import unfinished

CORNERS = torch.tensor([[0.2, 0.1, 0.0], [0.9, 0.3, 0.4], [0.4, 0.8, -0.2]], dtype=torch.float64)
DRAWN, PIECES, OFF = 40_000, 4, 0.15  # points; pieces of an edge; a share may be off by this share of itself
NEAR = 1e-5


def triangle_sampler(sample: Callable[..., Tensor]) -> list[str]:
    """Whether sample(a, b, c, u, v) puts points (m, 3) evenly on the triangle a, b, c (3,), for even u, v (m, 1)."""
    u, v = torch.rand(2, DRAWN, 1, generator=torch.Generator().manual_seed(0), dtype=torch.float64)
    points = sample(*CORNERS, u, v)
    if problem := unfinished(points):
        return [problem]
    if not isinstance(points, Tensor) or points.shape != (DRAWN, 3):
        got = tuple(points.shape) if isinstance(points, Tensor) else type(points).__name__
        return [f"for u and v of shape {tuple(u.shape)} it must return points {(DRAWN, 3)}, not {got}"]
    weights = _weights(points)
    if ((weights @ CORNERS - points).abs() > NEAR).any():
        return ["its points leave the plane of the triangle; the weights of the three corners must add up to 1"]
    outside = float((weights < -NEAR).any(-1).double().mean())
    if outside:
        return [f"{outside:.0%} of its points lie outside the triangle, where u + v > 1; turn those back into it"]
    return _crowded(weights)


def triangle_inequality(distance: Callable[[Tensor, Tensor], Tensor], x: Tensor, y: Tensor, z: Tensor) -> list[str]:
    """Whether three clouds (n, 3) break d(x, z) <= d(x, y) + d(y, z)."""
    direct, there, on = (float(distance(a, b)) for a, b in ((x, z), (x, y), (y, z)))
    if direct > (1 + 1e-6) * (there + on):
        return []
    way = f"by way of y {there:.3g} + {on:.3g}"
    return [f"from x to z it is {direct:.3g}, {way}, which is no shorter; bring y nearer to both"]


def _weights(points: Tensor) -> Tensor:
    """Weights (m, 3) of the corners, which add up to 1, of the points of their plane that are nearest."""
    edges = (CORNERS[1:] - CORNERS[0]).T
    v = torch.linalg.lstsq(edges, (points.double() - CORNERS[0]).T).solution.T
    return torch.cat([1 - v.sum(-1, keepdim=True), v], dim=-1)


def _crowded(weights: Tensor) -> list[str]:
    """Where points crowd: the triangle is cut into PIECES^2 small ones of one size, which should hold equally many."""
    cells = (PIECES * weights).floor().clamp(0, PIECES - 1)
    kinds, counts = cells.unique(dim=0, return_counts=True)
    share = counts.max().item() / (len(weights) / PIECES**2)
    if len(kinds) == PIECES**2 and abs(share - 1) < OFF:
        return []
    at = kinds[counts.argmax()] / PIECES
    where = "in its middle" if at.max() < 0.5 else f"at the corner {'abc'[int(at.argmax())]}"
    return [f"its points crowd {where}: {share:.1f} times as many in one place as there should be"]
