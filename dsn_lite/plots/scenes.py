"""Figures of shapes: in a row, source beside target, and the fields that move them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go

from .inputs import array, boxes_of, cloud_of, clouds_of, faces_of, labels_of, titles_of
from .look import BLUE, GREEN, GREY, VERMILLION
from .row import Cloud, Row
from .traces import boxes as box_lines
from .traces import cloud, draw, drawn_points, scene


def shapes(
    points: Any,
    *,
    labels: Any = None,
    titles: Any = None,
    part_names: Any = None,
    faces: Any = None,
    boxes: Any = None,
) -> go.Figure:
    """One cloud (n, 3), or several in a row: (m, n, 3) or a list of clouds of any sizes; tensors or arrays.

    labels (n,) or one array a cloud colour points by part, and part_names make a legend of them. With faces (f, 3), for
    all or one array a shape, meshes are drawn. boxes: corners (p, 8, 3) of each shape, or None, whose edges
    are drawn too. Of more than 4096 points 4096 are drawn. Raises ValueError where points are not finite clouds, or
    where labels, titles, faces or boxes do not fit them.
    """
    clouds = clouds_of(points, "shapes")
    marks, grids = labels_of(labels, clouds, "shapes"), faces_of(faces, clouds, "shapes")
    framed = {i: each for i, each in enumerate(boxes_of(boxes, len(clouds), "shapes")) if each is not None}
    row = Row.of([*clouds, *(each.reshape(-1, 3) for each in framed.values())], len(clouds))
    names = titles_of(titles, len(clouds), "shapes")
    traces = [draw(row, i, c, marks[i], grids[i], names=part_names) for i, c in enumerate(clouds)]
    traces += [box_lines(row, framed)] if framed else []
    said = f"{len(clouds)} shape{'s' * (len(clouds) > 1)} in a row, at one scale" + (
        f": {', '.join(names)}." if names else "."
    )
    return scene(row, traces, names, said, part_names if labels is not None else None)


def compare(
    source: Any,
    target: Any,
    deformed: Any,
    *,
    labels: Any = None,
    target_labels: Any = None,
    faces: Any = None,
    titles: Any = ("source", "target", "deformed, target behind"),
) -> go.Figure:
    """Source, target and deformed source side by side, the target once more as a faint ghost behind the deformed.

    labels (n,) are those of the source, which the deformed keeps; faces (f, 3) those of both. The target is drawn as
    points. Raises ValueError where points are not finite clouds.
    """
    clouds = [cloud_of(each, "compare") for each in (source, target, deformed)]
    row, (mark, behind) = Row.of(clouds), labels_of([labels, target_labels], clouds[:2], "compare")
    (grid,) = faces_of(faces, clouds[:1], "compare")
    traces = [
        draw(row, 0, clouds[0], mark, grid, colour=BLUE),
        draw(row, 1, clouds[1], behind, None, colour=GREEN),
        draw(row, 2, clouds[1], None, None, colour=GREY, ghost=True),
        draw(row, 2, clouds[2], mark, grid, colour=VERMILLION),
    ]
    names = titles_of(titles, 3, "compare")
    return scene(row, traces, names, "A source shape, a target, and the source deformed towards the target.")


def offsets(x: Any, u: Any, *, titles: Any = None) -> go.Figure:
    """Fields u on shapes x, in a row: a line from each point to x + u, with a dot where it ends.

    x and u are (n, 3) or several of that; one x serves for many u. Raises ValueError where they are not finite and of
    one size, or where titles are not one a field.
    """
    clouds, fields = clouds_of(x, "offsets"), clouds_of(u, "offsets")
    clouds = clouds * len(fields) if len(clouds) == 1 else clouds
    points, rows = ([len(each) for each in several] for several in (clouds, fields))
    if points != rows:
        raise ValueError(
            f"offsets: u must have one row for each point of x, got {rows} rows for {points} points; "
            "take one column of a dictionary, A[..., j]"
        )
    pairs = list(zip(clouds, fields, strict=True))
    row = Row.of([*clouds, *(start + field for start, field in pairs)], len(pairs))
    traces = [trace for i, pair in enumerate(pairs) for trace in _field(row, i, *pair)]
    lengths = ", ".join(f"{np.sqrt((field**2).sum(-1).mean()):.2g}" for field in fields)
    names = titles_of(titles, len(pairs), "offsets")
    said = f"Offsets of the points of {len(pairs)} shapes{': ' * bool(names)}{', '.join(names)}; {lengths} long (rms)."
    return scene(row, traces, names, said)


def _field(row: Row, index: int, points: Cloud, field: Cloud) -> list[go.Scatter3d]:
    """A faint cloud, the lines that leave it, and where they end."""
    kept = drawn_points(len(points))
    start, end = points[kept], (points + field)[kept]
    x, y, z = row.place(np.stack([start, end, np.full_like(start, np.nan)], 1).reshape(-1, 3), index)
    look = {"line": {"color": VERMILLION, "width": 3}, "hoverinfo": "skip", "showlegend": False}
    ends = cloud(row, index, points + field, colour=VERMILLION, scale=0.6)
    return [
        cloud(row, index, points, colour=GREY, ghost=True),
        go.Scatter3d(x=x, y=y, z=z, mode="lines", **look),
        ends,
    ]


def modes(
    x: Any, A: Any, columns: Sequence[int] = (0, 1, 2, 3), amount: float = 0.1, *, labels: Any = None
) -> go.Figure:
    """x + amount A_j for some columns j of a dictionary A (n, 3, k), in a row, x itself faint behind each.

    Raises ValueError where A does not fit x or has no such column.
    """
    points, fields = cloud_of(x, "modes"), array(A)
    if fields.ndim != 3 or fields.shape[:2] != points.shape:
        raise ValueError(
            f"modes: A must be (n, 3, k) for the {len(points)} points of x, got {fields.shape}; use space.dictionary(x)"
        )
    if not columns or not set(columns) <= set(range(fields.shape[-1])):
        raise ValueError(
            f"modes: columns must lie in 0 ... {fields.shape[-1] - 1}, got {tuple(columns)}; "
            f"A has k = {fields.shape[-1]}"
        )
    moved = [points + amount * fields[..., j] for j in columns]
    row, marks = Row.of([points, *moved], len(moved)), labels_of(labels, moved, "modes")
    traces = [cloud(row, i, points, colour=GREY, ghost=True) for i in range(len(moved))]
    traces += [cloud(row, i, each, marks[i], colour=VERMILLION) for i, each in enumerate(moved)]
    said = (
        f"A shape moved by {amount:+g} along columns {', '.join(map(str, columns))} of its dictionary, one at a time."
    )
    return scene(row, traces, [f"{amount:+g} column {j}" for j in columns], said)
