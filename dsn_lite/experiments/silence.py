"""How silent a mode is on shapes that lack the part it moves: the paper's swivel leg and shelf (Section 4.1)."""

from dataclasses import replace
from statistics import fmean
from typing import Any

import torch

from .. import modes
from ..shapes import Shapes
from ..space import ActionSpace
from .kinds import Experiment, Run, Scale, Trained
from .results import Results
from .scales import config, data
from .tables import table, within_spread

KINDS = {"chair": "column", "table": "shelf"}  # the swivel chair stands on a column
WEIGHTS = (0.0, 10.0)
EDITS = {  # change of the centres, factor of the extents: a thicker column, a higher shelf
    "column": ((0.0, 0.0, 0.0), (1.5, 1.0, 1.5)),
    "shelf": ((0.0, 0.08, 0.0), (1.0, 1.0, 1.0)),
}
FIGURES = {
    "share": "of its motion in that part, where there is one, %",
    "length": "its length in the handles on shapes without, of that on shapes with, %",
    "echo": "an edit of that part: motion of shapes without, of that of shapes with, %",
}


def runs(scale: Scale) -> list[Run]:
    """Chairs and tables, with and without the sparsity loss."""
    return [
        Run(
            f"{category}-w{w:g}",
            data(scale, category),
            config(scale, seed, k=64, sparsity=w),
            measure,
            {"kind": kind},
        )
        for category, kind in KINDS.items()
        for w in WEIGHTS
        for seed in range(scale.seeds)
    ]


def measure(trained: Trained, kind: str) -> dict[str, Any]:
    """The main mode of a kind of part, and an edit of that part, on shapes that lack it; trained and untrained."""
    untrained = trained.space.untrained(trained.config.seed)
    return _silence("", trained.space, trained.shapes, kind) | _silence("untrained_", untrained, trained.shapes, kind)


def _silence(prefix: str, space: ActionSpace, shapes: Shapes, kind: str) -> dict[str, float]:
    reading = modes.read(space, shapes)
    found, has = modes.silence(reading, kind), reading.present[:, reading.kinds.index(kind)].cpu()
    having, lacking = (shapes[rows.nonzero().flatten()].like(space) for rows in (has, ~has))
    lacking = lacking[torch.arange(len(having)) % len(lacking)]
    heard = modes.echo(space, having.points, edited(having, kind).points, lacking.points)
    figures = {"share": found.share, "length": found.handles, "echo": heard}
    return {prefix + name: 100 * value for name, value in figures.items()}


def edited(shapes: Shapes, kind: str) -> Shapes:
    """The same samples with every part of a kind moved or thicker, in its place; the other parts stay."""
    own = torch.tensor([modes.kind(name) == kind for name in shapes.part_names])
    shift, factor = (torch.tensor(change).to(shapes.boxes) for change in EDITS[kind])
    boxes = shapes.boxes.clone()
    boxes[:, own, :3] += shift
    boxes[:, own, 12:] *= factor
    return replace(shapes, points=shapes.at_boxes(boxes))


def section(results: Results) -> str:
    """A table a kind of part, and the account of it."""
    parts = [WHAT]
    for category, kind in KINDS.items():
        arms = [arm for arm in results.arms if arm.startswith(category)]
        if arms:
            head = [f"{kind} of a {category}", "untrained", *(f"trained, w = {arm.split('w')[-1]}" for arm in arms)]
            columns = [(arms[0], "untrained_"), *((arm, "") for arm in arms)]
            rows = [
                [name, *(results.cell(arm, prefix + figure) for arm, prefix in columns)]
                for figure, name in FIGURES.items()
            ]
            parts += [table(head, rows), _account(results, kind, arms)]
    return "\n\n".join(parts)


WHAT = (
    "The mode of a part is the one that has most of its squared motion there. A normalised column cannot vanish, so on "
    "shapes without the part it moves something else; what may be silent are its elements in the handles, or an edit "
    "of that part, whose vector may use several columns. The paper shows one such mode each, and no number."
)


def _account(results: Results, kind: str, arms: list[str]) -> str:
    """For each weight, what training does to an edit's motion where the part is not."""
    said = "; ".join(_clause(results, arm) for arm in arms)
    return (
        f"Shapes that lack the {kind} move under an edit of it, as a share of those that have it, untrained → trained, "
        f"{said}."
    )


def _clause(results: Results, arm: str) -> str:
    before, after = results.by_seed(arm, "untrained_echo"), results.by_seed(arm, "echo")
    changes = [after[seed] - before[seed] for seed in after]
    changed = "quieter" if fmean(changes) < 0 else "no quieter"
    told = f"{results.cell(arm, 'untrained_echo')} → {results.cell(arm, 'echo')} % with w = {arm.split('w')[-1]}"
    return f"{told} ({changed}{', within the spread' if within_spread(changes) else ''})"


EXPERIMENT = Experiment(
    "silence",
    "Silent modes",
    "the figure of dictionary elements in Section 4.1: swivel leg and shelf",
    "Does a mode of one part leave shapes alone that do not have the part?",
    runs,
    section,
)
