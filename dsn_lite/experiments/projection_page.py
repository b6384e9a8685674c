"""What the experiment on projection says: our table beside the paper's, and the account of it."""

from itertools import product
from statistics import fmean

from .measures import MILLI
from .results import Results
from .tables import listed, mean_and_spread, table, within_spread

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


def section(results: Results) -> str:
    """Our table beside the paper's, the corners that the paper leaves out, and the account of both.

    A row holds the seeds that both trainings have; a category that has none is left out.
    """
    done = [category for category in CATEGORIES if _seeds(results, category)]
    if not done:
        return "Of no category both trainings of one seed are done yet."
    cells = [(figure, category) for figure in FIGURES for category in done]
    rows = [_beside(results, figure, category) for figure, category in cells]
    head = ["trained", "", "without", "with", "difference", "paper: without", "paper: with", "same order"]
    corners = ["trained → measured", "", "without → without", "without → with", "with → without", "with → with", "idle"]
    whole = [_corners(results, figure, category) for figure, category in cells]
    account = [*_orders(results, cells), *_projected(results, done), *_idle(results, done)]
    return "\n\n".join([MEASURED, table(head, rows), CORNERS, table(corners, whole), " ".join(account)])


MEASURED = "Trained without and with projection, both measured with it, as in the paper:"
CORNERS = "The corners that the paper leaves out, measured without projection, beside transfers that move nothing:"
TRAINED, TESTED = ("without", "with"), ("free_", "")
SAME, OTHER, WITHIN = "yes", "no", ", within the spread"


def _seeds(results: Results, category: str) -> list[int]:
    """The seeds of which both trainings are done."""
    without, projected = (results.by_seed(f"{category}-{trained}", "fitting") for trained in TRAINED)
    return [seed for seed in without if seed in projected]


def _values(results: Results, category: str, trained: str, figure: str) -> list[float]:
    """A figure of one training of a category, in its unit, of the seeds that both trainings have."""
    own, unit = results.by_seed(f"{category}-{trained}", figure), FIGURES[figure.split("_")[-1]][1]
    return [own[seed] / unit for seed in _seeds(results, category)]


def _beside(results: Results, figure: str, category: str) -> list[str]:
    without, projected = (_values(results, category, trained, figure) for trained in TRAINED)
    cells = [mean_and_spread(values) for values in (without, projected, _differences(results, figure, category))]
    printed = (f"{value:g}" for value in PAPER[figure, category])
    return [FIGURES[figure][0], category, *cells, *printed, _order(results, figure, category)]


def _differences(results: Results, figure: str, category: str) -> list[float]:
    """What projection in training changes, seed by seed."""
    without, projected = (_values(results, category, trained, figure) for trained in TRAINED)
    return [b - a for a, b in zip(without, projected, strict=True)]


def _order(results: Results, figure: str, category: str) -> str:
    """Whether projection in training moves a figure the same way as in the paper, and whether beyond the spread."""
    (without, projected), ours = PAPER[figure, category], _differences(results, figure, category)
    same = SAME if (fmean(ours) > 0) == (projected > without) else OTHER
    if len(ours) < 2:
        return f"{same}, of one seed"
    return same + (WITHIN if within_spread(ours) else "")


def _corners(results: Results, figure: str, category: str) -> list[str]:
    values = [_values(results, category, trained, tested + figure) for trained, tested in product(TRAINED, TESTED)]
    idle = _values(results, category, "with", f"idle_{figure}")
    return [FIGURES[figure][0], category, *map(mean_and_spread, [*values, idle])]


def _orders(results: Results, cells: list[tuple[str, str]]) -> list[str]:
    """How many orders are the paper's, are not, or are not known."""
    named: dict[str, list[str]] = {}
    for figure, category in cells:
        order = _order(results, figure, category)
        kind = "of one seed" if "seed" in order else "within" if WITHIN in order else order
        named.setdefault(kind, []).append(f"{_short(figure)} of {category}")
    told = {
        SAME: "the paper's order beyond the spread over the seeds",
        OTHER: "the other order beyond it",
        "within": "a difference within the spread, which tells no order",
        "of one seed": "one seed, which has no spread",
    }
    counts = [
        f"{len(named[kind])} have {words} ({listed(named[kind])})" for kind, words in told.items() if kind in named
    ]
    return [f"Of {len(cells)} comparisons with the paper, {'; '.join(counts)}."]


def _projected(results: Results, done: list[str]) -> list[str]:
    """What projection at test time does to fitting."""
    said = []
    for trained in TRAINED:
        mean = lambda category, figure, trained=trained: fmean(_values(results, category, trained, figure))
        changes = [f"{mean(c, 'fitting') / mean(c, 'free_fitting') - 1:+.1%} for {c}" for c in done]
        said.append(f"Trained {trained} projection, measuring with it changes fitting CD by {listed(changes)}.")
    return said


def _idle(results: Results, done: list[str]) -> list[str]:
    """How doing nothing compares with transfers by the two measures of how real they look."""
    said = []
    for figure, better in {"mmd": min, "coverage": max}.items():
        places: dict[str, list[str]] = {}
        for category in done:
            each = product(TRAINED, TESTED)
            transfers = [fmean(_values(results, category, a, b + figure)) for a, b in each]
            idle = fmean(_values(results, category, "with", f"idle_{figure}"))
            beaten = sum(idle != value and better(idle, value) == idle for value in transfers)
            place = {0: "no better than any", len(transfers): "better than each"}.get(beaten, "better than some")
            places.setdefault(place, []).append(category)
        told = [f"{place} of the four kinds of transfers for {listed(found)}" for place, found in places.items()]
        said.append(f"In {_short(figure)}, doing nothing scores {'; '.join(told)}.")
    return [*said, REAL]


def _short(figure: str) -> str:
    return FIGURES[figure][0].split(",")[0]


REAL = "Both judge how real transfers look, not whether they are right, and one that moves nothing is a real shape."
