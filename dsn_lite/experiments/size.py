"""How fitting depends on the size k of the dictionary and on the number n of points that are read."""

from typing import Any

from .chart import Axis, Chart, Line
from .kinds import Data, Experiment, Run, Scale, Trained
from .measures import MILLI, baselines, fitting
from .results import Results
from .scales import COUNT, config, pairs
from .tables import table

STEPS = 500
K, N = (2, 8, 32, 128), (64, 192, 512)
FULL_K = (2, 4, 8, 16, 32, 64, 128, 256, 512)
SIZE = {"k": 64, "points": 512}  # what the other one is kept at
DENSE = 2048  # points of the targets, and of all shapes that are measured


def runs(scale: Scale) -> list[Run]:
    """Each k at one n, and each n at one k."""
    size = SIZE | ({"points": DENSE} if scale.full else {})
    told = [("k", k) for k in (FULL_K if scale.full else K)] + [("points", n) for n in N]
    count = COUNT["chair"] if scale.full else 2000
    return [
        Run(
            f"{name}-{value}",
            Data("chair", count, DENSE),
            config(scale, seed, lite_steps=STEPS, **size | {name: value}),
            measure,
            {"pairs": pairs(scale)},
        )
        for name, value in told
        for seed in range(scale.seeds)
    ]


def measure(trained: Trained, pairs: int) -> dict[str, Any]:
    """Fitting of dense shapes, and as a share: 0 at the sampling floor, 1 where nothing is done."""
    found, result = fitting(trained, pairs)
    return found | {"left": 100 * result.fitting_share}


def section(results: Results) -> str:
    """A table for k and one for n, and what they say."""
    parts = []
    for name, title in TITLES.items():
        arms = _arms(results, name)
        rows = [
            [f"{value:g}", results.cell(arm, "fitting_cd", MILLI), _left(results, arm)] for value, arm in arms.items()
        ]
        if rows:
            parts += [table([title, "fitting CD, 10⁻³", "left to do"], rows), _account(results, name, arms)]
    idle = baselines(results, results.arms[0])
    said = ", ".join(f"{name} {cd}" for name, cd in idle.items())
    return "\n\n".join([LEFT, *parts, f"For comparison, CD in 10⁻³: {said}."])


TITLES = {"k": "k", "points": "n, points read in training"}
LEFT = (
    "Left to do is (CD − floor) / (doing nothing − floor). All are measured on the same dense shapes, whatever n a "
    "space was trained with: columns have unit root mean square, so n may change."
)


def _arms(results: Results, name: str) -> dict[int, str]:
    """The arms that vary this, by its value."""
    return {int(arm.split("-")[1]): arm for arm in results.arms if arm.startswith(f"{name}-")}


def _left(results: Results, arm: str) -> str:
    return f"{results.cell(arm, 'left')} %"


def _account(results: Results, name: str, arms: dict[int, str]) -> str:
    if len(arms) < 2:
        return ""
    best = min(arms, key=lambda value: results.mean(arms[value], "left"))
    near = results.mean(arms[best], "left") + results.spread(arms[best], "left")
    enough = min(value for value in arms if results.mean(arms[value], "left") <= near)
    letter = "k" if name == "k" else "n"
    return f"Best is {letter} = {best}; from {letter} = {enough} on its spread is reached."


def charts(results: Results) -> list[Chart]:
    """What is left to do against k, and against n."""
    said = {"k": "Fitting against the number of columns", "points": "Fitting against the number of points read"}
    return [
        Chart(
            name,
            said[name],
            [_line(results, name)],
            Axis(TITLES[name], True, tuple(_arms(results, name))),
            Axis("left to do, %"),
        )
        for name in TITLES
        if len(_arms(results, name)) > 1
    ]


def _line(results: Results, name: str) -> Line:
    arms = _arms(results, name)
    ys, spreads = ([read(arm, "left") for arm in arms.values()] for read in (results.mean, results.spread))
    return Line("fitting", list(arms), ys, spreads)


EXPERIMENT = Experiment(
    "size",
    "The size of the dictionary and of the clouds",
    "the choice of k = 64 and k = 512, and of 2048 points, in Sections 4.1 and 4.2",
    "How does fitting depend on the number k of columns, and on the number n of points read?",
    runs,
    section,
    charts,
)
