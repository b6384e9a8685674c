"""A gallery: a shape of any family, with a slider for each of its parameters."""

from collections.abc import Callable, Mapping
from html import escape
from itertools import product
from typing import Any

import ipywidgets
import numpy as np

from .canvas import Canvas
from .guard import Notice

CUBE = np.array(list(product((-0.5, 0.5), repeat=3)))  # families lie in it, so that sizes compare


class FamilySliders(ipywidgets.VBox):
    """A shape of one of many families, chosen from a list, with a slider for each of its parameters.

    rigs are families by name, as data_gen has them: `parameters` (name, low, high, meaning, unit), `middle` and `draw`,
    `vertices` of parameters (N, p), `triangles`, `triangle_part` and `part_names`. colours(name) gives (P, 3), 0 to
    255, one a part. `family` and `values` can be read and set; the first family is shown first.
    """

    def __init__(self, rigs: Mapping[str, Any], colours: Callable[[str], Any]):
        self._rigs, self._colours, self._quiet = dict(rigs), colours, False
        self._generator = np.random.default_rng(0)
        self.choice = ipywidgets.Dropdown(options=list(self._rigs), description="family")
        self.sliders, self._rows, self._key, self.notice = {}, ipywidgets.VBox(), ipywidgets.HTML(), Notice()
        first = self._rigs[self.family]
        self.canvas = Canvas([first.vertices(first.middle)[0]], faces=first.triangles, also=[CUBE])
        self._choose()
        self.choice.observe(self.notice.guard(lambda _change: self._choose()), "value")
        panel = ipywidgets.VBox([self.choice, self._buttons(), self._rows, self.notice])
        beside = ipywidgets.HBox([self.canvas.view, panel], layout={"flex_flow": "row wrap"})
        super().__init__([beside, self._key])

    @property
    def family(self) -> str:
        """Name of the family that is shown."""
        return self.choice.value

    @family.setter
    def family(self, name: str) -> None:
        self.choice.value = name

    @property
    def values(self) -> dict[str, float]:
        """The parameters that are shown, by name; setting some leaves the others."""
        return {name: slider.value for name, slider in self.sliders.items()}

    @values.setter
    def values(self, values: Mapping[str, float]) -> None:
        self._quiet = True  # all sliders first, then one picture
        for name, value in values.items():
            self.sliders[name].value = value
        self._quiet = False
        self._draw()

    def _choose(self) -> None:
        """Another family: new sliders, all in the middle, and a new mesh."""
        rig, colours = self._rigs[self.family], np.asarray(self._colours(self.family))
        self.canvas.replace(0, rig.vertices(rig.middle)[0], rig.triangles, colours[rig.triangle_part])
        self._key.value = " &ensp; ".join(map(_named, rig.part_names, colours.tolist()))
        earlier, self.sliders = self.sliders, {one.name: self._slider(one) for one in rig.parameters}
        self._rows.children = list(self.sliders.values())
        for slider in earlier.values():
            slider.close()

    def _slider(self, parameter: Any) -> ipywidgets.FloatSlider:
        slider = ipywidgets.FloatSlider(
            value=(parameter.low + parameter.high) / 2,
            min=parameter.low,
            max=parameter.high,
            step=(parameter.high - parameter.low) / 100,
            description=parameter.name.replace("_", " "),
            tooltip=f"{parameter.meaning}, in {parameter.unit}; arrow keys work",
            style={"description_width": "150px"},
            layout={"width": "520px"},
            readout_format=".3f",
        )
        slider.observe(self.notice.guard(lambda _change: self._draw()), "value")
        return slider

    def _draw(self) -> None:
        if not self._quiet:
            values = np.array([list(self.values.values())])
            self.canvas.update(0, self._rigs[self.family].vertices(values)[0])

    def _buttons(self) -> ipywidgets.HBox:
        buttons = {
            name: ipywidgets.Button(description=name, layout={"width": "110px"}) for name in ("middle", "random")
        }
        buttons["middle"].on_click(self.notice.guard(lambda _button: self._go(self._rigs[self.family].middle)))
        drawn = lambda _button: self._go(self._rigs[self.family].draw(1, self._generator))
        buttons["random"].on_click(self.notice.guard(drawn))
        return ipywidgets.HBox(list(buttons.values()))

    def _go(self, parameters: Any) -> None:
        self.values = dict(zip(self.sliders, parameters[0].tolist(), strict=True))


def _named(part: str, colour: list[int]) -> str:
    """A part's name after its colour."""
    square = f"<span style='color:rgb{tuple(colour)}'>&#9632;</span>"
    return f"<span style='white-space:nowrap'>{square} {escape(part.replace('_', ' '))}</span>"
