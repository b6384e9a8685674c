"""train and sweep."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from .. import train as training
from ..config import Config
from ..training import Record
from .runs import File, shapes_of


@dataclass(frozen=True)
class Settings(Config):
    """What the training is told."""

    def __post_init__(self) -> None:
        """Checked when it becomes a Config: tyro would frame the sentence."""


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
    shapes = shapes_of(file, family)
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
    from .. import sweep as sweeping  # joblib loads slowly, and each training would wait for it

    told = Config(**asdict(config))
    outcomes = sweeping.sweep(files, out, told, whole=whole, jobs=jobs, dask=dask)
    print(sweeping.table(outcomes))
    states = {outcome.state for outcome in outcomes}
    return 1 if "failed" in states else 130 if "stopped" in states else 0


def _summary(records: Sequence[Record]) -> str:
    """Where a training ended: best and last look at the validation shapes."""
    if not records:
        return "stopped before the first look at the validation shapes"
    best, last = min(records, key=lambda record: record.validation_cd), records[-1]
    return f"{last.step} steps in {last.seconds:.1f} s, validation Chamfer distance {best.validation_cd:.4g}"
