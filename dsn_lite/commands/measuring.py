"""evaluate, axioms and reproduce."""

from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from .. import axioms, metrics
from ..config import check_device
from ..experiments import EXPERIMENTS, chosen, report, running
from ..experiments.kinds import Scale
from .runs import File, Run, held_out, space_of

NAME = f"An experiment ({', '.join(EXPERIMENTS)}), or all."


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
        file: A sample file (.npz), or a folder of shards.
        again: The same shapes sampled once more (python -m data_gen resample), for the sampling floor.
        family: Take only the shapes of this family, of what was held out of the file, or, where the space was trained
            on this family alone (train --family, sweep), of what was held out of that.
        all: Take every shape: for a file that the space was not trained on.
        pairs: How many pairs and triplets are drawn.
        seed: Seed of the pairs.
        project: Bring what is deformed to what the handles of its parts can follow (Eq. 8).
    """
    shapes, *second = held_out([file] if again is None else [file, again], run, family, all)
    print(f"{len(shapes)} shapes of {file}")
    told = {"again": next(iter(second), None), "pairs": pairs, "seed": seed, "project": project}
    print(metrics.evaluate(space_of(run), shapes, **told))


def report_axioms(run: Run, file: File, /, *, family: str | None = None, all: bool = False, seed: int = 0) -> None:
    """Print how far a space is from each axiom and derived law, on the hold-out shapes of its file.

    Args:
        run: A run folder, or the name of a ready-made space.
        file: A sample file (.npz), or a folder of shards.
        family: Take only the shapes of this family, of what was held out of the file, or, where the space was trained
            on this family alone (train --family, sweep), of what was held out of that.
        all: Take every shape: for a file that the space was not trained on.
        seed: Seed of the triplets.
    """
    (shapes,) = held_out([file], run, family, all)
    print(axioms.report(space_of(run), shapes, seed=seed))


def reproduce(
    name: Positional[Annotated[str | None, arg(metavar="NAME", help=NAME)]] = None,
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
        full: The paper's scale, which takes hours a run and wants a GPU, not the one that fits two cores.
        seeds: How many seeds each run is made with.
        only: Make only the runs that have this in their names.
        out: A folder to begin anew in: shapes, trainings, results and RESULTS.md go there.
        device: Where it is trained and measured: cpu, cuda, cuda:1, mps ...
        write: Only write RESULTS.md again, of the figures that are there.
    """
    scale, folder = Scale("full" if full else "lite", seeds), out or report.HERE
    place = running.Workplace(out or Path("runs") / "reproduce", folder / report.RESULTS, device)
    if name is None and not write:
        print(report.listing(folder))
        return
    asked = chosen(name or "all")
    if not write:
        check_device(device)
    runs = running.selected(asked, scale, only)
    try:
        for experiment in [] if write else asked:
            running.reproduce(experiment, runs[experiment.name], scale, place)
    finally:  # also of what was done before Ctrl-C
        print(report.write(folder))
