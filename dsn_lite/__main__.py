"""The command line: python -m dsn_lite collect | train | sweep | evaluate | axioms | deform | transfer | zoo ..."""

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


def train(
    file: File,
    /,
    *,
    out: Path,
    config: OmitArgPrefixes[Settings],
    family: str | None = None,
    resume: bool = False,
) -> None:
    """Train a deformation space on the shapes of a sample file. Ctrl-C stops and keeps the best weights so far.

    Args:
        file: A sample file (.npz), as python -m data_gen generate writes it.
        out: The run folder to write.
        config: What the training is told.
        family: Take only the shapes of this family, where the file holds several.
        resume: Go on with a training that was stopped.
    """
    records: list[Record] = []
    told = Config(**asdict(config))
    shapes = _shapes(file, family)
    training(shapes, told, out=out, resume=resume, watch=lambda _, record: records.append(record))
    print(f"{out}: {_summary(records)}")


def sweep(
    files: Positional[Annotated[tuple[Path, ...], arg(metavar="FILE...")]],
    /,
    *,
    out: Path,
    config: OmitArgPrefixes[Settings],
    whole: bool = False,
    jobs: int | None = None,
    dask: str | None = None,
) -> int:
    """Train one network for each family of some sample files, several at once, each in a process of its own.

    The folders of the runs have the names of the families, or of files that hold a single one. The same command again
    skips what is finished and goes on with what was stopped. Ctrl-C stops all, and each keeps its best weights so far.

    Args:
        files: Sample files (.npz), or folders of shards.
        out: The folder for the run folders, and for sweep.json, the table that is printed at the end.
        config: What each training is told.
        whole: One network for each file, of all its families together.
        jobs: How many are trained at once; each gets its share of the cores. As many as there are cores, if not told.
        dask: Train on the workers of the Dask scheduler at this address instead, as many at once as they have threads
            (jobs then says how many share a machine). They must see files and folders under the same paths.
    """
    from . import sweep as sweeping  # joblib loads slowly, and each training would wait for it

    told = Config(**asdict(config))
    outcomes = sweeping.sweep(files, out, told, whole=whole, jobs=jobs, dask=dask)
    print(sweeping.table(outcomes))
    states = {outcome.state for outcome in outcomes}
    return 1 if "failed" in states else 130 if "stopped" in states else 0


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
    family: str | None = None,
    all: bool = False,
    pairs: int = 200,
    seed: int = 0,
    project: bool = False,
) -> None:
    """Measure a space on the hold-out shapes of the file it was trained on.

    Args:
        run: A run folder, or the name of a ready-made space.
        file: A sample file (.npz).
        again: The same shapes sampled once more (python -m data_gen resample), for the sampling floor.
        family: Take only the shapes of this family, as it was trained on them.
        all: Take every shape: for a file that the space was not trained on.
        pairs: How many pairs and triplets are drawn.
        seed: Seed of the pairs.
        project: Bring what is deformed to what the handles of its parts can follow (Eq. 8).
    """
    shapes, second = _shapes(file, family), None if again is None else _shapes(again, family)
    if second is not None and len(second) != len(shapes):
        raise ValueError(
            f"evaluate: --again must hold the {len(shapes)} shapes of {file}, got {len(second)}; resample that file"
        )
    shapes, second = _held_out(shapes, run, all), second and _held_out(second, run, all)
    print(f"{len(shapes)} shapes of {file}")
    print(metrics.evaluate(_space(run), shapes, again=second, pairs=pairs, seed=seed, project=project))


def report_axioms(run: Run, file: File, /, *, family: str | None = None, all: bool = False, seed: int = 0) -> None:
    """Print how far a space is from each axiom and derived law, on the hold-out shapes of its file.

    Args:
        run: A run folder, or the name of a ready-made space.
        file: A sample file (.npz).
        family: Take only the shapes of this family, as it was trained on them.
        all: Take every shape: for a file that the space was not trained on.
        seed: Seed of the triplets.
    """
    print(axioms.report(_space(run), _held_out(_shapes(file, family), run, all), seed=seed))


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


def reproduce(
    name: Positional[Annotated[str | None, arg(metavar="NAME")]] = None,
    /,
    *,
    full: bool = False,
    seeds: int = 3,
    only: str | None = None,
    out: Path | None = None,
    device: str = "cpu",
    write: bool = False,
) -> None:
    """Make the paper's tables and figures again, run by run, and RESULTS.md of them; without a NAME, list them.

    What is done with the same settings is not done again, and what was stopped goes on where it was.

    Args:
        name: An experiment, or all.
        full: The paper's scale, which takes hours a run and wants a GPU, not the one that fits two cores.
        seeds: How many seeds each run is made with.
        only: Make only the runs that have this in their names.
        out: A folder to begin anew in: shapes, trainings, results and RESULTS.md go there.
        device: Where it is trained and measured.
        write: Only write RESULTS.md again, of the figures that are there.
    """
    from .experiments import chosen, report, running
    from .experiments.kinds import Scale

    scale, folder = Scale("full" if full else "lite", seeds), out or report.HERE
    place = running.Workplace(out or Path("runs") / "reproduce", folder / report.RESULTS, device)
    if name is None and not write:
        print(report.listing(folder))
        return
    asked = chosen(name or "all")
    runs = running.selected(asked, scale, only)
    try:
        for experiment in [] if write else asked:
            running.reproduce(experiment, runs[experiment.name], scale, place)
    finally:  # also of what was done before Ctrl-C
        print(report.write(folder))


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


def _shapes(file: Path, family: str | None) -> Shapes:
    shapes = load_shapes(file)
    return shapes if family is None else shapes.of_family(family)


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
    "sweep": sweep,
    "evaluate": evaluate,
    "axioms": report_axioms,
    "deform": deform,
    "transfer": transfer,
    "zoo": show_zoo,
    "reproduce": reproduce,
    "build": build,
}


def main(args: Sequence[str] | None = None) -> int:
    """Run a command; trouble becomes one sentence on stderr and 2 is returned, 130 after Ctrl-C, or its own code."""
    try:
        code = tyro.extras.subcommand_cli_from_dict(
            COMMANDS, prog="python -m dsn_lite", description="Deformation spaces: train, measure, use.", args=args
        )
    except (ValueError, OSError, FloatingPointError, ImportError) as trouble:
        print(trouble, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        return 130
    return code or 0


if __name__ == "__main__":
    sys.exit(main())
