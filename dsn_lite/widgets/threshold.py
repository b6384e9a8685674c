"""A slider over the threshold of zero: what is left above it, curve by curve, and what each curve was paid with."""

from itertools import cycle
from typing import Any

import ipywidgets
import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ..plots.laws import LEGEND
from ..plots.look import FONT, GREY, LINES, PALETTE, dress
from .canvas import WholeFigure
from .guard import Notice

SYMBOLS = ("circle", "diamond", "square", "x")  # four against seven colours: no two of 28 curves look alike
STEPS = 20  # of the slider, for a factor of ten
Curves = dict[str, dict[float, float]]


class ThresholdSlider(ipywidgets.VBox):
    """Curves over thresholds, and each curve's value at the threshold of the slider against its cost.

    quantities: what is counted, of which one is shown and buttons choose, as {quantity: {curve: {threshold: value}}};
    costs: a number for each curve, in the unit that `cost` names. `threshold` can be read and set; `values` are those
    shown, between two thresholds in proportion to the logarithm. Raises ValueError where a curve has no cost or no two
    thresholds above 0, or where the threshold is not among them.
    """

    def __init__(self, quantities: dict[str, Curves], costs: dict[str, float], *, cost: str, threshold: float = 0.01):
        low, high = _ends(quantities, costs)
        self.quantities, self.costs, self.notice = quantities, costs, Notice()
        look = {"style": {"description_width": "90px"}, "layout": {"width": "620px"}, "readout_format": ".2g"}
        ends = {"min": np.log10(low), "max": np.log10(high), "step": 1 / STEPS}
        told = {"description": "threshold", "tooltip": "what counts as zero, arrow keys work"}
        self.slider = ipywidgets.FloatLogSlider(value=low, **told, **ends, **look)
        self.choice = ipywidgets.ToggleButtons(options=list(quantities), style={"button_width": "220px"})
        self.threshold = threshold
        self.view = WholeFigure(self._figure(cost))
        for control in (self.slider, self.choice):
            control.observe(self.notice.guard(self._draw), "value")
        choices = [self.choice] if len(quantities) > 1 else []
        super().__init__([self.view, self.slider, *choices, self.notice])

    @property
    def threshold(self) -> float:
        """What counts as zero."""
        return self.slider.value

    @threshold.setter
    def threshold(self, threshold: float) -> None:
        low, high = 10**self.slider.min, 10**self.slider.max
        if not low * (1 - 1e-9) <= threshold <= high * (1 + 1e-9):
            raise ValueError(
                f"ThresholdSlider: threshold must be between {low:g} and {high:g}, where the curves are, got "
                f"{threshold}; choose one there"
            )
        self.slider.value = threshold

    @property
    def curves(self) -> Curves:
        """Those of the quantity that is shown."""
        return self.quantities[self.choice.value]

    @property
    def values(self) -> dict[str, float]:
        """Of each curve, its value at the threshold."""
        return {name: _at(curve, self.threshold) for name, curve in self.curves.items()}

    def _figure(self, cost: str) -> go.Figure:
        figure = make_subplots(1, 2, shared_yaxes=True, column_widths=[0.56, 0.44], horizontal_spacing=0.05)
        for (name, curve), colour, symbol in zip(self.curves.items(), cycle(PALETTE), cycle(SYMBOLS)):
            mark = {"color": colour, "symbol": symbol, "size": 8}
            line = go.Scatter(x=list(curve), y=list(curve.values()), name=name, marker=mark, mode="lines+markers")
            figure.add_trace(line, 1, 1)
            paid = go.Scatter(x=[self.costs[name]], y=[self.values[name]], name=name, showlegend=False, mode="markers")
            figure.add_trace(paid.update(marker=mark | {"size": 14}), 1, 2)
        figure.add_vline(self.threshold, row=1, col=1, line={"color": GREY, "width": 3, "dash": "dash"})
        figure.update_xaxes(type="log", title="threshold of zero", exponentformat="power", dtick=1, row=1, col=1)
        figure.update_xaxes(title=cost, row=1, col=2)
        figure.update_xaxes(gridcolor=LINES, zeroline=False, linecolor=GREY)
        figure.update_yaxes(gridcolor=LINES, zeroline=False, range=self._range())
        figure.update_yaxes(title=self.choice.value, row=1, col=1)
        legend = LEGEND | {"font": {"size": FONT["size"] - 3}}
        figure.update_layout(legend=legend, margin={"l": 80, "r": 20, "t": 90, "b": 70})
        return dress(figure, self._said(cost), width=840, height=460)

    def _range(self) -> list[float]:
        """From zero to a little above the highest value of the quantity."""
        return [0.0, 1.05 * max(max(curve.values()) for curve in self.curves.values()) or 1.0]

    def _said(self, cost: str) -> str:
        told = ", ".join(f"{name} {value:.3g} for {self.costs[name]:.3g}" for name, value in self.values.items())
        return f"{self.choice.value} at a threshold of {self.threshold:.2g}, against {cost}: {told}."

    def _draw(self, _change: Any) -> None:
        with self.view.batch_update():
            lines, paid = self.view.data[::2], self.view.data[1::2]
            for line, mark, (name, curve) in zip(lines, paid, self.curves.items(), strict=True):
                line.y, mark.y = list(curve.values()), [self.values[name]]
            self.view.layout.shapes[0].update(x0=self.threshold, x1=self.threshold)
            self.view.layout.yaxis.update(title=self.choice.value, range=self._range())
            self.view.layout.yaxis2.range = self._range()


def _at(curve: dict[float, float], threshold: float) -> float:
    return float(np.interp(np.log10(threshold), np.log10(list(curve)), list(curve.values())))


def _ends(quantities: dict[str, Curves], costs: dict[str, float]) -> tuple[float, float]:
    """The thresholds that all curves reach. Raises ValueError where there is nothing to show."""
    for name, curve in ((name, curve) for curves in quantities.values() for name, curve in curves.items()):
        if name not in costs:
            raise ValueError(f"ThresholdSlider: every curve must have a cost, {name!r} has none; add it to costs")
        if len(curve) < 2 or sorted(curve) != list(curve) or min(curve) <= 0:
            raise ValueError(
                f"ThresholdSlider: a curve must have two thresholds or more, above 0 and rising, {name!r} has "
                f"{list(curve)[:4]}; the axis is logarithmic"
            )
    every = [curve for curves in quantities.values() for curve in curves.values()]
    if not every or len({tuple(curves) for curves in quantities.values()}) > 1:
        raise ValueError(
            f"ThresholdSlider: every quantity must have the same curves, at least one, got "
            f"{[list(curves) for curves in quantities.values()]}; leave the others out"
        )
    return max(min(curve) for curve in every), min(max(curve) for curve in every)
