"""Sample files in and out: the format of data_gen (one .npz), of which only `points` is required."""

import json
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from .data import Shapes


def as_shapes(source: Any) -> Shapes:
    """Shapes from Shapes, from a data_gen collection, or from a plain array of point clouds (N, n, 3).

    Raises ValueError or TypeError in one sentence where the points are not finite clouds of one size.
    """
    if not hasattr(source, "points"):
        return Shapes(points=_points(source, "as_shapes"))
    known = {f.name: getattr(source, f.name, None) for f in fields(Shapes)}
    return _assemble(known, "as_shapes")


def load_shapes(path: str | Path) -> Shapes:
    """The shapes of a sample file, or of any .npz with an array `points` (N, n, 3).

    Raises FileNotFoundError or ValueError in one sentence: missing, truncated, of another kind, not finite, mixed n.
    """
    path, where = Path(path), f"load_shapes: {path}"
    if not path.is_file():
        raise FileNotFoundError(f"{where}: there is no such file; make one with python -m data_gen generate")
    try:
        # np.load would leave a broken file open, which Windows then refuses to replace
        with path.open("rb") as stream, np.lib.npyio.NpzFile(stream, allow_pickle=False) as file:
            known = {f.name: file[f.name] for f in fields(Shapes) if f.name in file}
    except Exception as trouble:  # zip, zlib, numpy and Python's own parser each fail in their way on broken bytes
        broken = f"must be a whole .npz sample file, got ({_short(trouble)}); {CURE}"
        raise ValueError(f"{where}: {MIXED if 'Object arrays' in str(trouble) else broken}") from None
    if "points" not in known:
        raise ValueError(f"{where}: must hold an array named points (N, n, 3), it holds none; {CURE}")
    try:
        known["about"] = json.loads(str(known.get("about", "{}")))
    except ValueError:
        raise ValueError(f"{where}: about must be JSON, got {str(known['about'])[:40]!r}; {CURE}") from None
    return _assemble(known, where)


MIXED = "all clouds must have the same n, got mixed sizes; resample them to one n"
CURE = "write it again, or check that it is a file of shapes"


def save_shapes(shapes: Any, path: str | Path) -> None:
    """Writes points (N, n, 3), or Shapes, as a sample file: beside it first, then renamed, so never half a file."""
    shapes, path = as_shapes(shapes), Path(path)
    arrays = {f.name: getattr(shapes, f.name) for f in fields(Shapes)}
    arrays["about"] = json.dumps(shapes.about)
    stored = {name: _stored(value) for name, value in arrays.items() if _known(value)}
    path.parent.mkdir(parents=True, exist_ok=True)
    beside(path, lambda part: _write(part, stored))


def beside(path: Path, write: Callable[[Path], Any]) -> None:
    """Calls `write` on a neighbouring path, then renames it to `path`."""
    part = path.with_name(path.name + ".part")
    try:
        write(part)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def _write(part: Path, arrays: dict[str, np.ndarray]) -> None:
    with part.open("wb") as file:  # given a path instead, np.savez would append .npz to it
        np.savez(file, **arrays)


def _stored(value: Any) -> np.ndarray:
    """As the contract has it: numbers in single precision, labels in two bytes."""
    if not isinstance(value, Tensor):
        return np.asarray(value)
    return value.cpu().numpy().astype("<f4" if value.is_floating_point() else "<i2")


def _known(value: Any) -> bool:
    return value is not None and not (isinstance(value, tuple) and not value)


def _assemble(known: dict[str, Any], where: str) -> Shapes:
    about = known.get("about") or {}
    if not isinstance(about, dict):
        raise ValueError(f"{where}: about must be a JSON object, got {str(about)[:40]!r}; {CURE}")
    taken: dict[str, Any] = {"points": _points(known["points"], where), "about": about}
    for name in ("labels", "rest", "boxes", "parameters"):
        if known.get(name) is not None:
            value = _numbers(name, np.asarray(known[name]), where)
            taken[name] = value if name == "labels" else value.to(taken["points"].dtype)
    for name in ("parameter_names", "part_names", "names"):
        value = known.get(name)
        taken[name] = tuple(str(word) for word in value) if value is not None else ()
    for name in ("labels", "rest", "boxes", "parameters"):
        _agree(name, taken.get(name), taken["points"], where)
    if "labels" in taken and "rest" in taken and taken["labels"].ndim != taken["rest"].ndim - 1:
        raise ValueError(f"{where}: labels and rest must both be shared by all shapes or both be each shape's; {CURE}")
    if "labels" in taken and "boxes" in taken and taken["labels"].max() >= taken["boxes"].shape[1]:
        parts, most = taken["boxes"].shape[1], int(taken["labels"].max())
        raise ValueError(f"{where}: labels must be parts 0 to {parts - 1} or -1, got {most}; {CURE}")
    return Shapes(**taken)


def _numbers(name: str, array: np.ndarray, where: str) -> Tensor:
    """Integers for labels, real numbers for the rest; only boxes may hold NaN, where a shape has fewer parts."""
    wanted, kinds = ("whole numbers", "iu") if name == "labels" else ("real numbers", "fiu")
    if array.dtype.kind not in kinds:
        raise ValueError(f"{where}: {name} must be {wanted}, got {array.dtype}; {CURE}")
    if name != "boxes" and not np.isfinite(array).all():
        raise ValueError(f"{where}: {name} must be finite, got NaN or infinity; {CURE}")
    return torch.as_tensor(array)


def _points(source: Any, where: str) -> Tensor:
    array = source.detach().cpu().numpy() if isinstance(source, Tensor) else source
    try:
        array = np.asarray(array)
    except ValueError:
        array = np.empty(0, dtype=object)
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
    if not np.isfinite(array).all():
        bad = int((~np.isfinite(array).all((1, 2))).argmax())
        raise ValueError(f"{where}: points must be finite, shape {bad} holds NaN or infinity; clean or drop it")
    return torch.from_numpy(np.array(array, dtype=np.float64 if array.dtype == np.float64 else np.float32))


def _agree(name: str, value: Tensor | None, points: Tensor, where: str) -> None:
    """Refuses labels, rest, boxes or parameters that belong to other points."""
    N, n = points.shape[:2]
    if value is None:
        return
    allowed = {"labels": [(N, n), (n,)], "rest": [(N, n, 3), (n, 3)], "parameters": [(N, value.shape[-1])]}
    if tuple(value.shape) not in allowed.get(name, [(N, *value.shape[1:2], 15)]):
        raise ValueError(f"{where}: {name} must go with {N} shapes of {n} points, got {tuple(value.shape)}; {CURE}")


def _short(trouble: Exception) -> str:
    return str(trouble).split("\n")[0][:80] or type(trouble).__name__
