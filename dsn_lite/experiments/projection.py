"""Whether projecting onto the handles while training pays: the counterpart of the paper's Table 3."""

from statistics import fmean
from typing import Any

from ..metrics import evaluate, held
from .kinds import Experiment, Run, Scale, Trained
from .measures import MILLI
from .results import Results
from .scales import config, data, pairs
from .tables import deviation, listed, mean_and_spread, table
from .transfers import plausible

CATEGORIES = ("chair", "sofa", "table")
FIGURES = {"fitting": ("fitting CD, 10⁻³", MILLI), "mmd": ("MMD-CD, 10⁻³", MILLI), "coverage": ("Cov-CD, %", 0.01)}
PAPER = {  # Table 3: trained without and with projection, measured with it
    ("fitting", "chair"): (6.82, 5.93),
    ("fitting", "sofa"): (4.75, 3.76),
    ("fitting", "table"): (7.91, 7.55),
    ("mmd", "chair"): (7.04, 7.25),
    ("mmd", "sofa"): (3.30, 3.17),
    ("mmd", "table"): (6.43, 6.50),
    ("coverage", "chair"): (39.1, 38.1),
    ("coverage", "sofa"): (38.8, 41.2),
    ("coverage", "table"): (40.3, 40.9),
}


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


def section(results: Results) -> str:
    """Our table beside the paper's, the corners that the paper leaves out, and the account of both."""
    done = [c for c in CATEGORIES if {f"{c}-without", f"{c}-with"} <= set(results.arms)]
    if not done:
        return "Of no category both trainings are done yet."
    cells = [(figure, category) for figure in FIGURES for category in done]
    rows = [_beside(results, figure, category) for figure, category in cells]
    head = ["trained", "", "without", "with", "difference", "paper: without", "paper: with", "same order"]
    corners = ["trained → measured", "", "without → without", "without → with", "with → without", "with → with", "idle"]
    whole = [_corners(results, figure, category) for figure, category in cells]
    return "\n\n".join([MEASURED, table(head, rows), CORNERS, table(corners, whole), _account(results, done)])


MEASURED = "Trained without and with projection, both measured with it, as in the paper:"
CORNERS = "The corners that the paper leaves out, measured without projection, beside transfers that move nothing:"


def _beside(results: Results, figure: str, category: str) -> list[str]:
    name, unit = FIGURES[figure]
    without, projected = f"{category}-without", f"{category}-with"
    differences = [value / unit for value in results.differences(projected, without, figure)]
    printed, same = PAPER[figure, category], _same(results, figure, category)
    order = ("yes" if same else "no") + (
        ", within the spread" if abs(fmean(differences)) <= deviation(differences) else ""
    )
    ours = [results.cell(without, figure, unit), results.cell(projected, figure, unit), mean_and_spread(differences)]
    return [name, category, *ours, *(f"{value:g}" for value in printed), order]


def _same(results: Results, figure: str, category: str) -> bool:
    """Whether projection in training moves a figure the same way as in the paper."""
    without, projected = PAPER[figure, category]
    ours = fmean(results.differences(f"{category}-with", f"{category}-without", figure))
    return (ours > 0) == (projected > without)


def _corners(results: Results, figure: str, category: str) -> list[str]:
    name, unit = FIGURES[figure]
    told = [(trained, measured) for trained in ("without", "with") for measured in ("free_", "")]
    cells = [results.cell(f"{category}-{trained}", measured + figure, unit) for trained, measured in told]
    return [name, category, *cells, results.cell(f"{category}-with", f"idle_{figure}", unit)]


def _account(results: Results, done: list[str]) -> str:
    same = {figure: [c for c in done if _same(results, figure, c)] for figure in FIGURES}
    names = {figure: name.split(",")[0] for figure, (name, _) in FIGURES.items()}
    said = [
        f"In {names[figure]} the order is the paper's for {listed(found) or 'none'} of {listed(done)}."
        for figure, found in same.items()
    ]
    for trained in ("without", "with"):
        over = [
            results.mean(f"{c}-{trained}", "fitting") / results.mean(f"{c}-{trained}", "free_fitting") for c in done
        ]
        said.append(f"Trained {trained} projection, measuring with it changes fitting CD by {fmean(over) - 1:+.1%}.")
    return " ".join([*said, PLAUSIBLE])


PLAUSIBLE = (
    "MMD-CD and Cov-CD judge how real transfers look, not whether they are right: transfers that move nothing are real "
    "shapes, so they score well, and figures should be read beside theirs."
)

EXPERIMENT = Experiment(
    "projection",
    "Projection in training",
    "Table 3",
    "Does it pay to project deformations onto the handles already while training?",
    runs,
    section,
)
