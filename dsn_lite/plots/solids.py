"""Meshes from files, in a row, in their own colours."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import plotly.graph_objects as go

from .inputs import titles_of
from .look import GREY
from .row import Row
from .traces import LIGHT, scene

if TYPE_CHECKING:
    import trimesh


def meshes(
    several: "trimesh.Trimesh | trimesh.Scene | Sequence[trimesh.Trimesh | trimesh.Scene]",
    *,
    titles: Sequence[str] | None = None,
) -> go.Figure:
    """One mesh or scene, or several side by side at one scale, in the colour of their material."""
    from ..meshes.surface import parts, placed

    several = list(several) if isinstance(several, Sequence) else [several]
    solids = [
        [(placed(g.vertices, matrix), np.asarray(g.faces), _colour(g)) for g, matrix in parts(each).values()]
        for each in several
    ]
    row = Row.of([np.concatenate([vertices for vertices, _, _ in solid]) for solid in solids])
    traces = [_solid(row, i, *part) for i, solid in enumerate(solids) for part in solid]
    names = titles_of(titles, len(solids), "meshes")
    return scene(row, traces, names, f"{len(solids)} meshes in a row, at one scale: {', '.join(names)}.")


def _colour(geometry: "trimesh.Trimesh") -> list[str] | str:
    """The colour of each face, or grey where the mesh has none."""
    visual = geometry.visual
    if not visual.defined:
        return GREY
    corners = visual.to_color().vertex_colors if visual.kind == "texture" else visual.vertex_colors
    colours = np.broadcast_to(corners, (len(geometry.vertices), 4))[geometry.faces[:, 0]]
    return [f"rgb({r},{g},{b})" for r, g, b, _ in colours]


def _solid(row: Row, index: int, vertices: np.ndarray, faces: np.ndarray, colour: list[str] | str) -> go.Mesh3d:
    x, y, z = row.place(vertices, index)
    i, j, k = np.ascontiguousarray(faces.T, dtype=np.int32)
    paint = {"color": colour} if isinstance(colour, str) else {"facecolor": colour}
    return go.Mesh3d(x=x, y=y, z=z, i=i, j=j, k=k, flatshading=True, lighting=LIGHT, hoverinfo="skip", **paint)
