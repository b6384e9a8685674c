"""Edits of many shapes completed, as boxes: all that symmetry and contact are read from."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import groupby

import torch
from jaxtyping import Bool, Float
from torch import Tensor

from ..handles import BoxHandles
from ..projection import EditProjector, Prior
from ..shapes import Shapes
from ..types import Dictionary
from .edits import Edit

Plausible = Callable[[Shapes], Dictionary]


@dataclass(frozen=True)
class Completed:
    """T edits, each completed: the parts' boxes (T, P, 15) afterwards, and whether an edge length met its bound."""

    boxes: Float[Tensor, "T P 15"]
    bounded: Bool[Tensor, " T"]


def complete(plausible: Plausible, shapes: Shapes, edits: Sequence[Edit], noise: float = 0.0) -> Completed:
    """Snaps each edit to what is plausible around its shape: a dictionary A (1, n, 3, k) of that one shape (Eqs. 4-7).

    Edge lengths stay > 0. `noise` is how far A is off, as of Prior, where real shapes vary by 1 along it.
    Raises ValueError where the shapes tell no parts.
    """
    found = [None] * len(edits)
    order = sorted(range(len(edits)), key=lambda t: edits[t].shape)
    for i, own in groupby(order, key=lambda t: edits[t].shape):
        one = shapes[i]
        handles = BoxHandles.of(one)
        A = plausible(one)[0]
        projector = EditProjector(A, handles, one.points[0], Prior(torch.eye(A.shape[-1]), noise) if noise else None)
        for t in own:
            snapped = projector({edits[t].handle: edits[t].value})
            change = snapped.z_hat - snapped.z0
            found[t] = moved_boxes(one.boxes[0], handles, change), bool(snapped.at_bounds)
    boxes, bounded = zip(*found, strict=True)
    return Completed(torch.stack(boxes), torch.tensor(bounded))


def uncompleted(shapes: Shapes, edits: Sequence[Edit]) -> Completed:
    """The edits as they are, nothing else moved."""
    boxes = []
    for edit in edits:
        handles = BoxHandles.of(shapes, edit.shape)
        change = torch.zeros_like(handles.z0)
        j = handles.names.index(edit.handle)
        change[j] = edit.value - handles.z0[j]
        boxes.append(moved_boxes(shapes.boxes[edit.shape], handles, change))
    return Completed(torch.stack(boxes), torch.zeros(len(edits), dtype=torch.bool))


def moved_boxes(
    boxes: Float[Tensor, "P 15"], handles: BoxHandles, change: Float[Tensor, " m"]
) -> Float[Tensor, "P 15"]:
    """Boxes after a change of their handles, in double precision; what has no handle stays."""
    boxes = boxes.double()
    z = boxes.new_zeros(handles.kept.shape).masked_scatter(handles.kept, change.double())
    shift = (handles.rotation.double() @ z[:, 0, :, None])[..., 0]
    return torch.cat([boxes[:, :3] + shift, boxes[:, 3:12], boxes[:, 12:] + z[:, 1]], dim=1)
