"""Whether arrays are shapes: what the format of data_gen asks of them, said in one sentence where they are not."""

from typing import Any

import numpy as np
import torch
from torch import Tensor

from .shapes import SHARED, Shapes

MIXED = "all clouds must have the same n, got mixed sizes; resample them to one n"
CURE = "write it again, or check that it is a file of shapes"
REALS = ("rest", "weights", "boxes", "parameters", "joints")
WHOLE = ("labels", "faces", "families")
TEXTS = ("parameter_names", "part_names", "names")
AT_ONCE = 1000  # shapes that are looked at together, so that mapped files stay out of memory


def assemble(known: dict[str, Any], where: str, *, lazy: bool = False) -> Shapes:
    """Shapes of the arrays that are known. Raises ValueError, beginning with `where`, unless they fit together.

    lazy: look at shapes and types alone, so that nothing of mapped arrays is read.
    """
    about = known.get("about") or {}
    if not isinstance(about, dict):
        raise ValueError(f"{where}: about must be a JSON object, got {str(about)[:40]!r}; {CURE}")
    taken: dict[str, Any] = {"points": as_points(known["points"], where, lazy=lazy), "about": about}
    for name in REALS + WHOLE:
        if known.get(name) is not None:
            value = _numbers(name, known[name], where)
            taken[name] = value if name in WHOLE else value.to(taken["points"].dtype)
            _agree(name, taken[name], taken["points"], where)
    for name in TEXTS:
        value = known.get(name)
        taken[name] = tuple(str(word) for word in value) if value is not None else ()
    if not lazy:
        _check_values(taken, where)
    return Shapes(**taken)


def as_points(source: Any, where: str, *, lazy: bool = False) -> Tensor:
    """Clouds (N, n, 3) in float32, or float64 where they are so. Raises ValueError, beginning with `where`."""
    array = source.detach().cpu().numpy() if isinstance(source, Tensor) else source
    try:
        array = np.asarray(array)
    except ValueError:
        array = np.empty(0, dtype=object)
    _check_points(array, where)
    if not lazy:
        _check_finite("points", array, where)
    taken = np.asarray if lazy or isinstance(source, Tensor) else np.array  # an array of others is copied
    return torch.from_numpy(taken(array, np.float64 if array.dtype == np.float64 else np.float32))


def _check_points(array: np.ndarray, where: str) -> None:
    if array.dtype == object:
        raise ValueError(f"{where}: {MIXED}")
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{where}: points must be real numbers, got {array.dtype}; {CURE}")
    if array.ndim != 3 or array.shape[-1] != 3 or 0 in array.shape:
        raise ValueError(
            f"{where}: points must be (N, n, 3) with N, n > 0, got {array.shape}; stack the clouds of all shapes"
        )
    if array.shape[1] < 2:
        raise ValueError(
            f"{where}: a shape needs at least 2 points, got {array.shape[1]}; sample the surfaces more densely"
        )


def _numbers(name: str, source: Any, where: str) -> Tensor:
    """Integers for labels, faces and families, real numbers for the rest."""
    array = source.detach().cpu().numpy() if isinstance(source, Tensor) else np.asarray(source)
    wanted, kinds = ("whole numbers", "iu") if name in WHOLE else ("real numbers", "fiu")
    if array.dtype.kind not in kinds:
        raise ValueError(f"{where}: {name} must be {wanted}, got {array.dtype}; {CURE}")
    return torch.as_tensor(array if array.flags.writeable else array.copy())


def _agree(name: str, value: Tensor, points: Tensor, where: str) -> None:
    """Refuses what belongs to other points."""
    N, n = points.shape[:2]
    sampled = {"labels": (n,), "rest": (n, 3), "faces": (n,), "weights": (n, 2)}
    wide = {"boxes": (*value.shape[1:2], 15), "joints": (*value.shape[1:2], 8), "parameters": value.shape[1:2]}
    own = (N, *(sampled | wide | {"families": ()})[name])
    if tuple(value.shape) != own and not (name in SHARED and tuple(value.shape) == own[1:]):
        raise ValueError(f"{where}: {name} must go with {N} shapes of {n} points, got {tuple(value.shape)}; {CURE}")


def _check_values(taken: dict[str, Any], where: str) -> None:
    """Refuses NaN, but where a shape has fewer parts, joints or parameters than others, and indices of nothing."""
    whole = ("rest", "weights") if "families" in taken else ("rest", "weights", "parameters")
    for name in whole:
        if name in taken:
            _check_finite(name, taken[name].numpy(), where)
    if "labels" in taken and "boxes" in taken and taken["labels"].max() >= taken["boxes"].shape[1]:
        parts, most = taken["boxes"].shape[1], int(taken["labels"].max())
        raise ValueError(f"{where}: labels must be parts 0 to {parts - 1} or -1, got {most}; {CURE}")
    rows, known = taken.get("families"), len(taken["about"].get("families", ()))
    if rows is not None and not 0 <= int(rows.min()) <= int(rows.max()) < known:
        raise ValueError(f"{where}: families must be rows of the {known} that about names, got {rows.max()}; {CURE}")


def _check_finite(name: str, array: np.ndarray, where: str) -> None:
    for start in range(0, len(array), AT_ONCE):
        finite = np.isfinite(array[start : start + AT_ONCE]).reshape(len(array[start : start + AT_ONCE]), -1).all(1)
        if not finite.all():
            row = start + int((~finite).argmax())
            raise ValueError(f"{where}: {name} must be finite, shape {row} holds NaN or infinity; clean or drop it")
