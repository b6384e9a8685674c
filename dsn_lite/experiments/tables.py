"""Numbers as tables have them."""

from collections.abc import Sequence
from math import floor, log10
from statistics import fmean, stdev

NONE = "–"
Number = float | int


def deviation(values: Sequence[Number]) -> float:
    """The standard deviation over the seeds; 0 of one."""
    return stdev(values) if len(values) > 1 else 0.0


def within_spread(differences: Sequence[Number]) -> bool:
    """Whether their mean is no further from 0 than their standard deviation; never of one seed, which has none."""
    return len(differences) > 1 and abs(fmean(differences)) <= deviation(differences)


def mean_and_spread(values: Sequence[Number]) -> str:
    """Mean ± standard deviation over the seeds, to the digits that the spread leaves; of one seed, its value."""
    if not values:
        return NONE
    if not (spread := deviation(values)):
        return f"{fmean(values):.3g}"
    places = min(5, max(0, 1 - floor(log10(spread))))
    return f"{fmean(values):.{places}f} ± {spread:.{places}f}"


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def listed(words: Sequence[str]) -> str:
    """a, b and c."""
    return " and ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else "".join(words)
