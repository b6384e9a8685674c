"""Files appear whole or not at all: they are written beside their place and then renamed."""

import os
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def beside(path):
    """A path to write to in the folder of `path`; it becomes `path` when the block ends, and vanishes if that fails.

    Raises ValueError if there is no such folder, or another in the place of the file.
    """
    path = Path(path)
    if path.is_dir():
        raise ValueError(f"{path}: must be a file, got a folder; name a file, such as one in that folder")
    if not path.parent.is_dir():
        raise ValueError(f"{path.name}: its folder must exist, got {path.parent}; make the folder first")
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def check_folder(path, where):
    """Raise ValueError, beginning with `where`, if a file is where a folder or one that leads to it would be made."""
    for one in (Path(path), *Path(path).parents):
        if one.exists() and not one.is_dir():
            raise ValueError(f"{where}: {one} must be a folder, got a file; choose another name for the folder")
