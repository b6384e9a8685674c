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
    about = _about(known.get("about") or {}, where)
    taken: dict[str, Any] = {"points": as_points(known["points"], where, lazy=lazy), "about": about}
    for name in REALS + WHOLE:
        if known.get(name) is not None:
            value = _numbers(name, known[name], where)
            taken[name] = value if name in WHOLE else value.to(taken["points"].dtype)
            _agree(name, taken[name], taken["points"], where)
    for name in TEXTS:
        taken[name] = _texts(name, known.get(name), where)
    _check_names(taken, where)
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


def _about(about: Any, where: str) -> dict[str, Any]:
    """Refuses what is no JSON object, and families and rigs that cannot be looked up in it."""
    if not isinstance(about, dict):
        raise ValueError(f"{where}: about must be a JSON object, got {str(about)[:40]!r}; {CURE}")
    families, rigs = about.get("families", []), about.get("rigs", {})
    if not _are_texts(families) or not isinstance(about.get("family", ""), str):
        said = families if "families" in about else about["family"]
        raise ValueError(f"{where}: about must name its family, or list its families, as text, got {said!r}; {CURE}")
    told = [rigs, *rigs.values()] if isinstance(rigs, dict) else [rigs]
    told += [rig.get("ranges", {}) for rig in told[1:] if isinstance(rig, dict)]
    if not all(isinstance(one, dict) for one in told):
        raise ValueError(f"{where}: about must hold a JSON object for each of its rigs, got {str(rigs)[:40]}; {CURE}")
    return about


def _texts(name: str, value: Any, where: str) -> tuple[str, ...]:
    words = value.tolist() if isinstance(value, np.ndarray) else () if value is None else value
    if not _are_texts(words):
        raise ValueError(f"{where}: {name} must be a list of text, got {str(words)[:40]!r}; {CURE}")
    return tuple(words)


def _are_texts(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and all(isinstance(word, str) for word in value)


def _check_names(taken: dict[str, Any], where: str) -> None:
    """Refuses names of another number than what they name; without names it stays nameless."""
    wide = {"parameter_names": "parameters", "part_names": "boxes"}
    for name in TEXTS:
        named = taken.get(wide.get(name, "points"))
        wanted = None if named is None else len(named) if name == "names" else named.shape[1]
        if taken[name] and wanted not in (None, len(taken[name])):
            what = wide.get(name, "shapes")
            raise ValueError(f"{where}: {name} must name {wanted} {what}, got {len(taken[name])} names; {CURE}")


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
    if array.dtype.kind == "u":  # which torch knows little of
        array = array.astype(np.int64)
    return torch.as_tensor(array if array.flags.writeable else array.copy())


def _agree(name: str, value: Tensor, points: Tensor, where: str) -> None:
    """Refuses what belongs to other points."""
    N, n = points.shape[:2]
    sampled = {"labels": (n,), "rest": (n, 3), "faces": (n,), "weights": (n, 2)}
    wide = {"boxes": (*value.shape[1:2], 15), "joints": (*value.shape[1:2], 8), "parameters": value.shape[1:2] or (1,)}
    own = (N, *(sampled | wide | {"families": ()})[name])
    if tuple(value.shape) != own and not (name in SHARED and tuple(value.shape) == own[1:]):
        raise ValueError(f"{where}: {name} must go with {N} shapes of {n} points, got {tuple(value.shape)}; {CURE}")


def _check_values(taken: dict[str, Any], where: str) -> None:
    """Refuses NaN, but where a shape has fewer parts, joints or parameters than others, and indices of nothing."""
    whole = ("rest", "weights") if "families" in taken else ("rest", "weights", "parameters")
    for name in whole:
        if name in taken:
            _check_finite(name, taken[name].numpy(), where)
    parts = taken["boxes"].shape[1] if "boxes" in taken else len(taken["part_names"])
    if "labels" in taken and ("boxes" in taken or parts) and taken["labels"].max() >= parts:
        most = int(taken["labels"].max())
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
