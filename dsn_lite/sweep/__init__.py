"""Many networks, several at once: one for each family of some files, here or on a Dask cluster.

joblib starts light tasks, in threads here and on the workers there; each waits for a `python -m dsn_lite train` of its
own. (Were the trainings joblib's own worker processes, the death of one would end them all.) A task goes by what it
finds in the run folder: a sweep that is started again skips what is finished and goes on with the rest.
"""

import json
import signal
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from types import FrameType

from joblib import Parallel, cpu_count, delayed
from tqdm.auto import tqdm

from ..config import Config
from ..files import beside
from . import child
from .child import Outcome
from .cluster import backend
from .networks import check_run, networks

STOP, SUMMARY = ".stop", "sweep.json"  # in the folder of the runs: other machines see it, too


def sweep(
    files: Sequence[str | Path],
    out: str | Path,
    config: Config | None = None,
    *,
    whole: bool = False,
    jobs: int | None = None,
    dask: str | None = None,
) -> list[Outcome]:
    """Trains a network for each family of these files, `jobs` at once, in folders of `out`; writes out/sweep.json.

    whole: one network for each file instead. dask: the address of a scheduler, whose workers then train. Ctrl-C stops
    all trainings, and each keeps its best weights. A training that fails is an Outcome. Raises ValueError before any
    begins: jobs, files, names of files, runs of another Config or of other shapes, a cluster that does not answer.
    """
    config, out = config or Config(), Path(out).resolve()
    if jobs is not None and jobs < 1:
        raise ValueError(f"sweep: jobs must be 1 or more, got {jobs}; leave it out to train on every core")
    planned = networks(files, out, whole=whole)
    for network in planned:
        check_run(network, config)
    out.mkdir(parents=True, exist_ok=True)
    if dask is None:
        jobs = min(jobs or cpu_count(), len(planned))
    with backend(jobs, dask, out), _stopping(out / STOP) as stop:
        tasks = (delayed(child.trained)(network, config, jobs, stop) for network in planned)
        parallel = Parallel(return_as="generator_unordered", batch_size=1, pre_dispatch="all")  # for workers to come
        found = _shown(parallel(tasks), len(planned))
    outcomes = [found[network.run.name] for network in planned]
    _write(outcomes, config, out)
    return outcomes


def table(outcomes: Iterable[Outcome]) -> str:
    """The outcomes as text, one network a line; the Chamfer distance is that of the best weights."""
    rows = [("network", "state", "steps", "seconds", "validation CD", "")]
    rows += [(o.name, o.state, *_figures(o), o.trouble) for o in outcomes]
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for name, state, *figures, trouble in rows:
        right = [figure.rjust(width) for figure, width in zip(figures, wide[2:5], strict=True)]
        lines.append("  ".join([name.ljust(wide[0]), state.ljust(wide[1]), *right, trouble]).rstrip())
    return "\n".join(lines)


def _figures(outcome: Outcome) -> tuple[str, str, str]:
    if outcome.steps is None:
        return "-", "-", "-"
    return str(outcome.steps), f"{outcome.seconds:.1f}", f"{outcome.validation_cd:.4g}"


def _shown(outcomes: Iterable[Outcome], count: int) -> dict[str, Outcome]:
    """Outcomes by name, with a bar while they come."""
    found = {}
    with tqdm(total=count, unit="network", file=sys.stdout) as bar:
        for outcome in outcomes:
            found[outcome.name] = outcome
            if outcome.trouble:
                bar.write(f"{outcome.name} failed: {outcome.trouble}")
            bar.set_postfix_str(f"{outcome.name} {outcome.state}", refresh=False)
            bar.update()
    return found


def _write(outcomes: Sequence[Outcome], config: Config, out: Path) -> None:
    text = json.dumps({"config": asdict(config), "networks": [asdict(outcome) for outcome in outcomes]}, indent=2)
    beside(out / SUMMARY, lambda part: part.write_text(text + "\n", encoding="utf-8"))


@contextmanager
def _stopping(stop: Path) -> Iterator[Path]:
    """Ctrl-C asks the trainings to stop, by the file `stop`; a second one gives up waiting for them."""

    def ask(number: int, frame: FrameType | None) -> None:
        stop.touch()
        signal.signal(signal.SIGINT, before)
        print("\nstopping; each network keeps its best weights", file=sys.stderr)

    stop.unlink(missing_ok=True)
    before = signal.signal(signal.SIGINT, ask)
    try:
        yield stop
    finally:
        signal.signal(signal.SIGINT, before)
        stop.unlink(missing_ok=True)
