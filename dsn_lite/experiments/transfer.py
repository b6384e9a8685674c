"""Transfers of the ready-made spaces against the truth, edits of parts that are not there, and the way back."""

from statistics import median
from typing import Any

from .. import zoo
from ..runs import read_config
from ..space import ActionSpace
from ..transfers import Triplets, echoes, errors, round_trip, two_way
from .kinds import Data, Experiment, Run, Scale, Trained, Transfers
from .transfer_page import CATEGORIES, KINDS, PART, POINTS, READ, section

SEED, PART_SEED = 7, 11  # not that of the recipes: all shapes are new


def runs(scale: Scale) -> list[Run]:
    """Three kinds of transfers, and edits of a part, for each ready-made space of a category."""
    count = 2000 if scale.full else 204
    found = []
    for category in CATEGORIES:
        config, _ = read_config(zoo.HERE / category)
        for kind in KINDS:
            data = Transfers(category, count, READ, SEED, across=kind != "same", single=kind == "single")
            how = {"points": POINTS, "back": kind == "same"}
            found.append(Run(f"{category}-{kind}", data, config, measure, how, ready=category))
        part, change = PART[category]
        how = {"part": part, "change": change, "sources": 12}
        shapes = Data(category, count // 2, POINTS, PART_SEED)
        found.append(Run(f"{category}-part", shapes, config, measure_part, how, ready=category))
    return found


def measure(trained: Trained, points: int, back: bool) -> dict[str, Any]:
    """Errors as shares of leaving z alone, by family, and, if asked, the way there and back; trained and untrained."""
    triplets, untrained = Triplets.of(trained.shapes, points), trained.space.untrained(trained.config.seed)
    plain, projected = errors(trained.space, triplets)
    found = {"idle": plain.idle.mean().item()}
    for name, each in {"": plain, "held_": projected, "blank_": errors(untrained, triplets)[0]}.items():
        shares = each.by_family.values()
        found |= {f"{name}error": median(shares), f"{name}families": list(shares)}
    if back:
        found |= _there_and_back("", trained.space, triplets) | _there_and_back("blank_", untrained, triplets)
    return found


def _there_and_back(name: str, space: ActionSpace, triplets: Triplets) -> dict[str, float]:
    """Both errors of going from z to the truth, whose points correspond, of the first triplets."""
    few = slice(0, 64)
    z, truth = (shapes[few].like(space).points for shapes in (triplets.z, triplets.truth))
    figures = {"round_trip": round_trip(space, z, space.vector(z, truth)), "two_way": two_way(space, z, truth)}
    return {name + figure: value for figure, value in figures.items()}


def measure_part(trained: Trained, part: str, change: dict[str, float], sources: int) -> dict[str, Any]:
    """How far shapes without the part move, as a share of those with it."""
    untrained, found = trained.space.untrained(trained.config.seed), {}
    for name, space in (("", trained.space), ("blank_", untrained)):
        for how, echo in echoes(space, trained.shapes, part, change, sources).items():
            found |= {f"{name}{how}": echo.plain, f"{name}{how}_held": echo.projected}
    return found


EXPERIMENT = Experiment(
    "transfer",
    "Transfers against the truth",
    "the two-way consistency and transfer figures of Section 4.3, and what the paper could not score",
    "Is what a transfer makes of a third shape right: of its family, of another, of one that lacks the part?",
    runs,
    section,
)
