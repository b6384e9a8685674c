"""train and sweep."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Literal

from tyro.conf import OmitArgPrefixes, Positional, arg

from .. import train as training
from ..checkpoints import load_history
from ..config import CHOICES, Config
from ..runs import finished
from ..training import Record
from .runs import File, shapes_of


@dataclass(frozen=True)
class Settings(Config):
    """What the training is told."""

    dense: float = Config.dense
    """Share of the training, at its end, in which a step reads all points of its sources: slower steps that see thin
    parts, good: 0.5 where clouds are denser than points."""
    waves: int = Config.waves
    """Frequencies at which the dictionary's network reads places too, so that it can bend at thin parts: 0 as in the
    paper, good: 4."""
    symmetry: float = Config.symmetry
    """How much a deformed shape must match its mirror image (weight of L_R); paper: 1, good for symmetric kinds."""
    mirror: Literal[CHOICES["mirror"][0]] = Config.mirror
    """Axis across which the symmetry loss mirrors shapes."""
    sparsity: float = Config.sparsity
    """How few handles each column should move (weight of L_S), for shapes with parts; paper: 10, good with l1: 3."""
    norm: Literal[CHOICES["norm"][0]] = Config.norm
    """What L_S adds up: every handle of a column (l1), which makes columns local, or their lengths (l21), as in the
    paper, which does not."""
    unit: Literal[CHOICES["unit"][0]] = Config.unit
    """What has unit length in L_S: whole columns, as in the paper, or what handles see of them (seen), so that columns
    gain nothing by hiding from handles."""
    vector: Literal[CHOICES["vector"][0]] = Config.vector
    """Difference of two codes, or concat, the ablation that reads both shapes together."""
    columns: Literal[CHOICES["columns"][0]] = Config.columns
    """Columns have root mean square 1 over the points (rms), or length 1 as in the paper (unit)."""

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
        file: A sample file (.npz) or a folder of shards, as python -m data_gen generate writes them.
        out: The run folder to write.
        config: What the training is told.
        family: Take only the shapes of this family, where the file holds several.
        resume: Go on with a training that was stopped.
    """
    records: list[Record] = []
    told = Config(**asdict(config))
    shapes = shapes_of(file, family)
    training(shapes, told, out=out, resume=resume, watch=lambda _, record: records.append(record))
    print(f"{out}: {_summary(records, out)}")


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


def _summary(records: Sequence[Record], out: Path) -> str:
    """Where a training ended: best and last look at the validation shapes."""
    if not records and finished(out):
        last = load_history(out)[-1]
        return f"had reached its end already, at step {last['step']} after {last['seconds']:.1f} s; nothing was trained"
    if not records:
        return "stopped before the first look at the validation shapes"
    best, last = min(records, key=lambda record: record.validation_cd), records[-1]
    return f"{last.step} steps in {last.seconds:.1f} s, validation Chamfer distance {best.validation_cd:.4g}"
