"""Files appear whole or not at all: they are written beside their place and then renamed."""

import os
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def beside(path):
    """A path to write to in the folder of `path`; it becomes `path` when the block ends, and vanishes if that fails.

    Raises ValueError if there is no such folder.
    """
    path = Path(path)
    if not path.parent.is_dir():
        raise ValueError(f"{path.name}: its folder must exist, got {path.parent}; make the folder first")
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
