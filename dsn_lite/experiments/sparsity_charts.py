"""The charts of the experiment on the sparsity loss, and the names of its arms."""

from collections.abc import Iterable

from .chart import Axis, Chart, Line
from .measures import MILLI
from .results import Results

WEIGHTS = {"l21": (0.0, 0.1, 1.0, 3.0, 10.0), "l1": (1.0, 3.0), "l1seen": (1.0, 3.0)}
WITHOUT = "l21-0"
NORMS = {"l21": "l2,1", "l1": "l1", "l1seen": "l1 of what is seen"}
THRESHOLDS = [10 ** (i / 3 - 4) for i in range(13)]
TICKS = (0.1, 1.0, 3.0, 10.0)
CD = Axis("fitting CD, 10⁻³")


def label(arm: str) -> str:
    """An arm as tables have it."""
    norm, w = arm.split("-")
    return "w = 0" if arm == WITHOUT else f"{NORMS[norm]}, w = {w}"


def charts(results: Results) -> list[Chart]:
    """Fitting against w, elements and columns against the threshold of zero, and what is paid for what."""
    if WITHOUT not in results.arms:
        return []
    first = [arm for arm in results.arms if arm.startswith("l21")]
    by_threshold = lambda figure: [Line(label(arm), THRESHOLDS, results.curve(arm, figure)) for arm in first]
    threshold = Axis("threshold of zero, share of the shape's largest", log=True)
    return [
        Chart("a", "Fitting against the weight of the loss", _fits(results), Axis("weight w", True, TICKS), CD),
        Chart(
            "b",
            "Non-zero elements against the threshold",
            by_threshold("elements"),
            threshold,
            Axis("non-zero elements, %"),
        ),
        Chart(
            "c", "Non-zero columns against the threshold", by_threshold("columns"), threshold, Axis("non-zero columns")
        ),
        Chart("d", "Small elements of scaled columns against fitting", _paid(results), CD, Axis("below 1 %, in %")),
    ]


def _arms(results: Results) -> dict[str, dict[float, str]]:
    """The arms that are done with a loss, by weight, by norm."""
    found = {norm: {w: f"{norm}-{w:g}" for w in given if w} for norm, given in WEIGHTS.items()}
    found = {norm: {w: arm for w, arm in arms.items() if arm in results.arms} for norm, arms in found.items()}
    return {norm: arms for norm, arms in found.items() if arms}


def _points(results: Results, arms: Iterable[str], figure: str, unit: float = 1) -> tuple[list[float], list[float]]:
    """Means and spreads of a figure, arm by arm."""
    return [results.mean(arm, figure) / unit for arm in arms], [results.spread(arm, figure) / unit for arm in arms]


def _fits(results: Results) -> list[Line]:
    lines = [
        Line(NORMS[norm], list(arms), *_points(results, arms.values(), "fitting_cd", MILLI))
        for norm, arms in _arms(results).items()
    ]
    flat = {"w = 0": "fitting_cd", "sampling floor": "floor"}
    ends = (TICKS[0], TICKS[-1])
    return lines + [
        Line(name, ends, [results.mean(WITHOUT, each) / MILLI] * 2, flat=True) for name, each in flat.items()
    ]


def _paid(results: Results) -> list[Line]:
    cds = lambda arms: _points(results, arms, "fitting_cd", MILLI)[0]
    lines = [
        Line(NORMS[norm], cds(arms.values()), *_points(results, arms.values(), "scaled"))
        for norm, arms in _arms(results).items()
    ]
    free = {"w = 0": "scaled", "w = 0, varimax": "varimax_scaled"}
    return lines + [Line(name, cds([WITHOUT]), *_points(results, [WITHOUT], figure)) for name, figure in free.items()]
