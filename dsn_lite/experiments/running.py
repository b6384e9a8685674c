"""Runs made one by one: data generated, a space trained, its figures written. What is done is not done again."""

import json
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import torch

from .. import zoo
from ..checkpoints import FILE as CHECKPOINT
from ..checkpoints import load_history
from ..config import Config
from ..driving import drive
from ..files import beside, load_shapes
from ..processes import python
from ..runs import finished, load_run
from ..shapes import Shapes
from ..training import Record, Training
from .kinds import Data, Experiment, Run, Scale, Trained
from .results import Results

LOOKS = "looks.jsonl"


@dataclass(frozen=True)
class Workplace:
    """Where the shapes and the trainings lie that runs share, and the folder that results are written to."""

    cache: Path
    results: Path
    device: str = "cpu"

    def shapes(self, data: Data) -> tuple[Shapes, Shapes]:
        """The shapes, and the same sampled again; both are generated if they are not here."""
        shapes, again = self.made(data), self.cache / "data" / f"{data.name}-again.npz"
        if not again.exists():
            file = again.with_name(f"{data.name}.npz")
            python("reproduce", "-m", "data_gen", "resample", file, "--seed", data.seed + 1, "--out", again)
        return shapes, load_shapes(again)

    def made(self, data: Data) -> Shapes:
        """The shapes, generated if they are not here."""
        file = self.cache / "data" / f"{data.name}.npz"
        file.parent.mkdir(parents=True, exist_ok=True)
        if not file.exists():
            python("reproduce", "-m", "data_gen", *data.told, "--out", file)
        return load_shapes(file)

    def folder(self, run: Run) -> Path:
        """The folder of a training: that of every run, of any experiment, which is told the same.

        What a Config leaves at its default is left out, so that a field added later makes no training another one.
        """
        usual = asdict(Config())
        told = {name: value for name, value in asdict(run.config).items() if value != usual[name] and name != "device"}
        told = json.dumps(run.training | {"config": told}, sort_keys=True).encode()
        return self.cache / "trainings" / f"{run.data.name}-{sha256(told).hexdigest()[:12]}"


def selected(experiments: list[Experiment], scale: Scale, only: str | None) -> dict[str, list[Run]]:
    """The runs of each experiment, or those whose names have `only` in them. Raises ValueError where none has."""
    every = {experiment.name: experiment.runs(scale) for experiment in experiments}
    found = {name: [run for run in runs if only is None or only in run.key] for name, runs in every.items()}
    if not any(found.values()):
        names = ", ".join(run.key for runs in every.values() for run in runs if run.config.seed == 0)
        raise ValueError(f"reproduce: --only must be in the name of a run, got {only!r}; of the first seed are {names}")
    return found


def reproduce(experiment: Experiment, runs: list[Run], scale: Scale, place: Workplace) -> None:
    """Makes those runs of an experiment that are not done yet; each is written as soon as it is.

    KeyboardInterrupt passes, and the run it met goes on where it was the next time.
    """
    results = Results(experiment, scale, place.results)
    left = [run for run in runs if run.key not in results.entries]
    print(f"{experiment.name}: {len(runs) - len(left)} of {len(runs)} runs are done")
    for i, run in enumerate(left, start=len(runs) - len(left) + 1):
        print(f"{experiment.name}, run {i} of {len(runs)}: {run.key}", flush=True)
        results.add(run, _entry(run, place))


def _entry(run: Run, place: Workplace) -> dict[str, Any]:
    """What is kept of a run: its steps, the seconds of its training and of its measuring, and its figures."""
    trained, took = _ready(run, place) if run.ready else _trained(run, place)
    start = time.perf_counter()
    with torch.no_grad():
        figures = run.measure(trained, **run.how)
    return {**took, "seconds_measuring": time.perf_counter() - start, "figures": figures}


def _ready(run: Run, place: Workplace) -> tuple[Trained, dict[str, float | int]]:
    """A ready-made space, and shapes that are all new to it."""
    shapes = place.made(run.data)
    space = load_run(zoo.HERE / run.ready, place.device)
    return Trained(space, run.config, shapes, shapes, shapes, []), {"steps": run.config.steps, "seconds": 0.0}


def _trained(run: Run, place: Workplace) -> tuple[Trained, dict[str, float | int]]:
    """The space of a run, and the steps and seconds that it took."""
    shapes, again = place.shapes(run.data)
    folder = place.folder(run)
    if not finished(folder):
        _train(run, shapes, folder, place.device)
    last, (seen, _, test) = load_history(folder)[-1], shapes.rows(run.config.seed)
    space = load_run(folder, place.device)
    trained = Trained(space, run.config, shapes[seen], shapes[test], again[test], _looks(folder))
    return trained, {"steps": last["step"], "seconds": last["seconds"]}


def _train(run: Run, shapes: Shapes, folder: Path, device: str) -> None:
    """Trains to the end, from the checkpoint if there is one."""
    config = replace(run.config, device=device)
    config.check(shapes)
    training = Training(shapes, config, run=folder, resume=(folder / CHECKPOINT).exists())
    if run.prepare:
        run.prepare(training)
    drive(training, run.watch and _watching(run.watch, folder, training.step))
    if not finished(folder):  # Ctrl-C, which only ends a training, is to end all
        raise KeyboardInterrupt


def _watching(watch: Callable[..., dict], folder: Path, step: int) -> Callable[[Training, Record], None]:
    """Writes what is watched to the folder at every look; what came after the step to go on from is forgotten."""
    looks = [look for look in _looks(folder) if look["step"] <= step]

    def write(training: Training, record: Record) -> None:
        looks.append({"step": record.step} | watch(training, record))
        lines = "".join(json.dumps(look) + "\n" for look in looks)
        beside(folder / LOOKS, lambda part: part.write_text(lines, encoding="utf-8"))

    return write


def _looks(folder: Path) -> list[dict[str, Any]]:
    file = folder / LOOKS
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []
