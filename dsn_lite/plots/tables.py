"""Numbers against names or numbers: which space breaks which law, a quantity against a choice or against another."""

from collections.abc import Sequence
from itertools import cycle
from typing import Any, Literal

import plotly.graph_objects as go

from .inputs import array
from .laws import LEGEND
from .look import BLUE, GREY, LINES, PALETTE, dress

STROKES = (
    ("solid", "circle"),
    ("dash", "diamond"),
    ("dot", "square"),
    ("dashdot", "x"),
)  # so that colour is not needed


def law_table(residuals: Any, spaces: Sequence[str], laws: Sequence[str]) -> go.Figure:
    """Residuals (spaces, laws) as a table of cells, the darker the larger; what holds to rounding shows a 0.

    Raises ValueError where the numbers are not one a space and law.
    """
    values = array(residuals)
    if values.shape != (len(spaces), len(laws)):
        raise ValueError(
            f"law_table: residuals must be one a space and law, ({len(spaces)}, {len(laws)}), got {values.shape}; "
            "use byhand.who_breaks_what"
        )
    text = [["0" if value < 1e-9 else f"{value:.2f}" for value in row] for row in values]
    scale = [[0, "white"], [1, BLUE]]
    cells = go.Heatmap(z=values, x=_broken(laws), y=list(spaces), text=text, texttemplate="%{text}", colorscale=scale)
    figure = go.Figure(cells.update(showscale=False, xgap=3, ygap=3, hoverinfo="skip"))
    figure.update_xaxes(side="top", tickangle=0)
    figure.update_yaxes(autorange="reversed", automargin=True, ticksuffix="  ")
    figure.update_layout(margin={"l": 20, "r": 20, "t": 110, "b": 20})
    broken = {
        name: [law for law, value in zip(laws, row, strict=True) if value >= 1e-9]
        for name, row in zip(spaces, values, strict=True)
    }
    said = " ".join(f"{name} breaks {', '.join(broken[name]) or 'none'}." for name in spaces)
    return dress(figure, f"Residual of each law for each space. {said}", width=860, height=140 + 52 * len(spaces))


def bars(values: dict[Any, float], *, x: str, y: str) -> go.Figure:
    """One bar a choice: values by choice, x and y what the axes are called."""
    figure = go.Figure(go.Bar(x=[str(choice) for choice in values], y=list(values.values()), marker={"color": BLUE}))
    figure.update_xaxes(title=x, type="category", automargin=True)
    figure.update_yaxes(title=y, gridcolor=LINES, zeroline=False)
    figure.update_layout(margin={"l": 90, "r": 20, "t": 20, "b": 70})
    return dress(
        figure, f"{y} against {x}: " + ", ".join(f"{k}: {v:.2g}" for k, v in values.items()), width=720, height=380
    )


def lines(values: dict[str, dict[Any, float]], *, x: str, y: str, log: bool | Literal["x"] = False) -> go.Figure:
    """One line a name: numbers by number, x and y what the axes are called; with `log` both are logarithmic, or one."""
    looks = zip(values.items(), cycle(PALETTE), cycle(STROKES))
    figure = go.Figure([_stroke(name, each, colour, *stroke) for (name, each), colour, stroke in looks])
    even, powers = {"type": "linear"}, {"type": "log", "exponentformat": "power", "dtick": 1}
    figure.update_xaxes(title=x, gridcolor=LINES, zeroline=False, linecolor=GREY, **(powers if log else even))
    figure.update_yaxes(title=y, gridcolor=LINES, zeroline=False, **(powers if log is True else even))
    figure.update_layout(legend=LEGEND, margin={"l": 90, "r": 20, "t": 60, "b": 70})
    told = [f"{name} goes from {each[min(each)]:.2g} to {each[max(each)]:.2g}" for name, each in values.items()]
    return dress(figure, f"{y} against {x}: {', '.join(told)}.", width=720, height=420)


def _stroke(name: str, numbers: dict[Any, float], colour: str, dash: str, symbol: str) -> go.Scatter:
    look = {"line": {"color": colour, "width": 3, "dash": dash}, "marker": {"symbol": symbol, "size": 9}}
    return go.Scatter(x=list(numbers), y=list(numbers.values()), mode="lines+markers", name=name, **look)


def _broken(laws: Sequence[str]) -> list[str]:
    """Names on several lines, so that columns stay narrow."""
    return [law.replace("_", "<br>") for law in laws]
