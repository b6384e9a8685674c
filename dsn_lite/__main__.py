"""The command line: python -m dsn_lite collect | train | evaluate | axioms | deform | transfer | zoo | build."""

import sys
import warnings
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import tyro
from tyro.conf import OmitArgPrefixes, Positional, arg

from . import axioms, metrics, zoo
from . import build as building
from . import train as training
from .config import Config
from .data import Shapes
from .files import load_shapes, save_shapes
from .runs import load_run, read_config
from .space import DeformSyncNet
from .training import Record

Run = Positional[Annotated[str, arg(metavar="RUN")]]
File = Positional[Annotated[Path, arg(metavar="FILE")]]
Out = Annotated[Path, arg(aliases=["-o"])]


@dataclass(frozen=True)
class Settings(Config):
    """What the training is told."""

    def __post_init__(self) -> None:
        """Checked when it becomes a Config: tyro would frame the sentence."""


@dataclass(frozen=True)
class Carrying:
    """How meshes are brought into the training box and deformed there."""

    up: tuple[Literal["auto", "y", "z"], ...] = ("auto",)
    """The axis that points up, for all meshes or for each in turn; auto goes by the format, then by the form."""
    subdivide: float | None = None
    """Split edges longer than this share of the longest extent first; 0.05 is a good start."""
    seed: int = 0
    """Seed of the points sampled on the meshes."""

    def told(self) -> dict[str, Any]:
        """As meshes.deform and meshes.transfer take it."""
        return asdict(self) | {"up": self.up[0] if len(self.up) == 1 else self.up}


CARRYING = Carrying()


def train(file: File, /, *, out: Path, config: OmitArgPrefixes[Settings], resume: bool = False) -> None:
    """Train a deformation space on the shapes of a sample file. Ctrl-C stops and keeps the best weights so far.

    Args:
        file: A sample file (.npz), as python -m data_gen generate writes it.
        out: The run folder to write.
        config: What the training is told.
        resume: Go on with a training that was stopped.
    """
    records: list[Record] = []
    told = Config(**asdict(config))
    training(load_shapes(file), told, out=out, resume=resume, watch=lambda _, record: records.append(record))
    print(f"{out}: {_summary(records)}")


def collect(
    folder: Positional[Annotated[Path, arg(metavar="FOLDER")]],
    /,
    *,
    out: Out,
    points: int = 512,
    up: Literal["auto", "y", "z"] = "auto",
    seed: int = 0,
) -> None:
    """Make a sample file to train on from a folder of meshes: sampled, upright, on one floor, at one scale.

    Args:
        folder: Its .glb, .gltf, .obj, .ply, .stl and .off files are taken, those of folders in it too.
        out: The sample file (.npz) to write.
        points: How many points are sampled on each mesh.
        up: The axis that points up in all files; auto goes by the format, then by the form.
        seed: Seed of the samples.
    """
    from . import meshes

    shapes = meshes.collect(meshes.folder(folder), points, up=up, seed=seed)
    save_shapes(shapes, out)
    print(f"{out}: {len(shapes)} shapes of {points} points")


def evaluate(
    run: Run,
    file: File,
    /,
    *,
    again: Path | None = None,
    all: bool = False,
    pairs: int = 200,
    seed: int = 0,
) -> None:
    """Measure a space on the hold-out shapes of the file it was trained on.

    Args:
        run: A run folder, or the name of a ready-made space.
        file: A sample file (.npz).
        again: The same shapes sampled once more (python -m data_gen resample), for the sampling floor.
        all: Take every shape: for a file that the space was not trained on.
        pairs: How many pairs and triplets are drawn.
        seed: Seed of the pairs.
    """
    shapes, second = load_shapes(file), None if again is None else load_shapes(again)
    if second is not None and len(second) != len(shapes):
        raise ValueError(
            f"evaluate: --again must hold the {len(shapes)} shapes of {file}, got {len(second)}; resample that file"
        )
    shapes, second = _held_out(shapes, run, all), second and _held_out(second, run, all)
    print(f"{len(shapes)} shapes of {file}")
    print(metrics.evaluate(_space(run), shapes, again=second, pairs=pairs, seed=seed))


def report_axioms(run: Run, file: File, /, *, all: bool = False, seed: int = 0) -> None:
    """Print how far a space is from each axiom and derived law, on the hold-out shapes of its file.

    Args:
        run: A run folder, or the name of a ready-made space.
        file: A sample file (.npz).
        all: Take every shape: for a file that the space was not trained on.
        seed: Seed of the triplets.
    """
    print(axioms.report(_space(run), _held_out(load_shapes(file), run, all), seed=seed))


