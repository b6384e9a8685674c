"""How far from the laws of Section 3.1 a space is while it learns."""

from statistics import fmean
from typing import Any

import torch

from ..axioms import LAWS, moved_by, residuals
from ..data import triplets
from ..shapes import Shapes
from ..space import ActionSpace, DoNothing
from ..training import Record, Training
from .chart import Axis, Chart, Line
from .kinds import Experiment, Run, Scale, Trained
from .results import Results
from .scales import config, data
from .tables import listed, table

FAMILIES = {"four_legs": "table/four_legs", "chair": "chair"}
TRIPLETS = 64
FALLING = {
    "target_is_reached": "target is reached",
    "parallelogram_closes": "parallelogram closes",
    "actions_add": "actions add",
    "moved": "(how far xy moves x)",
}


def runs(scale: Scale) -> list[Run]:
    """One family, and a category of many."""
    return [
        Run(arm, data(scale, family), config(scale, seed, k=64), measure, watch=laws_so_far)
        for arm, family in FAMILIES.items()
        for seed in range(scale.seeds)
    ]


def laws_so_far(training: Training, record: Record) -> dict[str, float]:
    """The residuals of the laws on the shapes held out, at a look."""
    with torch.no_grad():
        return laws(training.space, training.test)


def measure(trained: Trained) -> dict[str, Any]:
    """Every law at every look, from the untrained space on, and what it is where nothing moves."""
    first = {"step": 0} | laws(trained.space.untrained(trained.config.seed), trained.shapes)
    looks = [first, *trained.looks]
    curves = {name: [look[name] for look in looks] for name in first}
    return curves | {f"idle_{law}": value for law, value in laws(DoNothing(), trained.shapes).items()}


def laws(space: ActionSpace, shapes: Shapes) -> dict[str, float]:
    """The residuals on triplets of these shapes, and how far a vector moves one of them, rms."""
    x, y, z = triplets(shapes.like(space), TRIPLETS)
    return residuals(space, x, y, z) | {"moved": moved_by(space, x.points, space.vector(x.points, y.points))}


def section(results: Results) -> str:
    """For each set of shapes the laws before and after, and the account of the one that is not learned."""
    head = ["law", "", "untrained", "trained", "doing nothing"]
    parts = []
    for arm in results.arms:
        rows = [[law.replace("_", " "), statement, *_ends(results, arm, law)] for law, statement in LAWS.items()]
        rows.append(["how far xy moves x", "", *_ends(results, arm, "moved")])
        parts += [f"`{FAMILIES[arm]}`:", table(head, rows), _account(results, arm)]
    return "\n\n".join([UNIT, *parts])


UNIT = (
    "Residuals are rms lengths in the unit of the shapes. Those that are 0 but for rounding hold by construction, "
    "trained or not. Without correspondence a target is only reached up to the distance of neighbouring samples."
)


def curve(results: Results, arm: str, law: str) -> list[float]:
    """The mean over the seeds at each step that all were looked at: Ctrl-C in the middle of a look leaves it out."""
    seen = results.values(arm, "step")
    steps = sorted(set(seen[0]).intersection(*seen))
    by_step = [dict(zip(*pair, strict=True)) for pair in zip(seen, results.values(arm, law), strict=True)]
    return [fmean(values[step] for values in by_step) for step in steps]


def _ends(results: Results, arm: str, law: str) -> list[str]:
    values = curve(results, arm, law)
    return [f"{value:.1e}" for value in (values[0], values[-1], results.mean(arm, f"idle_{law}"))]


def _account(results: Results, arm: str) -> str:
    curves = {law: curve(results, arm, law) for law in FALLING}
    laws = [law for law in FALLING if law != "moved"]
    fallen = [law for law in laws if curves[law][-1] < curves[law][0]]
    share = [added / moved for added, moved in zip(curves["actions_add"], curves["moved"], strict=True)]
    changed = "falls" if share[-1] < share[0] else "rises"
    said = [f"{FALLING[law].capitalize()}: {curves[law][0]:.2g} → {curves[law][-1]:.2g}." for law in laws]
    said.append(f"As a length, {listed([FALLING[law] for law in fallen]) or 'none of them'} improved.")
    said.append(
        f"But who moves nothing adds up perfectly: as a share of how far xy moves x, the residual of additivity "
        f"{changed} from {share[0]:.1%} to {share[-1]:.1%}."
    )
    return " ".join(said)


def charts(results: Results) -> list[Chart]:
    """The residuals that are learned, against the steps."""
    return [
        Chart(
            arm,
            f"Residuals of the laws while training on {FAMILIES[arm]}",
            [Line(name, curve(results, arm, "step"), curve(results, arm, law)) for law, name in FALLING.items()],
            Axis("step"),
            Axis("rms residual", log=True),
        )
        for arm in results.arms
    ]


EXPERIMENT = Experiment(
    "axioms",
    "The axioms while training",
    "Section 3.1, of which the paper shows no curve",
    "Which laws are learned, how fast, and which hold from the start?",
    runs,
    section,
    charts,
)
