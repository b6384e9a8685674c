"""Transfers held against the truth, edits of parts that other shapes lack, and the way there and back.

The true transfers come from files of `python -m data_gen transfers`: they go by the parameters that shapes were made
from, so the third shape may be of another family than the first two.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import torch
from jaxtyping import Float
from torch import Tensor

from .dictionary import offsets
from .handles import BatchHandles
from .metrics import held
from .modes import kind
from .projection import EditProjector
from .shapes import Shapes
from .space import ActionSpace
from .types import Points, Vector

AT_ONCE = 32  # triplets that go through the networks together


class Triplets(NamedTuple):
    """Shapes x, y and z, and what z becomes by that which turned x into y; the samples of `truth` are those of z."""

    x: Shapes
    y: Shapes
    z: Shapes
    truth: Shapes

    @classmethod
    def of(cls, shapes: Shapes, points: int | None = None) -> "Triplets":
        """The triplets of a file; of z and truth only so many points. Raises ValueError where the file holds none."""
        count = shapes.about.get("transfers", 0)
        if not count or len(shapes) != 4 * count:
            raise ValueError(
                f"Triplets: the file must hold x, y, z and truth of {count or 'some'} transfers, got {len(shapes)} "
                "shapes; make it with python -m data_gen transfers, and take all of it"
            )
        x, y, z, truth = (shapes[role * count : (role + 1) * count] for role in range(4))
        return cls(x, y, first_points(z, points), first_points(truth, points))


class Errors(NamedTuple):
    """Mean squared distances to the true transfers, (N,) each, in squared units of the file."""

    wrong: Float[Tensor, " N"]  # of z (+) xy
    idle: Float[Tensor, " N"]  # of z left alone
    families: tuple[str, ...]  # of z, one a triplet

    @property
    def share(self) -> float:
        """What is wrong, summed, over what is wrong where nothing is done: 0 is right, 1 no better than nothing."""
        return (self.wrong.sum() / self.idle.sum()).item()

    @property
    def by_family(self) -> dict[str, float]:
        """The share of each family of z."""
        rows = {
            name: [i for i, one in enumerate(self.families) if one == name] for name in dict.fromkeys(self.families)
        }
        return {name: (self.wrong[own].sum() / self.idle[own].sum()).item() for name, own in rows.items()}


def first_points(shapes: Shapes, points: int | None) -> Shapes:
    """The same shapes with the first of their points only; samples are in random order, so it is a coarser sampling."""
    per_point = {"points": shapes.points, "labels": shapes.labels, "rest": shapes.rest}
    kept = {name: value[:, :points] for name, value in per_point.items() if value is not None}
    return replace(shapes, **kept, faces=None, weights=None)


@torch.no_grad()
def errors(space: ActionSpace, triplets: Triplets) -> tuple[Errors, Errors]:
    """How far z (+) xy is from the true transfers, as it is, and brought to what the handles of z can follow."""
    found = []
    for start in range(0, len(triplets.x), AT_ONCE):
        x, y, z, truth = (shapes[start : start + AT_ONCE].like(space) for shapes in triplets)
        moved = space.act(z.points, space.vector(x.points, y.points))
        found.append([squared(each - truth.points) for each in (moved, held(z, moved), z.points)])
    named = triplets.z.about.get("families") or [triplets.z.about["family"]]
    rows = [0] * len(triplets.z) if triplets.z.families is None else triplets.z.families.tolist()
    wrong, projected, idle = (torch.cat(each).cpu() for each in zip(*found, strict=True))
    families = tuple(named[row] for row in rows)
    return Errors(wrong, idle, families), Errors(projected, idle, families)


def squared(u: Points) -> Float[Tensor, "*b"]:
    """Mean squared length of the offsets of each cloud."""
    return u.square().sum(-1).mean(-1)


@torch.no_grad()
def two_way(space: ActionSpace, x: Points, y: Points) -> float:
    """The paper's two-way error of corresponding x and y, mean |(d(x -> y) - x) + (d(y -> x) - y)|^2 (Section 4.3).

    As a share of the mean squared motion of both. What it adds up is 0 where the two dictionaries are one.
    """
    v = space.vector(x, y)
    there, back = space.act(x, v) - x, space.act(y, -v) - y
    moved = (squared(there).mean() + squared(back).mean()) / 2
    return (squared(there + back).mean() / moved.clamp_min(1e-24)).item()


@torch.no_grad()
def round_trip(space: ActionSpace, x: Points, v: Vector) -> float:
    """How far x (+) v (+) -v is from x: mean squared, as a share of how far x (+) v is."""
    there = space.act(x, v)
    return (squared(space.act(there, -v) - x).mean() / squared(there - x).mean().clamp_min(1e-24)).item()


def pins_of_part(names: tuple[str, ...], part: str, change: Mapping[str, float], hold: bool) -> dict[str, float]:
    """Changes of handles that edit a kind of part, such as {"translation.y": 0.05}; with `hold` other parts stay."""
    own = [name for name in names if kind(name.split(".")[0]) == part]
    pins = {name: 0.0 for name in names if hold and name not in own}
    return pins | {name: change[how] for name in own if (how := name.split(".", 1)[1]) in change}


class Echo(NamedTuple):
    """How far an edit moves shapes that lack the part, as a share of how far it moves those that have it (rms)."""

    plain: float
    projected: float  # brought to what the handles of each shape can follow


@torch.no_grad()
def echoes(space: ActionSpace, shapes: Shapes, part: str, change: Mapping[str, float], sources: int) -> dict[str, Echo]:
    """An edit of one kind of part, made on shapes that have it and handed on to all others, in three ways.

    snapped: the vector that EditProjector finds with all other handles free (Eq. 4). kept: the same with all other
    parts held where they are. read: the vector E(x') - E(x) to the shape x' that the handles then make.
    Raises ValueError where no shape has the part, or none lacks it.
    """
    shapes = shapes.like(space)
    own = torch.tensor([kind(name) == part for name in shapes.part_names], device=shapes.boxes.device)
    has = (shapes.boxes.isfinite().all(-1) & own).any(1)
    if has.all() or not has.any():
        raise ValueError(
            f"echoes: some shapes must have a {part} and others not, got {int(has.sum())} of {len(has)}; mix families"
        )
    A, seen = _dictionaries(space, shapes)
    found = {how: [] for how in ("snapped", "kept", "read")}
    sampled = torch.isin(shapes.labels, own.nonzero().flatten()).any(1)  # a thin part may have no points, so no handles
    for i in (has & sampled).nonzero().flatten()[:sources].tolist():
        for how, v in _vectors(space, shapes[i], part, change).items():
            found[how].append([_by_presence(each, v, i, has) for each in (A, seen)])
    return {how: Echo(*_ratios(torch.tensor(squares))) for how, squares in found.items()}


def _vectors(space: ActionSpace, one: Shapes, part: str, change: Mapping[str, float]) -> dict[str, Vector]:
    projector = EditProjector.of(space, one)
    free, kept = (
        projector(pins_of_part(projector.handles.names, part, change, hold), change=True) for hold in (False, True)
    )
    read = space.vector(one.points[0], kept.by_handles)
    return {"snapped": free.v.to(read), "kept": kept.v.to(read), "read": read}


def _dictionaries(space: ActionSpace, shapes: Shapes) -> tuple[Tensor, Tensor]:
    """A and BB+A of every shape."""
    pieces = [shapes[start : start + AT_ONCE] for start in range(0, len(shapes), AT_ONCE)]
    A = [space.dictionary(piece.points) for piece in pieces]
    return torch.cat(A), torch.cat([BatchHandles.of(p).project(a) for p, a in zip(pieces, A, strict=True)])


def _by_presence(A: Tensor, v: Vector, source: int, has: Tensor) -> tuple[float, float]:
    """Mean squared motion of shapes without the part, and of the others with it, the source left out."""
    moved = squared(offsets(A, v))
    others = has & (torch.arange(len(has), device=has.device) != source)
    return moved[~has].mean().item(), moved[others].mean().item()


def _ratios(squares: Float[Tensor, "s 2 2"]) -> list[float]:
    """Roots of the ratios, plain and projected, of sums over the sources."""
    without, with_part = squares.sum(0).unbind(-1)
    return (without / with_part).sqrt().tolist()
