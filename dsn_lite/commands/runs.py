"""What commands are told, and the run folders and files that they mean."""

from collections.abc import Sequence
from math import isclose
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from .. import zoo
from ..config import some
from ..data import Frame
from ..files import load_shapes
from ..runs import fingerprint, load_run, read_config, read_fingerprint, same_shapes
from ..shapes import FEWEST, Shapes
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


def held_out(files: Sequence[Path], run: str, family: str | None, all: bool) -> list[Shapes]:
    """What a run did not see of its file, and the same shapes of further samplings; of one family, if one is told.

    The file is split before the family is taken, for a run of the whole file has seen the rest; where the run says that
    it was trained on this family alone, the family is split. Raises ValueError where the run was trained on other
    shapes, some of which this split might call held out, and where too few are left.
    """
    collections = [load_shapes(file) for file in files]
    _check_counts(files, [len(shapes) for shapes in collections])
    if all:
        return [shapes if family is None else shapes.of_family(family) for shapes in collections]
    seed = read_config(folder_of(run))[0].seed
    if family is not None and _trained_on(collections[0].of_family(family), folder_of(run)):
        collections, family = [shapes.of_family(family) for shapes in collections], None
    else:
        _check_whole(collections[0], files[0], run)
    held = [_test_rows(shapes, seed, family) for shapes in collections]
    count = len(held[0])
    if count < 3:
        raise ValueError(
            f"held out: at least 3 shapes are needed to measure, got {count}: only what was held out of {files[0]} was "
            "taken; bring more shapes, or give --all for a file that the space was not trained on"
        )
    return held


def _check_counts(files: Sequence[Path], counts: list[int]) -> None:
    if counts[-1] != counts[0]:
        raise ValueError(
            f"evaluate: --again must hold the {counts[0]} shapes of {files[0]}, got {counts[-1]}; resample that file"
        )


def _trained_on(shapes: Shapes, run: Path) -> bool:
    """Whether a run was trained on these: by its fingerprint, or, of an older run, by the frame of its shapes."""
    if len(shapes) < sum(FEWEST):
        return False
    if (known := read_fingerprint(run)) is not None:
        return same_shapes(known, fingerprint(shapes))
    config, frame = read_config(run)
    return isclose(Frame.of(some(shapes, shapes.rows(config.seed)[0])).size, frame.size, rel_tol=1e-5)


def _check_whole(shapes: Shapes, file: Path, run: str) -> None:
    known = read_fingerprint(folder_of(run))
    if known is not None and not same_shapes(known, fingerprint(shapes)):
        raise ValueError(
            f"held out: {file} must hold the shapes that {run} was trained on, it holds others, and what was held out "
            "of them nothing tells; give the file it was trained on (and its --family, if it had one), or --all if "
            "this file is new to the space"
        )


def _test_rows(shapes: Shapes, seed: int, family: str | None) -> Shapes:
    if len(shapes) < sum(FEWEST):
        return shapes[:0]
    held = shapes[shapes.rows(seed)[2]]
    if family is None:
        return held
    return held.of_family(family) if family in held.family_names else held[:0]
