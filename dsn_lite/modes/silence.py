"""How silent a mode is on shapes that lack the part it moves: the swivel leg, the shelf (Section 4.1 of the paper).

A normalised column cannot vanish: its rms over the points is 1 on every shape, so it moves something. What may be
silent is its image in the handles, B+A_j, or an edit, whose vector may use several columns. Each means something only
beside the same number of the untrained network.
"""

from typing import NamedTuple

import torch

from ..metrics import rms
from ..space import ActionSpace
from ..types import OtherPoints, Points
from .reading import Reading


class Silence(NamedTuple):
    """The mode that moves one kind of part most, on shapes that lack the kind against shapes that have it."""

    kind: str
    mode: int
    share: float  # of the mode's squared motion that lies in the kind, on shapes that have it
    having: int  # shapes
    lacking: int
    rms: float  # of the mode on those lacking, as a share of those having: 1 where columns have unit rms
    handles: float  # the same of |B+A_j|


def silence(reading: Reading, kind: str) -> Silence:
    """Measures the main mode of a kind of part, such as "shelf".

    Raises ValueError where there is no such kind, or no shape lacks it.
    """
    if kind not in reading.kinds:
        raise ValueError(f"silence: kind must be one of {', '.join(reading.kinds)}, got {kind!r}; leg_1 is a leg")
    index = reading.kinds.index(kind)
    has = reading.present[:, index]
    if has.all() or not has.any():
        raise ValueError(
            f"silence: some shapes must have a {kind} and others not, got {int(has.sum())} of {len(has)} that do; mix "
            "families"
        )
    energy = reading.energy_by_kind[has, index].mean(0)
    mode = int(energy.argmax())
    lengths = reading.rms[:, mode], reading.handles[..., mode].norm(dim=1)
    ratios = [(length[~has].mean() / length[has].mean()).item() for length in lengths]
    return Silence(kind, mode, energy[mode].item(), int(has.sum()), int((~has).sum()), *ratios)


@torch.no_grad()
def echo(space: ActionSpace, x: Points, y: OtherPoints, z: Points) -> float:
    """How far xy moves z as a share of how far it moves x (rms); z may be other shapes than x, as many or of other n.

    0 where x and y differ in a part that z lacks and the space knows it.
    """
    v = space.vector(x, y)
    return rms(space.act(z, v) - z) / max(rms(space.act(x, v) - x), 1e-12)
