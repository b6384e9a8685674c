"""What was measured: a JSON file an experiment and scale, written anew as soon as a run is done."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from math import nan
from pathlib import Path
from statistics import fmean
from typing import Any

from ..config import Config
from ..files import beside
from .kinds import Experiment, Run, Scale
from .tables import Number, deviation, mean_and_spread


class Results:
    """The figures of the runs of an experiment that are done with the settings they have now.

    `runs` are those of the scale, of more seeds where more were run; entries of runs that no longer exist, or that were
    told other things, are left out: they will be run again.
    """

    def __init__(self, experiment: Experiment, scale: Scale, folder: Path):
        self.experiment, self.scale, self.path = experiment, scale, folder / file_name(experiment, scale)
        stored = _read(self.path)
        seeds = max([scale.seeds, *(1 + entry["settings"]["config"]["seed"] for entry in stored.values())])
        self.runs = experiment.runs(Scale(scale.name, seeds))
        known = [run for run in self.runs if run.key in stored and fits(stored[run.key], run)]
        self.entries = {run.key: stored[run.key] for run in known}

    def add(self, run: Run, entry: dict[str, Any]) -> None:
        """Puts a run's entry in and writes the file."""
        self.entries[run.key] = {"settings": run.settings} | _rounded(entry)
        self.entries = {run.key: self.entries[run.key] for run in self.runs if run.key in self.entries}
        self.path.parent.mkdir(parents=True, exist_ok=True)
        beside(self.path, lambda part: part.write_text(_text(self.entries), encoding="utf-8"))

    @property
    def arms(self) -> list[str]:
        """The arms of which a run is done, in the order of the experiment."""
        return list(dict.fromkeys(run.arm for run in self.runs if run.key in self.entries))

    def by_seed(self, arm: str, figure: str) -> dict[int, Any]:
        """One figure of an arm; runs that have none are left out."""
        own = [run for run in self.runs if run.arm == arm and run.key in self.entries]
        found = {run.config.seed: self.entries[run.key]["figures"].get(figure) for run in own}
        return {seed: value for seed, value in found.items() if value is not None}

    def values(self, arm: str, figure: str) -> list[Any]:
        """One figure of an arm, seed by seed."""
        return list(self.by_seed(arm, figure).values())

    def mean(self, arm: str, figure: str) -> float:
        """The mean of a figure over the seeds; NaN where no run has it."""
        return fmean(self.values(arm, figure) or [nan])

    def spread(self, arm: str, figure: str) -> float:
        """Its standard deviation over the seeds; 0 where there is one."""
        return deviation(self.values(arm, figure))

    def curve(self, arm: str, figure: str) -> list[float]:
        """The mean over the seeds of a figure that is a list, place by place."""
        return [fmean(column) for column in zip(*self.values(arm, figure), strict=False)]

    def ratio(self, arm: str, other: str, figure: str) -> list[float]:
        """A figure of one arm over that of another, seed by seed."""
        above, below = self.by_seed(arm, figure), self.by_seed(other, figure)
        return [above[seed] / below[seed] for seed in above if seed in below]

    def differences(self, arm: str, other: str, figure: str) -> list[float]:
        """A figure of one arm less that of another, seed by seed."""
        mine, theirs = self.by_seed(arm, figure), self.by_seed(other, figure)
        return [mine[seed] - theirs[seed] for seed in mine if seed in theirs]

    def cell(self, arm: str, figure: str, unit: Number = 1) -> str:
        """Mean and spread over the seeds in units of `unit`, as tables have it."""
        return mean_and_spread([value / unit for value in self.values(arm, figure)])

    def told(self, name: str) -> list[Any]:
        """The different values of a Config field among the runs that are done, in their order."""
        return list(dict.fromkeys(_hashable(each["settings"]["config"][name]) for each in self.entries.values()))


def fits(entry: dict[str, Any], run: Run) -> bool:
    """Whether a stored entry is of this run as it is now: fields a Config has got since count with their default."""
    stored = entry["settings"]
    config = asdict(Config.from_json(stored["config"]))
    return stored | {"config": json.loads(json.dumps(config))} == run.settings


def file_name(experiment: Experiment, scale: Scale) -> str:
    """The name of the file of an experiment at a scale."""
    return f"{experiment.name}-full.json" if scale.full else f"{experiment.name}.json"


def _read(path: Path) -> dict[str, dict[str, Any]]:
    if not path.is_file():
        return {}
    try:
        return json.loads(path.read_text(encoding="utf-8"))["runs"]
    except (ValueError, KeyError, TypeError):
        raise ValueError(
            f"reproduce: {path} must be the results of earlier runs, it is broken; take it away to begin anew"
        ) from None


def _text(entries: dict[str, dict[str, Any]]) -> str:
    """One part of a run a line, so that a new figure is a short difference."""
    runs = [
        f" {json.dumps(key)}: {{\n"
        + ",\n".join(f"  {json.dumps(name)}: {json.dumps(value)}" for name, value in entry.items())
        + "\n }"
        for key, entry in entries.items()
    ]
    return '{"runs": {\n' + ",\n".join(runs) + "\n}}\n"


def _rounded(value: Any) -> Any:
    """Numbers to five digits: what follows is not known anyway."""
    if isinstance(value, dict):
        return {name: _rounded(each) for name, each in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_rounded(each) for each in value]
    return float(f"{value:.5g}") if isinstance(value, float) else value


def _hashable(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value
