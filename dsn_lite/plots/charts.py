"""Figures of numbers: the course of a training and the spectrum of a linear space."""

from collections.abc import Sequence
from math import log10
from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from .inputs import array
from .laws import LEGEND, decades
from .look import BLUE, FONT, GREY, LINES, TEXT, VERMILLION, dress


def curve(history: Sequence[Any], floor: float | None = None) -> go.Figure:
    """Training loss and validation CD against seconds, both on a log axis; `floor` is a dashed line.

    history holds Records, as in training.Training(...).history: .seconds, .loss, .validation_cd.
    """
    figure = go.Figure([_line(history, "loss", BLUE, "circle"), _line(history, "validation_cd", VERMILLION, "diamond")])
    if floor is not None:
        figure.add_hline(floor, line={"dash": "dash", "color": TEXT})
        at = {"x": 0, "xref": "paper", "xanchor": "left", "y": log10(floor), "yanchor": "top"}
        figure.add_annotation(text="sampling floor", showarrow=False, **at)
    figure.update_xaxes(title="seconds", gridcolor=LINES, zeroline=False, rangemode="tozero", linecolor=GREY)
    figure.update_yaxes(type="log", title="Chamfer distance", gridcolor=LINES, exponentformat="power", dtick="D2")
    figure.update_layout(legend=LEGEND, margin={"l": 90, "r": 20, "t": 60, "b": 70})
    last = f" The last validation is {history[-1].validation_cd:.2e}." if history else ""
    return dress(figure, f"Training loss and validation Chamfer distance against seconds.{last}", width=720, height=420)


def _line(history: Sequence[Any], field: str, colour: str, symbol: str) -> go.Scatter:
    """One quantity of a history against seconds."""
    names = {"loss": "training loss", "validation_cd": "validation CD"}
    seconds, values = ([getattr(record, name) for record in history] for name in ("seconds", field))
    look = {"line": {"color": colour, "width": 3}, "marker": {"symbol": symbol, "size": 9}}
    return go.Scatter(x=seconds, y=values, mode="lines+markers", name=names[field], **look)


def spectrum(values: Any) -> go.Figure:
    """Share of the variance that the first k principal axes explain, against k, from singular values, largest first.

    Beside it, on a log axis, the share left unexplained: there the true number of freedoms is a cliff. Raises
    ValueError where the singular values are not a finite, non-zero (k,).
    """
    singular = array(values).astype(np.float64)
    if singular.ndim != 1 or not len(singular) or not np.isfinite(singular).all() or not singular.any():
        raise ValueError(
            f"spectrum: values must be the singular values (k,), finite and not all 0, got {singular.shape}; "
            "torch.linalg.svdvals gives them"
        )
    k, power = np.arange(1, len(singular) + 1), singular**2
    left = np.append(power[::-1].cumsum()[::-1][1:], 0) / power.sum()
    figure = make_subplots(1, 2, horizontal_spacing=0.16, subplot_titles=("explained", "left unexplained"))
    figure.add_trace(go.Bar(x=k, y=1 - left, marker={"color": BLUE}), 1, 1)
    kept = left > 0
    figure.add_trace(go.Scatter(x=k[kept], y=left[kept], mode="markers", marker={"color": VERMILLION, "size": 9}), 1, 2)
    figure.update_xaxes(title="k, principal axes", range=[0.4, len(k) + 0.6], zeroline=False)
    figure.update_yaxes(gridcolor=LINES, zeroline=False)
    figure.update_yaxes(tickformat=".0%", range=[0, 1.02], row=1, col=1)
    ends = decades(left[kept].tolist())
    every = 1 + (ends[1] - ends[0]) // 6  # decades between two ticks
    figure.update_yaxes(type="log", exponentformat="power", dtick=every, range=ends, row=1, col=2)
    figure.update_annotations(font={"size": FONT["size"]})
    figure.update_layout(showlegend=False, margin={"l": 80, "r": 20, "t": 50, "b": 70})
    most = int((1 - left >= 0.99).argmax()) + 1
    said = f"The first {most} of {len(k)} principal axes explain 99 % of the variance."
    return dress(figure, said, width=860, height=380)
