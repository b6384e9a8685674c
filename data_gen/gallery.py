"""A page with twelve random shapes of a family, which turns under the mouse and needs no network."""

import html

import numpy as np

from data_gen.families import family as rig_of
from data_gen.files import beside
from data_gen.meshes import PALETTE
from data_gen.part import Box
from data_gen.rig import FLOOR

COLUMNS, ROWS = 4, 3
SPACING = np.array([1.35, 1.02, 1.5])
ZOOM = 0.45
CAMERA = {"eye": {"x": -0.3, "y": -1.1, "z": 0.75}, "projection": {"type": "orthographic"}}
SHADES = np.repeat([0.72, 0.72, 0.5, 1.0, 0.86, 0.86], 2)
"""Brightness of the twelve triangles of a box, two a face: low and high x, y, z."""
CONFIG = {"displaylogo": False, "responsive": True}
PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{name}</title>
<style>html, body {{ margin: 0; height: 100%; background: white; }} figure {{ margin: 0; height: 100%; }}</style></head>
<body><figure role="img" aria-label="{alt}">{plot}</figure></body></html>
"""


def show(family, path, seed=0):
    """Write the page (HTML) for a family. Raises ValueError for an unknown one."""
    rig = rig_of(family)
    parts = ", ".join(rig.part_names)
    alt = f"{COLUMNS * ROWS} random shapes of the family {rig.name}, each part in a colour of its own: {parts}"
    plot = figure(rig, seed).to_html(full_html=False, include_plotlyjs=True, default_height="100vh", config=CONFIG)
    with beside(path) as part:
        part.write_text(PAGE.format(name=rig.name, alt=html.escape(alt), plot=plot), encoding="utf-8")


def figure(rig, seed=0):
    """A plotly figure of twelve random shapes on one floor, four in a row, with equal axes and one colour a part."""
    from plotly.graph_objects import Figure  # drawing is all that needs it

    parameters = rig.draw(COLUMNS * ROWS, np.random.default_rng(seed))
    notes = [_note(rig, row) for row in parameters]
    boxes = rig.boxes(parameters)
    parts = [_part(name, boxes[:, i], PALETTE[i % len(PALETTE)], notes) for i, name in enumerate(rig.part_names)]
    keys = [_key(name, PALETTE[i % len(PALETTE)]) for i, name in enumerate(rig.part_names)]
    return Figure([_floor(), *parts, *keys], layout=_layout(rig))


def _part(name, boxes, colour, notes):
    from plotly.graph_objects import Mesh3d

    corners, triangles, _ = Box.unit_mesh()
    vertices = corners * boxes[:, None, 12:] + boxes[:, None, :3] + _places()[:, None]
    faces = triangles + len(corners) * np.arange(len(boxes))[:, None, None]
    return Mesh3d(
        **_upright(vertices.reshape(-1, 3)),
        **dict(zip("ijk", faces.reshape(-1, 3).T, strict=True)),
        legendgroup=name,
        facecolor=np.tile(_shaded(colour), len(boxes)),
        lighting={"ambient": 1, "diffuse": 0, "specular": 0},  # plotly's own light goes out in parallel projection
        text=np.repeat(notes, len(corners)),
        hovertemplate=f"<b>{name}</b><br>%{{text}}<extra></extra>",
    )


def _key(name, colour):
    from plotly.graph_objects import Scatter3d  # the legend of a mesh would show a shade of its colour

    marker = {"color": colour, "symbol": "square"}
    return Scatter3d(x=[None], y=[None], z=[None], mode="markers", marker=marker, name=name, legendgroup=name)


def _shaded(colour):
    rgb = np.array(list(bytes.fromhex(colour[1:])))
    return ["#{:02x}{:02x}{:02x}".format(*(rgb * shade).astype(int)) for shade in SHADES]


def _floor():
    from plotly.graph_objects import Mesh3d

    corners = np.array([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]) * SPACING * [COLUMNS / 2, 1, ROWS / 2]
    corners[:, 1] = FLOOR - 0.005  # a little below, so that feet and floor do not flicker
    return Mesh3d(**_upright(corners), i=[0, 0], j=[1, 2], k=[2, 3], color="#e9edf1", hoverinfo="skip")


def _layout(rig):
    title = f"<b>{rig.name}</b>  {COLUMNS * ROWS} random shapes"
    return {
        "title": {"text": title, "x": 0.5, "y": 0.96, "font": {"size": 26}},
        "font": {"family": "Helvetica, Arial, sans-serif", "size": 18, "color": "#222"},
        "legend": {"orientation": "h", "x": 0.5, "xanchor": "center", "y": 0.03, "itemsizing": "constant"},
        "margin": {"l": 0, "r": 0, "t": 0, "b": 0},
        "paper_bgcolor": "white",
        "scene": _scene(),
    }


def _scene():
    size = _upright(np.array([[COLUMNS, 1, -ROWS]]) * SPACING)
    axes = {f"{axis}axis": {"visible": False, "range": [-edge[0] / 2, edge[0] / 2]} for axis, edge in size.items()}
    ratio = {axis: ZOOM * edge[0] for axis, edge in size.items()}
    return {"aspectmode": "manual", "aspectratio": ratio, "camera": CAMERA, **axes}


def _places():
    row, column = np.divmod(np.arange(COLUMNS * ROWS), COLUMNS)
    steps = np.stack([column - (COLUMNS - 1) / 2, 0 * row, row - (ROWS - 1) / 2], axis=1)
    return steps * SPACING


def _upright(points):
    return {"x": points[:, 0], "y": -points[:, 2], "z": points[:, 1]}


def _note(rig, row):
    return "<br>".join(f"{name} {value:.3f}" for name, value in zip(rig.parameter_names, row, strict=True))
