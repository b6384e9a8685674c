"""What commands are told, and the run folders and files that they mean."""

from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from .. import zoo
from ..files import load_shapes
from ..runs import load_run, read_config
from ..shapes import Shapes
from ..space import DeformSyncNet

Run = Positional[Annotated[str, arg(metavar="RUN")]]
File = Positional[Annotated[Path, arg(metavar="FILE")]]
Out = Annotated[Path, arg(aliases=["-o"])]


def shapes_of(file: Path, family: str | None) -> Shapes:
    """The shapes of a file, or those of one of its families."""
    shapes = load_shapes(file)
    return shapes if family is None else shapes.of_family(family)


def folder_of(run: str) -> Path:
    """The run folder of this path, or of a ready-made space of this name."""
    if not Path(run).is_dir() and run in zoo.names():
        return zoo.HERE / run
    if not Path(run).is_dir():
        known = ", ".join(zoo.names()) or "none here"
        raise ValueError(f"run: must be a run folder or a ready-made space ({known}), got {run}; train one first")
    return Path(run)


def space_of(run: str) -> DeformSyncNet:
    """The space of a run folder, or a ready-made one."""
    return load_run(folder_of(run))


def held_out(shapes: Shapes, run: str, all: bool) -> Shapes:
    """The shapes that a run with this seed did not see."""
    if all:
        return shapes
    config, _ = read_config(folder_of(run))
    return shapes.split(config.seed)[2]
