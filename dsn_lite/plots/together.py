"""Shapes where they are, in one space: for seeing that one is a shifted copy of another."""

from typing import Any

import numpy as np
import plotly.graph_objects as go

from .inputs import clouds_of, titles_of
from .look import PALETTE
from .row import Row
from .traces import LEGEND, mesh, scene


def together(points: Any, *, faces: Any, titles: Any = None) -> go.Figure:
    """Meshes (m, n, 3) with the same faces (f, 3), not in a row but where they lie, each in a colour of its own.

    Raises ValueError where points are not finite, or titles are not one a shape.
    """
    clouds, faces = clouds_of(points, "together"), np.asarray(faces)
    names, row = titles_of(titles, len(clouds), "together"), Row.of(clouds, count=1)
    traces = [mesh(row, 0, each, faces, colour=PALETTE[i % len(PALETTE)]) for i, each in enumerate(clouds)]
    for trace, name in zip(traces, names, strict=False):
        trace.update(name=name, showlegend=True, lighting={"ambient": 1, "diffuse": 0})  # flat shapes seen from behind
    figure = scene(row, traces, [], f"{len(clouds)} shapes where they lie: {', '.join(names)}.")
    return figure.update_layout(legend=LEGEND, margin={"b": 60}, width=560, height=figure.layout.height + 60)
