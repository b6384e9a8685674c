"""What plotly draws at a place in the row: clouds and meshes, coloured by part."""

import numpy as np
import plotly.graph_objects as go
from jaxtyping import Float, Int

from .look import BLUE, GREY, PALETTE, TEXT, dress
from .row import Cloud, Row

ROUND = (0, 1, 3, 2, 0, 4, 5, 7, 6, 4, 5, 1, 3, 7, 6, 2)  # along all edges of a box, corners counted in binary
MOST_POINTS = 4096  # drawn of one cloud
COLOURS = (*PALETTE, GREY)  # a part's colour is its label; points of no part are grey
SCALE = [[(i + end) / len(COLOURS), colour] for i, colour in enumerate(COLOURS) for end in (0, 1)]
PAINT = {"colorscale": SCALE, "cmin": 0, "cmax": len(COLOURS)}
LIGHT = {
    "ambient": 0.55,
    "diffuse": 0.7,
    "specular": 0.1,
    "roughness": 0.9,
    "fresnel": 0.1,
    "facenormalsepsilon": 0,
    "vertexnormalsepsilon": 0,
}
LEGEND = {"orientation": "h", "x": 0.5, "xanchor": "center", "y": 0, "yanchor": "top", "itemsizing": "constant"}


def drawn_points(n: int) -> Int[np.ndarray, " m"]:
    """Which of n points are drawn: all, or 4096 of them spread evenly over their order."""
    return np.arange(n) if n <= MOST_POINTS else np.linspace(0, n - 1, MOST_POINTS).astype(int)


def colours(labels: Int[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Places on SCALE, each in the middle of its band: parts 0, 1, ... take the palette in turn, label -1 is grey."""
    return np.where(labels < 0, len(PALETTE), labels % len(PALETTE)).astype(np.float32) + 0.5


def draw(row: Row, index: int, points: Cloud, labels=None, faces=None, **look) -> go.Scatter3d | go.Mesh3d:
    """A shape at its place in the row: a mesh where faces are known, else a cloud."""
    if faces is None:
        return cloud(row, index, points, labels, **look)
    look.pop("names", None)
    return mesh(row, index, points, faces, labels, **look)


def cloud(
    row: Row, index: int, points: Cloud, labels=None, *, colour=BLUE, names=None, ghost=False, scale=1.0
) -> go.Scatter3d:
    """A cloud at its place, coloured by part where labels (n,) are known; a ghost is faint and small."""
    kept = drawn_points(len(points))
    x, y, z = row.place(points[kept], index)
    size = row.marker_size(len(kept)) * (0.7 if ghost else scale)
    paint, hover = {"color": colour}, {"hoverinfo": "skip"}
    if labels is not None:
        paint = PAINT | {"color": colours(labels[kept])}
        hover = {"hoverinfo": "text", "hovertext": [part_name(label, names) for label in labels[kept].tolist()]}
    marker = {"size": size, "line": {"width": 0}, **paint}
    return go.Scatter3d(
        x=x, y=y, z=z, mode="markers", marker=marker, opacity=0.35 if ghost else 1.0, showlegend=False, **hover
    )


def mesh(row: Row, index: int, points: Cloud, faces, labels=None, *, colour=BLUE) -> go.Mesh3d:
    """A mesh at its place, its faces coloured by the part of their first corner."""
    x, y, z = row.place(points, index)
    i, j, k = np.ascontiguousarray(faces.T, dtype=np.int32)
    paint = {"color": colour}
    if labels is not None:
        paint = PAINT | {"intensity": colours(labels[faces[:, 0]]), "intensitymode": "cell", "showscale": False}
    look = {"flatshading": True, "lighting": LIGHT, "hoverinfo": "skip", "showlegend": False}
    return go.Mesh3d(x=x, y=y, z=z, i=i, j=j, k=k, **paint, **look)


def edges(row: Row, corners: dict[int, Float[np.ndarray, "_ 8 3"]]) -> tuple[np.ndarray, ...]:
    """What plotly is given for the edges of the boxes at each place: one line, broken between boxes."""
    lines = [np.concatenate([each[:, ROUND], np.full((len(each), 1, 3), np.nan)], 1) for each in corners.values()]
    placed = [row.place(line.reshape(-1, 3), index) for index, line in zip(corners, lines, strict=True)]
    return tuple(np.concatenate(axis) for axis in zip(*placed, strict=True))


def boxes(row: Row, corners: dict[int, Float[np.ndarray, "_ 8 3"]]) -> go.Scatter3d:
    """The edges of boxes, by their place in the row."""
    x, y, z = edges(row, corners)
    look = {"line": {"color": TEXT, "width": 3}, "hoverinfo": "skip", "showlegend": False}
    return go.Scatter3d(x=x, y=y, z=z, mode="lines", **look)


def part_name(label: int, names) -> str:
    """What a reader sees for a label."""
    if label < 0:
        return "no part"
    return names[label] if names is not None and label < len(names) else f"part {label}"


def scene(row: Row, traces: list, titles: list[str], said: str, part_names=None) -> go.Figure:
    """The figure of a row, with a legend of the parts where they have names."""
    figure, layout = go.Figure(traces), row.layout(titles)
    if part_names is not None:
        figure.add_traces([_key(label, name) for label, name in enumerate(part_names)])
        layout |= {
            "showlegend": True,
            "legend": LEGEND,
            "height": layout["height"] + 70,
            "width": max(layout["width"], 640),
        }
        layout["margin"] = layout["margin"] | {"b": 70}
    figure.update_layout(layout)
    return dress(figure, said, width=layout["width"], height=layout["height"])


def _key(label: int, name: str) -> go.Scatter3d:
    """An entry of the legend: a trace without points."""
    colour = PALETTE[label % len(PALETTE)]
    marker = {"color": colour, "size": 12}
    return go.Scatter3d(x=[None], y=[None], z=[None], mode="markers", name=str(name).replace("_", " "), marker=marker)
