"""One slider from x to y, and on to what the same vector does to z."""

from typing import Any

import ipywidgets
import torch

from ..plots.inputs import clouds_of, labels_of
from ..plots.look import BLUE, GREEN
from ..space import ActionSpace
from .canvas import Canvas
from .guard import Notice
from .movers import mover, shapes_like


class DeformationPath(ipywidgets.VBox):
    """x (+) t xy for t from 0 to 1 and beyond to 1.5, with the target y beside and faintly behind.

    Where z is given, z (+) t xy moves along: the same vector on another shape. `t` can be read and set. labels are
    those of x, z_labels those of z. Raises ValueError where shapes are not finite clouds.
    """

    def __init__(self, space: ActionSpace, x: Any, y: Any, z: Any = None, *, labels: Any = None, z_labels: Any = None):
        (x,), (y,) = shapes_like(space, x), shapes_like(space, y)
        moving = [x, *(shapes_like(space, z) if z is not None else [])]
        self._places = [0, 2][: len(moving)]
        self._move = [mover(space, each) for each in moving]
        with torch.no_grad():
            self._vector = space.vector(x, y)
        self.slider = ipywidgets.FloatSlider(
            max=1.5,
            step=0.02,
            description="t",
            layout={"width": "460px"},
            tooltip="share of the vector",
        )
        shapes = [x, y, *moving[1:]]
        titles = ["x moved by t · xy", "target y", "z moved by t · xy"][: len(shapes)]
        colours = [BLUE, GREEN, BLUE][: len(shapes)]
        farthest = [move(self.slider.max * self._vector) for move in self._move]
        marks = labels_of(
            [labels, None, z_labels][: len(shapes)], clouds_of(shapes, "DeformationPath"), "DeformationPath"
        )
        self.canvas = Canvas(shapes, labels=marks, titles=titles, ghosts={0: y}, colours=colours, also=farthest)
        self.notice = Notice()
        self.slider.observe(self.notice.guard(self._draw), "value")
        super().__init__([self.canvas.view, self.slider, self.notice])

    @property
    def t(self) -> float:
        """Share of the vector that is shown."""
        return self.slider.value

    @t.setter
    def t(self, t: float) -> None:
        self.slider.value = t

    def _draw(self, _change: Any) -> None:
        v = self.t * self._vector
        self.canvas.update_all({place: move(v) for place, move in zip(self._places, self._move, strict=True)})
