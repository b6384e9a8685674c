"""RESULTS.md and its charts, made from the stored figures and from nothing else."""

from pathlib import Path
from statistics import fmean
from typing import Any

from ..files import beside
from . import EXPERIMENTS
from .chart import Chart, Picture
from .kinds import Scale
from .results import Results
from .tables import listed

HERE = Path(__file__).parent
RESULTS = "results"  # the folder beside RESULTS.md
SCALES = (Scale("lite"), Scale("full"))

HEAD = """# Results

The paper's tables and figures on procedural shapes. `python -m dsn_lite reproduce` lists the experiments; with a name,
or all, it makes what is missing. This page is generated from the figures in [results](results).

A figure is the mean over seeds ± their standard deviation; a seed draws the weights, the split and the batches. All are
of shapes held out. Chamfer distances (CD) are squared, both directions summed, in the unit of the shapes, which lie in
[-0.5, 0.5]; the sampling floor is the CD of two samplings of the same shape. The paper's shapes are those of ShapeNet:
compare orders and trends with it, not values. A run is made again where it is told other things; that
the code has changed since is not noticed."""


def stored(name: str, folder: Path = HERE) -> Results:
    """The figures of one of EXPERIMENTS, at lite scale."""
    return Results(EXPERIMENTS[name], SCALES[0], folder / RESULTS)


def write(folder: Path = HERE) -> Path:
    """Writes RESULTS.md and its charts into a folder that holds results; returns the page."""
    for name, chart in charts(folder).items():
        beside(folder / RESULTS / name, lambda part, chart=chart: part.write_text(chart, encoding="utf-8"))
    page = folder / "RESULTS.md"
    beside(page, lambda part: part.write_text(text(folder), encoding="utf-8"))
    return page


def text(folder: Path = HERE) -> str:
    """The page of a folder."""
    return "\n\n".join([HEAD, *map(_section, _known(folder))]) + "\n"


def charts(folder: Path = HERE) -> dict[str, str]:
    """The charts of the page, by the names of their files."""
    return {_file(each, chart.name): chart.svg for each in _known(folder) for chart in _charts(each)}


def listing(folder: Path = HERE) -> str:
    """A line an experiment: its name, how many of its runs are done, and what it asks."""
    lines = []
    for name, experiment in EXPERIMENTS.items():
        counts = [Results(experiment, scale, folder / RESULTS) for scale in SCALES]
        done = ", ".join(f"{each.scale.name} {len(each.entries)}/{len(each.runs)}" for each in counts)
        lines.append(f"{name:<16} {done:<24} {experiment.title}: {experiment.paper}")
    return "\n".join(lines)


def _known(folder: Path) -> list[Results]:
    """The experiments and scales to show: at lite scale all, at full scale those that were begun."""
    found = [Results(each, scale, folder / RESULTS) for each in EXPERIMENTS.values() for scale in SCALES]
    return [results for results in found if results.entries or not results.scale.full]


def _charts(results: Results) -> list[Chart | Picture]:
    return results.experiment.charts(results) if results.entries else []


def _section(results: Results) -> str:
    experiment = results.experiment
    parts = [
        f"## {experiment.title}{' at full scale' if results.scale.full else ''}",
        f"*Beside {experiment.paper}.* {experiment.question}",
    ]
    if not results.entries:
        return "\n\n".join([*parts, "No run is done yet."])
    parts += [_told(results), experiment.section(results)]
    parts += [f"![{chart.said}]({RESULTS}/{_file(results, chart.name)})" for chart in _charts(results)]
    return "\n\n".join(parts)


def _told(results: Results) -> str:
    """What was run: the command, the shapes, the steps and the time they took."""
    entries = list(results.entries.values())
    shapes = dict.fromkeys(f"{d['family']}: {d['count']} shapes of {d['points']} points" for d in _all(entries, "data"))
    told = {name: sorted({each[name] for each in _all(entries, "config")}) for name in ("k", "batch", "steps")}
    ran = ", ".join(f"{name} {listed([f'{value}' for value in values])}" for name, values in told.items())
    seconds = [entry["seconds"] for entry in entries]
    trained = f"trained in {fmean(seconds):.0f} s on average, {max(seconds):.0f} s at most"
    took = trained if max(seconds) else "with ready-made spaces"
    full = " --full" if results.scale.full else ""
    done = f"{len(entries)} of {len(results.runs)} runs done, {took}"
    return f"`python -m dsn_lite reproduce {results.experiment.name}{full}`: {done}. {'; '.join(shapes)}; {ran}."


def _all(entries: list[dict[str, Any]], part: str) -> list[dict[str, Any]]:
    return [entry["settings"][part] for entry in entries]


def _file(results: Results, chart: str) -> str:
    return f"{results.experiment.name}{'-full' if results.scale.full else ''}-{chart}.svg"
