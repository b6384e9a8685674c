"""What the columns of a dictionary do, part by part: numbers from which all else about modes is counted."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

import torch
from jaxtyping import Bool, Float
from torch import Tensor

from ..dictionary import column_rms
from ..handles import BatchHandles
from ..shapes import Shapes
from ..space import ActionSpace
from .bases import check_dictionary
from .kinds import kind, kinds

AT_ONCE = 16  # shapes whose dictionaries are in memory together
STILL = 0.1  # of the most moved point's motion: what moves less stands still


@dataclass(frozen=True)
class Reading:
    """What k modes do to N shapes of P parts of K kinds. Nothing here grows with the number of points.

    handles (N, 6P, k) is B+F(x), and real (N, 6P) tells which handles a shape has; rms (N, k) is the length of each
    column. energy (N, P, k) is the share of a mode's squared motion that lies in each part, and inside (N, k) the share
    that handles can make. profile (N, K, 6, k) is what a mode does to each kind of part, present (N, K): how far it
    moves it along x, y and z, and how far it stretches it, as shares of the mode's rms: squared, they add up to the
    energy, less what is neither shift nor stretch. still (N, k) is the share of points that move less than a tenth of
    what the most moved does.
    """

    handles: Float[Tensor, "N m k"]
    real: Bool[Tensor, "N m"]
    rms: Float[Tensor, "N k"]
    energy: Float[Tensor, "N P k"]
    inside: Float[Tensor, "N k"]
    profile: Float[Tensor, "N K 6 k"]
    present: Bool[Tensor, "N K"]
    still: Float[Tensor, "N k"]
    part_names: tuple[str, ...] = ()

    @property
    def kinds(self) -> tuple[str, ...]:
        """The K kinds of parts."""
        return kinds(self.part_names)

    @property
    def energy_by_kind(self) -> Float[Tensor, "N K k"]:
        """The share of a mode's squared motion that lies in each kind of part."""
        return members(self.part_names).to(self.energy).mT @ self.energy

    @property
    def parts_moved(self) -> Float[Tensor, "N k"]:
        """How many parts a mode moves, 1 / sum of p^2 over its shares p: P where all move alike, 1 where one does."""
        together = self.energy.square().sum(1)
        return torch.where(together > 0, 1 / together.clamp_min(1e-12), 0)

    def only(self, columns: slice | Sequence[int] | Tensor) -> "Reading":
        """Of some modes, by index: those that a space uses, or a few to look at."""
        per_mode = (field for field in fields(self) if field.name not in ("real", "present", "part_names"))
        return replace(self, **{field.name: getattr(self, field.name)[..., columns] for field in per_mode})


@torch.no_grad()
def read(space: ActionSpace, shapes: Shapes) -> Reading:
    """Reads the dictionary of a space on every one of these shapes.

    Raises ValueError where the space has no dictionary, or the shapes tell no parts.
    """
    check_dictionary("modes.read", space)
    if shapes.boxes is None or len(shapes.part_names) != shapes.boxes.shape[1]:
        raise ValueError(
            "modes.read: shapes must have boxes and names of their parts, these have not; take shapes of data_gen"
        )
    shapes = shapes.like(space)
    pieces = [list(_read(space, shapes[i : i + AT_ONCE])) for i in range(0, len(shapes), AT_ONCE)]
    return Reading(*map(torch.cat, zip(*pieces, strict=True)), part_names=shapes.part_names)


def members(part_names: tuple[str, ...]) -> Float[Tensor, "P K"]:
    """1 where a part is of a kind."""
    names = kinds(part_names)
    return torch.tensor([[float(kind(part) == name) for name in names] for part in part_names])


def _read(space: ActionSpace, shapes: Shapes) -> Iterator[Tensor]:
    """The fields of a Reading, in their order."""
    A, x, handles = space.dictionary(shapes.points), shapes.points, BatchHandles.of(shapes)
    parts = torch.nn.functional.one_hot(shapes.labels.expand(x.shape[:2]).long() + 1, len(shapes.part_names) + 1)
    parts = parts[..., 1:].to(x)
    moved, rms = A.square().sum(-2), column_rms(A)
    total, families = moved.sum(1).clamp_min(1e-12), parts @ members(shapes.part_names).to(x)
    yield handles.coordinates(A)
    yield handles.mask.flatten(1)
    yield rms
    yield parts.mT @ moved / total.unsqueeze(1)
    yield handles.project(A).square().sum((1, 2)) / total
    yield _profile(x, A, families) / rms.clamp_min(1e-12)[:, None, None]
    yield families.sum(1) > 0
    yield (moved < STILL**2 * moved.amax(1, keepdim=True)).to(x).mean(1)


def _profile(x: Tensor, A: Tensor, own: Tensor) -> Tensor:
    """Shift and stretch of each kind of part: (N, K, 6, k) from points, offsets and which kind (N, n, K) each is of."""
    count = own.sum(1).unsqueeze(-1)
    x = x - own @ (own.mT @ x / count.clamp_min(1))
    spread = (own.mT @ x.square()).sqrt()
    shift = torch.einsum("bnq,bnck->bqck", own, A) / count.clamp_min(1).sqrt().unsqueeze(-1)
    along = torch.einsum("bnqc,bnck->bqck", own.unsqueeze(-1) * x.unsqueeze(-2), A)
    # of all points, sqrt(count / n) (mean, slope times standard deviation)
    stretch = along / spread.clamp_min(1e-6 * x.shape[1] ** 0.5).unsqueeze(-1)
    return torch.cat([shift, stretch], dim=2) / x.shape[1] ** 0.5
