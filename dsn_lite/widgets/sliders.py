"""A slider for each column of a deformation dictionary."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import ipywidgets
import torch
from torch import Tensor

from ..plots.inputs import clouds_of, labels_of
from ..plots.look import BLUE, GREEN
from ..space import ActionSpace
from .canvas import Canvas
from .guard import Notice
from .movers import mover, shapes_like

PAGE, MOST = 8, 32  # sliders to be seen at once, and sliders there are unless columns are named


class DictionarySliders(ipywidgets.VBox):
    """x (+) v with a slider for each column of A; several shapes x share one v, each moved by its own dictionary.

    `v` can be read and set. columns: which ones, in this order; else at most 32, those first that `vectors` (N, k) use
    most, such as the codes of a collection, or those that xy uses most. Sliders reach to `span` either way, else to two
    standard deviations of the vectors, else to a quarter of the size of x. With y the target is shown beside x and
    faintly behind it, and a button goes there. Raises ValueError where something does not fit.
    """

    def __init__(
        self,
        space: ActionSpace,
        x: Any,
        columns: Sequence[int] | None = None,
        span: float | None = None,
        y: Any = None,
        *,
        vectors: Any = None,
        labels: Any = None,
        titles: Any = None,
    ):
        if not hasattr(space, "dictionary"):
            raise ValueError(
                f"DictionarySliders: the space must have a dictionary, {type(space).__name__} has none; "
                "use DeformationPath for it"
            )
        shapes, targets = shapes_like(space, x), [] if y is None else shapes_like(space, y)[:1]
        self._move = [mover(space, each) for each in shapes]
        with torch.no_grad():
            self._v = shapes[0].new_zeros(space.dictionary(shapes[0]).shape[-1])
            self._goal = space.vector(shapes[0], targets[0]) if targets else None
        marks = [
            *labels_of(labels, clouds_of(shapes, "DictionarySliders"), "DictionarySliders"),
            *(None for _ in targets),
        ]
        ghosts = {0: targets[0]} if targets else None
        colours = [*(BLUE for _ in shapes), *(GREEN for _ in targets)]
        every = [*shapes, *targets]
        self.canvas = Canvas(every, labels=marks, titles=titles, ghosts=ghosts, colours=colours, room=1.3)
        self.notice, self._generator, self._quiet = Notice(), torch.Generator().manual_seed(0), False
        self._reaches = self._reach(span, vectors, shapes[0]).tolist()
        self.sliders = {j: self._slider(j, self._reaches[j]) for j in self._order(columns, vectors)}
        super().__init__([self.canvas.view, self._buttons(), self._pages(), self.notice])

    @property
    def v(self) -> Tensor:
        """The vector (k,) that is shown; setting it moves the sliders and the shapes."""
        return self._v.clone()

    @v.setter
    def v(self, v: Any) -> None:
        v = torch.as_tensor(v).detach().to(self._v)
        if v.shape != self._v.shape or not v.isfinite().all():
            raise ValueError(
                f"DictionarySliders.v: v must be {len(self._v)} finite numbers, got shape {tuple(v.shape)}; "
                "use space.vector(x, y)"
            )
        self._v = v.clone()
        self._quiet = True  # all sliders first, then one picture
        for j, slider in self.sliders.items():
            value = float(v[j])
            slider.min, slider.max = min(slider.min, value), max(slider.max, value)
            slider.value = value
        self._quiet = False
        self._draw()

    def _draw(self) -> None:
        self.canvas.update_all({index: move(self._v) for index, move in enumerate(self._move)})

    def _slid(self, j: int, change: dict) -> None:
        if not self._quiet:
            self._v[j] = change["new"]
            self._draw()

    def _reach(self, span: float | None, vectors: Any, x: Tensor) -> Tensor:
        """How far each slider goes."""
        if span is not None:
            if not 0 < span < float("inf"):
                raise ValueError(
                    f"DictionarySliders: span must be a number above 0, got {span}; leave it out for the default"
                )
            return torch.full_like(self._v, span)
        if vectors is not None:
            spread = self._spread(vectors)
            return 2 * spread.clamp_min(0.05 * float(spread.max()) + 1e-6)
        return torch.full_like(self._v, 0.25 * float((x.amax(0) - x.amin(0)).max()))

    def _order(self, columns: Sequence[int] | None, vectors: Any) -> list[int]:
        """The columns that get a slider, in their order."""
        k = len(self._v)
        if columns is not None:
            if not len(columns) or not set(columns) <= set(range(k)):
                raise ValueError(
                    f"DictionarySliders: columns must lie in 0 ... {k - 1}, got {tuple(columns)}; A has k = {k}"
                )
            return list(columns)
        use = self._spread(vectors) if vectors is not None else self._goal
        order = range(k) if use is None else use.abs().argsort(descending=True, stable=True).tolist()
        return list(order)[:MOST]

    def _spread(self, vectors: Any) -> Tensor:
        vectors = torch.as_tensor(vectors).detach()
        if vectors.shape[1:] != self._v.shape or len(vectors) < 2 or not vectors.isfinite().all():
            raise ValueError(
                f"DictionarySliders: vectors must be finite (N, {len(self._v)}) with N > 1, "
                f"got {tuple(vectors.shape)}; use space.encode of a collection"
            )
        return vectors.std(0).to(self._v)

    def _slider(self, j: int, reach: float) -> ipywidgets.FloatSlider:
        slider = ipywidgets.FloatSlider(
            min=-reach,
            max=reach,
            step=reach / 50,
            description=f"column {j}",
            readout_format="+.2f",
            tooltip=f"how much of column {j} of the dictionary, arrow keys work",
            style={"description_width": "90px"},
            layout={"width": "460px"},
        )
        slider.observe(self.notice.guard(partial(self._slid, j)), "value")
        return slider

    def _buttons(self) -> ipywidgets.HBox:
        steps = {"reset": self._reset, "random": self._random} | (
            {"x to y": self._go} if self._goal is not None else {}
        )
        buttons = [ipywidgets.Button(description=name, layout={"width": "110px"}) for name in steps]
        for button, step in zip(buttons, steps.values(), strict=True):
            button.on_click(self.notice.guard(step))
        return ipywidgets.HBox(buttons)

    def _pages(self) -> ipywidgets.VBox:
        """Eight sliders, and, where there are more, a choice of which eight."""
        rows, order = ipywidgets.VBox(), list(self.sliders.values())
        pages = {f"{i + 1} to {min(i + PAGE, len(order))}": order[i : i + PAGE] for i in range(0, len(order), PAGE)}
        choice = ipywidgets.Dropdown(
            options=pages, description=f"of {len(order)}:", style={"description_width": "90px"}
        )
        choice.observe(self.notice.guard(lambda change: setattr(rows, "children", change["new"])), "value")
        rows.children = order[:PAGE]
        return ipywidgets.VBox([rows, choice] if len(pages) > 1 else [rows])

    def _reset(self, _button: Any) -> None:
        self.v = torch.zeros_like(self._v)

    def _random(self, _button: Any) -> None:
        """A random vector on the sliders, half their reach being one standard deviation, as it is in the vectors."""
        drawn, v = torch.randn(len(self._v), generator=self._generator), torch.zeros_like(self._v)
        for j in self.sliders:
            v[j] = drawn[j].item() * self._reaches[j] / 2
        self.v = v

    def _go(self, _button: Any) -> None:
        self.v = self._goal
