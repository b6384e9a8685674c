"""Sample files: one archive (.npz) that holds a collection whole, or a folder of shards, which is read lazily."""

import json
import zipfile
from pathlib import Path

import numpy as np

from data_gen.checks import check
from data_gen.files import beside
from data_gen.sample import KEYS, as_collection, parsed, stored
from data_gen.shards import load_shards

DAMAGED = "be whole, got a truncated or damaged file; copy it again"


def save(collection, path):
    """Write a sample file; the same collection gives the same bytes. Raises ValueError if it breaks the contract."""
    check(collection, "save")
    with beside(path) as part, zipfile.ZipFile(part, "w") as archive:
        for key in KEYS:
            value = getattr(collection, key)
            if key == "about":
                value = json.dumps(value, sort_keys=True, ensure_ascii=False)
            if value is not None:
                _write(archive, key, stored(key, value))


def load(path):
    """Read a sample file, or a folder written by `save_shards`: its arrays are then read as they are used.

    Raises ValueError if there is none or it is broken, with what to do about it.
    """
    path = Path(path)
    if path.is_dir():
        return _folder(path)
    if not path.is_file():
        raise ValueError(f"load: {path} must be a sample file, got no file of that name; check the path")
    with path.open("rb") as start:
        if start.read(4) != b"PK\3\4":
            raise ValueError(f"load: {path.name} must be a sample file (.npz), got another kind; write it with save")
    where = f"load: {path.name}"
    found = _held(path, where)
    collection = as_collection(found, parsed(str(found.pop("about", "{}")), where), where)
    check(collection, where)
    return collection


def _folder(path):
    try:
        return load_shards(path)
    except UnicodeDecodeError:
        raise ValueError(
            f"load: {path.name} must hold UTF-8 text in about.json, got other bytes; copy it again"
        ) from None


def _held(path, where):
    found, key = {}, ""
    try:
        with zipfile.ZipFile(path) as archive:
            held = set(archive.namelist())
            for key in KEYS:
                if f"{key}.npy" in held:
                    found[key] = _read(archive, key)
    except Exception as trouble:  # zip, zlib, numpy and Python's own parser each fail in their way on broken bytes
        plain = "Object arrays" not in str(trouble)
        raise ValueError(f"{where} must {DAMAGED if plain else _objects(key)}") from None
    return found


def _objects(key):
    """What is wrong where an array holds Python objects."""
    cause = (
        "in points, as clouds of mixed n become; sample all shapes with the same number of points"
        if key == "points"
        else f"in {key}; write it with save"
    )
    return f"hold plain arrays, got Python objects {cause}"


def _read(archive, key):
    with archive.open(f"{key}.npy") as member:
        return np.lib.format.read_array(member, allow_pickle=False)


def _write(archive, key, value):
    entry = zipfile.ZipInfo(f"{key}.npy", date_time=(1980, 1, 1, 0, 0, 0))
    entry.create_system, entry.external_attr = 3, 0o644 << 16
    with archive.open(entry, "w", force_zip64=True) as member:
        np.lib.format.write_array(member, value, allow_pickle=False)
