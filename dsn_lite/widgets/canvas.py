"""The one place where widgets draw in 3D: a row of shapes whose points can be moved.

Everything that a browser-side view will do instead is in `Canvas`: it is given shapes once, then only new points.
"""

from typing import Any

import numpy as np
import plotly.graph_objects as go

from ..plots.inputs import boxes_of, cloud_of, clouds_of, faces_of, labels_of, titles_of
from ..plots.look import BLUE, GREY
from ..plots.row import Row
from ..plots.traces import boxes as box_lines
from ..plots.traces import cloud, draw, drawn_points, edges, scene


class WholeFigure(go.FigureWidget):
    """A FigureWidget that reaches the page in one piece: plotly's own begins empty there and is told its data after
    that, which a page that loads faster than the kernel speaks never hears of.
    """

    _whole = False

    def __init__(self, figure: go.Figure):
        super().__init__(figure)
        self._config, self._whole = self._config | {"displaylogo": False}, True
        self.open()

    def open(self) -> None:
        """Opens the way to the page, once there is all to send."""
        if self._whole:
            super().open()


class Canvas:
    """A row of clouds, or of meshes where faces are given, in one figure, `canvas.view`.

    `points` as for plots.shapes; `ghosts` maps the place of a shape to another cloud, drawn faintly behind it, `boxes`
    to corners (p, 8, 3) whose edges are drawn. There is room for the clouds `also`, and for movement: `room` 1.3 leaves
    30 %. Raises ValueError where things do not fit.
    """

    def __init__(
        self,
        points: Any,
        *,
        labels=None,
        titles=None,
        faces=None,
        ghosts=None,
        boxes=None,
        colours=None,
        also=(),
        room=1.0,
    ):
        shapes = clouds_of(points, "Canvas")
        behind = {index: cloud_of(ghost, "Canvas") for index, ghost in (ghosts or {}).items()}
        extremes = [cloud_of(each, "Canvas") for each in also]
        self._boxes = _corners(boxes or {}, len(shapes))
        extremes += [each.reshape(-1, 3) for each in self._boxes.values()]
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
        traces += [box_lines(self._row, self._boxes)] if self._boxes else []
        names = titles_of(titles, len(shapes), "Canvas")
        said = f"{len(shapes)} shapes that can be moved{': ' if names else ''}{', '.join(names)}."
        self.view = WholeFigure(scene(self._row, traces, names, said))

    def update(self, index: int, points: Any) -> None:
        """Moves the shape at `index` to new points (n, 3), as many as it had."""
        self.update_all({index: points})

    def update_all(self, moved: dict[int, Any], boxes: dict[int, Any] | None = None) -> None:
        """Moves several shapes at once, and boxes that were there, in one message to the browser.

        Raises ValueError where points or corners are not finite, or not as many as the shape has.
        """
        clouds = {index: cloud_of(points, "Canvas.update") for index, points in moved.items()}
        for index, points in clouds.items():
            if len(points) != self._sizes[index]:
                raise ValueError(
                    f"Canvas.update: shape {index} has {self._sizes[index]} points, got {len(points)}; "
                    "make a new Canvas for another shape"
                )
        self._boxes |= self._checked(boxes or {})
        with self.view.batch_update():
            if boxes:
                trace = self.view.data[-1]
                trace.x, trace.y, trace.z = edges(self._row, self._boxes)
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

    def _checked(self, boxes: dict[int, Any]) -> dict[int, np.ndarray]:
        """The boxes' corners, as many as each shape has."""
        framed = _corners(boxes, len(self._sizes))
        for index, corners in framed.items():
            count = len(self._boxes.get(index, ()))
            if len(corners) != count:
                raise ValueError(
                    f"Canvas.update: shape {index} has {count} boxes, got {len(corners)}; make a new Canvas for others"
                )
        return framed

    def _move(self, trace, index: int, points) -> None:
        kept = points if self._meshes[index] else points[drawn_points(len(points))]
        trace.x, trace.y, trace.z = self._row.place(kept, index)


def _corners(boxes: dict[int, Any], count: int) -> dict[int, np.ndarray]:
    checked = boxes_of([boxes.get(index) for index in range(count)], count, "Canvas")
    return {index: each for index, each in enumerate(checked) if each is not None}