def deform(
    run: Run,
    source: Positional[Annotated[Path, arg(metavar="SOURCE")]],
    target: Positional[Annotated[Path, arg(metavar="TARGET")]],
    /,
    *,
    out: Out,
    how: OmitArgPrefixes[Carrying] = CARRYING,
) -> None:
    """Deform a mesh towards another one; its faces, colours, materials and UVs stay.

    Args:
        run: A run folder, or the name of a ready-made space.
        source: The mesh to deform (.glb, .gltf, .obj, .ply, .stl or .off).
        target: The mesh to come near to.
        out: The mesh to write (.glb, .obj, .ply or .stl).
        how: How meshes are brought into the training box.
    """
    from . import meshes  # trimesh loads slowly, and the other commands do without

    _save(meshes.deform(_space(run), source, target, **how.told()), out)


def transfer(
    run: Run,
    x: Positional[Annotated[Path, arg(metavar="X")]],
    y: Positional[Annotated[Path, arg(metavar="Y")]],
    z: Positional[Annotated[Path, arg(metavar="Z")]],
    /,
    *,
    out: Out,
    how: OmitArgPrefixes[Carrying] = CARRYING,
) -> None:
    """Do to the mesh Z what turns the mesh X into the mesh Y.

    Args:
        run: A run folder, or the name of a ready-made space.
        x: The mesh before.
        y: The mesh after.
        z: The mesh to change.
        out: The mesh to write (.glb, .obj, .ply or .stl).
        how: How meshes are brought into the training box.
    """
    from . import meshes

    _save(meshes.transfer(_space(run), x, y, z, **how.told()), out)


def show_zoo(*, rebuild: str | None = None) -> None:
    """List the ready-made spaces, or train one again from nothing.

    Args:
        rebuild: Name of the space to make again, by the recipe of its card.
    """
    if rebuild is not None:
        print(zoo.rebuild(rebuild))
        return
    for name in zoo.names():
        space = zoo.load(name)
        count = sum(weights.numel() for weights in space.parameters())
        print(f"{name}  k = {space.dictionary.k}, {space.frame.n} points, {count} weights")


def build(what: Positional[Literal["student"]], /, *, check: bool = False, root: Path = Path(".")) -> None:
    """Make the students' notebooks from their sources in notebooks/source.

    Args:
        what: student: the notebooks without their solutions.
        check: Write nothing; fail where a notebook is not what its source gives.
        root: The repository.
    """
    changed = building.outdated(root) if check else building.build_student(root)
    names = ", ".join(path.name for path in changed)
    if check and changed:
        raise ValueError(
            f"build: notebooks must be what their sources give, {names} differ; run python -m dsn_lite build student"
        )
    print(f"wrote {names}" if changed else "every notebook is what its source gives")


def _summary(records: Sequence[Record]) -> str:
    """Where a training ended: best and last look at the validation shapes."""
    if not records:
        return "stopped before the first look at the validation shapes"
    best, last = min(records, key=lambda record: record.validation_cd), records[-1]
    return f"{last.step} steps in {last.seconds:.1f} s, validation Chamfer distance {best.validation_cd:.4g}"


def _folder(run: str) -> Path:
    if not Path(run).is_dir() and run in zoo.names():
        return zoo.HERE / run
    if not Path(run).is_dir():
        known = ", ".join(zoo.names()) or "none here"
        raise ValueError(f"run: must be a run folder or a ready-made space ({known}), got {run}; train one first")
    return Path(run)


def _space(run: str) -> DeformSyncNet:
    return load_run(_folder(run))


def _held_out(shapes: Shapes, run: str, all: bool) -> Shapes:
    """The shapes that a run with this seed did not see."""
    if all:
        return shapes
    config, _ = read_config(_folder(run))
    return shapes.split(config.seed)[2]


def _save(mesh: object, out: Path) -> None:
    from . import meshes

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        meshes.save_mesh(mesh, out)
    for warning in caught:
        print(warning.message, file=sys.stderr)
    print(out)


COMMANDS = {
    "collect": collect,
    "train": train,
    "evaluate": evaluate,
    "axioms": report_axioms,
    "deform": deform,
    "transfer": transfer,
    "zoo": show_zoo,
    "build": build,
}


def main(args: Sequence[str] | None = None) -> int:
    """Run a command; trouble becomes one sentence on stderr and 2 is returned, 130 after Ctrl-C."""
    try:
        tyro.extras.subcommand_cli_from_dict(
            COMMANDS, prog="python -m dsn_lite", description="Deformation spaces: train, measure, use.", args=args
        )
    except (ValueError, OSError, FloatingPointError, ImportError) as trouble:
        print(trouble, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
