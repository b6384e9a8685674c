"""A training to watch: a falling curve, and a table that learns to become another."""

import _thread
from pathlib import Path
from time import perf_counter
from typing import Any

import ipywidgets
import torch
from IPython.display import display

from ..chamfer import chamfer
from ..config import Config
from ..data import Shapes
from ..driving import train
from ..files import as_shapes
from ..plots import curve
from ..plots.look import GREEN, VERMILLION
from ..space import DeformSyncNet
from ..training import Record, Training
from .canvas import Canvas, WholeFigure
from .guard import Notice, hear_while_busy

SHARE = 0.015  # of the training's time may go into drawing
HINT = "The button ends the training and keeps the best weights so far, as the notebook's own stop button does."


class LiveTraining(ipywidgets.VBox):
    """Trains on `shapes` before the reader's eyes; `run()` shows the widget, trains and returns the DeformSyncNet.

    x and y, by default two held-out shapes far apart, are the source and the target that are shown. floor is the
    sampling floor, drawn in the curve. Raises ValueError where the shapes or the configuration cannot be trained.
    """

    def __init__(
        self, shapes: Any, config: Config | None = None, x: Any = None, y: Any = None, *, floor: float | None = None
    ):
        self.shapes = shapes if isinstance(shapes, Shapes) else as_shapes(shapes)  # which would read all of shards
        self.config, self.floor = config or Config(), floor
        self.config.check(self.shapes)
        own = _far_apart(self.shapes, self.config.seed)
        self._x = (own.points[0] if x is None else torch.as_tensor(x)).float()
        self._y = (own.points[1] if y is None else torch.as_tensor(y)).float()
        labels = own.labels if x is None else None
        labels = labels[0] if labels is not None and labels.ndim == 2 else labels
        titles = ["x moved towards y", "target y"]
        self.canvas = Canvas(
            [self._x, self._y],
            labels=[labels, None],
            titles=titles,
            ghosts={0: self._y},
            colours=[VERMILLION, GREEN],
            room=1.2,
        )
        self.curve, self.notice = WholeFigure(curve([], floor)), Notice()
        self.button = ipywidgets.Button(description="stop", disabled=True, icon="stop", tooltip=HINT)
        self.button.on_click(lambda _button: self.stop())
        self.history: list[Record] = []
        self._seconds_drawing, self._running, self.pictures = 0.0, False, 0
        super().__init__([self.curve, self.canvas.view, ipywidgets.HBox([self.button, self.notice])])

    def run(self, out: str | Path | None = None) -> DeformSyncNet:
        """Shows the widget, trains and returns the space with the best weights; `out` is a run folder to keep it in."""
        display(self)
        self.history, self._running, self.button.disabled = [], True, False
        hear_while_busy(self.button)
        self.notice.say(f"Starting. {HINT}")
        try:
            space = train(self.shapes, self.config, out=out, watch=self._watch)
        finally:
            how, self._running, self.button.disabled = "Done" if self._running else "Stopped", False, True
        self._draw(space)
        self.notice.say(f"{how}: {self._progress()}")
        return space

    def stop(self) -> None:
        """What the button does: interrupts the training as Ctrl-C does; without a running training, nothing."""
        if self._running:
            self._running, self.button.disabled = False, True
            _thread.interrupt_main()

    def _watch(self, training: Training, record: Record) -> None:
        self.history.append(record)
        if self._seconds_drawing > SHARE * record.seconds:
            return
        began = perf_counter()
        self._draw(training.space)
        self.notice.say(f"{self._progress()} {HINT}")
        self._seconds_drawing += perf_counter() - began

    @torch.no_grad()
    def _draw(self, space: DeformSyncNet) -> None:
        device = next(space.parameters()).device
        x, y = self._x.to(device), self._y.to(device)
        self.canvas.update(0, space.deform(x, y))
        drawn = curve(self.history)
        with self.curve.batch_update():
            for own, fresh in zip(self.curve.data, drawn.data, strict=True):
                own.x, own.y = fresh.x, fresh.y
        self.pictures += 1

    def _progress(self) -> str:
        if not self.history:
            return "there was no look at the validation shapes yet."
        last, best = self.history[-1], min(record.validation_cd for record in self.history)
        floor = f", {best / self.floor:.2f} times the sampling floor" if self.floor else ""
        return f"step {last.step}, {last.seconds:.0f} s, CD {last.validation_cd:.2e}, best {best:.2e}{floor}."


def _far_apart(shapes: Shapes, seed: int) -> Shapes:
    """The first shape held out, and the one among the first 16 that is farthest from it."""
    few = shapes[torch.arange(len(shapes))[shapes.rows(seed)[2]][:16]]
    farthest = int(chamfer(few.points[:1].expand_as(few.points), few.points).argmax())
    return few[torch.tensor([0, farthest])]
