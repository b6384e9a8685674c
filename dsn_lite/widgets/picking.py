"""Picking a handle by name, part first, and a value for it."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import ipywidgets

from ..handles import BoxHandles

REACH = {"translation": (-0.5, 0.5), "scale": (0.5, 1.5)}  # Section 4.1: t - 0.5 to t + 0.5, and 0.5 s to 1.5 s
LOOK = {"style": {"description_width": "70px"}, "layout": {"width": "260px"}}


class HandlePicker(ipywidgets.VBox):
    """A list of parts, one of a part's handles, and a slider over the values that the paper gives a handle.

    `name`, such as leg_2.scale.y, and `value` can be read and set. on_pick is called when another handle is picked,
    after which `show` tells its value; on_slide when the value changes.
    """

    def __init__(self, handles: BoxHandles, on_pick: Callable[[Any], None], on_slide: Callable[[Any], None]):
        self._starts = dict(zip(handles.names, handles.z0.tolist(), strict=True))
        self.parts: dict[str, list[str]] = {}
        for name in handles.names:
            part, kind, axis = name.rsplit(".", 2)
            self.parts.setdefault(part, []).append(f"{kind}.{axis}")
        self.part = ipywidgets.Dropdown(options=_said(self.parts), description="part", **LOOK)
        self.handle = ipywidgets.Dropdown(options=_said(self.parts[self.part.value]), description="handle", **LOOK)
        self.slider = ipywidgets.FloatSlider(
            description="value",
            readout_format=".3f",
            tooltip="place or edge length along an axis of the part's box, arrow keys work",
            style={"description_width": "70px"},
            layout={"width": "530px"},
        )
        self._quiet, self._on_pick, self._on_slide = False, on_pick, on_slide
        self._shown: float | None = None  # what the slider was set to, until somebody moves it
        self.part.observe(self._part_picked, "value")
        self.handle.observe(self._told(on_pick), "value")
        self.slider.observe(self._slid, "value")
        super().__init__([ipywidgets.HBox([self.part, self.handle], layout={"flex_flow": "row wrap"}), self.slider])

    @property
    def name(self) -> str:
        """The handle that is picked."""
        return f"{self.part.value}.{self.handle.value}"

    @name.setter
    def name(self, name: str) -> None:
        if name not in self._starts:
            raise ValueError(
                f"HandlePicker.name: there is no handle {name!r}; it must be one of {', '.join(self._starts)}"
            )
        part, kind, axis = name.rsplit(".", 2)
        with self._quietly():
            self.part.value = part
            self.handle.value = f"{kind}.{axis}"
        self._on_pick(None)

    @property
    def value(self) -> float:
        """Where the slider stands."""
        return self.slider.value

    @value.setter
    def value(self, value: float) -> None:
        if not abs(value) < float("inf"):
            raise ValueError(f"HandlePicker.value: it must be a finite number, got {value}; see handles.z0")
        with self._quietly():
            self.show(value)
        self._on_slide(None)

    @property
    def row(self) -> int:
        """Which of the parts that have handles is picked."""
        return list(self.parts).index(self.part.value)

    def show(self, value: float) -> None:
        """Sets the slider to where the handle is, and its ends as far as the paper goes, or to the value."""
        start, kind = self._starts[self.name], self.name.split(".")[-2]
        low, high = (start + end if kind == "translation" else start * end for end in REACH[kind])
        low, high, self._shown = min(low, value), max(high, value), value
        with self._quietly(), self.slider.hold_sync():  # in pieces, the page would clip the value and send it back
            self.slider.min, self.slider.max = min(low, self.slider.min), max(high, self.slider.max)
            self.slider.value = value
            self.slider.min, self.slider.max, self.slider.step = low, high, (high - low) / 100

    def _slid(self, change: dict) -> None:
        """The slider moved; that the page rounds a value to its steps and sends it back is no move."""
        rounded = self._shown is not None and abs(change["new"] - self._shown) < 0.51 * self.slider.step
        if not self._quiet and not rounded:
            self._shown = None
            self._on_slide(change)

    def _part_picked(self, _change: Any) -> None:
        """Another part: its handles, the one of the same name if it has it."""
        names, before = self.parts[self.part.value], self.handle.value
        quiet, self._quiet = self._quiet, True
        self.handle.options = _said(names)
        self.handle.value = before if before in names else names[0]
        self._quiet = quiet
        self._told(self._on_pick)(None)

    def _told(self, callback: Callable[[Any], None]) -> Callable[[Any], None]:
        return lambda change: None if self._quiet else callback(change)

    @contextmanager
    def _quietly(self) -> Iterator[None]:
        """While it lasts, changes are not told."""
        before, self._quiet = self._quiet, True
        try:
            yield
        finally:
            self._quiet = before


def spoken(name: str) -> str:
    """The name of a part or a handle, in words."""
    return name.replace("_", " ").replace(".", " ")


def _said(names: Iterable[str]) -> list[tuple[str, str]]:
    """What a list shows, and what it means."""
    return [(spoken(name), name) for name in names]
