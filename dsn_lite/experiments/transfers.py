"""How plausible transfers are, by the two measures of the paper's Tables 1 and 3."""

from collections.abc import Callable
from statistics import fmean

import torch

from ..coverage import chamfer_table, coverage_cd, mmd_cd
from ..shapes import Shapes
from ..types import Points
from .kinds import Trained


def plausible(
    trained: Trained,
    move: Callable[[Shapes, Points, Shapes], Points],
    name: str,
    *,
    targets: int,
    sources: int,
    references: int,
    points: int,
) -> dict[str, float]:
    """MMD-CD and Cov-CD of transfers among the hold-out shapes against shapes seen, mean over targets (Section 4.2).

    For each target y as many pairs of a source x and a new source z; both see the same `points` of every shape.
    """
    rng, found = torch.Generator().manual_seed(0), []
    shapes, seen = (each.like(trained.space) for each in (trained.shapes, trained.seen[:references]))
    draw = lambda count: torch.randint(len(shapes), (count,), generator=rng)
    kept = torch.randperm(shapes.points.shape[1], generator=rng)[:points]
    for target in draw(targets):
        y, x, z = shapes.points[target], shapes[draw(sources)], shapes[draw(sources)]
        pairwise = chamfer_table(move(x, y.expand_as(x.points), z)[:, kept], seen.points[:, kept])
        found.append((mmd_cd(pairwise), coverage_cd(pairwise)))
    mmd, coverage = (fmean(each) for each in zip(*found, strict=True))
    return {f"{name}mmd": mmd, f"{name}coverage": coverage}
