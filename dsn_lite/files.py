"""Sample files in and out: the format of data_gen, an .npz or a folder of .npy, of which only `points` is required."""

import json
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from torch import Tensor

from .contract import CURE, MIXED, WHOLE, as_points, assemble
from .shapes import Shapes

KEYS = tuple(f.name for f in fields(Shapes))
MOST = 2**15 - 1  # of what two bytes hold


def as_shapes(source: Any) -> Shapes:
    """Shapes from Shapes, from a data_gen collection, or from a plain array of point clouds (N, n, 3).

    Raises ValueError or TypeError in one sentence where the points are not finite clouds of one size.
    """
    if not hasattr(source, "points"):
        return Shapes(points=as_points(source, "as_shapes"))
    return assemble({name: getattr(source, name, None) for name in KEYS}, "as_shapes")


def load_shapes(path: str | Path) -> Shapes:
    """The shapes of a sample file, or of any .npz with an array `points` (N, n, 3).

    Of a folder, as data_gen.save_shards writes it, nothing is read before it is used.
    Raises FileNotFoundError or ValueError in one sentence: missing, truncated, of another kind, not finite, mixed n.
    """
    path, where = Path(path), f"load_shapes: {path}"
    if not path.exists():
        raise FileNotFoundError(f"{where}: there is no such file; make one with python -m data_gen generate")
    known = _folder(path, where) if path.is_dir() else _archive(path, where)
    if "points" not in known:
        raise ValueError(f"{where}: must hold an array named points (N, n, 3), it holds none; {CURE}")
    return assemble(known, where, lazy=path.is_dir())


def save_shapes(shapes: Any, path: str | Path) -> None:
    """Writes points (N, n, 3), or Shapes, as a sample file: beside it first, then renamed, so never half a file.

    Raises ValueError where they are no shapes, or where a whole number is too large for the two bytes of the format.
    """
    shapes, path = as_shapes(shapes), Path(path)
    arrays = {name: getattr(shapes, name) for name in KEYS}
    arrays["about"] = json.dumps(shapes.about)
    stored = {name: _stored(name, value) for name, value in arrays.items() if _known(value)}
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


def _archive(path: Path, where: str) -> dict[str, Any]:
    known, name = {}, ""
    try:
        # np.load would leave a broken file open, which Windows then refuses to replace
        with path.open("rb") as stream, np.lib.npyio.NpzFile(stream, allow_pickle=False) as file:
            for name in KEYS:
                if name in file:
                    known[name] = file[name]
    except Exception as trouble:  # zip, zlib, numpy and Python's own parser each fail in their way on broken bytes
        broken = f"must be a whole .npz sample file, got ({_short(trouble)}); {CURE}"
        objects = MIXED if name == "points" else f"{name} must be a plain array, got Python objects; {CURE}"
        raise ValueError(f"{where}: {objects if 'Object arrays' in str(trouble) else broken}") from None
    return known | {"about": _parsed(str(known.get("about", "{}")), where)}


def _folder(path: Path, where: str) -> dict[str, Any]:
    if not (path / "about.json").is_file():
        raise ValueError(f"{where}: a folder must hold about.json, it holds none; write it with data_gen.save_shards")
    about = _parsed(_text(path / "about.json", where), where)
    held = about.pop("arrays", ["points"]) if isinstance(about, dict) else ["points"]
    if not isinstance(held, list):
        raise ValueError(f"{where}: about must list the names of the arrays, got {held!r}; {CURE}")
    return {name: _mapped(path / f"{name}.npy", where) for name in held if name in KEYS} | {"about": about}


def _text(file: Path, where: str) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise ValueError(f"{where}: {file.name} must be UTF-8 text, got other bytes; {CURE}") from None


def _mapped(file: Path, where: str) -> np.ndarray:
    """An array that is read as it is used, and copied where it is written to."""
    if not file.is_file():
        raise ValueError(f"{where}: must hold {file.name}, it holds none; copy the folder again")
    try:
        return np.lib.format.open_memmap(file, mode="c")  # np.load would take an archive too
    except Exception as trouble:
        raise ValueError(f"{where}: {file.name} must be a whole array, got ({_short(trouble)}); {CURE}") from None


def _parsed(text: str, where: str) -> Any:
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        raise ValueError(f"{where}: about must be JSON, got {text[:40]!r}; {CURE}") from None


def _write(part: Path, arrays: dict[str, np.ndarray]) -> None:
    with part.open("wb") as file:  # given a path instead, np.savez would append .npz to it
        np.savez(file, **arrays)


def _stored(name: str, value: Any) -> np.ndarray:
    """As the contract has it: numbers in single precision, labels in two bytes."""
    if not isinstance(value, Tensor):
        return np.asarray(value)
    if name in WHOLE and not -MOST - 1 <= int(value.min()) <= int(value.max()) <= MOST:
        raise ValueError(
            f"save_shapes: {name} must be {MOST} at most, got {value.max()}; that is all a file has room for"
        )
    return value.cpu().numpy().astype("<f4" if value.is_floating_point() else "<i2")


def _known(value: Any) -> bool:
    return value is not None and not (isinstance(value, tuple) and not value)


def _short(trouble: Exception) -> str:
    return str(trouble).split("\n")[0][:80] or type(trouble).__name__
