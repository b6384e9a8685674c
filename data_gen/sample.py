"""THE contract: one sample file, the only place where shapes made here and their readers meet.

An .npz archive. Only `points` is required. N shapes, n points, P parts, p parameters, J joints:

| key             | shape           | meaning                                                                     |
|-----------------|-----------------|-----------------------------------------------------------------------------|
| points          | (N, n, 3) f4    | clouds, in [-0.5, 0.5] on each axis unless `about` says else                 |
| labels          | (N, n) i2       | index of the point's part, or -1; (n,) where all shapes share it            |
| rest            | (N, n, 3) f4    | the point in its part's unit box; (n, 3) where all shapes share it          |
| boxes           | (N, P, 15) f4   | centre 3, rotation 9 by rows, edge lengths 3; NaN rows for parts not there  |
| parameters      | (N, p) f4       | what the shape was made from                                                |
| parameter_names | (p,) text       |                                                                             |
| part_names      | (P,) text       |                                                                             |
| names           | (N,) text       | one a shape                                                                 |
| joints          | (N, J, 8) f4    | axis 3, pivot 3, value, 0 hinge or 1 slide; NaN rows for joints not there   |
| about           | text            | JSON: family, seed, units, axes, sampling, and each family's truth          |
"""

import json
import zipfile
import zlib
from dataclasses import dataclass, field, fields
from pathlib import Path

import numpy as np

from data_gen.files import beside

VERSION = 1
"""Of this contract, not of the package."""
STORED = {"points": "<f4", "labels": "<i2", "rest": "<f4", "boxes": "<f4", "parameters": "<f4", "joints": "<f4"}
NAMES = ("parameter_names", "part_names", "names")


@dataclass(frozen=True)
class Collection:
    """The contents of a sample file; what a file leaves out is None. Shapes as in the table above."""

    points: np.ndarray
    labels: np.ndarray | None = None
    rest: np.ndarray | None = None
    boxes: np.ndarray | None = None
    parameters: np.ndarray | None = None
    parameter_names: tuple[str, ...] | None = None
    part_names: tuple[str, ...] | None = None
    names: tuple[str, ...] | None = None
    joints: np.ndarray | None = None
    about: dict = field(default_factory=dict)


KEYS = tuple(key.name for key in fields(Collection))


def save(collection, path):
    """Write a sample file; the same collection gives the same bytes. Raises ValueError if it breaks the contract."""
    check(collection, "save")
    with beside(path) as part, zipfile.ZipFile(part, "w") as archive:
        for key in KEYS:
            if getattr(collection, key) is not None:
                _write(archive, key, _stored(key, getattr(collection, key)))


def load(path):
    """Read a sample file. Raises ValueError if there is none or it is broken, with what to do about it."""
    path = Path(path)
    if not path.is_file():
        raise ValueError(f"load: {path} must be a sample file, got no file of that name; check the path")
    with path.open("rb") as start:
        if start.read(4) != b"PK\3\4":
            raise ValueError(f"load: {path.name} must be a sample file (.npz), got another kind; write it with save")
    try:
        with zipfile.ZipFile(path) as archive:
            held = set(archive.namelist())
            found = {key: _read(archive, key) for key in KEYS if f"{key}.npy" in held}
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError):
        raise ValueError(f"load: {path.name} must be whole, got a truncated or damaged file; copy it again") from None
    except ValueError:
        raise ValueError(
            f"load: {path.name} must hold plain arrays, got Python objects, as clouds of mixed n become; "
            "sample all shapes with the same number of points"
        ) from None
    return _collection(found, f"load: {path.name}")


def check(collection, where):
    """Raise ValueError, beginning with `where`, unless the collection keeps the contract."""
    points = collection.points
    if points.ndim != 3 or points.shape[-1] != 3 or points.dtype.kind != "f":
        raise ValueError(
            f"{where}: points must be (N, n, 3) floats, got {points.shape} {points.dtype}; stack the clouds"
        )
    if points.shape[0] < 1 or points.shape[1] < 2:
        raise ValueError(f"{where}: points must hold a shape of two points or more, got {points.shape}; sample more")
    for key in ("points", "rest", "parameters"):
        value = getattr(collection, key)
        if value is not None and not np.isfinite(value).all():
            row = int(np.argwhere(~np.isfinite(value))[0][0])
            raise ValueError(f"{where}: {key} must be finite, got NaN or infinity in row {row}; leave that shape out")
    for key, shapes in _shapes(collection).items():
        value = getattr(collection, key)
        if value is not None and np.shape(value) not in shapes:
            wanted = " or ".join(str(shape) for shape in shapes)
            raise ValueError(f"{where}: {key} must be {wanted}, got {np.shape(value)}; it has to fit the points")
    _check_labels(collection, where)


def _shapes(collection):
    N, n, _ = collection.points.shape
    P = len(collection.part_names or ())
    J = 0 if collection.joints is None or collection.joints.ndim != 3 else collection.joints.shape[1]
    return {
        "labels": ((N, n), (n,)),
        "rest": ((N, n, 3), (n, 3)),
        "boxes": ((N, P, 15),),
        "parameters": ((N, len(collection.parameter_names or ())),),
        "names": ((N,),),
        "joints": ((N, J, 8),),
    }


def _check_labels(collection, where):
    labels = collection.labels
    if labels is None:
        return
    low, high, parts = labels.min(), labels.max(), len(collection.part_names or ())
    if low < -1 or high >= parts or labels.dtype.kind != "i":
        raise ValueError(
            f"{where}: labels must be integers from -1 to {parts - 1}, one a part, got {low} to {high} {labels.dtype}; "
            "number the parts as in part_names"
        )


def _collection(found, where):
    if "points" not in found:
        held = ", ".join(sorted(found)) or "nothing we know"
        raise ValueError(f"{where} must hold an array called points, got {held}; name the clouds so")
    about = str(found.pop("about", "{}"))
    for key in NAMES:
        if key in found:
            found[key] = tuple(found[key].tolist())
    collection = Collection(**found, about=_parsed(about, where))
    check(collection, where)
    return collection


def _parsed(about, where):
    try:
        parsed = json.loads(about)
    except json.JSONDecodeError:
        parsed = None
    if not isinstance(parsed, dict):
        raise ValueError(f"{where} must hold a JSON object in about, got {about[:40]!r}; write the file with save")
    return parsed


def _stored(key, value):
    if key == "about":
        value = json.dumps(value, sort_keys=True, ensure_ascii=False)
    return np.asarray(value, STORED.get(key, "U"), order="C")


def _read(archive, key):
    with archive.open(f"{key}.npy") as member:
        return np.lib.format.read_array(member, allow_pickle=False)


def _write(archive, key, value):
    entry = zipfile.ZipInfo(f"{key}.npy", date_time=(1980, 1, 1, 0, 0, 0))
    entry.create_system, entry.external_attr = 3, 0o644 << 16
    with archive.open(entry, "w", force_zip64=True) as member:
        np.lib.format.write_array(member, value, allow_pickle=False)
