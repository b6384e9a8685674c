"""Whether projecting onto the handles while training pays: the counterpart of the paper's Table 3."""

from typing import Any

from ..metrics import evaluate, held
from .kinds import Experiment, Run, Scale, Trained
from .projection_page import CATEGORIES, section
from .scales import config, data, pairs
from .transfers import plausible


def runs(scale: Scale) -> list[Run]:
    """Each category, trained without and with projection."""
    how = {"pairs": pairs(scale), "targets": 10}
    how |= {"sources": 200, "references": 480, "points": 2048} if scale.full else {}
    how = {"sources": 100, "references": 100, "points": 256} | how
    return [
        Run(
            f"{category}-{'with' if project else 'without'}",
            data(scale, category),
            config(scale, seed, k=64, sparsity=10.0, project=project),
            measure,
            how,
        )
        for category in CATEGORIES
        for project in (False, True)
        for seed in range(scale.seeds)
    ]


def measure(trained: Trained, pairs: int, **how: int) -> dict[str, Any]:
    """Fitting, and how plausible transfers are, with projection at test time, without it, and where nothing moves."""
    space, found = trained.space, {}
    for name, project in {"free_": False, "": True}.items():
        result = evaluate(space, trained.shapes, again=trained.again, pairs=pairs, project=project)
        found |= {f"{name}fitting": result.fitting_cd, f"{name}moved": result.share_moved}
        move = lambda x, y, z, project=project: held(z, space.transfer(x.points, y, z.points), project)
        found |= plausible(trained, move, name, **how)
    found |= {"floor": result.floor, "idle_fitting": result.do_nothing_cd}
    return found | plausible(trained, lambda x, y, z: z.points, "idle_", **how)


EXPERIMENT = Experiment(
    "projection",
    "Projection in training",
    "Table 3",
    "Does it pay to project deformations onto the handles already while training?",
    runs,
    section,
)
