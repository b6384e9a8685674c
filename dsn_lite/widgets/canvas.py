"""The one place where widgets draw in 3D: a row of shapes whose points can be moved.

Everything that a browser-side view will do instead is in `Canvas`: it is given shapes once, then only new points.
"""

from typing import Any

import numpy as np
import plotly.graph_objects as go

from ..plots.inputs import cloud_of, clouds_of, faces_of, labels_of, titles_of
from ..plots.look import BLUE, GREY
from ..plots.row import Row
from ..plots.traces import cloud, draw, drawn_points, scene


class Canvas:
    """A row of clouds, or of meshes where faces are given, in one figure, `canvas.view`.

    `points` as for plots.shapes; `ghosts` maps the place of a shape to another cloud, drawn faintly behind it. There is
    room for the clouds `also`, and for movement: `room` 1.3 leaves 30 %. Raises ValueError where things do not fit.
    """

    def __init__(
        self, points: Any, *, labels=None, titles=None, faces=None, ghosts=None, colours=None, also=(), room=1.0
    ):
        shapes = clouds_of(points, "Canvas")
        behind = {index: cloud_of(ghost, "Canvas") for index, ghost in (ghosts or {}).items()}
        extremes = [cloud_of(each, "Canvas") for each in also]
        self._row = Row.of([*shapes, *behind.values(), *extremes], len(shapes), room)
        self._sizes = [len(each) for each in shapes]
        self._meshes = [grid is not None for grid in faces_of(faces, shapes, "Canvas")]
        looks = zip(
            shapes,
            labels_of(labels, shapes, "Canvas"),
            faces_of(faces, shapes, "Canvas"),
            colours or [BLUE] * len(shapes),
            strict=True,
        )
        traces = [draw(self._row, i, c, mark, grid, colour=colour) for i, (c, mark, grid, colour) in enumerate(looks)]
        traces += [cloud(self._row, i, ghost, colour=GREY, ghost=True) for i, ghost in behind.items()]
        names = titles_of(titles, len(shapes), "Canvas")
        said = f"{len(shapes)} shapes that can be moved{': ' if names else ''}{', '.join(names)}."
        self.view = go.FigureWidget(scene(self._row, traces, names, said))
        self.view._config = self.view._config | {"displaylogo": False}

    def update(self, index: int, points: Any) -> None:
        """Moves the shape at `index` to new points (n, 3), as many as it had."""
        self.update_all({index: points})

    def update_all(self, moved: dict[int, Any]) -> None:
        """Moves several shapes at once, in one message to the browser.

        Raises ValueError where points are not finite, or not as many as the shape has.
        """
        clouds = {index: cloud_of(points, "Canvas.update") for index, points in moved.items()}
        for index, points in clouds.items():
            if len(points) != self._sizes[index]:
                raise ValueError(
                    f"Canvas.update: shape {index} has {self._sizes[index]} points, got {len(points)}; "
                    "make a new Canvas for another shape"
                )
        with self.view.batch_update():
            for index, points in clouds.items():
                self._move(self.view.data[index], index, points)

    def replace(self, index: int, points: Any, faces: Any, colours: Any) -> None:
        """Draws another mesh in place of the one at `index`: points (n, 3), faces (f, 3), colours (f, 3), 0 to 255.

        Raises ValueError where faces are not of the points.
        """
        mesh = cloud_of(points, "Canvas.replace")
        (faces,), trace = faces_of([faces], [mesh], "Canvas.replace"), self.view.data[index]
        self._sizes[index] = len(mesh)
        with self.view.batch_update():
            trace.i, trace.j, trace.k = np.ascontiguousarray(faces.T, dtype=np.int32)
            trace.facecolor = [f"rgb({r:.0f},{g:.0f},{b:.0f})" for r, g, b in np.asarray(colours).tolist()]
            self._move(trace, index, mesh)

    def points(self, index: int):
        """The three arrays that are drawn for a shape, in plotly's axes: x, -z and y, moved along the row."""
        trace = self.view.data[index]
        return trace.x, trace.y, trace.z

    def _move(self, trace, index: int, points) -> None:
        kept = points if self._meshes[index] else points[drawn_points(len(points))]
        trace.x, trace.y, trace.z = self._row.place(kept, index)
