"""What edits lead to, and several of them at once: vectors of one source add up, so edits blend like colours."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import isfinite

import torch
from torch import Tensor

from ..projection import Snapped
from ..types import Vector
from .followers import Followed


@dataclass(frozen=True)
class CoEdit:
    """Where edits have led: the source, snapped, and the others that followed.

    source holds the totals since the shape as it was: z0, z_hat, v, points, by_handles, residual; its pinned, edited,
    at_bounds and distance are those of the latest edit. v (k,) is what the others were moved by: strength times that of
    the source in one edit. moved: root mean square length by which the points of the source have moved.
    """

    source: Snapped
    v: Vector
    others: tuple[Followed, ...]
    moved: float


def blended(start: CoEdit, edits: Sequence[CoEdit], weights: Sequence[float]) -> tuple[Snapped, Vector, Vector]:
    """Handle values and broken edit, v of the source and v of the others. Raises ValueError as CoEditor.blend does."""
    _check(start.source, edits, weights)
    left = 1 - sum(weights)

    def mixed(of: Callable[[CoEdit], Tensor]) -> Tensor:
        # not start + sum w (edit - start), which rounds where one weight is 1
        return sum(w * of(edit) for w, edit in zip(weights, edits, strict=True)) + left * of(start)

    used = [edit.source for w, edit in zip(weights, edits, strict=True) if w != 0]
    step = replace(
        start.source,
        z_hat=mixed(lambda edit: edit.source.z_hat),
        edited=mixed(lambda edit: edit.source.edited),
        pinned=tuple(dict.fromkeys(name for snapped in used for name in snapped.pinned)),
        at_bounds=tuple(dict.fromkeys(name for snapped in used for name in snapped.at_bounds)),
    )
    return step, mixed(lambda edit: edit.source.v), mixed(lambda edit: edit.v)


def _check(own: Snapped, edits: Sequence[CoEdit], weights: Sequence[float]) -> None:
    if len(weights) != len(edits) or not all(map(isfinite, weights)):
        raise ValueError(
            f"blend: weights must be one finite number for each of the {len(edits)} edits, got {list(weights)}; "
            "count again"
        )
    if any(edit.source.names != own.names or not torch.equal(edit.source.z0, own.z0) for edit in edits):
        raise ValueError("blend: edits must be of the source of this CoEditor, got one of another; make them with it")
