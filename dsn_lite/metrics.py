"""The numbers of the tables: how well a space fits, closes parallelograms and transfers, beside doing nothing.

All Chamfer values are in squared units of the file (see chamfer.py). `evaluate` gathers them for hold-out shapes.
"""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import torch
from jaxtyping import Float
from torch import Tensor

from .chamfer import chamfer
from .data import Shapes, triplets, true_deformation, true_transfer
from .dictionary import rms as rms  # what lessons and laws know it by
from .files import as_shapes
from .handles import BatchHandles
from .space import ActionSpace, DoNothing
from .types import Points

AT_ONCE = 32  # pairs that go through the networks together: 1000 of 2048 points and k = 64 would take 5 GB


def floor(shapes: Shapes, again: Shapes) -> float:
    """The sampling floor: mean Ch between two independent samplings of the same shapes. No fit gets below."""
    if len(shapes) != len(again):
        raise ValueError(
            f"floor: both samplings must be of the same shapes, got {len(shapes)} and {len(again)}; resample"
        )
    return chamfer(shapes.points, again.points).mean().item()


@dataclass(frozen=True, repr=False)
class Evaluation:
    """Hold-out results of one space. `floor` and what needs the true answer are None where the file does not tell."""

    pairs: int
    fitting_cd: float
    do_nothing_cd: float
    floor: float | None
    exact_cd: float | None  # what the true deformation scores: samples of x placed on y are not area-weighted on y
    identity: float
    parallelogram_cd: float  # Ch(z (+) xy, y (+) xz)
    parallelogram_idle_cd: float  # Ch(z, y): where nothing moves
    moved: float  # rms of z (+) xy - z: a parallelogram closes easily where little moves
    share_moved: float  # rms of z (+) xy - z over rms of x (+) xy - x
    transfer_error: float | None  # squared distance to the true transfer, as a share of leaving z alone

    @property
    def fitting_share(self) -> float | None:
        """What is left to fit, (CD - floor) / (doing nothing - floor): 0 at the sampling floor, 1 for doing nothing."""
        return None if self.floor is None else (self.fitting_cd - self.floor) / (self.do_nothing_cd - self.floor)

    @property
    def parallelogram_share(self) -> float | None:
        """What is left to close, (Ch(z + xy, y + xz) - floor) / (Ch(z, y) - floor)."""
        if self.floor is None:
            return None
        return (self.parallelogram_cd - self.floor) / (self.parallelogram_idle_cd - self.floor)

    def __repr__(self) -> str:
        lines = []
        shares = {"fitting_share": self.fitting_share, "parallelogram_share": self.parallelogram_share}
        for name, value in (asdict(self) | shares).items():
            shown = "unknown" if value is None else f"{value:.4g}"
            compared = name.endswith("_cd") and value is not None and self.floor
            lines.append(f"{name:>21}  {shown}" + (f"  = {value / self.floor:.2f} x floor" if compared else ""))
        return "\n".join(lines)


@torch.no_grad()
def evaluate(
    space: ActionSpace, shapes: Any, *, again: Any = None, pairs: int = 200, seed: int = 0, project: bool = False
) -> Evaluation:
    """Measures a space on shapes it was not trained on; `again` is a second sampling of them, for the floor.

    Both are collections or plain arrays (N, n, 3). With `project` all that is deformed is brought to what the handles
    of its parts can follow (Eq. 8), transfers too. Raises ValueError where there are fewer than three shapes, or no
    parts to project to.
    """
    shapes = as_shapes(shapes).like(space)
    triples, known = triplets(shapes, pairs, seed), shapes.truth_is_known
    found = [_measured(space, *some, project, known) for some in _pieces(*triples)]
    mean = {name: torch.cat([one[name] for one in found]).mean().item() for name in found[0]}
    fitted, moved, off = (mean.pop(name) ** 0.5 for name in ("fitted", "moved", "identity"))
    return Evaluation(
        pairs=pairs,
        floor=None if again is None else floor(shapes, as_shapes(again).like(space)),
        identity=off,
        moved=moved,
        share_moved=moved / max(fitted, 1e-12),
        transfer_error=_transfer_error(space, shapes, pairs, seed, project) if known else None,
        **{"exact_cd": None} | mean,
    )


def _pieces(*collections: Shapes) -> Iterator[tuple[Shapes, ...]]:
    for start in range(0, len(collections[0]), AT_ONCE):
        yield tuple(shapes[start : start + AT_ONCE] for shapes in collections)


def _measured(
    space: ActionSpace, x: Shapes, y: Shapes, z: Shapes, project: bool, known: bool
) -> dict[str, Float[Tensor, " b"]]:
    """What `Evaluation` holds, of each triplet; lengths are squared."""
    deformed = held(x, space.deform(x.points, y.points), project)
    moved, other = (held(b, space.transfer(x.points, a.points, b.points), project) for a, b in ((y, z), (z, y)))
    exact = {"exact_cd": chamfer(true_deformation(x, y), y.points)} if known else {}
    return exact | {
        "fitting_cd": chamfer(deformed, y.points),
        "do_nothing_cd": chamfer(x.points, y.points),
        "identity": _each(space.deform(x.points, x.points) - x.points),
        "parallelogram_cd": chamfer(moved, other),
        "parallelogram_idle_cd": chamfer(z.points, y.points),
        "moved": _each(moved - z.points),
        "fitted": _each(deformed - x.points),
    }


def _each(u: Points) -> Float[Tensor, " b"]:
    """Mean squared length of the offsets of each cloud."""
    return u.square().sum(-1).mean(-1)


def held(shapes: Shapes, moved: Points, project: bool = True) -> Points:
    """d_proj (Eq. 8): shapes that were moved, brought to what the handles of their own parts can follow."""
    return BatchHandles.of(shapes).project(moved) if project else moved


def _transfer_error(space: ActionSpace, shapes: Shapes, pairs: int, seed: int, project: bool) -> float | None:
    try:
        return transfer_error(space, *triplets(shapes, pairs, seed, with_truth=True), project=project)
    except ValueError:  # among few shapes no true transfer may stay inside the ranges
        return None


@torch.no_grad()
def transfer_error(space: ActionSpace, x: Shapes, y: Shapes, z: Shapes, *, project: bool = False) -> float:
    """Mean squared distance of z (+) xy to the true transfer of the same samples, as a share of leaving z alone."""
    pairs = [_wrong(space, *some, project) for some in _pieces(x, y, z)]
    wrong, idle = (torch.cat(each).mean() for each in zip(*pairs, strict=True))
    return (wrong / idle).item()


def _wrong(space: ActionSpace, x: Shapes, y: Shapes, z: Shapes, project: bool) -> tuple[Tensor, Tensor]:
    """Mean squared distances (b,) to the true transfers, of z (+) xy and of z left alone."""
    truth, nothing = true_transfer(x, y, z), DoNothing().act(z.points, z.points.new_zeros(1))
    moved = held(z, space.transfer(x.points, y.points, z.points), project)
    return _each(moved - truth), _each(nothing - truth)
