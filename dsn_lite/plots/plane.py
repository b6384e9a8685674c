"""Figures of the plane: curves and points whose shape, angle and distance mean something."""

from itertools import cycle
from typing import Any

import numpy as np
import plotly.graph_objects as go

from .inputs import array
from .laws import LEGEND
from .look import BLACK, GREY, LINES, PALETTE, dress
from .tables import STROKES


def plane(curves: dict[str, Any], points: dict[str, Any] | None = None, *, x: str, y: str) -> go.Figure:
    """Curves (m, 2) and named points (2,) with the axes at one scale; x and y are what the axes are called.

    Raises ValueError where a curve is no list of places in the plane, or a point no place.
    """
    drawn = {name: array(curve) for name, curve in curves.items()}
    marked = {name: array(point) for name, point in (points or {}).items()}
    _check(drawn, marked)
    looks = zip(drawn.items(), cycle(PALETTE), cycle(STROKES))
    figure = go.Figure([_curve(name, curve, colour, dash) for (name, curve), colour, (dash, _) in looks])
    figure.add_traces([_point(name, point) for name, point in marked.items()])
    for update, title in ((figure.update_xaxes, x), (figure.update_yaxes, y)):
        update(title=title, gridcolor=LINES, zeroline=True, zerolinecolor=GREY, dtick=0.5)
    figure.update_yaxes(scaleanchor="x", scaleratio=1)
    figure.update_layout(legend=LEGEND, margin={"l": 80, "r": 20, "t": 60, "b": 70})
    told = "".join(f", {name} at ({point[0]:.2f}, {point[1]:.2f})" for name, point in marked.items())
    return dress(figure, f"Curves in the plane of {x} and {y}: {', '.join(drawn)}{told}.", width=720, height=560)


def _curve(name: str, curve: np.ndarray, colour: str, dash: str) -> go.Scatter:
    line = {"color": colour, "dash": dash, "width": 3}
    return go.Scatter(x=curve[:, 0], y=curve[:, 1], name=name, mode="lines", line=line, hoverinfo="skip")


def _point(name: str, point: np.ndarray) -> go.Scatter:
    mark = {"color": BLACK, "size": 11}
    at = {"x": point[:1], "y": point[1:], "text": [name], "textposition": "top right"}
    return go.Scatter(mode="markers+text", marker=mark, showlegend=False, cliponaxis=False, hoverinfo="skip", **at)


def _check(curves: dict[str, np.ndarray], points: dict[str, np.ndarray]) -> None:
    wrong = [name for name, curve in curves.items() if curve.ndim != 2 or curve.shape[1] != 2]
    wrong += [name for name, point in points.items() if point.shape != (2,)]
    if wrong:
        given = (curves | points)[wrong[0]].shape
        raise ValueError(f"plane: a curve must be (m, 2) and a point (2,), {wrong[0]!r} is {given}; stack its two axes")
