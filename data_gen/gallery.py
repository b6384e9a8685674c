"""The contact sheet of a family as a page: twelve random shapes that turn under the mouse, and what parameters do.

The page needs no network. Alone it holds all it needs; in a folder of many, plotly.js lies beside the pages once.
"""

import base64
import html
import io

import numpy as np

from data_gen.colours import colours
from data_gen.families import family as rig_of
from data_gen.files import beside
from data_gen.paint import tones
from data_gen.rig import FLOOR
from data_gen.sheet import COLUMNS, ROWS, range_of, shapes, sort_of, sweep

ZOOM = 0.62
CAMERA = {"eye": {"x": 0.62, "y": -1.0, "z": 0.56}, "projection": {"type": "orthographic"}}
CONFIG = {"displaylogo": False, "responsive": True}
PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{name}</title>
<style>
body {{ font: 16px/1.5 Helvetica, Arial, sans-serif; color: #222; background: white; margin: 0 auto; max-width: 1200px;
  padding: 1em 1.5em 3em; }}
h1 {{ margin: 0; font-weight: 500; }} h2 {{ font-weight: 500; border-top: 1px solid #ddd; padding-top: 1em; }}
p {{ color: #666; margin: 0.2em 0; }} .plot {{ height: 78vh; margin: 0; }}
.sweeps {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(500px, 1fr)); gap: 1em; }}
.sweeps figure {{ margin: 0; }} .sweeps img {{ max-width: 100%; display: block; }}
table {{ border-collapse: collapse; }} th, td {{ padding: 0.1em 0.8em; text-align: right; font-weight: 400; }}
th {{ color: #666; }}
</style></head><body>
<h1>{name}</h1><p>{sort}</p><p>{parts}</p>
<figure class="plot" role="img" aria-label="{alt}">{plot}</figure>
<h2>One parameter at a time, the others in the middle</h2><div class="sweeps">{sweeps}</div>
<h2>The twelve shapes, row by row from behind</h2><table>{table}</table>
</body></html>
"""


def write_page(family, path, seed=0, alone=True):
    """Write the page (HTML) of a family; where it is not alone, with plotly.js beside it. ValueError if unknown."""
    rig = rig_of(family)
    plot = figure(rig, seed).to_html(
        full_html=False, include_plotlyjs=True if alone else "directory", default_height="100%", config=CONFIG
    )
    alt = f"{COLUMNS * ROWS} random shapes of {rig.name}, which turn under the mouse"
    parts = ", ".join(rig.part_names)
    sweeps = "".join(_swept(rig, i) for i in range(len(rig.parameters)))
    page = PAGE.format(
        name=rig.name, sort=sort_of(rig), parts=parts, alt=alt, plot=plot, sweeps=sweeps, table=_table(rig, seed)
    )
    with beside(path) as part:
        part.write_text(page, encoding="utf-8")


def figure(rig, seed=0):
    """A plotly figure of twelve random shapes on one floor, four in a row, with equal axes and one trace a part."""
    from plotly.graph_objects import Figure  # drawing is all that needs it

    vertices = rig.vertices(shapes(rig, seed))
    spacing = np.maximum(np.ptp(vertices, axis=1).max(axis=0) * [1.2, 1, 1.35], 0.3)
    step = _places() * spacing
    drawn = [_part(rig, i, vertices, step) for i in range(len(rig.part_names))]
    return Figure([_floor(spacing), *drawn], layout=_layout(vertices, spacing))


def _part(rig, i, vertices, step):
    from plotly.graph_objects import Mesh3d

    own, triangles = vertices[:, rig.vertex_part == i], rig.triangles[rig.triangle_part == i]
    triangles = triangles - triangles.min()
    faces = triangles + own.shape[1] * np.arange(len(own))[:, None, None]
    colour = "#{:02x}{:02x}{:02x}".format(*colours(rig.name)[i])
    return Mesh3d(
        **_upright((own + step[:, None]).reshape(-1, 3)),
        **dict(zip("ijk", faces.reshape(-1, 3).T.astype(np.int32), strict=True)),
        intensity=np.concatenate([tones(one[triangles]) for one in own]).clip(0, 1).astype(np.float32),
        intensitymode="cell",
        colorscale=[[0, "black"], [1, colour]],
        cmin=0,
        cmax=1,
        showscale=False,
        lighting={"ambient": 1, "diffuse": 0, "specular": 0},  # plotly's own light goes out in parallel projection
        hovertemplate=f"<b>{rig.part_names[i]}</b><extra></extra>",
    )


def _floor(spacing):
    from plotly.graph_objects import Mesh3d

    corners = np.array([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]) * spacing * [COLUMNS / 2, 1, ROWS / 2]
    corners[:, 1] = FLOOR - 0.005  # a little below, so that feet and floor do not flicker
    return Mesh3d(**_upright(corners), i=[0, 0], j=[1, 2], k=[2, 3], color="#eef1f4", hoverinfo="skip")


def _layout(vertices, spacing):
    size = spacing * [COLUMNS, 1, ROWS]
    low, high = FLOOR - 0.01, max(vertices[..., 1].max() + 0.01, FLOOR + 0.3)  # at its range plotly cuts a shape off
    ranges = {"x": (-size[0] / 2, size[0] / 2), "y": (-size[2] / 2, size[2] / 2), "z": (low, high)}
    longest = max(size[0], size[2])
    scene = {f"{axis}axis": {"visible": False, "range": ends} for axis, ends in ranges.items()}
    ratio = {axis: 4 * ZOOM * (ends[1] - ends[0]) / longest for axis, ends in ranges.items()}
    margin = dict.fromkeys("lrtb", 0)
    return {
        "margin": margin,
        "paper_bgcolor": "white",
        "scene": {"aspectmode": "manual", "aspectratio": ratio, "camera": CAMERA, **scene},
    }


def _places():
    row, column = np.divmod(np.arange(COLUMNS * ROWS), COLUMNS)
    return np.stack([column - (COLUMNS - 1) / 2, 0 * row, row - (ROWS - 1) / 2], axis=1)


def _upright(points):
    points = points.astype(np.float32)
    return {"x": points[:, 0], "y": -points[:, 2], "z": points[:, 1]}


def _swept(rig, i):
    parameter, stream = rig.parameters[i], io.BytesIO()
    sweep(rig, i).save(stream, "PNG", optimize=True)
    coded = base64.b64encode(stream.getvalue()).decode()
    alt = html.escape(f"five shapes with {parameter.name} from {parameter.low:g} to {parameter.high:g}")
    said = f"<b>{parameter.name}</b> {range_of(parameter)}: {html.escape(parameter.meaning)}"
    return f'<figure><figcaption>{said}</figcaption><img alt="{alt}" src="data:image/png;base64,{coded}"></figure>'


def _table(rig, seed):
    head = "".join(f"<th scope=col>{name}</th>" for name in ("", *rig.parameter_names))
    rows = ["".join(f"<td>{value:.3f}</td>" for value in row) for row in shapes(rig, seed)]
    return f"<tr>{head}</tr>" + "".join(f"<tr><th scope=row>{i}</th>{row}</tr>" for i, row in enumerate(rows, 1))
