"""Collections that do not fit in memory: a folder of plain .npy files, written piece by piece and read lazily.

One file a key of the contract, and `about.json`, which also lists them under "arrays".
"""

import json
import os
import shutil
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from data_gen.checks import check, check_shapes
from data_gen.growing import Growing
from data_gen.sample import AXES_IF_SHARED, KEYS, NAMES, PER_SHAPE, as_collection, parsed, stored

ABOUT = "about.json"


def save_shards(pieces, path):
    """Write a collection that comes in pieces, as from `pieces`, to a new folder; one piece is in memory at a time.

    The folder appears whole or not at all. Raises ValueError if it holds something already, or if the pieces do not
    fit together.
    """
    path = Path(path)
    _check_free(path)
    with _folder_beside(path) as folder, ExitStack() as opened:
        shards = Shards(folder, opened)
        for piece in pieces:
            shards.append(piece)
            del piece  # before the next one is made
        shards.finish()


def load_shards(path):
    """The collection in a folder of shards, its arrays mapped read-only: only shapes and types are checked.

    Raises ValueError if a file is missing or broken.
    """
    where = f"load: {path.name}"
    if not (path / ABOUT).is_file():
        raise ValueError(f"{where} must hold {ABOUT}, got none; write the folder with save_shards")
    about = parsed((path / ABOUT).read_text(encoding="utf-8"), where)
    held = about.pop("arrays", ["points"])
    collection = as_collection({key: _mapped(path, key, where) for key in held}, about, where)
    check_shapes(collection, where)
    return collection


class Shards:
    """A folder of shards that is being written."""

    def __init__(self, folder, opened):
        self.folder, self.opened = folder, opened
        self.first, self.growing, self.names = None, {}, []

    def append(self, piece):
        """Write a piece at the end. Raises ValueError if it breaks the contract or is of another collection."""
        check(piece, "save_shards")
        if self.first is None:
            self.first = replace(piece[[0]], about=piece.about)
            files = {key: Growing(self.folder / f"{key}.npy") for key in _growing(piece)}
            self.growing = {key: self.opened.enter_context(file) for key, file in files.items()}
        _check_alike(self.first, piece, self.growing["points"].rows)
        for key, file in self.growing.items():
            file.append(stored(key, getattr(piece, key)))
        self.names += piece.names or ()

    def finish(self):
        """Write what is not written row by row: names, what all shapes share, and `about`."""
        if self.first is None:
            raise ValueError("save_shards: there must be a piece or more, got none; take them from pieces")
        whole = {key: getattr(self.first, key) for key in (*AXES_IF_SHARED, *NAMES) if key not in self.growing}
        whole = {key: value for key, value in {**whole, "names": self.names or None}.items() if value is not None}
        for key, value in whole.items():
            np.save(self.folder / f"{key}.npy", stored(key, value), allow_pickle=False)
        about = {**self.first.about, "arrays": [*self.growing, *whole]}
        text = json.dumps(about, sort_keys=True, ensure_ascii=False, indent=1)
        (self.folder / ABOUT).write_text(text, encoding="utf-8")


def _growing(piece):
    """The keys of which every piece brings rows of its own."""
    held = (key for key in PER_SHAPE if key != "names" and getattr(piece, key) is not None)
    return [key for key in held if getattr(piece, key).ndim != AXES_IF_SHARED.get(key)]


def _check_alike(first, piece, row):
    """Raise ValueError if a piece is of another collection than the first row."""
    wrong = [key for key in KEYS if not _alike(key, getattr(first, key), getattr(piece, key))]
    if wrong:
        raise ValueError(
            f"save_shards: all pieces must be of one collection, got another {wrong[0]} from row {row} on; "
            "take them from one call of pieces"
        )


def _alike(key, one, other):
    if one is None or other is None:
        return one is other
    if key == "about":
        return one == other
    if key in PER_SHAPE and not np.ndim(one) == np.ndim(other) == AXES_IF_SHARED.get(key):
        return np.shape(one)[1:] == np.shape(other)[1:] and np.ndim(one) == np.ndim(other)
    return np.array_equal(one, other)


def _mapped(path, key, where):
    file = path / f"{key}.npy"
    if not file.is_file():
        raise ValueError(f"{where} must hold {file.name}, got none; copy the folder again")
    try:
        array = np.load(file, mmap_mode="r", allow_pickle=False)
    except (ValueError, OSError, EOFError):
        raise ValueError(f"{where}/{file.name} must be whole, got a truncated or damaged file; copy it again") from None
    return array


def _check_free(path):
    if not path.parent.is_dir():
        raise ValueError(f"save_shards: its folder must exist, got {path.parent}; make the folder first")
    if path.exists() and (not path.name or not path.is_dir() or any(path.iterdir())):
        raise ValueError(f"save_shards: {path} must be new or an empty folder, got one that is not; choose another")


@contextmanager
def _folder_beside(path):
    """A folder to write to beside `path`; it becomes `path` when the block ends, and vanishes if that fails."""
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    part.mkdir()
    try:
        yield part
        if path.exists():
            path.rmdir()
        part.replace(path)
    finally:
        shutil.rmtree(part, ignore_errors=True)
