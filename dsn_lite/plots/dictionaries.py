"""Figures of dictionaries: which parts a mode moves, where on a shape, and how it fares beside others."""

from collections.abc import Sequence
from itertools import cycle
from typing import Any

import numpy as np
import plotly.graph_objects as go

from .inputs import array, clouds_of, titles_of
from .laws import LEGEND
from .look import BLUE, FONT, GREY, LINES, ORANGE, PALETTE, VERMILLION, dress
from .row import Row
from .traces import cloud, drawn_points, scene

WARMTH = [[0, "#DADADA"], [0.4, ORANGE], [0.75, VERMILLION], [1, "#6B2300"]]  # ever darker, so read without colour too
PATTERNS = ("", "/", ".", "x")
BAR = {"thickness": 16, "outlinewidth": 0, "tickfont": {"size": 16}}


def mode_heat(energy: Any, kinds: Sequence[str], columns: Sequence[int] | None = None) -> go.Figure:
    """The share of each mode's squared motion that lies in each kind of part: energy (K, k), darker is more.

    Modes are drawn in the order of the kind that they move most, under their own numbers or the `columns` given. Raises
    ValueError where the shares are not one a kind and mode.
    """
    shares = array(energy)
    names = list(range(shares.shape[-1])) if columns is None else list(columns)
    if shares.shape != (len(kinds), len(names)):
        raise ValueError(
            f"mode_heat: energy must be one share a kind and mode, ({len(kinds)}, {len(names)}), got {shares.shape}; "
            "take reading.energy_by_kind.mean(0)"
        )
    main = shares.argmax(0)
    order = np.lexsort((-shares.max(0), main))
    x, y = [str(names[j]) for j in order], [kind.replace("_", " ") for kind in kinds]
    cells = go.Heatmap(z=shares[:, order], x=x, y=y, colorscale=[[0, "white"], [1, BLUE]], zmin=0, zmax=1)
    cells.update(xgap=1, ygap=1, hovertemplate="mode %{x}, %{y}: %{z:.0%}<extra></extra>")
    figure = go.Figure(cells.update(colorbar=BAR | {"tickformat": ".0%", "dtick": 0.25}))
    figure.update_xaxes(type="category", title="mode", showticklabels=len(x) <= 32, tickangle=0, tickfont={"size": 15})
    figure.update_yaxes(autorange="reversed", automargin=True, ticksuffix="  ")
    figure.update_layout(margin={"l": 20, "r": 20, "t": 20, "b": 70})
    counts = {kind: int((main == row).sum()) for row, kind in enumerate(y)}
    told = ", ".join(f"{kind} {count}" for kind, count in counts.items() if count)
    said = f"Share of the squared motion of {len(x)} modes by kind of part; modes that move a kind most: {told}."
    return dress(figure, said, width=860, height=130 + 34 * len(y))


def mode_on_shapes(points: Any, fields: Any, *, titles: Any = None) -> go.Figure:
    """Shapes in a row, each point painted by how far one mode moves it: light where it is still, dark where it moves.

    points and fields, such as A[..., j], are (m, n, 3) or lists of (n, 3); the scale is the same for all shapes. Raises
    ValueError where they are not finite and of one size.
    """
    clouds, moved = clouds_of(points, "mode_on_shapes"), clouds_of(fields, "mode_on_shapes")
    if [len(each) for each in clouds] != [len(each) for each in moved]:
        raise ValueError(
            f"mode_on_shapes: fields must have one row for each point, got {[len(each) for each in moved]} rows for "
            f"{[len(each) for each in clouds]} points; take one column of a dictionary, A[..., j]"
        )
    lengths = [np.linalg.norm(field, axis=1) for field in moved]
    row, names = Row.of(clouds), titles_of(titles, len(clouds), "mode_on_shapes")
    paint = {"colorscale": WARMTH, "cmin": 0, "cmax": float(max(map(np.max, lengths))) or 1.0}
    traces = [cloud(row, i, each) for i, each in enumerate(clouds)]
    for trace, length in zip(traces, lengths, strict=True):
        trace.marker.update(color=length[drawn_points(len(length))].astype(np.float32), **paint)
    traces[0].marker.update(showscale=True, colorbar=BAR | {"len": 0.8, "title": {"text": "moves by", "side": "right"}})
    shares = ", ".join(f"{(length > 0.1 * paint['cmax']).mean():.0%}" for length in lengths)
    said = f"{len(clouds)} shapes painted by how far a mode moves each point; of their points {shares} move visibly."
    figure = scene(row, traces, names, said)
    return figure.update_layout(width=figure.layout.width + 90, margin={"r": 90})


def paired_bars(values: dict[str, dict[str, float]], *, y: str) -> go.Figure:
    """Groups of bars, one bar a name in each, with its number above: values by group, then by name."""
    names = list(dict.fromkeys(name for group in values.values() for name in group))
    figure = go.Figure()
    for name, colour, pattern in zip(names, cycle(PALETTE), cycle(PATTERNS)):
        heights = [group.get(name) for group in values.values()]
        text = ["" if height is None else f"{height:.2f}" for height in heights]
        look = {"color": colour, "pattern": {"shape": pattern, "solidity": 0.35}}
        figure.add_trace(go.Bar(x=list(values), y=heights, name=name, text=text, textposition="outside", marker=look))
    figure.update_xaxes(type="category")
    figure.update_yaxes(title=y, gridcolor=LINES, zeroline=True, zerolinecolor=GREY)
    figure.update_layout(barmode="group", legend=LEGEND, margin={"l": 90, "r": 20, "t": 60, "b": 60})
    figure.update_traces(textfont={"size": FONT["size"] - 3}, cliponaxis=False)
    told = "; ".join(
        f"{group}: " + ", ".join(f"{name} {value:.2f}" for name, value in each.items())
        for group, each in values.items()
    )
    return dress(figure, f"{y}, {told}.".replace("<br>", " "), width=720, height=420)
